#ifndef tribodraw_surface_closed_voids_h
#define tribodraw_surface_closed_voids_h

#include <tribodraw/surface/height_map.h>

#include <vector>

namespace tribodraw
{
  /// Voids under a flat counter-surface that stands at one height of the map.
  struct VoidState
  {
    double contact_fraction = 0; ///< share of the area above the height
    double height           = 0; ///< about the mean [mm]
    double volume           = 0; ///< of all voids, per area [mm]
    double closed_volume    = 0; ///< Vcl: of the closed voids, per area [mm]
    double closed_area      = 0; ///< share of the area over closed voids
  };

  /// Void volume and closed void volume at contact fractions 1/n, 2/n, ... (n - 1)/n. A void is a set of pixels below
  /// the height that are connected through their edges, as in the flow cells. It is closed (a lubricant pocket) if it
  /// does not reach the border of the map, or on a periodic map if no path in it leads around the map. Lowering the
  /// counter-surface only splits voids, so one pass over the sorted heights with union-find gives all states in O(n log
  /// n).
  std::vector<VoidState> closed_voids(const HeightMap &map, unsigned n = 100);

  /// The state at one contact fraction, linear between those of @p states.
  VoidState state_at(const std::vector<VoidState> &states, double contact_fraction);
} // namespace tribodraw

#endif
