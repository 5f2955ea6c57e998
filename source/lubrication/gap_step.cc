#include "rectangular_gap.h"

namespace tribodraw
{
  namespace
  {
    class StepGap : public RectangularGap
    {
    public:
      explicit StepGap(Parameters &parameters) : RectangularGap(parameters)
      {
        const Range film = Range::positive().usual(1e-2, 1e4);
        inlet            = parameters.quantity("Inlet film", "um", film, "Gap before the step.");
        outlet           = parameters.quantity("Outlet film", "um", film, "Gap behind the step.");
        step             = parameters.quantity("Step position", "mm", sides(), "Position x of the step.");
        if (!(step < l) && !parameters.documentation_mode())
          parameters.problem("Step position", "The step lies outside the bearing.", "less than `Length`");
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
      double inlet, outlet, step;
    };
  } // namespace

  TRIBODRAW_REGISTER(GapShape, StepGap, "step", "Two parallel gaps and a step between them.",
                     "Lord Rayleigh, Phil. Mag. 35 (1918) 1-12")
} // namespace tribodraw
