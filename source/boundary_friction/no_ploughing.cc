#include <tribodraw/base/registry.h>
#include <tribodraw/boundary_friction/ploughing_law.h>

namespace tribodraw
{
  namespace
  {
    /// The boundary layer alone, whatever the tool's roughness.
    class NoPloughing : public PloughingLaw
    {
    public:
      explicit NoPloughing(Parameters &) {}

      std::unique_ptr<Indentation>
      indentation(const PlateauContact &, const PloughingStrength &) const override
      {
        return nullptr;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(PloughingLaw, NoPloughing, "none", "Tool summits do not plough; the boundary layer is sheared.",
                     "F.P. Bowden, D. Tabor: The Friction and Lubrication of Solids. Oxford 1950 (shear term)")
} // namespace tribodraw
