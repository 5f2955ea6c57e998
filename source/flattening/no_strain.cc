#include <tribodraw/base/registry.h>
#include <tribodraw/flattening/bulk_strain_law.h>

#include <limits>

namespace tribodraw
{
  namespace
  {
    /// Strain acts through the hardening of the sheet only.
    class NoStrain : public BulkStrainLaw
    {
    public:
      explicit NoStrain(Parameters &) {}

      double
      strain_rate_number(double, double, double) const override
      {
        return std::numeric_limits<double>::infinity();
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(BulkStrainLaw, NoStrain, "none", "Bulk strain does not flatten asperities.",
                     "Load alone, as in F.P. Bowden, D. Tabor: The Friction and Lubrication of Solids. Oxford 1950")
} // namespace tribodraw
