#include "rectangular_gap.h"

namespace tribodraw
{
  namespace
  {
    class InclinedSlider : public RectangularGap
    {
    public:
      explicit InclinedSlider(Parameters &parameters) : RectangularGap(parameters)
      {
        const Range film = Range::positive().usual(1e-2, 1e4);
        inlet            = parameters.quantity("Inlet film", "um", film, "Gap at x = 0.");
        outlet           = parameters.quantity("Outlet film", "um", film, "Gap at x = length.");
      }
      double
      gap(const double x, double) const override
      {
        return inlet + (outlet - inlet) * x / l;
      }

    private:
      double inlet, outlet;
    };
  } // namespace

  TRIBODRAW_REGISTER(GapShape, InclinedSlider, "inclined slider",
                     "Plane slider: the gap changes linearly from inlet to outlet.",
                     "Lord Rayleigh, Phil. Mag. 35 (1918) 1-12")
} // namespace tribodraw
