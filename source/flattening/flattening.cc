#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/flattening/asperity_count.h>
#include <tribodraw/flattening/flattening.h>
#include <tribodraw/material/hardening_law.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tribodraw
{
  namespace
  {
    constexpr const char *from_map = "from map";

    /// l [mm]; 0 if it is to be taken from the map.
    double
    read_half_spacing(Parameters &parameters)
    {
      const std::string entry         = "Asperity half spacing";
      const std::string documentation = "Half the mean distance of asperities, the length that turns bulk strain into "
                                        "flattening: a length, usually 1 to 1000 um, or `from map`, which counts "
                                        "the connected plateaus of the sheet in the state in which there are most.";
      const std::string text          = parameters.text(entry, documentation);
      if (text.empty() || text == from_map)
        return 0.;
      return parameters.quantity(entry, "um", Range::positive().usual(1, 1000), documentation);
    }
  } // namespace

  Flattening
  Flattening::read(Parameters &parameters)
  {
    std::shared_ptr<const AsperityModel> model
        = parameters.model<AsperityModel>("Model", "How much load flattened asperities carry without bulk strain.");
    std::shared_ptr<const BulkStrainLaw> bulk_strain = parameters.model<BulkStrainLaw>(
        "Bulk strain", "How bulk plastic strain of the sheet flattens loaded asperities further.",
        Default{ "Westeneng", "straining sheets are flattened several times more than sheets under load alone" });
    const double l       = read_half_spacing(parameters);
    const double rate    = parameters.quantity("Strain rate", "1/s", Range::non_negative().usual(0, 1e4),
                                               "Bulk strain rate at which the flow stress of the asperities is taken.");
    double       pruning = 0.05;
    if (!(l > 0) || parameters.documentation_mode())
      pruning = parameters.quantity(
          "Asperity pruning", "", Range::between(0, 1),
          "Only with `from map`: a plateau counts as an asperity of its own where it stands at least this fraction of "
          "the map's height range above the saddle to a higher one.",
          Default{ "0.05", "Wolf pruning of hills in ISO 25178-2" });
    else
      parameters.mark_unselected("Asperity pruning");
    return Flattening(std::move(model), l, rate, std::move(bulk_strain), pruning);
  }

  Flattening::Flattening(std::shared_ptr<const AsperityModel> asperity_model, const double half_spacing,
                         const double strain_rate, std::shared_ptr<const BulkStrainLaw> strain_law,
                         const double wolf_pruning)
      : model(std::move(asperity_model)), bulk_strain(std::move(strain_law)), l(half_spacing), rate(strain_rate),
        pruning(wolf_pruning)
  {
  }

  bool
  Flattening::needs_spacing() const
  {
    return !(l > 0);
  }

  Flattening
  Flattening::with_spacing_of(const HeightMap &sheet) const
  {
    if (!needs_spacing())
      return *this;
    return Flattening(model, count_asperities(sheet, pruning).half_spacing, rate, bulk_strain, pruning);
  }

  double
  Flattening::half_spacing() const
  {
    if (needs_spacing())
      throw std::logic_error("The asperity spacing was not taken from the map yet.");
    return l;
  }

  SheetStrength
  Flattening::strength(const HardeningLaw &hardening, const double eps) const
  {
    return SheetStrength(hardening, eps, rate);
  }

  double
  Flattening::shear_strength(const HardeningLaw &hardening, const double eps) const
  {
    return strength(hardening, eps).shear_strength;
  }

  double
  Flattening::hardness(const SheetStrength &strength) const
  {
    return model->hardness(strength);
  }

  double
  Flattening::normal_load(const PlateauState &state, const SheetStrength &strength) const
  {
    return model->normal_load(state, strength);
  }

  double
  Flattening::contact_fraction_under_load(const double p_solid, const SheetStrength &strength) const
  {
    if (!(p_solid > 0))
      return 0.;
    double low = 0., high = 1. - 1e-12;
    if (model->normal_load(high, strength) <= p_solid)
      return high;
    for (unsigned int i = 0; i < 200 && high - low > 1e-15 * high; ++i)
      {
        const double mid                                           = 0.5 * (low + high);
        (model->normal_load(mid, strength) < p_solid ? low : high) = mid;
      }
    return high;
  }

  double
  Flattening::cut_height_under_load(const HeightDistribution &heights, const double p_solid,
                                    const SheetStrength &strength) const
  {
    if (!(p_solid > 0))
      return heights.highest();
    if (!model->needs_heights())
      return heights.cut_height_for_contact_fraction(contact_fraction_under_load(p_solid, strength));
    // The number of plateau pixels, by halving: the fewest that carry the load.
    std::size_t low = 0, high = heights.size();
    while (high - low > 1)
      {
        const std::size_t  mid = low + (high - low) / 2;
        const PlateauState state(heights, heights.nth_highest(mid));
        (state.contact_fraction < 1. && model->normal_load(state, strength) < p_solid ? low : high) = mid;
      }
    return heights.nth_highest(high);
  }

  double
  Flattening::strain_per_descent(const PlateauState &state, const double p_solid, const SheetStrength &strength) const
  {
    const double on_plateaus = state.contact_fraction * strength.shear_strength;
    if (!bulk_strain)
      return std::numeric_limits<double>::infinity();
    // No plateau: nothing has been flattened yet, and the hardness of the first summit counts.
    const double at_rest  = on_plateaus > 0 ? model->normal_load(state, strength) / on_plateaus
                                            : model->hardness(strength) / strength.shear_strength;
    const double hardness = on_plateaus > 0 ? p_solid / on_plateaus : std::numeric_limits<double>::infinity();
    return bulk_strain->strain_rate_number(state.contact_fraction, hardness, at_rest) / half_spacing();
  }

  double
  Flattening::advance(const HeightDistribution &heights, const HardeningLaw &hardening, const double s_old,
                      const double p_solid, const double eps_old, const double eps_new) const
  {
    if (!(p_solid > 0))
      return s_old;
    const double s = std::min(s_old, cut_height_under_load(heights, p_solid, strength(hardening, eps_old)));
    if (!(eps_new > eps_old))
      return s;
    return strain_under_load(heights, hardening, s, p_solid, eps_old, { eps_new }).front();
  }

  std::vector<double>
  Flattening::monotone_cut_heights(const HeightDistribution &heights, const HardeningLaw &hardening,
                                   const double p_solid, const std::vector<double> &strains) const
  {
    const double s = cut_height_under_load(heights, p_solid, strength(hardening, 0.));
    if (!(p_solid > 0))
      return std::vector<double>(strains.size(), s);
    return strain_under_load(heights, hardening, s, p_solid, 0., strains);
  }

  std::vector<double>
  Flattening::strain_under_load(const HeightDistribution &heights, const HardeningLaw &hardening, double s,
                                const double p_solid, double eps, const std::vector<double> &strains) const
  {
    const auto cost = [&](const double at, const double strain) {
      return std::max(0., strain_per_descent(PlateauState(heights, at), p_solid, strength(hardening, strain)));
    };
    // Heun steps of at most 1/2000 Sq and 0.002 strain: the error, about 1e-6 of the descent, is far below that of
    // any table made from the result. Models that integrate over the heights take longer to evaluate; 1/400 Sq leaves
    // an error of about 2e-5.
    const double       longest_step   = heights.sq() / (model->needs_heights() ? 400. : 2000.);
    const double       largest_strain = 0.002;
    const unsigned int max_steps      = 10000000;

    std::vector<double> result;
    double              rate_here = cost(s, eps);
    if (std::isinf(rate_here))
      return std::vector<double>(strains.size(), s);
    for (unsigned int step = 0; result.size() < strains.size(); ++step)
      {
        if (step == max_steps)
          throw ConvergenceError(describe_error("Flattening by bulk strain took too many steps", "flattening",
                                                "solid pressure " + units::format(p_solid, "MPa")));
        if (eps >= strains[result.size()])
          {
            result.push_back(s);
            continue;
          }
        double length = std::min(longest_step, s - heights.lowest());
        if (rate_here * length > largest_strain)
          length = largest_strain / rate_here;
        if (!(length > 1e-15 * heights.sq()))
          {
            result.push_back(s); // closed: nothing left to flatten
            continue;
          }
        double rate_there = cost(s - length, eps + rate_here * length);
        if (std::isinf(rate_there))
          {
            result.push_back(s);
            continue;
          }
        rate_there             = cost(s - length, eps + 0.5 * (rate_here + rate_there) * length);
        const double increment = 0.5 * (rate_here + rate_there) * length;
        double       eps_left  = strains[result.size()] - eps;
        while (result.size() < strains.size() && (eps_left = strains[result.size()] - eps) <= increment)
          result.push_back(s - distance_for_amount(eps_left, rate_here, rate_there, length));
        s -= length;
        eps += increment;
        rate_here = rate_there;
      }
    return result;
  }

  double
  distance_for_amount(const double amount, const double rate_a, const double rate_b, const double length)
  {
    if (!(amount > 0))
      return 0.;
    const double root = std::sqrt(std::max(0., rate_a * rate_a + 2. * (rate_b - rate_a) / length * amount));
    return std::min(length, 2. * amount / (rate_a + root));
  }
} // namespace tribodraw
