#ifndef tribodraw_material_vegter_curves_h
#define tribodraw_material_vegter_curves_h

#include <tribodraw/material/cosine_interpolation.h>
#include <tribodraw/material/mohr_circle.h>

namespace tribodraw
{
  /// A point of the locus at unit flow stress in the coordinates mean m = (s1+s2)/2 and radius R = (s1-s2)/2 of
  /// Mohr's circle; they make the equibiaxial state (R = 0) free of cancellation.
  template <class Number>
  struct MohrPoint
  {
    Number m, R;
  };

  /// A Bezier curve of second order between two neighbouring reference points. The hinge point is
  /// base + (numerator/denominator) tangent, all functions of c.
  template <class Number>
  struct VegterSector
  {
    MohrPoint<CosinesOf<Number>> far;  ///< end with the larger R/m
    MohrPoint<CosinesOf<Number>> near; ///< end with the smaller R/m
    MohrPoint<CosinesOf<Number>> base, tangent;
    CosinesOf<Number>            numerator, denominator;
  };

  /// The Bezier curves of a Vegter locus and the equivalent stress with its derivatives.
  template <class Number>
  struct VegterCurves
  {
    VegterSector<Number> shear_uniaxial, uniaxial_plane_strain, plane_strain_equibiaxial;
    Number               rho, f_bi; ///< equibiaxial ratio and factor

    /// Closer to the equibiaxial state than this fraction of the mean stress the gradient is interpolated linearly
    /// between that state and this radius, and the second derivative, whose limit depends on the direction of
    /// approach, is that at this radius. 1e-7 balances round-off (1e-16/1e-7) against the error of the interpolation
    /// (1e-7 squared).
    static constexpr double apex_radius = 1e-7;

    Number                   equivalent_stress(const MohrStress<Number> &stress) const;
    LocusDerivatives<Number> evaluate(const MohrStress<Number> &stress) const;

  private:
    /// The stress after use of the symmetry e(-s) = e(s): mean, radius, cos and sin of 2 theta.
    struct State
    {
      Number m, R, c, q;
      Number sign;        ///< -1 if the stress was reversed
      Number apex_weight; ///< 1, or R/(apex_radius |m|) if R was raised to apex_radius |m|
      /// The sector; @p mixed holds it where it is not the same for all components.
      const VegterSector<Number> *sector;
      VegterSector<Number>        mixed;
    };
    /// The curve G = near + t l1 + t^2 l2 at the place t where the ray of the stress meets it.
    struct Arc
    {
      Jet<Number> near_m, near_R, l1_m, l1_R, l2_m, l2_R;
      Number      t;
    };
    void                    locate(const MohrStress<Number> &stress, State &state) const;
    void                    choose_sector(State &state) const;
    static Arc              intersect(const State &state);
    MohrDerivatives<Number> derivatives(const State &state) const;
  };

  /// Component by component a where the mask is true.
  template <class Number>
  TRIBODRAW_INLINE inline CosinesOf<Number>
  select(const pack::Mask<Number> &mask, const CosinesOf<Number> &a, const CosinesOf<Number> &b)
  {
    return { pack::select(mask, a.k0, b.k0), pack::select(mask, a.k1, b.k1), pack::select(mask, a.k2, b.k2) };
  }
  template <class Number>
  TRIBODRAW_INLINE inline VegterSector<Number>
  select(const pack::Mask<Number> &mask, const VegterSector<Number> &a, const VegterSector<Number> &b)
  {
    return { { select<Number>(mask, a.far.m, b.far.m), select<Number>(mask, a.far.R, b.far.R) },
             { select<Number>(mask, a.near.m, b.near.m), select<Number>(mask, a.near.R, b.near.R) },
             { select<Number>(mask, a.base.m, b.base.m), select<Number>(mask, a.base.R, b.base.R) },
             { select<Number>(mask, a.tangent.m, b.tangent.m), select<Number>(mask, a.tangent.R, b.tangent.R) },
             select<Number>(mask, a.numerator, b.numerator),
             select<Number>(mask, a.denominator, b.denominator) };
  }

