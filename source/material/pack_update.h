#ifndef tribodraw_material_pack_update_h
#define tribodraw_material_pack_update_h

#include <tribodraw/material/hardening_law.h>
#include <tribodraw/material/point_batch.h>
#include <tribodraw/material/yield_locus.h>

namespace tribodraw
{
  /// A logarithmic strain as exx + eyy, exx - eyy and gamma, conjugate to MohrStress.
  struct MohrStrainPack
  {
    Pack m, a, b;
  };

  /// A symmetric matrix over (m, a, b).
  struct SymmetricPack
  {
    Pack mm, aa, bb, ma, mb, ab;
  };

  /// The plane-stress update of four points in logarithmic strain space, with the equations of ReturnMapping and of
  /// SheetMaterial::update().
  class PackUpdate
  {
  public:
    PackUpdate(const SheetMaterial &material, const PointOptions &options);

    struct Result
    {
      MohrStress<Pack> stress;
      SymmetricPack    tangent;      ///< d stress / d strain, if options.tangent
      PackMask         plastic;      ///< yielded in this increment
      PackMask         failed;       ///< not converged: not to be used
      Pack             flow;         ///< increment of the equivalent plastic strain
      Pack             plastic_work; ///< per volume
    };
    /// @param elastic_trial strain without the old plastic strain
    /// @param eps_p old equivalent plastic strain
    void solve(const MohrStrainPack &elastic_trial, const Pack &eps_p, Result &result) const;

    /// Stiffness of the mean and of the deviatoric stress [MPa].
    double mean_modulus, shear_modulus;

  private:
    const YieldLocus   &locus;
    const HardeningLaw &hardening;
    const PointOptions  options;
  };
} // namespace tribodraw

#endif
