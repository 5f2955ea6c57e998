#ifndef tribodraw_material_sheet_material_h
#define tribodraw_material_sheet_material_h

#include <tribodraw/material/hardening_law.h>
#include <tribodraw/material/yield_locus.h>

#include <memory>

namespace tribodraw
{
  /// Plastic state of a material point: logarithmic plastic strain (xx, yy, gamma_xy; axes of the blank, which
  /// turn with the material) and accumulated equivalent plastic strain.
  struct PlasticState
  {
    Vector3 plastic_strain = Vector3::Zero();
    double  eps_p          = 0;
  };

  /// Result of a stress update in logarithmic strain space.
  struct StressUpdate
  {
    Vector3 stress;               ///< conjugate to the logarithmic strain [MPa]
    Matrix3 tangent;              ///< algorithmic tangent d stress / d strain [MPa]
    bool    plastic    = false;   ///< yielded in this increment
    double  plastic_work = 0;     ///< of the increment, per reference volume [N/mm^2]
    double  elastic_energy = 0;   ///< stored, per reference volume [N/mm^2]
    bool    converged  = true;
  };

  /// Elastic-plastic sheet material in plane stress: isotropic elasticity, additive plasticity in logarithmic strains,
  /// yield locus and hardening law from the registry. No state of its own: thread-safe.
  class SheetMaterial
  {
  public:
    /// Reads the current subsection (`Sheet material`): Young's modulus, Poisson's ratio, yield locus, hardening law.
    static SheetMaterial read(Parameters &parameters);
    SheetMaterial(double                              youngs_modulus,
                  double                              poissons_ratio,
                  std::shared_ptr<const YieldLocus>   locus,
                  std::shared_ptr<const HardeningLaw> hardening);

    double              youngs_modulus() const { return E; }
    double              poissons_ratio() const { return nu; }
    const YieldLocus   &locus() const { return *yield_locus; }
    const HardeningLaw &hardening() const { return *hardening_law; }
    /// Plane-stress elasticity matrix [MPa] (engineering shear strain).
    const Matrix3      &elasticity() const { return D; }

    /// Backward-Euler update from @p old to total logarithmic strain @p strain (E11, E22, 2 E12).
    /// @param time_increment [s], for the strain rate; > 0
    /// @param loading_tangent return the plastic tangent also for a point that lies on the yield surface
    ///        without flowing (used by the predictor of the forming loop)
    StressUpdate update(const Vector3      &strain,
                        const PlasticState &old_state,
                        double              time_increment,
                        PlasticState       &new_state,
                        bool                loading_tangent = false) const;

    /// Logarithmic strain through the thickness from elastic and plastic parts:
    /// -nu/(1-nu) tr(E - E^p) - tr E^p.
    double thickness_strain(const Vector3 &strain, const PlasticState &state) const;

  private:
    double                              E, nu;
    Matrix3                             D;
    std::shared_ptr<const YieldLocus>   yield_locus;
    std::shared_ptr<const HardeningLaw> hardening_law;
  };

  /// A material point that is driven by the right Cauchy-Green tensor of the surface.
  struct CauchyGreenResponse
  {
    Vector3 stress;  ///< s = dW/dC_v with C_v = (C11, C22, C12): s = (S11, S22, 2 S12)/2 [MPa]
    Matrix3 tangent; ///< d s / d C_v, symmetric for associated plasticity [MPa]
    Vector3 strain;  ///< logarithmic strain (E11, E22, 2 E12)
    StressUpdate update;
  };

  /// Evaluate the material for C = (C11, C22, C12) (positive definite), via E = 1/2 ln C (Miehe's logarithmic strain space).
  CauchyGreenResponse evaluate_in_cauchy_green(const SheetMaterial &material,
                                               const Vector3       &C,
                                               const PlasticState  &old_state,
                                               double               time_increment,
                                               PlasticState        &new_state,
                                               bool                 loading_tangent = false);
} // namespace tribodraw

#endif
