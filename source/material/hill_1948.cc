#include <tribodraw/base/parameters.h>

#include "quadratic_locus.h"

namespace tribodraw
{
  namespace
  {
    /// Quadratic orthotropic locus fitted to three R-values (width over thickness strain in a tensile test at 0, 45
    /// and 90 degrees to the rolling direction), normalised to the flow stress in rolling direction (G + H = 1):
    /// sigma^2 = sxx^2 - 2 H sxx syy + (F + H) syy^2 + 2 N sxy^2 with H = R0/(1+R0), F = H/R90,
    /// N = (R0+R90)(1+2 R45)/(2 R90 (1+R0)).
    class Hill1948 : public QuadraticLocus
    {
    public:
      explicit Hill1948(Parameters &parameters)
      {
        const Range  range = Range::positive().usual(0.2, 5.);
        const double R0    = parameters.quantity("R0", "", range, "R-value in rolling direction.");
        const double R45   = parameters.quantity("R45", "", range, "R-value at 45 degrees to the rolling direction.");
        const double R90   = parameters.quantity("R90", "", range, "R-value across the rolling direction.");
        const double H     = R0 / (1 + R0);
        const double F     = H / R90;
        const double N     = (R0 + R90) * (1 + 2 * R45) / (2 * R90 * (1 + R0));
        set(1, -2 * H, F + H, 2 * N);
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(YieldLocus, Hill1948, "Hill 1948",
                     "Quadratic orthotropic yield locus fitted to the R-values at 0, 45 and 90 degrees.",
                     "R. Hill, Proc. R. Soc. London A 193 (1948) 281-297")
} // namespace tribodraw
