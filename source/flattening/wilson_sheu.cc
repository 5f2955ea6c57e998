#include <tribodraw/base/registry.h>
#include <tribodraw/flattening/asperity_model.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Upper-bound fit of Wilson and Sheu (1988) for plateaus on a sheet that does not strain (their E = 0):
    ///   P / (A k) = 2 / f2(A),   1/f2 = 2.571 - A - A ln(1 - A).
    class WilsonSheu : public AsperityModel
    {
    public:
      explicit WilsonSheu(Parameters &) {}

      double
      normal_load(const PlateauState &state, const SheetStrength &strength) const override
      {
        const double alpha = state.contact_fraction;
        return alpha > 0 ? 2. * strength.shear_strength * alpha * (2.571 - alpha - alpha * std::log1p(-alpha)) : 0.;
      }
      double
      hardness(const SheetStrength &strength) const override
      {
        return 2. * 2.571 * strength.shear_strength;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(AsperityModel, WilsonSheu, "Wilson-Sheu",
                     "Upper-bound fit for plateaus that interact as they grow; its hardness at small contact is the "
                     "slip-line value 5.14 k.",
                     "W.R.D. Wilson, S. Sheu: Real area of contact and boundary friction in metal forming. "
                     "Int. J. Mech. Sci. 30 (1988) 475-489")
} // namespace tribodraw
