#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/asperity_model.h>

namespace tribodraw
{
  namespace
  {
    /// Every plateau carries the same hardness, P = H alpha with H = B sigma_y.
    class IdealPlastic : public AsperityModel
    {
    public:
      explicit IdealPlastic(Parameters &parameters)
          : ratio(parameters.quantity("Hardness over flow stress", "", Range::positive().usual(1, 6),
                                      "Indentation hardness divided by the flow stress (Tabor: 2.8)."))
      {
      }

      double
      normal_load(const PlateauState &state, const SheetStrength &strength) const override
      {
        return hardness(strength) * state.contact_fraction;
      }
      double
      hardness(const SheetStrength &strength) const override
      {
        return ratio * strength.flow_stress();
      }

    private:
      const double ratio;
    };
  } // namespace

  TRIBODRAW_REGISTER(AsperityModel, IdealPlastic, "ideal plastic",
                     "Constant hardness: contact fraction = solid pressure / hardness.",
                     "F.P. Bowden, D. Tabor: The Friction and Lubrication of Solids. Oxford 1950")
} // namespace tribodraw
