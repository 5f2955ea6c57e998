#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/viscosity_law.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// eta = eta_0 exp(a p). Far too stiff above some 200 MPa, where measured oils follow Roelands.
    class BarusViscosity : public ViscosityLaw
    {
    public:
      explicit BarusViscosity(Parameters &parameters)
          : a(parameters.quantity("Pressure coefficient", "1/GPa", Range::non_negative().usual(1, 60),
                                  "Relative growth of the viscosity with pressure; mineral oils 15 to 22 1/GPa."))
      {
      }

      Value
      viscosity(const double pressure, double) const override
      {
        const double eta = reference * std::exp(a * pressure);
        return { eta, a * eta };
      }

    private:
      double a; // [1/MPa]
    };
  } // namespace

  TRIBODRAW_REGISTER(ViscosityLaw, BarusViscosity, "Barus", "Viscosity grows exponentially with pressure.",
                     "Barus, Am. J. Sci. 45 (1893) 87-96")
} // namespace tribodraw
