#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/lubricant.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    void
    read_map(Parameters &parameters, Lubricant &lubricant)
    {
      const auto file = parameters.input_file(
          "Amount file",
          "Measured lubricant over the blank instead of `Amount`: CSV with x_mm, y_mm (a map on a rectangular grid) or one "
          "of them (a traverse), from the middle of the blank, x along the rolling direction; and amount_g_per_m2, or "
          "amount_punch_g_per_m2 and amount_die_g_per_m2. Linear between the points.");
      if (parameters.documentation_mode() || file.empty())
        return;
      try
        {
          lubricant.map = std::make_shared<AmountMap>(AmountMap::read(file));
          // Scatter of measured amounts is of this order.
          if (lubricant.map->asymmetry() > 0.05)
            log::warning("'Lubricant/Amount file' is not symmetric (differences up to "
                         + std::to_string(std::lround(100 * lubricant.map->asymmetry()))
                         + " % of the greatest amount); a quarter model takes the part x >= 0, y >= 0.");
        }
      catch (const InputError &e)
        {
          parameters.problem("Amount file", e.what());
        }
    }
  } // namespace

  Lubricant
  Lubricant::read(Parameters &parameters, const bool maps)
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
    if (maps && (parameters.has("Amount file") || parameters.documentation_mode()))
      read_map(parameters, lubricant);
    if (!lubricant.map || parameters.documentation_mode())
      {
        const auto amount = parameters.quantity_list(
            "Amount", "g/m^2", Range::non_negative().usual(0, 20),
            "Lubricant on the sheet, mass per area of one face. One value for both faces, or two: punch side, die side. 0 "
            "is dry.");
        if (amount.size() == 1 || amount.size() == 2)
          lubricant.amount = { amount.front(), amount.back() };
        if (!parameters.documentation_mode() && (amount.size() > 2 || (amount.size() == 2 && !maps)))
          parameters.problem("Amount", maps ? "There are two faces." : "One face of the sheet is considered.",
                             maps ? "one or two values" : "one value");
      }
    else
      parameters.mark_unselected("Amount");
    return lubricant;
  }
} // namespace tribodraw
