#include <tribodraw/base/registry.h>
#include <tribodraw/surface/surface.h>

namespace tribodraw
{
  namespace
  {
    /// A surface whose roughness is neglected against that of its partner: an empty map.
    class SmoothSurface : public SurfaceSource
    {
    public:
      explicit SmoothSurface(Parameters &) {}

      HeightMap
      make() const override
      {
        HeightMap map;
        map.periodic    = true;
        map.description = "ideally smooth";
        return map;
      }

      bool
      needs_levelling() const override
      {
        return false;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceSource, SmoothSurface, "smooth",
                     "Ideally smooth: the roughness is neglected against that of the other surface.", "")
} // namespace tribodraw
