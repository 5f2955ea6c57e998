#ifndef tribodraw_friction_table_monotone_curve_h
#define tribodraw_friction_table_monotone_curve_h

#include <vector>

namespace tribodraw
{
  /// Piecewise cubic through given points that is monotone wherever the points are (Fritsch and Carlson 1980): no value
  /// outside those of the two neighbours. Constant outside the points.
  class MonotoneCurve
  {
  public:
    /// @param x strictly ascending, at least one point.
    MonotoneCurve(std::vector<double> x, std::vector<double> y);
    double operator()(double x) const;

  private:
    std::vector<double> x, y, slope;
  };
} // namespace tribodraw

#endif
