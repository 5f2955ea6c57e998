#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/gap_shape.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Unrolled: x = R theta, theta from the widest gap.
    class JournalBearing : public GapShape
    {
    public:
      explicit JournalBearing(Parameters &parameters)
      {
        const Range size = Range::positive().usual(1e-3, 1e5);
        radius           = parameters.quantity("Radius", "mm", size, "Radius of the journal.");
        clearance
            = parameters.quantity("Clearance", "um", Range::positive().usual(1e-2, 1e4), "Difference of the radii of bush and journal.");
        eccentricity
            = parameters.quantity("Eccentricity", "", Range::between(0, 0.999), "Distance of the axes over the clearance.");
        b = parameters.quantity("Width", "mm", size, "Length of the bearing along its axis y.");
      }
      double
      length() const override
      {
        return 2. * M_PI * radius;
      }
      double
      width() const override
      {
        return b;
      }
      double
      gap(const double x, double) const override
      {
        return clearance * (1. + eccentricity * std::cos(x / radius));
      }
      double
      direction(const double x) const override
      {
        return x / radius;
      }

    private:
      double radius, clearance, eccentricity, b;
    };
  } // namespace

  TRIBODRAW_REGISTER(GapShape, JournalBearing, "journal",
                     "Journal bearing: the gap is clearance (1 + eccentricity cos(x/radius)), from its widest place once around.",
                     "A. Sommerfeld, Z. Math. Phys. 50 (1904) 97-155")
} // namespace tribodraw
