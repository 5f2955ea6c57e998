#include <tribodraw/base/parameters.h>
#include <tribodraw/flow_factors/fitted_factors.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    // End of the published fit of the pressure factor, and of the curves of the shear factor.
    constexpr double largest_h_of_pressure = 3, largest_h_of_shear = 5;

    double
    published_pressure(const double h, const double gamma)
    {
      const double l = std::log(gamma), l9 = std::log(9 * gamma);
      const double threshold = 3 * (1 - std::pow(0.47476 / gamma + 1, -0.25007));
      const double a2        = 0.051375 * std::pow(l9, 3) - 0.0071901 * std::pow(l9, 4);
      const double a3        = 1.0019 + l * (-0.17927 + l * (0.047583 - 0.016417 * l));
      const double x         = std::max(0., h - threshold);
      return x * x * (a2 + a3 * x) / (h * h * h);
    }

    // Polynomials in H (first index) and gamma (second) fitted to the curves of the publication's Fig. 4, degrees up to
    // five; coefficients as used in the rolling lubrication solver of foam-extend.
    struct Term
    {
      int    h, gamma;
      double coefficient;
    };
    constexpr Term transverse[]
        = { { 0, 0, 1.036 },    { 1, 0, 0.3781 },    { 0, 1, -4.05 },    { 2, 0, -0.1298 }, { 0, 2, 9.711 },
            { 3, 0, -0.01477 }, { 0, 3, -13.49 },    { 4, 0, 0.007365 }, { 0, 4, 10.21 },   { 5, 0, -0.0005668 },
            { 0, 5, -3.194 },   { 1, 1, 0.6817 },    { 2, 1, 0.00306 },  { 1, 2, -1.204 },  { 3, 1, -0.01289 },
            { 1, 3, 0.6632 },   { 4, 1, 0.0005116 }, { 1, 4, -0.1098 },  { 2, 2, 0.09008 }, { 3, 2, 0.003367 },
            { 2, 3, -0.04641 } };
    constexpr Term longitudinal[]
        = { { 0, 0, 0.1403 },    { 1, 0, 0.7448 },    { 0, 1, 0.1098 },     { 2, 0, -0.2744 },   { 0, 2, -0.1042 },
            { 3, 0, 0.03141 },   { 0, 3, 0.02828 },   { 4, 0, -0.0005932 }, { 0, 4, -0.003105 }, { 5, 0, -0.00007039 },
            { 0, 5, 0.0001203 }, { 1, 1, -0.203 },    { 2, 1, 0.05916 },    { 1, 2, 0.02689 },   { 3, 1, -0.004833 },
            { 1, 3, -0.001413 }, { 4, 1, 0.0001006 }, { 1, 4, 0.00002183 }, { 2, 2, -0.005968 }, { 3, 2, 0.0002656 },
            { 2, 3, 0.0001916 } };

    double
    polynomial(const double h, const double gamma)
    {
      double sum = 0;
      for (const Term &term : gamma < 1 ? transverse : longitudinal)
        sum += term.coefficient * std::pow(h, term.h) * std::pow(gamma, term.gamma);
      return sum;
    }

    // Both factors are functions of the mean gap, as in the publication.
    class WilsonMarsault : public FittedFactors
    {
    public:
      explicit WilsonMarsault(Parameters &parameters) : FittedFactors(parameters) {}

      // Beyond the fit the deviation from 1 falls with H^-2, as it must for small roughness; our continuation.
      double
      pressure_factor(const FittedSeparation &at, const double gamma) const override
      {
        const double g = limited_gamma(gamma), h = std::min(at.h_avg, largest_h_of_pressure);
        return 1 - (1 - published_pressure(h, g)) * std::pow(h / at.h_avg, 2);
      }

      // Beyond the curves it falls with 1/H, as it must for small roughness; never more than all lubricant moves with
      // the rough surface.
      double
      shear_factor(const FittedSeparation &at, const double gamma) const override
      {
        const double g = limited_gamma(gamma), h = std::min(at.h_avg, largest_h_of_shear);
        return std::clamp(polynomial(h, g) * h / at.h_avg, 0., at.h_avg);
      }

    protected:
      std::string
      law() const override
      {
        return "Wilson-Marsault 1";
      }
      std::string
      remark(const FittedSeparation &at, const double gamma) const override
      {
        if (limited_gamma(gamma) != gamma)
          return "Wilson and Marsault's coefficients end at ratios of correlation lengths of 1/9 and 9; the end is "
                 "used.";
        return at.h_avg > largest_h_of_pressure
                   ? "Wilson and Marsault's fits end at h_avg/Sq = 3 (pressure) and 5 (shear); beyond, the factors "
                     "approach 1 and 0 as for small roughness."
                   : "";
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FlowFactorModel, WilsonMarsault, "Wilson-Marsault",
                     "Fits for large contact areas, functions of the mean gap",
                     "Wilson and Marsault, J. Tribol. 120 (1998) 16-20")
} // namespace tribodraw
