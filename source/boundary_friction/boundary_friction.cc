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
    result.ploughing = parameters.model<PloughingLaw>(
        "Ploughing", "How summits of a rough tool plough the plateaus of the sheet. A smooth tool does not plough.",
        Default{ "paraboloid", "the model of the paper" });
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

  double
  BoundaryFriction::shear_per_nominal_area(const double contact_fraction, const double p_solid,
                                           const double p_lubricant, const double shear_strength,
                                           const double ploughing_coefficient) const
  {
    if (!(p_solid > 0))
      return 0.;
    const double p0 = plateau_pressure(p_solid, contact_fraction, p_lubricant);
    return contact_fraction * layer_shear(p0, shear_strength) + ploughing_coefficient * p_solid;
  }

  double
  plateau_pressure(const double p_solid, const double contact_fraction, const double p_lubricant)
  {
    return contact_fraction > 0 ? p_solid / contact_fraction + p_lubricant : 0.;
  }
} // namespace tribodraw
