#ifndef tribodraw_boundary_friction_ploughing_h
#define tribodraw_boundary_friction_ploughing_h

#include <tribodraw/boundary_friction/contact_patches.h>
#include <tribodraw/boundary_friction/ploughing_law.h>

#include <cstddef>

namespace tribodraw
{
  /// Forces on a hard asperity that slides in +x through a softer, rigid-plastic body. [N if lengths are in mm]
  struct PloughingForces
  {
    double drag           = 0; ///< against the sliding
    double support        = 0; ///< normal to the surface
    double lateral        = 0; ///< in +y, on the asperity
    double projected_area = 0; ///< load-bearing area A_xy [mm^2]
    double frontal_area   = 0; ///< A_yz [mm^2]
  };

  /// Forces per projected area dx dy where the tool surface z = -zeta(x,y) has slopes zx = d zeta/dx < 0 (leading side)
  /// and zy: normal pressure @p p on the true surface and shear @p tau against the sliding direction projected on it,
  ///   drag = p |zx| + tau sqrt(1+zy^2),  support = p - tau |zx| / sqrt(1+zy^2),  lateral = p zy + tau zx zy /
  ///   sqrt(1+zy^2).
  PloughingForces ploughing_traction(double zx, double zy, double p, double tau);

  /// The integral of ploughing_traction() over the leading half of the elliptical paraboloid
  ///   zeta = w (1 - (x'/a)^2 - (y'/b)^2),  x' axis at angle @p psi to the sliding direction.
  /// Exact: the pressure terms and the radial integrals in closed form, the angle by Gauss quadrature (converged to
  /// round-off for slopes below 1). @p a, @p b semi-axes, @p w depth [mm].
  PloughingForces plough_paraboloid(double a, double b, double w, double psi, double p, double tau);

  /// What the indentation of a rough tool into the flattened sheet came to.
  struct PloughingBalance
  {
    /// (drag - tau * touching area that was counted) / load. The pure shear of the boundary layer is not in it: the
    /// friction table adds it over the whole plateau, alpha min(tau_BL, k) + coefficient * p_solid.
    double      coefficient    = 0;
    double      support        = 0; ///< carried by the patches, per nominal area [MPa]
    double      patch_fraction = 0; ///< area of the contact patches per nominal area
    double      patch_pressure = 0; ///< mean pressure on the leading sides [MPa]
    double      back_pressure  = 0; ///< on the trailing sides [MPa]; 0 unless in full contact
    std::size_t n_patches      = 0;
    bool        full_contact   = false; ///< plateaus touch everywhere, trailing sides carry as well
  };

  /// Find the indentation of the tool at which its contact patches carry @p p_solid per nominal area.
  ///
  /// As long as the leading sides can carry the load, they alone do: the groove behind a summit stays open. Pixels
  /// enter the contact one at a time; two states that differ by one pixel or 0.2 % of them are mixed so that support
  /// equals load. If the whole plateau touches and its leading sides cannot carry the load, the rest is a uniform back
  /// pressure on all of the plateau, leading and trailing sides alike: plastic flow, and with it the drag, depends on
  /// the difference of the pressures only (doc/theory/friction.md, Full contact).
  PloughingBalance balance_ploughing(const PlateauContact &contact, const PloughingLaw &law, double p_solid,
                                     const PloughingStrength &strength);
} // namespace tribodraw

#endif
