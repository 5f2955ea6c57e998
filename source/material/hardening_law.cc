#include <tribodraw/material/hardening_law.h>

namespace tribodraw
{
  void
  HardeningLaw::flow_stress_pack(const Pack &strain, const Pack &rate, FlowStressOf<Pack> &result) const
  {
    for (unsigned i = 0; i < pack::lanes; ++i)
      {
        const FlowStress one   = flow_stress(strain[i], rate[i]);
        result.value[i]        = one.value;
        result.strain_slope[i] = one.strain_slope;
        result.rate_slope[i]   = one.rate_slope;
      }
  }
} // namespace tribodraw
