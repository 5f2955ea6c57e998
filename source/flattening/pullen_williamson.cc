#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/asperity_model.h>

namespace tribodraw
{
  namespace
  {
    /// Plastic contact with volume conservation and uniform rise: alpha = P / (P + H), H = B sigma_y.
    class PullenWilliamson : public AsperityModel
    {
    public:
      explicit PullenWilliamson(Parameters &parameters)
          : ratio(parameters.quantity("Hardness over flow stress", "", Range::positive().usual(1, 6),
                                      "Indentation hardness divided by the flow stress (Tabor: 2.8)."))
      {
      }

      double
      normal_load(const PlateauState &state, const SheetStrength &strength) const override
      {
        return hardness(strength) * state.contact_fraction / (1. - state.contact_fraction);
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

  TRIBODRAW_REGISTER(AsperityModel, PullenWilliamson, "Pullen-Williamson",
                     "Contact fraction = P / (P + hardness): raised valleys resist.",
                     "J. Pullen, J.B.P. Williamson: On the plastic contact of rough surfaces. "
                     "Proc. R. Soc. Lond. A 327 (1972) 159-173")
} // namespace tribodraw
