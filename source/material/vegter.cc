#include <tribodraw/base/parameters.h>
#include <tribodraw/material/yield_locus.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "vegter_curves.h"

namespace tribodraw
{
  namespace
  {
    template <class Number>
    using Point = MohrPoint<Number>;

    Point<double>
    from_principal(const double s1, const double s2)
    {
      return { 0.5 * (s1 + s2), 0.5 * (s1 - s2) };
    }

    Point<Cosines>
    through(const Point<double> &p0, const Point<double> &p45, const Point<double> &p90)
    {
      return { Cosines::through(p0.m, p45.m, p90.m), Cosines::through(p0.R, p45.R, p90.R) };
    }

    CosinesOf<Pack>
    broadcast(const Cosines &f)
    {
      return { f.k0, f.k1, f.k2 };
    }
    MohrPoint<CosinesOf<Pack>>
    broadcast(const MohrPoint<Cosines> &p)
    {
      return { broadcast(p.m), broadcast(p.R) };
    }
    VegterSector<Pack>
    broadcast(const VegterSector<double> &s)
    {
      return { broadcast(s.far),     broadcast(s.near),      broadcast(s.base),
               broadcast(s.tangent), broadcast(s.numerator), broadcast(s.denominator) };
    }
    VegterCurves<Pack>
    broadcast(const VegterCurves<double> &c)
    {
      VegterCurves<Pack> r;
      r.shear_uniaxial           = broadcast(c.shear_uniaxial);
      r.uniaxial_plane_strain    = broadcast(c.uniaxial_plane_strain);
      r.plane_strain_equibiaxial = broadcast(c.plane_strain_equibiaxial);
      r.rho                      = c.rho;
      r.f_bi                     = c.f_bi;
      return r;
    }

    /// Vegter's plane-stress yield locus: Bezier curves through measured points (pure shear SH, uniaxial UN, plane
    /// strain PS, equibiaxial BI) with measured normals at 0, 45 and 90 degrees to the rolling direction.
    ///
    /// Construction at one angle (H. Vegter and A. H. van den Boogaard 2006): reference points in principal stresses
    ///   SH (f_sh(th), -f_sh(90-th)), normal (1,-1);   UN (f_un, 0), normal (1, -R/(1+R));
    ///   PS (f_ps, f_ps2), normal (1, 0);              BI (f_bi, f_bi), normal (1, rho(th));
    /// hinge points are the intersections of neighbouring tangents, and f_ps2 lies at the plane strain ratio between
    /// the hinge points on its sides.
    ///
    /// Between the test angles every reference point is interpolated with cosines. For the hinge points there are two
    /// ways: `tangent` interpolates the tangent direction in UN, takes the exact rho(th) in BI and intersects again, so
    /// the gradient is continuous at every angle; `interpolated` interpolates the coordinates of the hinge points like
    /// those of the others, as other programs do: then the gradient jumps in UN and BI off the test angles (up to 0.003
    /// rad with the data of DC04, on some sides against convexity). At 0, 45 and 90 degrees both are the same.
    class Vegter : public YieldLocus
    {
    public:
      explicit Vegter(Parameters &parameters);
      double equivalent_stress(const Vector3 &stress) const override;
      double evaluate(const Vector3 &stress, Vector3 &gradient, Matrix3 &hessian) const override;
      void   evaluate_pack(const MohrStress<Pack> &stress, LocusDerivatives<Pack> &result) const override;

    private:
      struct Data
      {
        std::vector<double> R, uniaxial, plane_strain, plane_strain_ratio, shear;
        double              equibiaxial, rho;
        bool                tangent_hinges;
      };
      static Data read(Parameters &parameters);
      static bool complete(Parameters &parameters, Data &data);
      void        construct(const Data &data);
      void        check_convexity(Parameters &parameters) const;

      VegterCurves<double> curves;
      VegterCurves<Pack>   pack_curves;
    };

    Vegter::Vegter(Parameters &parameters)
    {
      Data data = read(parameters);
      if (!complete(parameters, data) || parameters.documentation_mode())
        return;
      construct(data);
      pack_curves = broadcast(curves);
      check_convexity(parameters);
    }

