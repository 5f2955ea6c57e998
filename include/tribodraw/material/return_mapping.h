#ifndef tribodraw_material_return_mapping_h
#define tribodraw_material_return_mapping_h

#include <tribodraw/material/hardening_law.h>
#include <tribodraw/material/yield_locus.h>

namespace tribodraw
{
  /// Backward-Euler flow of one increment in plane stress (J. C. Simo, T. J. R. Hughes: Computational inelasticity,
  /// 1998, ch. 3): for the elastic trial strain eps_tr find stress s and flow dg >= 0 with
  ///   D^-1 s + dg n(s) = eps_tr,   e(s) = sigma_y(eps_p + dg, dg/dt),   n = de/ds.
  /// Because e is homogeneous of degree one, dg is the increment of the equivalent plastic strain.
  class ReturnMapping
  {
  public:
    struct Input
    {
      Vector3 elastic_trial_strain;
      double  eps_p;          ///< equivalent plastic strain before the increment
      double  time_increment; ///< [s]
    };
    struct Result
    {
      Vector3                  stress;
      Vector3                  normal;     ///< n(s)
      Matrix3                  compliance; ///< D^-1 + dg Hessian [1/MPa]
      HardeningLaw::FlowStress flow_stress;
      double                   flow          = 0; ///< dg
      double                   error         = 0; ///< of both equations relative to the flow stress
      unsigned                 n_evaluations = 0; ///< of the yield locus
      bool                     converged     = false;
    };

    ReturnMapping(const Matrix3 &elasticity, const Matrix3 &compliance, const YieldLocus &locus,
                  const HardeningLaw &hardening);

    /// Newton on stress and flow; if that fails, robust().
    Result solve(const Input &input) const;
    /// Slow but globally convergent for convex loci: for given dg the stress minimises a convex function (damped
    /// Newton), and e(s(dg)) - sigma_y falls monotonically with dg (bracketed Newton).
    Result robust(const Input &input) const;

    /// Both equations hold to this fraction of the flow stress: far below what a global Newton iteration resolves, far
    /// above round-off of trial stresses 1000 times the flow stress.
    static constexpr double tolerance = 1e-11;

  private:
    /// Evaluate everything at (stress, flow) of @p result; returns the residual of the strain equation.
    Vector3 evaluate(const Input &input, Result &result, double &yield) const;
    bool    newton(const Input &input, Result &result) const;
    bool    leave_origin(const Input &input, double flow, double scale, Result &result) const;
    bool    minimise(const Input &input, double flow, Result &result, double &equivalent_stress) const;

    const Matrix3      &D, &D_inverse;
    const YieldLocus   &locus;
    const HardeningLaw &hardening;
  };
} // namespace tribodraw

#endif
