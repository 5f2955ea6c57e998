#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/flattening/asperity_model.h>

#include <algorithm>
#include <vector>

namespace tribodraw
{
  namespace
  {
    /// Hardness over the contact fraction from measurements or finite-element models of asperities:
    /// P = H(alpha) alpha, H/sigma_y interpolated linearly, constant outside the given fractions.
    class TabulatedHardness : public AsperityModel
    {
    public:
      explicit TabulatedHardness(Parameters &parameters)
          : fraction(parameters.quantity_list("Contact fractions", "", Range::between(0, 1),
                                              "Contact fractions at which the hardness is given, ascending.")),
            ratio(parameters.quantity_list("Hardness over flow stress", "", Range::positive().usual(0.1, 100),
                                           "Mean pressure on the plateaus divided by the flow stress of the sheet, for "
                                           "each contact fraction."))
      {
        if (parameters.documentation_mode() || parameters.has_problems())
          return;
        if (fraction.size() != ratio.size())
          parameters.problem("Hardness over flow stress",
                             std::to_string(ratio.size()) + " values for " + std::to_string(fraction.size())
                                 + " contact fractions.",
                             "one value for each contact fraction");
        for (std::size_t i = 1; i < std::min(fraction.size(), ratio.size()); ++i)
          {
            if (!(fraction[i] > fraction[i - 1]))
              parameters.problem("Contact fractions",
                                 "value " + std::to_string(i + 1) + " is not greater than the one before it.",
                                 "an ascending list");
            else if (!load_increases(i))
              parameters.problem("Hardness over flow stress",
                                 "the load, hardness times contact fraction, falls before contact fraction "
                                     + units::number(fraction[i]) + ".",
                                 "values with which the load rises with the contact fraction",
                                 "A sheet that carries less the more it is flattened has no stable state.");
          }
      }

      double
      normal_load(const PlateauState &state, const SheetStrength &strength) const override
      {
        return value(state.contact_fraction) * strength.flow_stress() * state.contact_fraction;
      }
      double
      hardness(const SheetStrength &strength) const override
      {
        return ratio.front() * strength.flow_stress();
      }

    private:
      const std::vector<double> fraction, ratio;

      /// alpha H is a parabola in interval i: it rises if it does so at both ends.
      bool
      load_increases(const std::size_t i) const
      {
        const double slope = (ratio[i] - ratio[i - 1]) / (fraction[i] - fraction[i - 1]);
        return ratio[i - 1] + slope * fraction[i - 1] > 0 && ratio[i] + slope * fraction[i] > 0;
      }

      double
      value(const double alpha) const
      {
        const auto above = std::upper_bound(fraction.begin(), fraction.end(), alpha);
        if (above == fraction.begin())
          return ratio.front();
        if (above == fraction.end())
          return ratio.back();
        const std::size_t i      = above - fraction.begin();
        const double      weight = (alpha - fraction[i - 1]) / (fraction[i] - fraction[i - 1]);
        return ratio[i - 1] + weight * (ratio[i] - ratio[i - 1]);
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(AsperityModel, TabulatedHardness, "tabulated hardness",
                     "Hardness over the contact fraction as given, from experiments or finite-element models of "
                     "asperities (coated sheets, for instance).",
                     "Idea: M. Shisode, J. Hazrati, T. Mishra, M. de Rooij, T. van den Boogaard: Semi-analytical "
                     "contact model of coated sheets. Tribol. Int. (2020)")
} // namespace tribodraw
