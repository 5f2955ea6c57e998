#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/gap_shape.h>

namespace tribodraw
{
  namespace
  {
    class ParallelGap : public GapShape
    {
    public:
      explicit ParallelGap(Parameters &parameters)
      {
        const Range size = Range::positive().usual(1e-3, 1e5);
        film             = parameters.quantity("Film", "um", Range::positive().usual(1e-2, 1e5), "Gap.");
        l                = parameters.quantity("Length", "mm", size, "Length along the direction of sliding x.");
        b                = parameters.quantity("Width", "mm", size, "Width along y.");
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
      gap(double, double) const override
      {
        return film;
      }

    private:
      double film, l, b;
    };

  } // namespace

  TRIBODRAW_REGISTER(GapShape, ParallelGap, "parallel", "Two parallel rectangles, for squeeze films.",
                     "J. Stefan, Sitzungsber. Akad. Wiss. Wien 69 (1874) 713-735")
} // namespace tribodraw
