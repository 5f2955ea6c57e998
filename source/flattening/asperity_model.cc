#include <tribodraw/flattening/asperity_model.h>
#include <tribodraw/flattening/height_distribution.h>
#include <tribodraw/material/hardening_law.h>

#include <cmath>

namespace tribodraw
{
  PlateauState::PlateauState(const HeightDistribution &h, const double s)
      : contact_fraction(h.contact_fraction(s)), cut_height(s), heights(&h)
  {
  }

  SheetStrength::SheetStrength(const HardeningLaw &law, const double eps, const double eps_rate)
      : shear_strength(law.flow_stress(eps, eps_rate).value / std::sqrt(3.)), hardening(&law), strain(eps),
        rate(eps_rate)
  {
  }

  double
  SheetStrength::flow_stress(const double extra) const
  {
    return hardening && extra > 0 ? hardening->flow_stress(strain + extra, rate).value : std::sqrt(3.) * shear_strength;
  }
} // namespace tribodraw
