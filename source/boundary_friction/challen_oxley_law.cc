#include "patch_sums.h"

#include <tribodraw/boundary_friction/challen_oxley.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Every patch is a wedge with the attack angle of its leading side, tan theta = frontal / load-bearing area; its
    /// pressure follows from the slip-line field and falls with the shear of the boundary layer.
    struct ChallenOxleyIndentation : PatchIndentation
    {
      using PatchIndentation::PatchIndentation;

      IndentationForces
      forces(const std::size_t n_pixels) const override
      {
        const double k = strength.shear_strength, f = strength.tau / k;
        return sum_over_patches(
            contact, n_pixels,
            [&](IndentationForces &sums, const ContactPatch &patch, const double psi, const double weight) {
              const PloughingForces geometry = plough_paraboloid(patch.a, patch.b, depth.of(patch), psi, 0., 0.);
              const double          area = weight * geometry.projected_area, frontal = weight * geometry.frontal_area;
              const ChallenOxley    wedge = challen_oxley(std::atan2(frontal, area), f);
              sums.area += area;
              sums.pressure_support += k * wedge.pressure * area;
              sums.pressure_drag += k * wedge.pressure * frontal;
              sums.shear_support += k * wedge.shear * frontal;
              sums.shear_drag += k * wedge.shear * area;
            });
      }
    };

    using ChallenOxleyLaw = PatchLaw<ChallenOxleyIndentation>;
  } // namespace

  TRIBODRAW_REGISTER(PloughingLaw, ChallenOxleyLaw, "Challen-Oxley",
                     "Every contact patch is a wedge of its mean slope; slip-line solutions for wave, wedge and "
                     "cutting.",
                     "J.M. Challen, P.L.B. Oxley: An explanation of the different regimes of friction and wear using "
                     "asperity deformation models. Wear 53 (1979) 229-243")
} // namespace tribodraw
