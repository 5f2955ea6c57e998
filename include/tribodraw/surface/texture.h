#ifndef tribodraw_surface_texture_h
#define tribodraw_surface_texture_h

#include <tribodraw/surface/random_field.h>

#include <string>
#include <vector>

namespace tribodraw
{
  /// The kind of a generated surface: what its heights look like up to a shift and a factor. The generated surface
  /// source scales the result to zero mean and the prescribed Sq.
  class SurfaceTexture
  {
  public:
    virtual ~SurfaceTexture() = default;
    static const char *
    kind()
    {
      return "surface texture";
    }
    /// Heights in arbitrary units, row by row, periodic in x and y. Random numbers come from @p deviates only.
    virtual std::vector<double> heights(const Grid &grid, NormalDeviates &deviates) const = 0;
    /// What speaks against this texture on this grid (a length that the grid cannot show), or nothing.
    virtual std::string problem(const Grid &grid) const = 0;
  };
} // namespace tribodraw

#endif
