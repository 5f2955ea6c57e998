#ifndef tribodraw_friction_table_coefficient_table_h
#define tribodraw_friction_table_coefficient_table_h

#include <tribodraw/base/csv.h>
#include <tribodraw/base/table.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <vector>

namespace tribodraw
{
  class FrictionTable;

  /// Friction coefficient over nominal pressure [MPa], sliding speed [mm/s] and equivalent plastic strain: what other
  /// forming programs take. Made by a strip draw, or from a friction table for contacts without lubricant pressure.
  class CoefficientTable
  {
  public:
    std::vector<double> pressures, speeds, strains; ///< ascending, at least one each
    std::vector<double> values;                     ///< mu[(i_pressure * n_speeds + i_speed) * n_strains + i_strain]
    nlohmann::json      provenance;                 ///< conditions, inputs, program

    double
    operator()(const std::size_t pressure, const std::size_t speed, const std::size_t strain) const
    {
      return values[(pressure * speeds.size() + speed) * strains.size() + strain];
    }

    /// Boundary friction alone (no lubricant pressure, any speed): the monotone look-up of a friction table.
    static CoefficientTable from(const FrictionTable &table);

    /// The same with one strain: the value at @p strain (linear between the points), which must lie in the range.
    CoefficientTable at_strain(double strain) const;
    /// The same with one strain: the mean over the range of strains.
    CoefficientTable mean_over_strain() const;
    /// Greatest difference between the values of one pressure and speed over the strains, and their mean over strain.
    double strain_deviation() const;

    /// Throws InputError naming the first inconsistency.
    void check(const std::string &name) const;

    void                    write(const std::filesystem::path &json_file, const std::filesystem::path &csv_file) const;
    nlohmann::json          to_json() const;
    static CoefficientTable from_json(const nlohmann::json &json, const std::string &name);
    /// Reads a file of coefficients, or a friction table (then see from()).
    static CoefficientTable read(const std::filesystem::path &json_file);
    /// `pressure_mpa,speed_mm_per_s,eps_p,mu`
    CsvTable csv() const;
  };
} // namespace tribodraw

#endif
