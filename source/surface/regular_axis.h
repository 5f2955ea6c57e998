#ifndef tribodraw_source_surface_regular_axis_h
#define tribodraw_source_surface_regular_axis_h

#include <cstddef>
#include <optional>
#include <vector>

namespace tribodraw
{
  /// Equally spaced positions: first + i pitch, i = 0 ... n - 1.
  struct RegularAxis
  {
    double      first = 0, pitch = 0;
    std::size_t n = 0;

    /// Index of the position nearest to @p coordinate.
    std::size_t index(double coordinate) const;
    /// Distance to that position over the pitch.
    double deviation(double coordinate) const;
  };

  /// Finds the axis on which scattered coordinates lie. Coordinates come in any order, repeated, with gaps, and rounded
  /// to few digits: a deviation of 1 % of the pitch is allowed.
  class AxisFinder
  {
  public:
    void add(double coordinate);

    /// The axis, or nothing if the coordinates do not lie on one.
    std::optional<RegularAxis> find();
    /// Number of coordinates that differ (by 1e-8 of their range).
    std::size_t n_different();

  private:
    void compact();

    std::vector<double> values;
    bool                too_many = false;
    bool                sorted   = false;
  };
} // namespace tribodraw

#endif
