#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/flattening/flattening.h>
#include <tribodraw/material/hardening_law.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  Flattening
  Flattening::read(Parameters &parameters)
  {
    std::shared_ptr<const AsperityModel> model = parameters.model<AsperityModel>(
        "Model", "How much load flattened asperities carry and how bulk strain flattens them.");
    const double l = parameters.quantity(
        "Asperity half spacing", "um", Range::positive().usual(1, 1000),
        "Half the mean distance of asperities: the length that turns bulk strain into flattening.");
    const double rate = parameters.quantity("Strain rate", "1/s", Range::non_negative().usual(0, 1e4),
                                            "Bulk strain rate at which the flow stress of the asperities is taken.");
    return Flattening(std::move(model), l, rate);
  }

  Flattening::Flattening(std::shared_ptr<const AsperityModel> asperity_model, const double half_spacing,
                         const double strain_rate)
      : model(std::move(asperity_model)), l(half_spacing), rate(strain_rate)
  {
  }

  double
  Flattening::shear_strength(const HardeningLaw &hardening, const double eps) const
  {
    return hardening.flow_stress(eps, rate).value / std::sqrt(3.);
  }

  double
  Flattening::hardness(const double k) const
  {
    const double small = 1e-9;
    return model->normal_load(small, k) / small;
  }

  double
  Flattening::contact_fraction_under_load(const double p_solid, const double k) const
  {
    if (!(p_solid > 0))
      return 0.;
    double low = 0., high = 1. - 1e-12;
    if (model->normal_load(high, k) <= p_solid)
      return high;
    for (unsigned int i = 0; i < 200 && high - low > 1e-15 * high; ++i)
      {
        const double mid                                    = 0.5 * (low + high);
        (model->normal_load(mid, k) < p_solid ? low : high) = mid;
      }
    return high;
  }

  double
  Flattening::cut_height_under_load(const HeightDistribution &heights, const double p_solid, const double k) const
  {
    if (!(p_solid > 0))
      return heights.highest();
    return heights.cut_height_for_contact_fraction(contact_fraction_under_load(p_solid, k));
  }

  double
  Flattening::strain_per_descent(const double contact_fraction, const double p_solid, const double k) const
  {
    return model->strain_rate_number(contact_fraction, p_solid, k) / l;
  }

  std::vector<double>
  Flattening::monotone_cut_heights(const HeightDistribution &heights, const HardeningLaw &hardening,
                                   const double p_solid, const std::vector<double> &strains) const
  {
    const auto cost = [&](const double s, const double eps) {
      const double alpha = heights.contact_fraction(s);
      return std::max(0., strain_per_descent(alpha, p_solid, shear_strength(hardening, eps)));
    };
    // Heun steps of at most 1/2000 Sq and 0.002 strain: the error, about 1e-6 of the descent, is far below that of
    // any table made from the result.
    const double       longest_step   = heights.sq() / 2000.;
    const double       largest_strain = 0.002;
    const unsigned int max_steps      = 10000000;

    double              eps = 0., s = cut_height_under_load(heights, p_solid, shear_strength(hardening, 0.));
    std::vector<double> result;
    if (!(p_solid > 0) || std::isinf(cost(s, 0.)))
      return std::vector<double>(strains.size(), s);
    double rate_here = cost(s, eps);
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
