#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/gap_shape.h>

namespace tribodraw
{
  namespace
  {
    class InclinedSlider : public GapShape
    {
    public:
      explicit InclinedSlider(Parameters &parameters)
      {
        const Range film = Range::positive().usual(1e-2, 1e4), size = Range::positive().usual(1e-3, 1e5);
        inlet  = parameters.quantity("Inlet film", "um", film, "Gap at x = 0.");
        outlet = parameters.quantity("Outlet film", "um", film, "Gap at x = length.");
        l      = parameters.quantity("Length", "mm", size, "Length along the direction of sliding x.");
        b      = parameters.quantity("Width", "mm", size, "Width along y.");
      }
      double
      length() const override
      {
        return l;
      }
      double
      width() const override
      {
        return b;
      }
      double
      gap(const double x, double) const override
      {
        return inlet + (outlet - inlet) * x / l;
      }

    private:
      double inlet, outlet, l, b;
    };
  } // namespace

  TRIBODRAW_REGISTER(GapShape, InclinedSlider, "inclined slider",
                     "Plane slider: the gap changes linearly from inlet to outlet.",
                     "Lord Rayleigh, Phil. Mag. 35 (1918) 1-12")
} // namespace tribodraw
