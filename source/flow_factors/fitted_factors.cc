#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/flattening/height_distribution.h>
#include <tribodraw/flow_factors/fitted_factors.h>
#include <tribodraw/surface/autocorrelation.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace tribodraw
{
  namespace
  {
    // Peklenik number of a map. A lay that does not decay within the map counts as the longest for which
    // coefficients exist.
    double
    measured_gamma(const HeightMap &map, const std::string &which)
    {
      const Autocorrelation autocorrelation(map);
      constexpr double      half = 0.5, right_angle = 1.57079632679489662;
      const auto            along = autocorrelation.decay_length(0, half),
                 across           = autocorrelation.decay_length(right_angle, half);
      if (!along && !across)
        throw InputError(describe_error("The autocorrelation function of the " + which + " does not fall to 0.5",
                                        "flow factors", "", "in at least one direction",
                                        "Set 'Anisotropy = given' and state the ratios of correlation lengths."));
      if (!along || !across)
        return along ? 1 / largest_gamma : largest_gamma;
      return *along / *across;
    }

    double
    mean_square(const HeightMap &map)
    {
      double mean = 0, square = 0;
      for (const double z : map.z)
        mean += z / static_cast<double>(map.z.size());
      for (const double z : map.z)
        square += (z - mean) * (z - mean) / static_cast<double>(map.z.size());
      return square;
    }
  } // namespace

  double
  limited_gamma(const double gamma)
  {
    return std::clamp(gamma, 1 / largest_gamma, largest_gamma);
  }

  FittedFactors::FittedFactors(Parameters &parameters)
  {
    measured = parameters.choice(
                   "Anisotropy", { "measured", "given" },
                   "Ratio gamma of the correlation lengths along x and y. `measured`: from the lags at which the "
                   "autocorrelation of the maps falls to 0.5. `given`: by the next entries.",
                   Default{ "measured", "belongs to the surfaces at hand" })
               == "measured";
    const struct
    {
      const char *entry;
      double     &value;
      const char *what;
    } entries[]
        = { { "Gap gamma", given.gap, "gamma of the sum of both heights, for the pressure factor." },
            { "Sheet gamma", given.sheet, "gamma of the sheet, for the shear factor." },
            { "Tool gamma", given.tool, "gamma of the tool, for the shear factor; without effect if it is smooth." } };
    for (const auto &e : entries)
      if (!measured || parameters.documentation_mode())
        e.value = parameters.quantity(e.entry, "", Range::positive().usual(1. / 20, 20), e.what);
      else
        parameters.mark_unselected(e.entry);
  }

  std::string
  FittedFactors::fingerprint() const
  {
    return law()
           + (measured ? std::string("; gamma measured")
                       : "; gamma " + units::number(given.gap) + ", " + units::number(given.sheet) + ", "
                             + units::number(given.tool));
  }

  FittedFactors::Ratios
  FittedFactors::ratios(const HeightMap &sheet, const HeightMap &tool, const HeightMap &sum) const
  {
    if (!measured)
      return given;
    Ratios result{ measured_gamma(sum, "gap"), 1, 1 };
    result.sheet = tool.z.empty() ? result.gap : measured_gamma(sheet, "sheet");
    if (!tool.z.empty() && mean_square(tool) > 0)
      result.tool = measured_gamma(tool, "tool");
    const auto text = [](const double g) { return units::number(std::round(1000 * g) / 1000); };
    log::info("Flow factors: ratio of correlation lengths along x and y: gap " + text(result.gap) + ", sheet "
              + text(result.sheet) + (tool.z.empty() ? "." : ", tool " + text(result.tool) + "."));
    return result;
  }

  std::vector<FlowFactors>
  FittedFactors::compute(const HeightMap &sheet, const HeightMap &tool, const double sq_reference,
                         const std::vector<double> &cut_heights, const std::function<void(double)> &progress) const
  {
    if (!tool.z.empty() && (tool.nx != sheet.nx || tool.ny != sheet.ny))
      throw InputError(describe_error("The maps of sheet and tool have different grids", "flow factors"));
    if (!(sq_reference > 0))
      throw InputError(describe_error("Published flow factors need a rough surface", "flow factors"));
    HeightMap sum = sheet;
    for (std::size_t i = 0; i < tool.z.size(); ++i)
      sum.z[i] += tool.z[i];
    const HeightDistribution distribution(sum);
    const Ratios             gamma  = ratios(sheet, tool, sum);
    const double             square = sq_reference * sq_reference, share_sheet = mean_square(sheet) / square,
                 share_tool = mean_square(tool) / square;

    std::vector<FlowFactors> results;
    std::set<std::string>    remarks;
    for (const double cut_height : cut_heights)
      {
        FlowFactors f;
        f.cut_height       = cut_height;
        f.h_avg            = distribution.mean_gap(cut_height);
        f.contact_fraction = distribution.contact_fraction(cut_height);
        const FittedSeparation at{ cut_height / sq_reference, f.h_avg / sq_reference, [&](const double h_t) {
                                    return distribution.mean_gap(h_t * sq_reference) / sq_reference;
                                  } };
        for (const int axis : { 0, 1 })
          {
            const auto turned = [axis](const double g) { return axis == 0 ? g : 1 / g; };
            f.phi_p[3 * axis] = f.h_avg > 0 ? pressure_factor(at, turned(gamma.gap)) : 0.;
            f.phi_s[3 * axis] = f.h_avg > 0 ? share_sheet * shear_factor(at, turned(gamma.sheet))
                                                  - share_tool * shear_factor(at, turned(gamma.tool))
                                            : 0.;
            remarks.insert(remark(at, turned(gamma.gap)));
          }
        results.push_back(f);
      }
    for (const std::string &text : remarks)
      if (!text.empty())
        log::info("Flow factors: " + text);
    if (progress)
      progress(1.);
    return results;
  }
} // namespace tribodraw
