#ifndef tribodraw_material_yield_locus_h
#define tribodraw_material_yield_locus_h

#include <Eigen/Core>

namespace tribodraw
{
  class Parameters;

  using Vector3 = Eigen::Vector3d; ///< plane-stress components (xx, yy, xy); strains carry the engineering shear
  using Matrix3 = Eigen::Matrix3d;

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
  };
} // namespace tribodraw

#endif
