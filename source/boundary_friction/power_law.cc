#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/boundary_friction/shear_law.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// tau_BL = c0 P0^m. The coefficient has the unit of a pressure to the power 1 - m, so that its number depends on
    /// the unit of pressure: 11.2 Pa^0.25 is 0.354 MPa^0.25.
    class PowerLaw : public ShearLaw
    {
    public:
      explicit PowerLaw(Parameters &parameters)
          : exponent(parameters.quantity("m", "", Range{ 0., 1., true }.usual(0.5, 1.),
                                         "Exponent of the pressure in tau_BL = c0 P0^m.")),
            coefficient(read_coefficient(parameters, exponent))
      {
      }

      double
      shear_stress(const double p0) const override
      {
        return p0 > 0 ? coefficient * std::pow(p0, exponent) : 0.;
      }

    private:
      static double
      read_coefficient(Parameters &parameters, const double m)
      {
        if (!(m > 0 && m <= 1) && !parameters.documentation_mode())
          {
            parameters.mark_unselected("c0"); // its unit is not known until m is right
            return 0.;
          }
        return parameters.quantity(
            "c0", coefficient_unit(parameters.documentation_mode() ? 0.75 : m), Range::positive(),
            "Coefficient of tau_BL = c0 P0^m. Its unit follows from m: Pa^(1-m), with any unit of pressure. For "
            "m = 0.75 that is Pa^0.25; for m = 1 it is a plain number, the friction coefficient.");
      }

      static std::string
      coefficient_unit(const double m)
      {
        // 1 - 0.88 must read 0.12 and not 0.12000000000000001
        const double power = std::round((1. - m) * 1e12) / 1e12;
        return power == 0. ? std::string() : "Pa^" + units::number(power);
      }

      const double exponent, coefficient;
    };
  } // namespace

  TRIBODRAW_REGISTER(
      ShearLaw, PowerLaw, "power law",
      "Shear strength of the boundary layer as a power of the pressure in it, tau = c0 P0^m.",
      "M. Shisode, J. Hazrati, T. Mishra, M. de Rooij, T. van den Boogaard: Mixed lubrication friction model "
      "including surface texture effects for sheet metal forming. J. Mater. Process. Technol. (2021) 117035")
} // namespace tribodraw
