#ifndef tribodraw_boundary_friction_tool_surface_h
#define tribodraw_boundary_friction_tool_surface_h

#include <tribodraw/surface/height_map.h>

#include <cstdint>
#include <vector>

namespace tribodraw
{
  /// Indices of the pixels of a map from the highest to the lowest.
  std::vector<std::uint32_t> pixels_by_height(const HeightMap &map);

  /// A tool map prepared for ploughing: what does not depend on the load. The map must outlive it.
  ///
  /// Slopes are one-sided differences to the neighbours, each valid on a quarter of the pixel: the surface that joins
  /// the heights of neighbouring pixels by straight lines. Averages are over these quarters and over sliding
  /// directions spread evenly over 360 degrees (@p n_directions and their opposites).
  struct ToolSurface
  {
    ToolSurface(const HeightMap &tool, unsigned int n_directions);

    const HeightMap           &map;
    const unsigned int         n_directions; ///< over 180 degrees
    std::vector<std::uint32_t> order;        ///< pixels_by_height()
    /// Per pixel and unit area: means of ploughing_traction() over the parts that lead (zx < 0), which are one half of
    /// the area, as every slope leads in one of two opposite directions: |zx|, sqrt(1 + zy^2), |zx| / sqrt(1 + zy^2).
    std::vector<float> frontal, shear_drag, shear_support;
    std::vector<float> square_slope; ///< mean of zx^2 + zy^2
  };
} // namespace tribodraw

#endif
