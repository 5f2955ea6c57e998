#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/pressure_friction.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// mu = mu0 (p / p0)^(n - 1), bounded where the pressure is small.
    class PowerLawFriction : public PressureFrictionLaw
    {
    public:
      explicit PowerLawFriction(Parameters &p)
        : mu0(p.quantity("Reference coefficient", "", Range::non_negative().usual(0, 0.5), "Coefficient at the reference pressure, mu0."))
        , p0(p.quantity("Reference pressure", "MPa", Range::positive(), "Pressure p0 at which the coefficient is mu0."))
        , n(p.quantity("Exponent", "", Range::between(0, 2).usual(0.3, 1.2), "n: friction stress grows with this power of the pressure; 1: Coulomb."))
        , largest(p.quantity("Largest coefficient", "", Range::positive().usual(0.01, 1), "Bound of the coefficient, which would grow without limit as the pressure vanishes (n < 1)."))
      {
        if (largest < mu0 && !p.documentation_mode())
          p.problem("Largest coefficient", "the bound is below the reference coefficient.", "at least " + std::to_string(mu0));
      }
      double coefficient(const double pressure) const override
      {
        if (n == 1)
          return mu0;
        if (pressure <= 0)
          return n < 1 ? largest : 0.;
        return std::min(largest, mu0 * std::pow(pressure / p0, n - 1));
      }

    private:
      double mu0, p0, n, largest;
    };
  } // namespace

  TRIBODRAW_REGISTER(PressureFrictionLaw, PowerLawFriction, "power law", "Friction stress as a power of the contact pressure.", "")
} // namespace tribodraw
