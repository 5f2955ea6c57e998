#include "rate_independent_law.h"

namespace tribodraw
{
  namespace
  {
    /// Hardening that saturates: sigma = sigma_s - (sigma_s - sigma_0) exp(-C eps).
    class Voce : public RateIndependentLaw<Voce>
    {
    public:
      explicit Voce(Parameters &parameters)
          : initial(parameters.quantity("Initial stress", "MPa", Range::positive().usual(10., 3000.),
                                        "Flow stress sigma_0 at zero plastic strain.")),
            saturation(parameters.quantity("Saturation stress", "MPa", Range::positive().usual(10., 5000.),
                                           "Flow stress sigma_s that is approached at large strain.")),
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
        const Number missing = (saturation - initial) * pack::exp(Number(-rate * strain));
        return { saturation - missing, rate * missing, 0. };
      }

    private:
      const double initial, saturation, rate;
    };
  } // namespace

  TRIBODRAW_REGISTER(HardeningLaw, Voce, "Voce", "Hardening that saturates; does not depend on the strain rate.",
                     "E. Voce, J. Inst. Metals 74 (1948) 537-562")
} // namespace tribodraw
