#include "rate_independent_law.h"

namespace tribodraw
{
  namespace
  {
    /// Rate-independent power law sigma = K (eps0 + eps)^n (Swift 1952).
    class Swift : public RateIndependentLaw<Swift>
    {
    public:
      explicit Swift(Parameters &parameters)
          : K(parameters.quantity("Strength coefficient", "MPa", Range::positive().usual(10, 5000),
                                  "Factor K of K (eps0 + eps)^n.")),
            eps0(parameters.quantity("Initial strain", "", Range::positive().usual(1e-6, 0.2),
                                     "Strain eps0 of K (eps0 + eps)^n.")),
            n(parameters.quantity("Hardening exponent", "", Range::non_negative().usual(0., 1.),
                                  "Exponent n of K (eps0 + eps)^n."))
      {
      }

      template <class Number>
      TRIBODRAW_INLINE FlowStressOf<Number>
                       compute(const Number &strain) const
      {
        const Number value = K * pack::pow(Number(eps0 + strain), n);
        return { value, n * value / (eps0 + strain), 0. };
      }

    private:
      const double K, eps0, n;
    };
  } // namespace

  TRIBODRAW_REGISTER(HardeningLaw, Swift, "Swift", "Power law with initial strain; does not depend on the strain rate.",
                     "H. W. Swift, J. Mech. Phys. Solids 1 (1952) 1-18")
} // namespace tribodraw