    Vegter::Data
    Vegter::read(Parameters &parameters)
    {
      const Range factor = Range::positive().usual(0.3, 2.);
      Data        data;
      data.R        = parameters.quantity_list("R values", "", Range::positive().usual(0.2, 5.),
                                               "R-values at 0, 45, 90 degrees to the rolling direction.");
      data.uniaxial = parameters.quantity_list(
          "Uniaxial factors", "", factor,
          "Uniaxial yield stress at 0, 45, 90 degrees over that at 0 degrees (the first is 1).");
      data.plane_strain       = parameters.quantity_list("Plane strain factors", "", factor,
                                                         "Major stress in plane strain tension at 0, 45, 90 degrees.");
      data.plane_strain_ratio = parameters.quantity_list(
          "Plane strain ratios", "", Range::between(0., 1.),
          "Place of the plane strain point between its two hinge points at 0, 45, 90 degrees "
          "(0: uniaxial side, 1: equibiaxial side).");
      data.shear
          = parameters.quantity_list("Shear factors", "", factor, "Major stress in pure shear at 0, 45, 90 degrees.");
      data.equibiaxial = parameters.quantity("Equibiaxial factor", "", factor, "Stress in equibiaxial tension.");
      data.rho         = parameters.quantity("Equibiaxial ratio", "", Range::positive().usual(0.3, 3.),
                                             "Strain across over strain along the rolling direction in equibiaxial tension.");
      data.tangent_hinges
          = parameters.choice(
                "Hinge points", { "tangent", "interpolated" },
                "Hinge points between the test angles: intersection of the tangents there, or interpolated "
                "coordinates, for comparison with other programs; it has small kinks, where some stress updates fail.",
                Default{ "tangent", "The gradient is continuous, which the stress update relies on." })
            != "interpolated";
      return data;
    }

    // True if the lists have three numbers each and the first uniaxial factor is one.
    bool
    Vegter::complete(Parameters &parameters, Data &data)
    {
      bool       good  = true;
      const auto check = [&](const char *entry, const std::vector<double> &list) {
        if (list.size() == 3)
          return;
        good = false;
        if (!list.empty() && !parameters.documentation_mode())
          parameters.problem(entry, std::to_string(list.size()) + " numbers were given",
                             "3 numbers, for 0, 45 and 90 degrees to the rolling direction");
      };
      check("R values", data.R);
      check("Uniaxial factors", data.uniaxial);
      check("Plane strain factors", data.plane_strain);
      check("Plane strain ratios", data.plane_strain_ratio);
      check("Shear factors", data.shear);
      if (good && !parameters.documentation_mode() && std::abs(data.uniaxial[0] - 1) > 1e-12)
        parameters.problem("Uniaxial factors", "the first factor is " + std::to_string(data.uniaxial[0]),
                           "1, because the flow stress is that of the rolling direction",
                           "Divide all factors by the first.");
      return good && data.equibiaxial > 0 && data.rho > 0;
    }

    void
    Vegter::construct(const Data &data)
    {
      std::array<Point<double>, 3> SH, UN, PS, BI, hinge_su, hinge_up, hinge_pb;
      for (int j = 0; j < 3; ++j)
        {
          const double cosine = 1. - j;
          const double rho    = ((data.rho + 1) + (data.rho - 1) * cosine) / ((data.rho + 1) - (data.rho - 1) * cosine);
          const double f_ps = data.plane_strain[j], f_un = data.uniaxial[j], f_bi = data.equibiaxial;
          const double sh1 = data.shear[j], sh2 = -data.shear[2 - j];
          // The tangent in UN runs along (R, 1+R), that in SH along (1,1), that in PS along (0,1), that in BI along
          // (rho,-1).
          const double R      = data.R[j];
          const double lambda = (sh1 - f_un) - sh2; // UN + lambda (R,1+R) = SH + k (1,1) gives -lambda
          const double mu     = (f_ps - f_un) / R;
          const double up2    = mu * (1 + R);
          const double pb2    = f_bi - (f_ps - f_bi) / rho;
          SH[j]               = from_principal(sh1, sh2);
          UN[j]               = from_principal(f_un, 0);
          PS[j]               = from_principal(f_ps, up2 + data.plane_strain_ratio[j] * (pb2 - up2));
          BI[j]               = from_principal(f_bi, f_bi);
          hinge_su[j]         = from_principal(f_un - lambda * R, -lambda * (1 + R));
          hinge_up[j]         = from_principal(f_ps, up2);
          hinge_pb[j]         = from_principal(f_ps, pb2);
        }
      const auto sh = through(SH[0], SH[1], SH[2]), un = through(UN[0], UN[1], UN[2]),
                 ps = through(PS[0], PS[1], PS[2]), bi = through(BI[0], BI[1], BI[2]);
      const auto su  = through(hinge_su[0], hinge_su[1], hinge_su[2]);
      const auto up  = through(hinge_up[0], hinge_up[1], hinge_up[2]);
      const auto pb  = through(hinge_pb[0], hinge_pb[1], hinge_pb[2]);
      const auto sum = [](const Cosines &a, const Cosines &b, const double s) {
        return Cosines{ a.k0 + s * b.k0, a.k1 + s * b.k1, a.k2 + s * b.k2 };
      };
      const Cosines zero{}, one{ 1, 0, 0 };
      curves.rho                      = data.rho;
      curves.f_bi                     = data.equibiaxial;
      curves.shear_uniaxial           = { sh, un, su, { zero, zero }, zero, one };
      curves.uniaxial_plane_strain    = { un, ps, up, { zero, zero }, zero, one };
      curves.plane_strain_equibiaxial = { ps, bi, pb, { zero, zero }, zero, one };
      if (!data.tangent_hinges)
        return;
      // At the test angles UN lies between its two hinge points on the tangent, so their difference has its direction.
      const Point<Cosines> tangent{ sum(up.m, su.m, -1), sum(up.R, su.R, -1) };
      // The tangent in SH keeps R, that in PS keeps m + R.
      curves.shear_uniaxial = { sh, un, un, tangent, sum(sh.R, un.R, -1), tangent.R };
      curves.uniaxial_plane_strain
          = { un, ps, un, tangent, sum(sum(ps.m, ps.R, 1), sum(un.m, un.R, 1), -1), sum(tangent.m, tangent.R, 1) };
      // The tangent in BI has the direction ((rho-1) c, rho+1) in (m,R) at every angle.
      const double         k0 = data.rho + 1, k1 = data.rho - 1;
      const Point<Cosines> apex_tangent{ { 0, k1, 0 }, { k0, 0, 0 } };
      curves.plane_strain_equibiaxial = { ps, bi, bi, apex_tangent, sum(sum(ps.m, ps.R, 1), bi.m, -1), { k0, k1, 0 } };
    }

