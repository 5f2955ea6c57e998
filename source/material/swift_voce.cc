#include "rate_independent_law.h"

namespace tribodraw
{
  namespace
  {
    /// w K (eps0 + eps)^n + (1 - w) [sigma_s - (sigma_s - sigma_0) exp(-C eps)].
    class SwiftVoce : public RateIndependentLaw<SwiftVoce>
    {
    public:
      explicit SwiftVoce(Parameters &parameters)
          : weight(parameters.quantity("Weight of Swift", "", Range::between(0., 1.),
                                       "Share w of the power law in the flow stress.")),
            K(parameters.quantity("Strength coefficient", "MPa", Range::positive().usual(10., 5000.),
                                  "Factor K of K (eps0 + eps)^n.")),
            eps0(parameters.quantity("Initial strain", "", Range::positive().usual(1e-6, 0.2),
                                     "Strain eps0 of K (eps0 + eps)^n.")),
            n(parameters.quantity("Hardening exponent", "", Range::non_negative().usual(0., 1.),
                                  "Exponent n of K (eps0 + eps)^n.")),
            initial(parameters.quantity("Initial stress", "MPa", Range::positive().usual(10., 3000.),
                                        "Stress sigma_0 of the saturating part at zero plastic strain.")),
            saturation(parameters.quantity("Saturation stress", "MPa", Range::positive().usual(10., 5000.),
                                           "Stress sigma_s that the saturating part approaches.")),
            rate(parameters.quantity("Saturation rate", "", Range::positive().usual(0.5, 100.),
                                     "C: the distance to saturation falls by e in a strain of 1/C."))
      {
        if (saturation < initial && !parameters.documentation_mode())
          parameters.problem("Saturation stress", "it is below the initial stress", "at least `Initial stress`");
      }

      template <class Number>
      TRIBODRAW_INLINE FlowStressOf<Number>
                       compute(const Number &strain) const
      {
        const Number power   = weight * K * pack::pow(Number(eps0 + strain), n);
        const Number missing = (1 - weight) * (saturation - initial) * pack::exp(Number(-rate * strain));
        return { power + (1 - weight) * saturation - missing, n * power / (eps0 + strain) + rate * missing, 0. };
      }

    private:
      const double weight, K, eps0, n, initial, saturation, rate;
    };
  } // namespace

  TRIBODRAW_REGISTER(HardeningLaw, SwiftVoce, "Swift-Voce",
                     "Weighted sum of a power law and a saturating law; does not depend on the strain rate.",
                     "H. W. Swift, J. Mech. Phys. Solids 1 (1952) 1-18; E. Voce, J. Inst. Metals 74 (1948) 537-562")
} // namespace tribodraw
