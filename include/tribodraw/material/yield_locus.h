#ifndef tribodraw_material_yield_locus_h
#define tribodraw_material_yield_locus_h

#include <tribodraw/material/pack.h>

#include <Eigen/Core>

namespace tribodraw
{
  class Parameters;

  using Vector3 = Eigen::Vector3d; ///< plane-stress components (xx, yy, xy); strains carry the engineering shear
  using Matrix3 = Eigen::Matrix3d;

  /// Plane stress as mean m = (sxx+syy)/2, half difference a = (sxx-syy)/2 and shear b = sxy. The conjugate strains are
  /// exx + eyy, exx - eyy and gamma. Isotropic elasticity is diagonal in them, and sqrt(a^2+b^2) is the radius of
  /// Mohr's circle.
  template <class Number>
  struct MohrStress
  {
    Number m, a, b;
  };

  /// Equivalent stress with its derivatives with respect to (m, a, b).
  template <class Number>
  struct LocusDerivatives
  {
    Number e;
    Number m, a, b;                ///< gradient
    Number mm, aa, bb, ma, mb, ab; ///< Hessian
  };

  /// Plane-stress yield function in the axes of orthotropy (x = rolling direction): a convex equivalent stress,
  /// homogeneous of degree one, equal to the uniaxial flow stress in rolling direction.
  class YieldLocus
  {
  public:
    virtual ~YieldLocus() = default;
    static const char *
    kind()
    {
      return "yield locus";
    }
    /// Equivalent stress of @p stress [MPa].
    virtual double equivalent_stress(const Vector3 &stress) const = 0;
    /// Equivalent stress, its gradient (conjugate to engineering strain components; degree 0)
    /// and Hessian [1/MPa] (symmetric, degree -1). @p stress must not be zero.
    virtual double evaluate(const Vector3 &stress, Vector3 &gradient, Matrix3 &hessian) const = 0;
    /// The same for four stresses at once, none of them zero. A law may implement it in vector arithmetic, for speed;
    /// otherwise it calls the function above for each.
    virtual void evaluate_pack(const MohrStress<Pack> &stress, LocusDerivatives<Pack> &result) const;
  };

  /// Gradient and Hessian with respect to (xx, yy, xy) from those with respect to (m, a, b), and back.
  void                     to_cartesian(const LocusDerivatives<double> &from, Vector3 &gradient, Matrix3 &hessian);
  LocusDerivatives<double> from_cartesian(double e, const Vector3 &gradient, const Matrix3 &hessian);
} // namespace tribodraw

#endif
