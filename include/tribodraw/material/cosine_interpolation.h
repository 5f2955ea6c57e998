#ifndef tribodraw_material_cosine_interpolation_h
#define tribodraw_material_cosine_interpolation_h

#include <tribodraw/material/pack.h>

namespace tribodraw
{
  /// A function of the direction of the stress, written in c = cos 2 theta (theta: angle between rolling direction
  /// and major principal stress): a0 + a1 cos 2 theta + a2 cos 4 theta through the values at 0, 45 and 90 degrees.
  template <class Number>
  struct CosinesOf
  {
    Number k0 = 0., k1 = 0., k2 = 0.; ///< k0 + k1 c + k2 c^2

    static CosinesOf
    through(const Number f0, const Number f45, const Number f90)
    {
      return { f45, 0.5 * (f0 - f90), 0.5 * (f0 - 2. * f45 + f90) };
    }
    TRIBODRAW_INLINE Number
    value(const Number &c) const
    {
      return k0 + c * (k1 + c * k2);
    }
    TRIBODRAW_INLINE Number
    slope(const Number &c) const
    {
      return k1 + 2. * c * k2;
    }
    TRIBODRAW_INLINE Number
    curvature() const
    {
      return 2. * k2;
    }
  };
  using Cosines = CosinesOf<double>;

  /// Value with first and second derivative with respect to c.
  template <class Number>
  struct Jet
  {
    Number v, d, dd;

    TRIBODRAW_INLINE
    Jet(const Number &value, const Number &slope, const Number &curvature) : v(value), d(slope), dd(curvature) {}
    TRIBODRAW_INLINE
    Jet(const CosinesOf<Number> &f, const Number &c) : v(f.value(c)), d(f.slope(c)), dd(f.curvature()) {}
    TRIBODRAW_INLINE Jet
    operator+(const Jet &o) const
    {
      return { v + o.v, d + o.d, dd + o.dd };
    }
    TRIBODRAW_INLINE Jet
    operator-(const Jet &o) const
    {
      return { v - o.v, d - o.d, dd - o.dd };
    }
    TRIBODRAW_INLINE Jet
    operator*(const Jet &o) const
    {
      return { v * o.v, d * o.v + v * o.d, dd * o.v + 2. * d * o.d + v * o.dd };
    }
    TRIBODRAW_INLINE Jet
    operator*(const Number &a) const
    {
      return { a * v, a * d, a * dd };
    }
    TRIBODRAW_INLINE Jet
    operator/(const Jet &o) const
    {
      const Number i = 1. / o.v, q = v * i, qd = (d - q * o.d) * i;
      return { q, qd, (dd - 2. * qd * o.d - q * o.dd) * i };
    }
  };
} // namespace tribodraw

#endif
