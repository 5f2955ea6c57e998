#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/gap_shape.h>

namespace tribodraw
{
  namespace
  {
    class StepGap : public GapShape
    {
    public:
      explicit StepGap(Parameters &parameters)
      {
        const Range film = Range::positive().usual(1e-2, 1e4), size = Range::positive().usual(1e-3, 1e5);
        inlet  = parameters.quantity("Inlet film", "um", film, "Gap before the step.");
        outlet = parameters.quantity("Outlet film", "um", film, "Gap behind the step.");
        l      = parameters.quantity("Length", "mm", size, "Length along the direction of sliding x.");
        b      = parameters.quantity("Width", "mm", size, "Width along y.");
        step   = parameters.quantity("Step position", "mm", size, "Position x of the step.");
        if (!(step < l) && !parameters.documentation_mode())
          parameters.problem("Step position", "The step lies outside the bearing.", "less than `Length`");
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
        return x < step ? inlet : outlet;
      }
      std::vector<double>
      jumps() const override
      {
        return { step };
      }

    private:
      double inlet, outlet, l, b, step;
    };
  } // namespace

  TRIBODRAW_REGISTER(GapShape, StepGap, "step", "Two parallel gaps and a step between them.",
                     "Lord Rayleigh, Phil. Mag. 35 (1918) 1-12")
} // namespace tribodraw
