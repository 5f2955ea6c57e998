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
    Vector3 stress;                 ///< conjugate to the logarithmic strain [MPa]
    Matrix3 tangent;                ///< algorithmic tangent d stress / d strain [MPa]
    bool    plastic        = false; ///< yielded in this increment
    double  plastic_work   = 0;     ///< of the increment, per reference volume [N/mm^2]
    double  elastic_energy = 0;     ///< stored, per reference volume [N/mm^2]
    bool    converged      = true;
    /// Parts into which the increment had to be cut, radially from the elastic state without stress, because it could
    /// not be solved in one; 0: in one. The tangent then comes from differences.
    unsigned sub_steps = 0;
  };

  /// Elastic-plastic sheet material in plane stress: isotropic elasticity, additive plasticity in logarithmic strains,
  /// yield locus and hardening law from the registry. No state of its own: thread-safe.
  class SheetMaterial
  {
  public:
    /// Reads the current subsection (`Sheet material`): Young's modulus, Poisson's ratio, yield locus, hardening law.
    static SheetMaterial read(Parameters &parameters);
    SheetMaterial(double youngs_modulus, double poissons_ratio, std::shared_ptr<const YieldLocus> locus,
                  std::shared_ptr<const HardeningLaw> hardening);

    double
    youngs_modulus() const
    {
      return E;
    }
    double
    poissons_ratio() const
    {
      return nu;
    }
    const YieldLocus &
    locus() const
    {
      return *yield_locus;
    }
    const HardeningLaw &
    hardening() const
    {
      return *hardening_law;
    }
    /// Plane-stress elasticity matrix [MPa] (engineering shear strain).
    const Matrix3 &
    elasticity() const
    {
      return D;
    }

    /// Backward-Euler update from @p old to total logarithmic strain @p strain (E11, E22, 2 E12).
    /// @param time_increment [s], for the strain rate; > 0
    /// @param loading_tangent for the predictor of the forming loop: return the plastic tangent also for a point that
    /// has
    ///        flowed before and lies on the yield surface (within loading_tolerance) without flowing now, and leave the
    ///        rate slope out of the tangent, because the next increment continues at about the same rate. This tangent
    ///        is not the derivative of the returned stress.
    /// The result has converged = false if the local equations could not be solved or an argument is not finite.
    StressUpdate update(const Vector3 &strain, const PlasticState &old_state, double time_increment,
                        PlasticState &new_state, bool loading_tangent = false) const;

    /// Logarithmic strain through the thickness from elastic and plastic parts:
    /// -nu/(1-nu) tr(E - E^p) - tr E^p.
    double thickness_strain(const Vector3 &strain, const PlasticState &state) const;

    /// Fraction of the flow stress by which a point may lie inside the yield surface and still count as loading: the
    /// equilibrium iteration leaves elastic unloadings of this order at points that will flow on.
    static constexpr double loading_tolerance = 1e-4;

  private:
    /// The last resort for an increment that does not converge at once.
    bool update_in_parts(const Vector3 &strain, const PlasticState &old_state, double time_increment,
                         PlasticState &new_state, StressUpdate &result) const;
    bool run_parts(const Vector3 &elastic_trial, const PlasticState &old_state, double time_increment, unsigned n,
                   PlasticState &new_state, StressUpdate &result) const;

    double                              E, nu;
    Matrix3                             D, D_inverse;
    std::shared_ptr<const YieldLocus>   yield_locus;
    std::shared_ptr<const HardeningLaw> hardening_law;
  };

  /// The law in logarithmic strains for C = (C11, C22, C12): E = 1/2 ln C with its first and second derivatives. In
  /// p = (C11+C22)/2, d = (C11-C22)/2 and y = C12 it is E = 1/4 ln(det C) I + theta (C - p I), where theta is the
  /// divided difference of 1/2 ln at the two eigenvalues (a series where they are close).
  class LogarithmicStrain
  {
  public:
    explicit LogarithmicStrain(const Vector3 &C);
    bool
    valid() const
    {
      return positive;
    } ///< C is positive definite
    const Vector3 &
    strain() const
    {
      return value;
    } ///< (E11, E22, 2 E12)
    /// d (E11, E22, 2 E12) / d (C11, C22, C12).
    const Matrix3 &
    derivative() const
    {
      return slope;
    }
    /// Sum over the strain components of stress[i] d^2 strain_i / d C^2: symmetric.
    Matrix3 second_derivative(const Vector3 &stress) const;

  private:
    double  p, d, y, determinant;
    double  theta, theta_r, theta_rr; ///< derivatives with respect to d^2 + y^2
    bool    positive;
    Vector3 value;
    Matrix3 slope;
  };

  /// A material point that is driven by the right Cauchy-Green tensor of the surface.
  struct CauchyGreenResponse
  {
    Vector3      stress;  ///< s = dW/dC_v with C_v = (C11, C22, C12): s = (S11, S22, 2 S12)/2 [MPa]
    Matrix3      tangent; ///< d s / d C_v, symmetric for associated plasticity [MPa]
    Vector3      strain;  ///< logarithmic strain (E11, E22, 2 E12)
    StressUpdate update;
  };

  /// Evaluate the material for C = (C11, C22, C12) (positive definite), via E = 1/2 ln C (Miehe's logarithmic strain
  /// space).
  CauchyGreenResponse evaluate_in_cauchy_green(const SheetMaterial &material, const Vector3 &C,
                                               const PlasticState &old_state, double time_increment,
                                               PlasticState &new_state, bool loading_tangent = false);
} // namespace tribodraw

#endif
