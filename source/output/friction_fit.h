#ifndef tribodraw_source_output_friction_fit_h
#define tribodraw_source_output_friction_fit_h

#include <tribodraw/friction_table/coefficient_table.h>

#include <functional>
#include <string>
#include <vector>

namespace tribodraw
{
  /// A formula mu(p, v) with constants that enter linearly and exponents that do not.
  struct FrictionFormula
  {
    /// The functions that are multiplied by the constants, at scaled pressure and speed (0 to 1) for given exponents.
    std::function<std::vector<double>(double p, double v, const std::vector<double> &exponents)> terms;
    std::size_t                                                                                  n_exponents = 0;
    double lowest = 0, highest = 0; ///< range of the exponents
  };

  struct FrictionFit
  {
    std::vector<double> constants, exponents; ///< for scaled pressure and speed
    double              rms = 0, max = 0;     ///< differences from the table
    double              smallest = 0;         ///< value of the formula in the range of the table
  };

  /// Least squares over all points of a table with one strain: linear for the constants, a search over the exponents
  /// (coarse grid, then ever smaller steps). The same input gives the same bits.
  FrictionFit fit_friction(const CoefficientTable &table, const FrictionFormula &formula);

  /// Greatest pressure and speed, by which they are scaled (1 where all speeds are zero).
  double pressure_scale(const CoefficientTable &table);
  double speed_scale(const CoefficientTable &table);
} // namespace tribodraw

#endif
