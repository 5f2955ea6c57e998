#ifndef tribodraw_output_comparison_h
#define tribodraw_output_comparison_h

#include <tribodraw/output/measured_table.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tribodraw
{
  /// A measured curve beside the computed one, over the same abscissa.
  struct CurveComparison
  {
    std::string abscissa, quantity; ///< names of the computed columns
    /// In the units of the computed columns. Measured points in rising order; those the machine took while it stood still or
    /// went back are left out.
    std::vector<double> measured_x, measured_y, computed_x, computed_y;
    std::size_t         left_out = 0; ///< measured points that were not taken

    // Over the range that both curves cover, at the measured points:
    std::size_t points = 0;
    double      from = 0, to = 0;
    double      rms     = 0; ///< root of the mean square of computed minus measured
    double      mean    = 0; ///< of computed minus measured
    double      largest = 0; ///< of computed minus measured, by magnitude, with its sign
    double      largest_at = 0;
    double      measured_peak = 0, computed_peak = 0;
    double      measured_area = 0, computed_area = 0; ///< trapezoidal rule: the work, for force over travel

    /// rms over the greatest magnitude of the measured values in the range
    double relative_rms() const;
  };

  /// Compare two curves. Throws InputError if fewer than two measured points lie in the range of the computed curve.
  CurveComparison compare_curves(const MeasuredTable::Column &measured_x, const MeasuredTable::Column &measured_y,
                                 const MeasuredTable::Column &computed_x, const MeasuredTable::Column &computed_y);

  /// Compare a measurement with a CSV file of an output folder.
  /// @param pairs names (measured, computed), the abscissa first; empty: columns that have the same name but for the unit at
  /// its end, with the first of them as abscissa.
  /// The computed columns are looked for in history.csv and then in the other CSV files in alphabetical order.
  std::vector<CurveComparison> compare_with_run(const MeasuredTable                                    &measured,
                                                const std::filesystem::path                            &folder,
                                                const std::vector<std::pair<std::string, std::string>> &pairs);

  /// Name of a column as one reads it: `punch_force_n` -> "Punch force / N".
  std::string spoken_column(const std::string &column);

  /// Write compare.csv and one figure compare_QUANTITY.svg and .png for each curve into the folder.
  void write_comparison(const std::vector<CurveComparison> &curves, const std::filesystem::path &folder);
} // namespace tribodraw

#endif
