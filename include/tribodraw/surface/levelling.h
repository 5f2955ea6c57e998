#ifndef tribodraw_surface_levelling_h
#define tribodraw_surface_levelling_h

#include <tribodraw/surface/height_map.h>

#include <string>
#include <vector>

namespace tribodraw
{
  /// Names of the levellings: `none`, `mean`, `plane`.
  const std::vector<std::string> &levelling_names();

  /// Bring the map to zero mean and append to its description what was done.
  /// `none` changes nothing and throws InputError if the mean is not zero already (1e-6 of Sq), because every
  /// user of a map relies on it; `mean` subtracts the mean; `plane` subtracts the least-squares plane (after which a
  /// periodic map is no longer called periodic). An empty map stays as it is.
  void level(HeightMap &map, const std::string &levelling);
} // namespace tribodraw

#endif
