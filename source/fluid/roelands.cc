#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/viscosity_law.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// eta = eta_0 exp{ (ln eta_0 + 9.67) [(1 + p/p_r)^z - 1] } with eta_0 in Pa s and p_r = 196.2 MPa, at constant
    /// temperature. The exponent z is chosen so that the slope at p = 0 is that of Barus: z = a p_r / (ln eta_0
    /// + 9.67).
    class RoelandsViscosity : public ViscosityLaw
    {
    public:
      explicit RoelandsViscosity(Parameters &parameters)
          : a(parameters.quantity("Pressure coefficient", "1/GPa", Range::non_negative().usual(1, 60),
                                  "Relative growth of the viscosity with pressure at ambient pressure; mineral oils 15 "
                                  "to 22 1/GPa."))
      {
      }

      Value
      viscosity(const double pressure, double) const override
      {
        // Oils of all viscosities meet at exp(-9.67) Pa s = 6.3e-5 Pa s and -196.2 MPa, far below any lubricant.
        const double level = std::log(reference / pascal_second) + 9.67;
        const double z     = a * reference_pressure / level;
        const double base  = 1 + pressure / reference_pressure;
        const double eta   = reference * std::exp(level * (std::pow(base, z) - 1));
        return { eta, eta * a * std::pow(base, z - 1) };
      }

    private:
      static constexpr double reference_pressure = 196.2; // [MPa]
      static constexpr double pascal_second      = 1e-6;  // [MPa s]
      double                  a;                          // [1/MPa]
    };
  } // namespace

  TRIBODRAW_REGISTER(ViscosityLaw, RoelandsViscosity, "Roelands",
                     "Viscosity grows with pressure, less than exponentially; the slope at zero is that of Barus.",
                     "Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of "
                     "lubricating oils, PhD thesis, TU Delft (1966)")
} // namespace tribodraw
