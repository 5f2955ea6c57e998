#ifndef tribodraw_material_mohr_circle_h
#define tribodraw_material_mohr_circle_h

#include <tribodraw/material/yield_locus.h>

namespace tribodraw
{
  /// Value and derivatives of a function e(m, R, c) of Mohr's circle: mean stress m, radius R, c = cos 2 theta with the
  /// angle theta between x and the major principal stress.
  template <class Number>
  struct MohrDerivatives
  {
    Number e;
    Number m, R, c;                ///< first
    Number mm, mR, mc, RR, Rc, cc; ///< second
  };

  /// Derivatives of e with respect to (m, a, b) where cos 2 theta = @p c, sin 2 theta = @p q, radius @p radius > 0. In
  /// the plane of a = (sxx-syy)/2 and b = sxy, R and 2 theta are polar coordinates.
  template <class Number>
  TRIBODRAW_INLINE inline LocusDerivatives<Number>
  from_polar(const MohrDerivatives<Number> &e, const Number &c, const Number &q, const Number &radius)
  {
    const Number iR = 1. / radius;
    // Radial (r) and tangential (t) components of the Hessian, then those along a and b.
    const Number mt = -q * e.mc * iR, rt = -q * (e.Rc - e.c * iR) * iR;
    const Number tt    = ((q * q * e.cc - c * e.c) * iR + e.R) * iR;
    const Number along = e.c * q * iR; // minus the tangential derivative

    LocusDerivatives<Number> r;
    r.e  = e.e;
    r.m  = e.m;
    r.a  = e.R * c + along * q;
    r.b  = e.R * q - along * c;
    r.mm = e.mm;
    r.ma = e.mR * c - mt * q;
    r.mb = e.mR * q + mt * c;
    r.aa = e.RR * c * c - 2. * rt * c * q + tt * q * q;
    r.bb = e.RR * q * q + 2. * rt * c * q + tt * c * c;
    r.ab = (e.RR - tt) * c * q + rt * (c * c - q * q);
    return r;
  }
} // namespace tribodraw

#endif
