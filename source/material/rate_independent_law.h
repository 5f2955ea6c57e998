#ifndef tribodraw_material_rate_independent_law_h
#define tribodraw_material_rate_independent_law_h

#include <tribodraw/base/parameters.h>
#include <tribodraw/material/hardening_law.h>

namespace tribodraw
{
  /// A hardening law that does not depend on the strain rate. @p Law has a member `compute(strain)` for one number and
  /// for a pack of them; both functions of the interface come from it.
  template <class Law>
  class RateIndependentLaw : public HardeningLaw
  {
  public:
    FlowStress
    flow_stress(const double strain, double /*rate*/) const override
    {
      return static_cast<const Law &>(*this).compute(strain);
    }
    void
    flow_stress_pack(const Pack &strain, const Pack & /*rate*/, FlowStressOf<Pack> &result) const override
    {
      pack::vectorised([&]() TRIBODRAW_INLINE { result = static_cast<const Law &>(*this).compute(strain); });
    }
  };
} // namespace tribodraw

#endif
