#include "rectangular_gap.h"

namespace tribodraw
{
  namespace
  {
    class ParallelGap : public RectangularGap
    {
    public:
      explicit ParallelGap(Parameters &parameters) : RectangularGap(parameters)
      {
        film = parameters.quantity("Film", "um", Range::positive().usual(1e-2, 1e5), "Gap.");
      }
      double
      gap(double, double) const override
      {
        return film;
      }

    private:
      double film;
    };

  } // namespace

  TRIBODRAW_REGISTER(GapShape, ParallelGap, "parallel", "Two parallel rectangles, for squeeze films.",
                     "J. Stefan, Sitzungsber. Akad. Wiss. Wien 69 (1874) 713-735")
} // namespace tribodraw
