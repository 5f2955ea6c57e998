#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/viscosity_law.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// eta_eff = tau_E/rate asinh(eta rate/tau_E), eta = eta_0 exp(a p): the shear stress grows with the logarithm of
    /// the rate once it exceeds the Eyring stress. As an effective viscosity it is exact for simple shear only.
    class EyringViscosity : public ViscosityLaw
    {
    public:
      explicit EyringViscosity(Parameters &parameters)
          : a(parameters.quantity("Pressure coefficient", "1/GPa", Range::non_negative().usual(0, 60),
                                  "Relative growth of the viscosity with pressure; 0 for shear thinning alone.")),
            eyring_stress(parameters.quantity("Eyring stress", "MPa", Range::positive().usual(0.5, 50),
                                              "Shear stress above which the oil shear-thins; 3 to 10 MPa for oils."))
      {
      }

      Value
      viscosity(const double pressure, const double shear_rate) const override
      {
        const double eta = reference * std::exp(a * pressure);
        const double x   = eta * shear_rate / eyring_stress;
        // asinh(x)/x = 1 - x^2/6 + ...: below 1e-4 the next term is smaller than the rounding.
        const double thinning = x < 1e-4 ? 1 - x * x / 6 : std::asinh(x) / x;
        // d(eta asinh(x)/x)/d p, where d x/d p = a x: eta a / sqrt(1 + x^2).
        return { eta * thinning, eta * a / std::hypot(1., x) };
      }

    private:
      double a;             // [1/MPa]
      double eyring_stress; // [MPa]
    };
  } // namespace

  TRIBODRAW_REGISTER(ViscosityLaw, EyringViscosity, "Eyring",
                     "Shear thinning above the Eyring stress, exponential growth with pressure.",
                     "Eyring, J. Chem. Phys. 4 (1936) 283-291")
} // namespace tribodraw
