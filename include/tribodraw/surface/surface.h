#ifndef tribodraw_surface_surface_h
#define tribodraw_surface_surface_h

#include <tribodraw/surface/height_map.h>

#include <functional>
#include <memory>

namespace tribodraw
{
  class Parameters;

  /// A way to obtain a height map: read from a file or generated from a seed.
  class SurfaceSource
  {
  public:
    virtual ~SurfaceSource() = default;
    static const char *
    kind()
    {
      return "surface source";
    }
    /// The raw map. A map with nx = 0 stands for an ideally smooth surface.
    virtual HeightMap make() const = 0;
    /// True if the heights may contain offset and tilt, so that the user must choose a levelling. Sources whose maps
    /// are level by construction return false, and levelling is then `none` unless stated.
    virtual bool
    needs_levelling() const
    {
      return true;
    }
  };

  /// Reads the current subsection (`Model` = `file` | `generated` | `smooth`, levelling) without doing work.
  /// @return a function that makes the levelled, zero-mean map; it may be expensive and throws InputError on
  /// bad files. For an ideally smooth surface the map is empty (nx = ny = 0). The same seed gives the same map on every
  /// rank without communication. Mistakes in the parameters are recorded in @p parameters.
  std::function<HeightMap()> read_surface(Parameters &parameters);
} // namespace tribodraw

#endif
