#ifndef tribodraw_boundary_friction_boundary_friction_h
#define tribodraw_boundary_friction_boundary_friction_h

#include <tribodraw/boundary_friction/shear_law.h>

#include <memory>

namespace tribodraw
{
  /// Settings of the friction of touching asperities: section `Boundary friction`.
  struct BoundaryFriction
  {
    std::shared_ptr<const ShearLaw> shear_law;
    unsigned int                    ploughing_directions = 4; ///< sliding directions over which ploughing is averaged

    /// Reads the current subsection: `Model` and its entries, `Ploughing directions`.
    static BoundaryFriction read(Parameters &parameters);
    /// min(tau_BL(p0), k) [MPa per real area].
    double layer_shear(double p0, double shear_strength) const;
  };
} // namespace tribodraw

#endif