    // Scan of the eigenvalues of the second derivative over all stress directions. Measured data have none below zero
    // but for round-off; a mistyped factor gives values of order one (times 1/stress).
    void
    Vegter::check_convexity(Parameters &parameters) const
    {
      const double tolerance = -0.02;
      const int    n_angles = 19, n_ratios = 48;
      for (int i = 0; i < n_angles; ++i)
        for (int j = 0; j < n_ratios; ++j)
          {
            const double  theta = M_PI / 2 * i / (n_angles - 1), phi = M_PI * (j + 0.37) / n_ratios;
            const double  m = std::cos(phi), R = std::sin(phi);
            Vector3       n;
            Matrix3       H;
            const Vector3 s(m + R * std::cos(2 * theta), m - R * std::cos(2 * theta), R * std::sin(2 * theta));
            const double  e = evaluate(s, n, H);
            // The smaller eigenvalue of the part across s; e H has no dimension.
            const double trace  = H.trace();
            const double minors = H(0, 0) * H(1, 1) - H(0, 1) * H(0, 1) + H(1, 1) * H(2, 2) - H(1, 2) * H(1, 2)
                                  + H(0, 0) * H(2, 2) - H(0, 2) * H(0, 2);
            const double smallest = 0.5 * (trace - std::sqrt(std::max(0., trace * trace - 4 * minors)));
            if (!(e > 0) || !(e * smallest > tolerance))
              {
                parameters.problem("",
                                   "the yield locus is not convex (major stress at "
                                       + std::to_string(theta * 180 / M_PI) + " degrees)",
                                   "factors that make a convex locus, as measured ones do",
                                   "Compare the entries with the data sheet; a mistyped factor is the usual cause.");
                return;
              }
          }
    }

    double
    Vegter::equivalent_stress(const Vector3 &stress) const
    {
      if (stress[0] == 0 && stress[1] == 0 && stress[2] == 0)
        return 0;
      return curves.equivalent_stress({ 0.5 * (stress[0] + stress[1]), 0.5 * (stress[0] - stress[1]), stress[2] });
    }

    double
    Vegter::evaluate(const Vector3 &stress, Vector3 &gradient, Matrix3 &hessian) const
    {
      const auto r = curves.evaluate({ 0.5 * (stress[0] + stress[1]), 0.5 * (stress[0] - stress[1]), stress[2] });
      to_cartesian(r, gradient, hessian);
      return r.e;
    }

    void
    Vegter::evaluate_pack(const MohrStress<Pack> &stress, LocusDerivatives<Pack> &result) const
    {
      pack::vectorised([&]() TRIBODRAW_INLINE { result = pack_curves.evaluate(stress); });
    }
  } // namespace

  TRIBODRAW_REGISTER(YieldLocus, Vegter, "Vegter",
                     "Bezier interpolation of measured yield points and normals (shear, uniaxial, plane strain, "
                     "equibiaxial) at 0, 45 and 90 degrees.",
                     "H. Vegter, A. H. van den Boogaard, Int. J. Plasticity 22 (2006) 557-580")
} // namespace tribodraw
