#include <tribodraw/base/parameters.h>
#include <tribodraw/flow_factors/fitted_factors.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tribodraw
{
  namespace
  {
    // Patir and Cheng 1978 (pressure), 1979 (shear), for Gaussian heights; H is the distance of the mean planes over
    // Sq. gamma <= 1: phi_x = 1 - C exp(-r H), else 1 + C H^-r, for H above `least`; Ps = A1 H^a1 exp(-a2 H + a3 H^2)
    // for 0.5 < H <= 5, A2 exp(-0.25 H) beyond.
    struct Row
    {
      double gamma, c, r, least, a1, alpha1, alpha2, alpha3, a2;
    };
    constexpr Row    rows[]           = { { 1. / 9, 1.48, 0.42, 1, 2.046, 1.12, 0.78, 0.03, 1.856 },
                                          { 1. / 6, 1.38, 0.42, 1, 1.962, 1.08, 0.77, 0.03, 1.754 },
                                          { 1. / 3, 1.18, 0.42, 0.75, 1.858, 1.01, 0.76, 0.03, 1.561 },
                                          { 1, 0.90, 0.56, 0.5, 1.899, 0.98, 0.92, 0.05, 1.126 },
                                          { 3, 0.225, 1.5, 0.5, 1.560, 0.85, 1.13, 0.08, 0.556 },
                                          { 6, 0.520, 1.5, 0.5, 1.290, 0.62, 1.09, 0.08, 0.388 },
                                          { 9, 0.870, 1.5, 0.5, 1.011, 0.54, 1.07, 0.08, 0.295 } };
    constexpr double least_h_of_shear = 0.5;

    double
    published_pressure(const Row &row, const double h)
    {
      return row.gamma <= 1 ? 1 - row.c * std::exp(-row.r * h) : 1 + row.c * std::pow(h, -row.r);
    }

    double
    published_shear(const Row &row, const double h)
    {
      return h <= 5 ? row.a1 * std::pow(h, row.alpha1) * std::exp((row.alpha3 * h - row.alpha2) * h)
                    : row.a2 * std::exp(-0.25 * h);
    }

    // Between published ratios the factors themselves are interpolated, linearly in ln gamma; outside the nearest row
    // holds.
    template <class Value>
    double
    interpolate(const double gamma, const Value &value)
    {
      const double g = limited_gamma(gamma);
      std::size_t  i = 0;
      while (i + 2 < std::size(rows) && rows[i + 1].gamma < g)
        ++i;
      const double w = std::log(g / rows[i].gamma) / std::log(rows[i + 1].gamma / rows[i].gamma);
      return (1 - w) * value(rows[i]) + w * value(rows[i + 1]);
    }

    class PatirCheng : public FittedFactors
    {
    public:
      explicit PatirCheng(Parameters &parameters) : FittedFactors(parameters) {}

      // phi_x belongs to the cube of the distance of the mean planes. Below the published range the factor in the form
      // with the mean gap goes to zero with the mean gap, linearly: our continuation.
      double
      pressure_factor(const FittedSeparation &at, const double gamma) const override
      {
        return interpolate(gamma, [&at](const Row &row) {
          const double h = std::max(at.h_t, row.least), h_avg = h > at.h_t ? at.mean_gap(h) : at.h_avg;
          return published_pressure(row, h) * std::pow(h / h_avg, 3) * at.h_avg / h_avg;
        });
      }

      // The same continuation; it stays below the limit h_avg/Sq of trapped lubricant.
      double
      shear_factor(const FittedSeparation &at, const double gamma) const override
      {
        const double h = std::max(at.h_t, least_h_of_shear), h_avg = h > at.h_t ? at.mean_gap(h) : at.h_avg;
        return interpolate(gamma, [h](const Row &row) { return published_shear(row, h); }) * at.h_avg / h_avg;
      }

    protected:
      std::string
      law() const override
      {
        return "Patir-Cheng 1";
      }
      std::string
      remark(const FittedSeparation &at, const double gamma) const override
      {
        if (limited_gamma(gamma) != gamma)
          return "Patir and Cheng's coefficients end at ratios of correlation lengths of 1/9 and 9; the end is used.";
        if (at.h_t < interpolate(
                gamma, [](const Row &row) { return row.least; }))
          return "some separations are below the range of Patir and Cheng's fit (0.5 to 1 Sq between the mean planes); "
                 "there the factors go to zero with the mean gap.";
        return "";
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FlowFactorModel, PatirCheng, "Patir-Cheng",
                     "Fits to solutions on Gaussian surfaces, lays from transverse to longitudinal",
                     "Patir and Cheng, J. Lubr. Technol. 100 (1978) 12-17 and 101 (1979) 220-230")
} // namespace tribodraw
