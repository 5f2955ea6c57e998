#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/gap_shape.h>

namespace tribodraw
{
  namespace
  {
    class DiscGap : public GapShape
    {
    public:
      explicit DiscGap(Parameters &parameters)
      {
        film   = parameters.quantity("Film", "um", Range::positive().usual(1e-2, 1e5), "Gap.");
        radius = parameters.quantity("Radius", "mm", Range::positive().usual(1e-3, 1e5), "Radius of the discs.");
      }
      double
      length() const override
      {
        return 2. * radius;
      }
      double
      width() const override
      {
        return 2. * radius;
      }
      double
      gap(double, double) const override
      {
        return film;
      }
      double
      disc_radius() const override
      {
        return radius;
      }

    private:
      double film, radius;
    };
  } // namespace

  TRIBODRAW_REGISTER(GapShape, DiscGap, "disc", "Two parallel discs around the origin, for squeeze films.",
                     "J. Stefan, Sitzungsber. Akad. Wiss. Wien 69 (1874) 713-735")
} // namespace tribodraw
