#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/shape_entries.h>

namespace tribodraw
{
  Facing
  read_facing(Parameters &parameters)
  {
    const std::string facing
        = parameters.choice("Facing", { "down", "up" },
                            "Where the tool touches the sheet: `down` for one above it, `up` for one below it.");
    return facing == "up" ? Facing::up : Facing::down;
  }

  double
  read_diameter(Parameters &parameters, const std::string &documentation)
  {
    const double value = parameters.quantity("Diameter", "mm", Range::positive().usual(0.1, 5000), documentation);
    return parameters.documentation_mode() || !(value > 0) ? 60 : value;
  }
} // namespace tribodraw
