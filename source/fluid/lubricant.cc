#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/lubricant.h>

namespace tribodraw
{
  Lubricant
  Lubricant::read(Parameters &parameters)
  {
    Lubricant lubricant;
    // From water to a drawing compound; catches Pa s for mPa s.
    const double viscosity = parameters.quantity(
        "Viscosity", "mPa s", Range::positive().usual(0.5, 5000),
        "Dynamic viscosity of the lubricant at ambient pressure and at the temperature of the process.");
    std::unique_ptr<ViscosityLaw> law = parameters.model<ViscosityLaw>(
        "Viscosity law", "How the viscosity depends on pressure and shear rate.",
        Default{ "constant", "needs no constants beside the viscosity, and is what the paper uses" });
    if (law)
      law->set_reference_viscosity(viscosity);
    lubricant.viscosity_law = std::move(law);
    lubricant.density
        = parameters.quantity("Density", "g/cm^3", Range::positive().usual(0.5, 2),
                              "Density of the lubricant at the temperature at which the amount is weighed.");
    lubricant.amount = parameters.quantity("Amount", "g/m^2", Range::non_negative().usual(0, 20),
                                           "Lubricant on each face of the sheet, mass per area of one face. 0 is dry.");
    return lubricant;
  }
} // namespace tribodraw
