#include "friction_fit.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/output/friction_export.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace tribodraw
{
  class Parameters;

  namespace
  {
    /// One of the program's formulas with the constants of the card: C1 ... C6, FRIC.
    struct Candidate
    {
      int                   form = 0;
      FrictionFit           fit;
      std::array<double, 7> card{}; // C1 ... C6, FRIC
    };

    constexpr double steepest = 20; // of the exponentials over the range of speeds

    /// I_fric = 1: mu = FRIC + C1 p + C2 v + C3 p v + C4 p^2 + C5 v^2
    Candidate
    polynomial(const CoefficientTable &table)
    {
      const FrictionFormula formula{ [](const double p, const double v, const std::vector<double> &) {
                                      return std::vector<double>{ 1., p, v, p * v, p * p, v * v };
                                    },
                                     0, 0., 0. };
      const double p = pressure_scale(table), v = speed_scale(table);
      Candidate    c{ 1, fit_friction(table, formula), {} };
      const auto  &k = c.fit.constants;
      c.card         = { k[1] / p, k[2] / v, k[3] / (p * v), k[4] / (p * p), k[5] / (v * v), 0., k[0] };
      return c;
    }

    /// I_fric = 2: mu = FRIC + C1 exp(C2 v) p^2 + C3 exp(C4 v) p + C5 exp(C6 v)
    Candidate
    exponential(const CoefficientTable &table)
    {
      const FrictionFormula formula{
        [](const double p, const double v, const std::vector<double> &e) {
          return std::vector<double>{ 1., std::exp(e[0] * v) * p * p, std::exp(e[1] * v) * p, std::exp(e[2] * v) };
        },
        3, -steepest, 0.
      };
      const double p = pressure_scale(table), v = speed_scale(table);
      Candidate    c{ 2, fit_friction(table, formula), {} };
      const auto  &k = c.fit.constants, &e = c.fit.exponents;
      c.card = { k[1] / (p * p), e[0] / v, k[2] / p, e[1] / v, k[3], e[2] / v, k[0] };
      return c;
    }

    /// I_fric = 4: mu = C1 + (FRIC - C1) exp(-C2 v)
    Candidate
    decay(const CoefficientTable &table)
    {
      const FrictionFormula formula{ [](double, const double v, const std::vector<double> &e) {
                                      return std::vector<double>{ 1., std::exp(e[0] * v) };
                                    },
                                     1, -steepest, 0. };
      Candidate   c{ 4, fit_friction(table, formula), {} };
      const auto &k = c.fit.constants;
      c.card        = { k[0], -c.fit.exponents[0] / speed_scale(table), 0., 0., 0., 0., k[0] + k[1] };
      return c;
    }

    /// /FRICTION with the formula that is nearest to the table.
    class OpenRadiossExport : public FrictionExport
    {
    public:
      explicit OpenRadiossExport(Parameters &) {}
      std::string
      file_ending() const override
      {
        return "_openradioss.rad";
      }
      std::string
      text(const CoefficientTable &table, const FrictionExportSettings &settings) const override
      {
        Candidate best;
        best.fit.max = 1e300;
        for (const Candidate &candidate : { polynomial(table), exponential(table), decay(table) })
          if (candidate.fit.smallest > 0 && candidate.fit.max < best.fit.max * (1. - 1e-6))
            best = candidate;
        if (!(best.fit.max <= settings.max_error))
          throw InputError(describe_error(
              "No friction formula of OpenRadioss comes near enough to the table", "tribodraw export, " + settings.name,
              best.form == 0 ? "all fits become negative" : "greatest difference " + units::number(best.fit.max),
              "up to " + units::number(settings.max_error),
              "Narrow the pressures and speeds of the table to those of the process, or allow more with --max-error."));
        return card(best, table, settings);
      }

    private:
      static std::string
      card(const Candidate &c, const CoefficientTable &table, const FrictionExportSettings &settings)
      {
        char title[200];
        std::snprintf(title, sizeof title, "%s rms %.4f max %.4f p %g-%g MPa v %g-%g mm/s", settings.name.c_str(),
                      c.fit.rms, c.fit.max, table.pressures.front(), table.pressures.back(), table.speeds.front(),
                      table.speeds.back());
        std::string result
            = "# Friction table " + settings.name + ", fitted by tribodraw. Units: mm, N, MPa, s (tonne).\n";
        if (!settings.note.empty())
          result += "# " + settings.note + "\n";
        result += "# Outside the stated range the formula extrapolates and may leave the table far behind.\n";
        result += std::string("/FRICTION/1\n") + title + "\n#   I_fric   I_filtr              X_freq    I_form\n";
        char text[160];
        std::snprintf(text, sizeof text, "%10d%10d%20.10g%10d\n", c.form, 0, 0., 2);
        result += text;
        result
            += "#                 C1                  C2                  C3                  C4                  C5\n";
        for (int i = 0; i < 5; ++i)
          result += field(c.card[i]);
        result += "\n#                 C6                FRIC               VIS_f\n";
        return result + field(c.card[5]) + field(c.card[6]) + field(1.) + "\n";
      }

      static std::string
      field(const double value)
      {
        char text[32];
        std::snprintf(text, sizeof text, "%20.10E", value);
        return text;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FrictionExport, OpenRadiossExport, "openradioss",
                     "/FRICTION with the nearest of three formulas; the errors of the fit stand in its title.",
                     "OpenRadioss reference guide, /FRICTION")
} // namespace tribodraw
