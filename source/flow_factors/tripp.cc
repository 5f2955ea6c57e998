#include <tribodraw/base/parameters.h>
#include <tribodraw/flow_factors/fitted_factors.h>

#include <algorithm>

namespace tribodraw
{
  namespace
  {
    // Second-order perturbation for small Sq/h and elliptical correlation: PhiP = 1 + (3/H^2)(1 - 3 g), Ps = 3 g/H,
    // g = 1/(1 + gamma), the mean of cos^2 over the directions of the waves.
    class Tripp : public FittedFactors
    {
    public:
      explicit Tripp(Parameters &parameters) : FittedFactors(parameters) {}

      double
      pressure_factor(const FittedSeparation &at, const double gamma) const override
      {
        return std::max(0., 1 + 3 / (at.h_avg * at.h_avg) * (1 - 3 / (1 + gamma)));
      }

      // Never more than all lubricant moves with the rough surface.
      double
      shear_factor(const FittedSeparation &at, const double gamma) const override
      {
        return std::min(3 / ((1 + gamma) * at.h_avg), at.h_avg);
      }

    protected:
      std::string
      law() const override
      {
        return "Tripp 1";
      }
      std::string
      remark(const FittedSeparation &at, double) const override
      {
        return at.h_avg < 3 ? "Tripp's expansion is meant for small roughness; below h_avg/Sq = 3 it is not valid."
                            : "";
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FlowFactorModel, Tripp, "Tripp",
                     "Second-order perturbation for gaps much larger than the roughness",
                     "Tripp, J. Lubr. Technol. 105 (1983) 458-465")
} // namespace tribodraw
