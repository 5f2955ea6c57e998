#ifndef tribodraw_surface_height_map_h
#define tribodraw_surface_height_map_h

#include <cstddef>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Heights of a surface on a regular grid. Heights point out of the material (towards the counter-surface);
  /// x is the rolling direction of a sheet, y points up in a picture seen from above. All lengths in mm.
  ///
  /// In a map as read from a file a point that was not measured is NaN. Whoever works on heights may rely on
  /// read_surface(), which fills or refuses such points: maps beyond it are finite.
  struct HeightMap
  {
    std::size_t         nx = 0, ny = 0;   ///< pixels along x and y
    double              dx = 0, dy = 0;   ///< pixel sizes [mm]
    std::vector<double> z;                ///< heights [mm], z[iy * nx + ix]; zero mean after levelling
    bool                periodic = false; ///< the map continues at the opposite side without a jump (generated maps)
    std::string         description;      ///< where it comes from and what was applied to it

    double
    operator()(std::size_t ix, std::size_t iy) const
    {
      return z[iy * nx + ix];
    }
    double &
    operator()(std::size_t ix, std::size_t iy)
    {
      return z[iy * nx + ix];
    }
    std::size_t
    size() const
    {
      return nx * ny;
    }
    /// Hash over sizes and heights, for provenance and caching.
    std::string hash() const;
  };

  /// Number of points that were not measured (NaN).
  std::size_t n_missing(const HeightMap &map);
} // namespace tribodraw

#endif
