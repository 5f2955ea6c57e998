#ifndef tribodraw_material_mohr_circle_h
#define tribodraw_material_mohr_circle_h

#include <tribodraw/material/yield_locus.h>

namespace tribodraw
{
  /// Value and derivatives of a function e(m, R, c) of Mohr's circle: mean stress m, radius R, c = cos 2 theta with the
  /// angle theta between x and the major principal stress.
  struct MohrDerivatives
  {
    double e;
    double m, R, c;                ///< first
    double mm, mR, mc, RR, Rc, cc; ///< second
  };

  /// Gradient and Hessian of e with respect to (sxx, syy, sxy) where cos 2 theta = @p c, sin 2 theta = @p q, radius
  /// @p radius > 0. In the plane of a = (sxx-syy)/2 and b = sxy, R and 2 theta are polar coordinates.
  inline void
  mohr_to_cartesian(const MohrDerivatives &e, const double c, const double q, const double radius, Vector3 &gradient,
                    Matrix3 &hessian)
  {
    const double iR = 1 / radius;
    // Radial (r) and tangential (t) components of the Hessian, then those along a and b.
    const double mt = -q * e.mc * iR, rt = -q * (e.Rc - e.c * iR) * iR;
    const double tt = ((q * q * e.cc - c * e.c) * iR + e.R) * iR;
    const double ma = e.mR * c - mt * q, mb = e.mR * q + mt * c;
    const double aa    = e.RR * c * c - 2 * rt * c * q + tt * q * q;
    const double bb    = e.RR * q * q + 2 * rt * c * q + tt * c * c;
    const double ab    = (e.RR - tt) * c * q + rt * (c * c - q * q);
    const double along = e.c * q * iR; // minus the tangential derivative
    const double n_a   = e.R * c + along * q;

    gradient[0]   = 0.5 * (e.m + n_a);
    gradient[1]   = 0.5 * (e.m - n_a);
    gradient[2]   = e.R * q - along * c;
    hessian(0, 0) = 0.25 * (e.mm + aa) + 0.5 * ma;
    hessian(1, 1) = 0.25 * (e.mm + aa) - 0.5 * ma;
    hessian(0, 1) = hessian(1, 0) = 0.25 * (e.mm - aa);
    hessian(0, 2) = hessian(2, 0) = 0.5 * (mb + ab);
    hessian(1, 2) = hessian(2, 1) = 0.5 * (mb - ab);
    hessian(2, 2)                 = bb;
  }
} // namespace tribodraw

#endif
