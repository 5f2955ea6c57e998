#ifndef tribodraw_boundary_friction_boundary_friction_h
#define tribodraw_boundary_friction_boundary_friction_h

#include <tribodraw/boundary_friction/ploughing_law.h>
#include <tribodraw/boundary_friction/shear_law.h>

#include <memory>

namespace tribodraw
{
  /// Settings of the friction of touching asperities: section `Boundary friction`.
  ///
  /// Which pressure is which (all MPa; alpha = real contact fraction, doc/theory/friction.md, Pressures):
  ///  - p_solid = P_nom - P_lub per nominal area: flattening, contact fraction, film, flow factors, ploughing load;
  ///  - P0 = plateau_pressure(), per real area: shear strength of the boundary layer;
  ///  - tau_BL per real area, what a table stores as solid shear per nominal area.
  struct BoundaryFriction
  {
    std::shared_ptr<const ShearLaw>     shear_law;
    std::shared_ptr<const PloughingLaw> ploughing;
    unsigned int                        ploughing_directions = 4; ///< over which ploughing is averaged

    /// Reads the current subsection: `Model` and its entries, `Ploughing`, `Ploughing directions`.
    static BoundaryFriction read(Parameters &parameters);
    /// min(tau_BL(p0), k) [MPa per real area].
    double layer_shear(double p0, double shear_strength) const;
    /// Shear stress of the solids per nominal area [MPa]: alpha min(tau_BL(P0), k) + ploughing coefficient * p_solid.
    /// The contact fraction enters here and nowhere else; friction coefficient = this / (p_solid + p_lubricant) when
    /// the lubricant's own shear is left out.
    double shear_per_nominal_area(double contact_fraction, double p_solid, double p_lubricant, double shear_strength,
                                  double ploughing_coefficient) const;
  };

  /// Pressure P0 on the plateaus, per real area [MPa]: P_nom = alpha P0 + (1 - alpha) P_lub and p_solid = P_nom - P_lub
  /// give P0 = p_solid / alpha + P_lub. Zero without contact.
  double plateau_pressure(double p_solid, double contact_fraction, double p_lubricant = 0);
} // namespace tribodraw

#endif