  template <class Number>
  TRIBODRAW_INLINE inline void
  VegterCurves<Number>::choose_sector(State &s) const
  {
    const auto in_shear = s.m < s.R;
    const auto in_plane_strain
        = s.m * uniaxial_plane_strain.near.R.value(s.c) < s.R * uniaxial_plane_strain.near.m.value(s.c);
    if (!pack::any(!in_shear))
      s.sector = &shear_uniaxial;
    else if (!pack::any(in_shear) && !pack::any(!in_plane_strain))
      s.sector = &uniaxial_plane_strain;
    else if (!pack::any(in_shear) && !pack::any(in_plane_strain))
      s.sector = &plane_strain_equibiaxial;
    else
      {
        s.mixed  = select<Number>(in_plane_strain, uniaxial_plane_strain, plane_strain_equibiaxial);
        s.mixed  = select<Number>(in_shear, shear_uniaxial, s.mixed);
        s.sector = &s.mixed;
      }
  }

  template <class Number>
  TRIBODRAW_INLINE inline void
  VegterCurves<Number>::locate(const MohrStress<Number> &stress, State &s) const
  {
    const Number zero = Number(0.), one = Number(1.);
    s.m                = stress.m;
    s.R                = pack::sqrt(stress.a * stress.a + stress.b * stress.b);
    const auto   round = s.R > 0.;
    const Number iR    = 1. / pack::select(round, s.R, one);
    s.c                = pack::select(round, stress.a * iR, one);
    s.q                = pack::select(round, stress.b * iR, zero);
    // In the equibiaxial state R becomes a little more than zero.
    const Number least = apex_radius * pack::abs(s.m);
    const auto   apex  = s.R < least;
    s.apex_weight      = pack::select(apex, s.R / pack::select(apex, least, one), one);
    s.R                = pack::select(apex, least, s.R);
    // Beyond SH.
    const auto reverse = s.m * shear_uniaxial.far.R.value(s.c) < s.R * shear_uniaxial.far.m.value(s.c);
    s.sign             = pack::select(reverse, -one, one);
    s.m                = s.m * s.sign;
    s.c                = s.c * s.sign;
    s.q                = s.q * s.sign;
    choose_sector(s);
  }

  // The cross product v0 + v1 t + v2 t^2 of ray and curve is not positive at t = 0 (the near end), not negative at t =
  // 1 and rises through its root.
  template <class Number>
  TRIBODRAW_INLINE inline typename VegterCurves<Number>::Arc
  VegterCurves<Number>::intersect(const State &s)
  {
    using J                            = Jet<Number>;
    const VegterSector<Number> &S      = *s.sector;
    const Number                c      = s.c;
    const J                     factor = J(S.numerator, c) / J(S.denominator, c);
    const J                     near_m(S.near.m, c), near_R(S.near.R, c);
    const Number                two  = Number(2.);
    const J                     l1_m = (J(S.base.m, c) + factor * J(S.tangent.m, c) - near_m) * two;
    const J                     l1_R = (J(S.base.R, c) + factor * J(S.tangent.R, c) - near_R) * two;
    const J                     l2_m = J(S.far.m, c) - near_m - l1_m, l2_R = J(S.far.R, c) - near_R - l1_R;

    const Number v0 = s.m * near_R.v - s.R * near_m.v, v1 = s.m * l1_R.v - s.R * l1_m.v,
                 v2   = s.m * l2_R.v - s.R * l2_m.v;
    const Number zero = Number(0.), one = Number(1.);
    const Number sum  = v1 + pack::sqrt(pack::max(zero, Number(v1 * v1 - 4. * v0 * v2)));
    const auto   good = sum > 0.;
    const Number t    = pack::select(good, -2. * v0 / pack::select(good, sum, one), zero);
    return { near_m, near_R, l1_m, l1_R, l2_m, l2_R, pack::min(one, pack::max(zero, t)) };
  }

