#ifndef tribodraw_flattening_asperity_count_h
#define tribodraw_flattening_asperity_count_h

#include <tribodraw/surface/height_map.h>

namespace tribodraw
{
  /// Number and spacing of the asperities of a map.
  struct AsperityCount
  {
    double density          = 0; ///< asperities per nominal area [1/mm^2]
    double half_spacing     = 0; ///< l = 1 / (2 sqrt(density)) [mm]
    double cut_height       = 0; ///< the state in which they were counted [mm]
    double contact_fraction = 0; ///< in that state
  };

  /// Count asperities: connected pieces (8 neighbours; across the borders of a periodic map) of the plateaus
  /// { z >= s }, in the state s in which there are most. Before, summits have not come up yet; after, plateaus merge.
  /// A piece counts only from the depth at which it stands @p pruning times the map's height range above the saddle to
  /// the next higher one (Wolf pruning as for hills in ISO 25178-2, there 5 %): roughness on a plateau is no asperity.
  AsperityCount count_asperities(const HeightMap &map, double pruning = 0.05);
} // namespace tribodraw

#endif
