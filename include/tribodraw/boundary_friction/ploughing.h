#ifndef tribodraw_boundary_friction_ploughing_h
#define tribodraw_boundary_friction_ploughing_h

#include <tribodraw/boundary_friction/contact_patches.h>

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
    /// (drag - tau * load-bearing area of the patches) / load. The pure shear of the boundary layer is not in it: the
    /// friction table adds it over the whole plateau, alpha min(tau_BL, k) + coefficient * p_solid.
    double      coefficient    = 0;
    double      support        = 0; ///< carried by the patches, per nominal area [MPa]
    double      patch_fraction = 0; ///< area of the contact patches per nominal area
    double      patch_pressure = 0; ///< pressure on the leading sides [MPa]: the hardness unless saturated
    std::size_t n_patches      = 0;
    bool        saturated = false; ///< all plateaus touch and still carry less at the hardness: the pressure is raised
  };

  /// Find the indentation of the tool at which the leading sides of its contact patches, at pressure @p hardness and
  /// shear stress @p tau, carry @p p_solid per nominal area; average over @p n_directions sliding directions spread
  /// over 180 degrees. Pixels enter the contact one at a time; two states that differ by one pixel or 0.2 % of them are
  /// mixed so that support equals load.
  PloughingBalance balance_ploughing(const PlateauContact &contact, double p_solid, double hardness, double tau,
                                     unsigned int n_directions);
} // namespace tribodraw

#endif
