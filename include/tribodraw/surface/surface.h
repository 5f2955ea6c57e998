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
    static const char *kind() { return "surface source"; }
    /// The raw map.
    virtual HeightMap make() const = 0;
  };

  /// Reads the current subsection (`Model` = `file` | `generated` | `smooth`, levelling) without doing work.
  /// @return a function that makes the levelled, zero-mean map; it may be expensive and throws InputError on
  /// bad files. Mistakes in the parameters are recorded in @p parameters.
  std::function<HeightMap()> read_surface(Parameters &parameters);
} // namespace tribodraw

#endif
