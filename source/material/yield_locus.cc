#include <tribodraw/material/yield_locus.h>

namespace tribodraw
{
  void
  to_cartesian(const LocusDerivatives<double> &from, Vector3 &gradient, Matrix3 &hessian)
  {
    gradient << 0.5 * (from.m + from.a), 0.5 * (from.m - from.a), from.b;
    hessian(0, 0) = 0.25 * (from.mm + from.aa) + 0.5 * from.ma;
    hessian(1, 1) = 0.25 * (from.mm + from.aa) - 0.5 * from.ma;
    hessian(0, 1) = hessian(1, 0) = 0.25 * (from.mm - from.aa);
    hessian(0, 2) = hessian(2, 0) = 0.5 * (from.mb + from.ab);
    hessian(1, 2) = hessian(2, 1) = 0.5 * (from.mb - from.ab);
    hessian(2, 2)                 = from.bb;
  }

  LocusDerivatives<double>
  from_cartesian(const double e, const Vector3 &n, const Matrix3 &H)
  {
    LocusDerivatives<double> to;
    to.e  = e;
    to.m  = n[0] + n[1];
    to.a  = n[0] - n[1];
    to.b  = n[2];
    to.mm = H(0, 0) + 2 * H(0, 1) + H(1, 1);
    to.aa = H(0, 0) - 2 * H(0, 1) + H(1, 1);
    to.ma = H(0, 0) - H(1, 1);
    to.mb = H(0, 2) + H(1, 2);
    to.ab = H(0, 2) - H(1, 2);
    to.bb = H(2, 2);
    return to;
  }

  void
  YieldLocus::evaluate_pack(const MohrStress<Pack> &stress, LocusDerivatives<Pack> &result) const
  {
    for (unsigned i = 0; i < pack::lanes; ++i)
      {
        Vector3       n;
        Matrix3       H;
        const Vector3 s(stress.m[i] + stress.a[i], stress.m[i] - stress.a[i], stress.b[i]);
        const double  e   = evaluate(s, n, H);
        const auto    one = from_cartesian(e, n, H);
        result.e[i]       = one.e;
        result.m[i]       = one.m;
        result.a[i]       = one.a;
        result.b[i]       = one.b;
        result.mm[i]      = one.mm;
        result.aa[i]      = one.aa;
        result.bb[i]      = one.bb;
        result.ma[i]      = one.ma;
        result.mb[i]      = one.mb;
        result.ab[i]      = one.ab;
      }
  }
} // namespace tribodraw
