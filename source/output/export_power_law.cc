#include "friction_fit.h"

#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/output/friction_export.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  class Parameters;

  namespace
  {
    /// mu = mu0 (p/p_ref)^(e-1) - a ln(max(v, v_ref)/v_ref), with p_ref and v_ref from the range of the table.
    class PowerLawExport : public FrictionExport
    {
    public:
      explicit PowerLawExport(Parameters &) {}
      std::string
      file_ending() const override
      {
        return "_power-law.csv";
      }
      std::string
      text(const CoefficientTable &table, const FrictionExportSettings &settings) const override
      {
        const double p_ref = std::sqrt(table.pressures.front() * table.pressures.back());
        const auto   first = std::upper_bound(table.speeds.begin(), table.speeds.end(), 0.);
        const double v_ref = first == table.speeds.end() ? 1. : *first;
        const double p = pressure_scale(table), v = speed_scale(table);

        const FrictionFormula formula{ [=](const double ps, const double vs, const std::vector<double> &e) {
                                        return std::vector<double>{ std::pow(ps * p / p_ref, e[0] - 1.),
                                                                    -std::log(std::max(vs * v, v_ref) / v_ref) };
                                      },
                                       1, 0., 2. };
        const FrictionFit fit = fit_friction(table, formula);
        if (!(fit.max <= settings.max_error) || !(fit.smallest > 0))
          throw InputError(describe_error(
              "The power law does not come near enough to the table", "tribodraw export, " + settings.name,
              fit.smallest > 0 ? "greatest difference " + units::number(fit.max) : "the fit becomes negative",
              "up to " + units::number(settings.max_error),
              "Narrow the pressures and speeds of the table to those of the process, or allow more with --max-error."));
        CsvTable csv({ "quantity", "value", "unit" });
        csv.add_row({ "mu0", fit.constants[0], "1" });
        csv.add_row({ "p_ref", p_ref, "MPa" });
        csv.add_row({ "e", fit.exponents[0], "1" });
        csv.add_row({ "a", fit.constants[1], "1" });
        csv.add_row({ "v_ref", v_ref, "mm/s" });
        csv.add_row({ "fit_rms", fit.rms, "1" });
        csv.add_row({ "fit_max", fit.max, "1" });
        csv.add_row({ "p_min", table.pressures.front(), "MPa" });
        csv.add_row({ "p_max", table.pressures.back(), "MPa" });
        csv.add_row({ "v_min", table.speeds.front(), "mm/s" });
        csv.add_row({ "v_max", table.speeds.back(), "mm/s" });
        return csv.text();
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FrictionExport, PowerLawExport, "power-law",
                     "Constants of mu = mu0 (p/p_ref)^(e-1) - a ln(max(v, v_ref)/v_ref) with the errors of the fit.",
                     "form of the friction law after Filzek, as entered in AutoForm")
} // namespace tribodraw
