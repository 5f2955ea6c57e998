#ifndef tribodraw_material_quadratic_locus_h
#define tribodraw_material_quadratic_locus_h

#include <tribodraw/material/yield_locus.h>

namespace tribodraw
{
  /// e^2 = a0 sxx^2 + a1 sxx syy + a2 syy^2 + a3 sxy^2: the form that von Mises' and Hill's loci share.
  class QuadraticLocus : public YieldLocus
  {
  public:
    double
    equivalent_stress(const Vector3 &s) const override
    {
      return std::sqrt(a0 * s[0] * s[0] + a1 * s[0] * s[1] + a2 * s[1] * s[1] + a3 * s[2] * s[2]);
    }
    double
    evaluate(const Vector3 &s, Vector3 &gradient, Matrix3 &hessian) const override
    {
      const auto r = compute<double>({ 0.5 * (s[0] + s[1]), 0.5 * (s[0] - s[1]), s[2] });
      to_cartesian(r, gradient, hessian);
      return r.e;
    }
    void
    evaluate_pack(const MohrStress<Pack> &stress, LocusDerivatives<Pack> &result) const override
    {
      pack::vectorised([&]() TRIBODRAW_INLINE { result = compute<Pack>(stress); });
    }

  protected:
    void
    set(const double xx, const double mixed, const double yy, const double shear)
    {
      a0 = xx;
      a1 = mixed;
      a2 = yy;
      a3 = shear;
    }

  private:
    template <class Number>
    TRIBODRAW_INLINE LocusDerivatives<Number>
                     compute(const MohrStress<Number> &s) const
    {
      const double             mm = a0 + a1 + a2, ma = a0 - a2, aa = a0 - a1 + a2;
      const Number             Pm = mm * s.m + ma * s.a, Pa = ma * s.m + aa * s.a, Pb = a3 * s.b;
      LocusDerivatives<Number> r;
      r.e            = pack::sqrt(Number(s.m * Pm + s.a * Pa + s.b * Pb));
      const Number i = 1. / r.e;
      r.m            = Pm * i;
      r.a            = Pa * i;
      r.b            = Pb * i;
      r.mm           = (mm - r.m * r.m) * i;
      r.aa           = (aa - r.a * r.a) * i;
      r.bb           = (a3 - r.b * r.b) * i;
      r.ma           = (ma - r.m * r.a) * i;
      r.mb           = -r.m * r.b * i;
      r.ab           = -r.a * r.b * i;
      return r;
    }

    double a0 = 1, a1 = -1, a2 = 1, a3 = 3;
  };
} // namespace tribodraw

#endif
