#include <tribodraw/base/parameters.h>
#include <tribodraw/boundary_friction/boundary_friction.h>

#include <algorithm>

namespace tribodraw
{
  BoundaryFriction
  BoundaryFriction::read(Parameters &parameters)
  {
    BoundaryFriction result;
    result.shear_law
        = parameters.model<ShearLaw>("Model", "Shear strength of the boundary layer on touching plateaus.");
    result.ploughing_directions = static_cast<unsigned int>(parameters.integer(
        "Ploughing directions", Range::between(1, 180),
        "Number of sliding directions, spread evenly over 180 degrees, over which ploughing by a rough tool "
        "is averaged.",
        Default{ "4", "along, across and both diagonals: exact for patches of any orientation up to terms "
                      "that repeat every 45 degrees" }));
    return result;
  }

  double
  BoundaryFriction::layer_shear(const double p0, const double shear_strength) const
  {
    return std::min(shear_law->shear_stress(p0), shear_strength);
  }
} // namespace tribodraw
