#include "patch_sums.h"

namespace tribodraw
{
  namespace
  {
    /// Every patch ploughs as an elliptical paraboloid at any orientation.
    struct ParaboloidIndentation : PatchIndentation
    {
      using PatchIndentation::PatchIndentation;

      IndentationForces
      forces(const std::size_t n_pixels) const override
      {
        return sum_over_patches(
            contact, n_pixels,
            [&](IndentationForces &sums, const ContactPatch &patch, const double psi, const double weight) {
              const PloughingForces by_shear
                  = plough_paraboloid(patch.a, patch.b, depth.of(patch), psi, 0., weight * strength.tau);
              sums.area += weight * by_shear.projected_area;
              sums.pressure_support += weight * strength.hardness * by_shear.projected_area;
              sums.pressure_drag += weight * strength.hardness * by_shear.frontal_area;
              sums.shear_support -= by_shear.support;
              sums.shear_drag += by_shear.drag;
            });
      }
    };

    using Paraboloid = PatchLaw<ParaboloidIndentation>;
  } // namespace

  TRIBODRAW_REGISTER(PloughingLaw, Paraboloid, "paraboloid",
                     "Every contact patch is an elliptical paraboloid; normal pressure and shear are integrated over "
                     "its leading side.",
                     "Idea: T. Mishra, M. de Rooij, M. Shisode, J. Hazrati, D.J. Schipper: works on ploughing of "
                     "elliptical asperities (2019). The integrals are ours.")
} // namespace tribodraw