  // With the curve G(t, c) in (m,R) and ' = d/dt: (m,R) = e G. At fixed c e is homogeneous in (m,R), its gradient g
  // normal to G' with g.G = 1; at fixed (m,R) t moves with c so that G stays on the ray.
  template <class Number>
  TRIBODRAW_INLINE inline MohrDerivatives<Number>
  VegterCurves<Number>::derivatives(const State &s) const
  {
    const Arc         A    = intersect(s);
    const Number      t    = A.t;
    const Jet<Number> Gm   = A.near_m + (A.l1_m + A.l2_m * t) * t;
    const Jet<Number> GR   = A.near_R + (A.l1_R + A.l2_R * t) * t;
    const Number      Gm_t = A.l1_m.v + 2. * t * A.l2_m.v, GR_t = A.l1_R.v + 2. * t * A.l2_R.v;
    const Number      Gm_tc = A.l1_m.d + 2. * t * A.l2_m.d, GR_tc = A.l1_R.d + 2. * t * A.l2_R.d;

    const Number            iD = 1. / (Gm.v * GR_t - GR.v * Gm_t);
    const Number            ie = (Gm.v + GR.v) / (s.m + s.R);
    MohrDerivatives<Number> e;
    e.e               = (s.m + s.R) / (Gm.v + GR.v);
    e.m               = GR_t * iD;
    e.R               = -Gm_t * iD;
    const Number g_Gc = e.m * Gm.d + e.R * GR.d;
    e.c               = -e.e * g_Gc;
    const Number K    = 2. * (Gm_t * A.l2_R.v - GR_t * A.l2_m.v) * iD * iD; // G' x G'' / (G x G')^2
    const Number k    = K * iD * ie;
    e.mm              = k * GR.v * GR.v;
    e.mR              = -k * GR.v * Gm.v;
    e.RR              = k * Gm.v * Gm.v;
    const Number t_c  = -(Gm.v * GR.d - GR.v * Gm.d) * iD;
    const Number D_c  = (Gm.d * GR_t + Gm.v * GR_tc - GR.d * Gm_t - GR.v * Gm_tc) * iD;
    e.mc              = GR_tc * iD - e.m * D_c - GR.v * K * t_c;
    e.Rc              = -Gm_tc * iD - e.R * D_c + Gm.v * K * t_c;
    e.cc = -e.c * g_Gc - e.e * (e.mc * Gm.d + e.Rc * GR.d + e.m * (Gm.dd + Gm_tc * t_c) + e.R * (GR.dd + GR_tc * t_c));
    return e;
  }

  template <class Number>
  TRIBODRAW_INLINE inline LocusDerivatives<Number>
  VegterCurves<Number>::evaluate(const MohrStress<Number> &stress) const
  {
    State s;
    locate(stress, s);
    LocusDerivatives<Number> r = from_polar<Number>(derivatives(s), s.c, s.q, s.R);
    r.m                        = r.m * s.sign;
    r.a                        = r.a * s.sign;
    r.b                        = r.b * s.sign;
    const auto apex            = s.apex_weight < 1.;
    if (pack::any(apex))
      {
        // Gradient (1, rho)/((1 + rho) f_bi) of the equibiaxial state; value by Euler's identity.
        const Number w = s.apex_weight, rest = s.sign * (1. - w) / f_bi;
        r.m = pack::select(apex, rest + w * r.m, r.m);
        r.a = pack::select(apex, rest * ((1. - rho) / (1. + rho)) + w * r.a, r.a);
        r.b = pack::select(apex, w * r.b, r.b);
        r.e = pack::select(apex, r.m * stress.m + r.a * stress.a + r.b * stress.b, r.e);
      }
    return r;
  }

  template <class Number>
  TRIBODRAW_INLINE inline Number
  VegterCurves<Number>::equivalent_stress(const MohrStress<Number> &stress) const
  {
    State s;
    locate(stress, s);
    if (pack::any(s.apex_weight < 1.))
      return evaluate(stress).e;
    const Arc A = intersect(s);
    return (s.m + s.R) / (A.near_m.v + A.near_R.v + A.t * (A.l1_m.v + A.l1_R.v + A.t * (A.l2_m.v + A.l2_R.v)));
  }
} // namespace tribodraw

#endif
