#include <tribodraw/base/parameters.h>

#include "quadratic_locus.h"

namespace tribodraw
{
  namespace
  {
    /// Isotropic plane-stress locus: sigma^2 = sxx^2 - sxx syy + syy^2 + 3 sxy^2 (von Mises 1913).
    class VonMises : public QuadraticLocus
    {
    public:
      explicit VonMises(Parameters &) { set(1, -1, 1, 3); }
    };
  } // namespace

  TRIBODRAW_REGISTER(YieldLocus, VonMises, "von Mises", "Isotropic yield locus; no parameters.",
                     "R. von Mises, Nachr. Ges. Wiss. Goettingen (1913) 582-592")
} // namespace tribodraw
