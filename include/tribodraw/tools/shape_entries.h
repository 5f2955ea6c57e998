#ifndef tribodraw_tools_shape_entries_h
#define tribodraw_tools_shape_entries_h

#include <string>

namespace tribodraw
{
  class Parameters;

  /// Where a tool touches the sheet: `up` from below, `down` from above.
  enum class Facing
  {
    up,
    down
  };

  /// Entry `Facing`.
  Facing read_facing(Parameters &parameters);

  /// Entry `Diameter` [mm]; an example where there is no readable value.
  double read_diameter(Parameters &parameters, const std::string &documentation);

  /// +1 for a tool that faces up.
  inline double
  normal_z(const Facing facing)
  {
    return facing == Facing::up ? 1 : -1;
  }
} // namespace tribodraw

#endif
