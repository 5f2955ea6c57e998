#ifndef tribodraw_fluid_amount_map_h
#define tribodraw_fluid_amount_map_h

#include <tribodraw/base/table.h>

#include <array>
#include <filesystem>
#include <string>

namespace tribodraw
{
  /// Amount of lubricant over the blank as measured, on each face: a map on a rectangular grid or a traverse along one
  /// direction (constant along the other), linear between the points.
  class AmountMap
  {
  public:
    /// CSV with one or both of the columns `x_mm` and `y_mm` (origin in the middle of the blank, x along the rolling
    /// direction) and either `amount_g_per_m2` for both faces or `amount_punch_g_per_m2` and `amount_die_g_per_m2`.
    /// Throws InputError naming file, line and column for anything else.
    static AmountMap read(const std::filesystem::path &file);

    /// @param face 0: punch side, 1: die side. Throws InputError where the map does not reach.
    /// @return [t/mm^2]
    double at(unsigned face, double x, double y) const;
    /// Largest relative difference between points that a quarter model takes as one (x and -x, y and -y).
    double asymmetry() const;

  private:
    std::string             name;
    std::array<Table<2>, 2> amount; // over x and y; a direction without column has one point
  };
} // namespace tribodraw

#endif
