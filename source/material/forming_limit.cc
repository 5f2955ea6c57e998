#include <tribodraw/material/forming_limit.h>

namespace tribodraw
{
  double
  forming_limit_margin(const FormingLimitCurve &curve, const double major_strain, const double minor_strain)
  {
    return major_strain / curve.limit(minor_strain);
  }
} // namespace tribodraw
