#include <tribodraw/base/parameters.h>
#include <tribodraw/material/forming_limit.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Forming limit curve of low-carbon steel from hardening exponent n and thickness t (mm), in true strains:
    /// FLC0 = ln[1 + (n/0.21)(0.233 + 0.1413 t)] in plane strain; on the left e1 = FLC0 - e2 (constant thickness
    /// strain). For the right side different rules are in use; here the limit stays at FLC0, which is below all of
    /// them.
    class KeelerBrazier : public FormingLimitCurve
    {
    public:
      explicit KeelerBrazier(Parameters &parameters)
      {
        const double n = parameters.quantity("Hardening exponent", "", Range::positive().usual(0.05, 0.35),
                                             "Exponent n of a power law fitted to the tensile test.");
        const double t = parameters.quantity("Thickness", "mm", Range::positive().usual(0.2, 3.),
                                             "Initial thickness of the sheet.");
        plane_strain   = std::log(1 + n / 0.21 * (0.233 + 0.1413 * t));
      }

      double
      limit(const double minor_strain) const override
      {
        return plane_strain - std::min(0., minor_strain);
      }

    private:
      double plane_strain;
    };
  } // namespace

  TRIBODRAW_REGISTER(FormingLimitCurve, KeelerBrazier, "Keeler-Brazier",
                     "Forming limit curve of low-carbon steel from hardening exponent and thickness; flat right side.",
                     "S. P. Keeler, W. G. Brazier, Micro Alloying 75 (1977) 517-530")
} // namespace tribodraw
