#include <tribodraw/base/parameters.h>
#include <tribodraw/material/yield_locus.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Isotropic plane-stress locus: sigma^2 = sxx^2 - sxx syy + syy^2 + 3 sxy^2 (von Mises 1913).
    class VonMises : public YieldLocus
    {
    public:
      explicit VonMises(Parameters &) { P << 1., -0.5, 0., -0.5, 1., 0., 0., 0., 3.; }

      double
      equivalent_stress(const Vector3 &stress) const override
      {
        return std::sqrt(stress.dot(P * stress));
      }

      double
      evaluate(const Vector3 &stress, Vector3 &gradient, Matrix3 &hessian) const override
      {
        const Vector3 Ps    = P * stress;
        const double  value = std::sqrt(stress.dot(Ps));
        gradient            = Ps / value;
        hessian.noalias()   = (P - gradient * gradient.transpose()) / value;
        return value;
      }

    private:
      Matrix3 P; ///< sigma^2 = s . P s
    };
  } // namespace

  TRIBODRAW_REGISTER(YieldLocus, VonMises, "von Mises", "Isotropic yield locus; no parameters.",
                     "R. von Mises, Nachr. Ges. Wiss. Goettingen (1913) 582-592")
} // namespace tribodraw
