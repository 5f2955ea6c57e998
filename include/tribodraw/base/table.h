#ifndef tribodraw_base_table_h
#define tribodraw_base_table_h

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace tribodraw
{
  /// How an axis is interpolated: linear in the coordinate or in its logarithm.
  enum class AxisScale { linear, logarithmic };

  /// A strictly increasing axis of a rectilinear table.
  struct Axis
  {
    std::vector<double> points;
    AxisScale           scale = AxisScale::linear;

    struct Location
    {
      std::size_t cell;             ///< interval [cell, cell+1]
      double      weight;           ///< of the upper point, 0..1 (clamped)
      double      weight_derivative; ///< d weight / d coordinate (0 when clamped)
      bool        outside;
    };
    /// Find the interval of @p x; values outside are clamped to the ends and reported.
    Location locate(double x) const;
    /// Throws InputError naming @p name unless points are finite and strictly increasing (positive if logarithmic).
    void check(const std::string &name) const;
  };

  /// Rectilinear table of dimension N, multilinear interpolation, clamped outside.
  /// Values are stored with the last axis running fastest.
  template <int N>
  class Table
  {
  public:
    Table() = default;
    Table(std::array<Axis, N> axes, std::vector<double> values);

    double value(const std::array<double, N> &x) const;
    /// Value and gradient with respect to the coordinates.
    double value(const std::array<double, N> &x, std::array<double, N> &gradient) const;
    bool   outside(const std::array<double, N> &x) const;

    const std::array<Axis, N>   &axes() const { return axis; }
    const std::vector<double>   &values() const { return data; }
    bool                         empty() const { return data.empty(); }

  private:
    std::array<Axis, N> axis;
    std::vector<double> data;
  };
} // namespace tribodraw

#endif
