#ifndef tribodraw_flattening_deformed_surface_h
#define tribodraw_flattening_deformed_surface_h

#include <tribodraw/surface/height_map.h>

namespace tribodraw
{
  /// Heights of sheet plus tool [mm]: what a rough tool and a rough sheet have in common is a flat tool on this map.
  /// An empty tool is smooth. The maps need the same grid.
  HeightMap sum_of_heights(const HeightMap &sheet, const HeightMap &tool);

  /// The sheet after flattening to cut height @p s (of sum_of_heights()), with the material of the summits raised
  /// evenly elsewhere. Under a flat tool the plateaus lie at s + u; under a rough one the sheet takes the shape of the
  /// tool where they touch, s + u - t. About the mean plane of the undeformed sheet; the volume does not change.
  /// A tool map must have zero mean.
  HeightMap deformed_sheet(const HeightMap &sheet, const HeightMap &tool, double s);

  /// Gap between deformed sheet and tool, max(0, s - z - t), of mean sum.mean_gap(s) = s + u [mm].
  HeightMap deformed_gap(const HeightMap &sheet, const HeightMap &tool, double s);
} // namespace tribodraw

#endif
