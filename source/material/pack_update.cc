#include "pack_update.h"

#include <tribodraw/material/return_mapping.h>

namespace tribodraw
{
  using FlowStressPack = HardeningLaw::FlowStressOf<Pack>;

  PackUpdate::PackUpdate(const SheetMaterial &material, const PointOptions &point_options)
      : mean_modulus(0.5 * material.youngs_modulus() / (1 - material.poissons_ratio())),
        shear_modulus(0.5 * material.youngs_modulus() / (1 + material.poissons_ratio())), locus(material.locus()),
        hardening(material.hardening()), options(point_options)
  {
  }

  namespace
  {
    /// Everything at the present stress and flow.
    struct State
    {
      MohrStress<Pack>       stress;
      Pack                   flow;
      LocusDerivatives<Pack> d; ///< of the locus
      FlowStressPack         f;
      PackMask               plastic, active, failed;
      PackMask               zero;       ///< no stress at all; there `stress` is not used and not zero
      PackMask               on_surface; ///< trial stress within loading_tolerance of the yield surface
    };

    TRIBODRAW_INLINE inline Pack
    square(const Pack &x)
    {
      return x * x;
    }

    /// Adjugate over determinant.
    TRIBODRAW_INLINE inline SymmetricPack
    inverse(const SymmetricPack &A)
    {
      const Pack    mm = A.aa * A.bb - A.ab * A.ab, ma = A.mb * A.ab - A.ma * A.bb, mb = A.ma * A.ab - A.mb * A.aa;
      const Pack    i = 1. / (A.mm * mm + A.ma * ma + A.mb * mb);
      SymmetricPack r;
      r.mm = mm * i;
      r.ma = ma * i;
      r.mb = mb * i;
      r.aa = (A.mm * A.bb - A.mb * A.mb) * i;
      r.bb = (A.mm * A.aa - A.ma * A.ma) * i;
      r.ab = (A.ma * A.mb - A.mm * A.ab) * i;
      return r;
    }

    TRIBODRAW_INLINE inline MohrStress<Pack>
    product(const SymmetricPack &A, const Pack &m, const Pack &a, const Pack &b)
    {
      return { A.mm * m + A.ma * a + A.mb * b, A.ma * m + A.aa * a + A.ab * b, A.mb * m + A.ab * a + A.bb * b };
    }

    /// (D^-1 + flow H)^-1.
    TRIBODRAW_INLINE inline SymmetricPack
    stiffness(const double mean_modulus, const double shear_modulus, const Pack &flow, const LocusDerivatives<Pack> &d)
    {
      return inverse({ 1 / mean_modulus + flow * d.mm, 1 / shear_modulus + flow * d.aa, 1 / shear_modulus + flow * d.bb,
                       flow * d.ma, flow * d.mb, flow * d.ab });
    }

    /// Multiply the stress by @p factor (positive): the gradient stays, the Hessian is divided.
    TRIBODRAW_INLINE inline void
    scale(const Pack &factor, MohrStress<Pack> &stress, LocusDerivatives<Pack> &d)
    {
      const Pack i = 1. / factor;
      stress.m     = stress.m * factor;
      stress.a     = stress.a * factor;
      stress.b     = stress.b * factor;
      d.e          = d.e * factor;
      d.mm         = d.mm * i;
      d.aa         = d.aa * i;
      d.bb         = d.bb * i;
      d.ma         = d.ma * i;
      d.mb         = d.mb * i;
      d.ab         = d.ab * i;
    }

    struct Solver
    {
      const YieldLocus     &locus;
      const HardeningLaw   &hardening;
      const PointOptions   &options;
      const MohrStrainPack &trial;
      const Pack           &eps_p; ///< old
      double                mean_modulus, shear_modulus;

      void start(State &s) const;
      void project(State &s) const;
      void iterate(State &s) const;
      void tangent(const State &s, SymmetricPack &T) const;
    };

    // Elastic trial and, for points that yield, a first estimate: cutting along the normal at the trial stress gives
    // the flow; the stress is the trial stress scaled to the flow stress.
    TRIBODRAW_INLINE inline void
    Solver::start(State &s) const
    {
      s.stress        = { mean_modulus * trial.m, shear_modulus * trial.a, shear_modulus * trial.b };
      const Pack size = pack::abs(s.stress.m) + pack::abs(s.stress.a) + pack::abs(s.stress.b);
      // The locus has no derivatives at zero; there any stress serves, nothing of it is used.
      s.zero     = size <= 0.;
      s.stress.m = pack::select(s.zero, Pack(1.), s.stress.m);
      locus.evaluate_pack(s.stress, s.d);
      hardening.flow_stress_pack(eps_p, Pack(0.), s.f);
      s.failed     = !(s.d.e < 1e300) || !(size < 1e300);
      s.plastic    = s.d.e > s.f.value && !s.zero && !s.failed;
      s.active     = s.plastic;
      s.on_surface = !s.zero && eps_p > 0. && s.d.e >= (1 - SheetMaterial::loading_tolerance) * s.f.value;

      const Pack nDn = mean_modulus * square(s.d.m) + shear_modulus * (square(s.d.a) + square(s.d.b));
      s.flow         = pack::select(s.plastic, (s.d.e - s.f.value) / (nDn + s.f.strain_slope), Pack(0.));
      if (pack::any(s.plastic))
        scale(pack::select(s.plastic, s.f.value / s.d.e, Pack(1.)), s.stress, s.d);
    }

    // With the stress on the yield surface and this normal, the flow that solves the strain equation along the normal.
    TRIBODRAW_INLINE inline void
    Solver::project(State &s) const
    {
      const Pack idt    = 1 / options.time_increment;
      const Pack nDn    = mean_modulus * square(s.d.m) + shear_modulus * (square(s.d.a) + square(s.d.b));
      const Pack n_tr   = mean_modulus * s.d.m * trial.m + shear_modulus * (s.d.a * trial.a + s.d.b * trial.b);
      const Pack slope  = s.f.strain_slope + s.f.rate_slope * idt;
      const Pack next   = pack::max(s.flow + (n_tr - s.flow * nDn - s.f.value) / (nDn + slope), 0.2 * s.flow);
      const Pack before = s.flow;
      s.flow            = pack::select(s.active, next, s.flow);
      const Pack value  = pack::max(s.f.value + slope * (s.flow - before), 0.5 * s.f.value);
      scale(pack::select(s.active, value / s.f.value, Pack(1.)), s.stress, s.d);
      s.f.value = value;
    }

    // Newton on stress and flow. Because the locus is homogeneous, scaling the stress to the yield surface costs
    // nothing, and only the strain equation is left as residual.
    TRIBODRAW_INLINE inline void
    Solver::iterate(State &s) const
    {
      constexpr unsigned max_iterations = 40;
      MohrStress<Pack>   base = s.stress, step = s.stress; // start and full length of the step under way
      Pack               base_flow = s.flow, step_flow = 0., base_error = 1e300, length = 1.;
      const Pack         idt = 1 / options.time_increment;
      const double       cm = 1 / mean_modulus, ca = 1 / shear_modulus;
      for (unsigned iteration = 0; iteration < max_iterations; ++iteration)
        {
          locus.evaluate_pack(s.stress, s.d);
          hardening.flow_stress_pack(eps_p + s.flow, s.flow * idt, s.f);
          if (!pack::any(s.active))
            return;
          scale(pack::select(s.active, s.f.value / s.d.e, Pack(1.)), s.stress, s.d);
          if (iteration == 0)
            project(s);

          const Pack rm = cm * s.stress.m + s.flow * s.d.m - trial.m, ra = ca * s.stress.a + s.flow * s.d.a - trial.a,
                     rb   = ca * s.stress.b + s.flow * s.d.b - trial.b;
          const Pack size = square(mean_modulus * rm) + square(shear_modulus) * (square(ra) + square(rb));
          const Pack goal = square(s.f.value);
          // project() leaves a flow stress that is extrapolated: not before the next evaluation is the yield equation true.
          if (iteration > 0)
            s.active = s.active && !(size <= square(ReturnMapping::tolerance) * goal);
          s.failed        = s.failed || (s.active && !(size < 1e12 * goal));
          s.active        = s.active && !s.failed;
          if (!pack::any(s.active))
            return;

          // A step must reduce the error, or is halved.
          const Pack     error    = size / goal;
          const PackMask too_long = s.active && !(error < (1 - 1e-4) * base_error);
          length                  = pack::select(too_long, 0.5 * length, Pack(1.));
          // Round-off may hide the last digit: then the start of the step is the solution.
          const PackMask settled = too_long && base_error < square(10 * ReturnMapping::tolerance);
          s.stress   = { pack::select(settled, base.m, s.stress.m), pack::select(settled, base.a, s.stress.a),
                         pack::select(settled, base.b, s.stress.b) };
          s.flow     = pack::select(settled, base_flow, s.flow);
          s.active   = s.active && !settled;
          s.failed   = s.failed || (s.active && too_long && length < 0.02);
          s.active   = s.active && !s.failed;
          base_error = pack::select(too_long, base_error, error);
          base       = { pack::select(too_long, base.m, s.stress.m), pack::select(too_long, base.a, s.stress.a),
                         pack::select(too_long, base.b, s.stress.b) };
          base_flow  = pack::select(too_long, base_flow, s.flow);

          const SymmetricPack X     = stiffness(mean_modulus, shear_modulus, s.flow, s.d);
          const auto          Xr    = product(X, rm, ra, rb);
          const auto          Xn    = product(X, s.d.m, s.d.a, s.d.b);
          const Pack          slope = s.f.strain_slope + s.f.rate_slope * idt;
          const Pack          d_flow
              = -(s.d.m * Xr.m + s.d.a * Xr.a + s.d.b * Xr.b) / (s.d.m * Xn.m + s.d.a * Xn.a + s.d.b * Xn.b + slope);
          // The flow stays positive: at most 80 per cent down at a time. Such a step need not reduce the error.
          const PackMask cut  = !too_long && d_flow < -0.8 * s.flow;
          const Pack     full = pack::select(cut, -0.8 * s.flow / pack::select(cut, d_flow, Pack(-1.)), Pack(1.));
          base_error          = iteration == 0 ? Pack(1e300) : pack::select(cut, Pack(1e300), base_error);
          step                = { pack::select(too_long, step.m, full * (-Xr.m - d_flow * Xn.m)),
                                  pack::select(too_long, step.a, full * (-Xr.a - d_flow * Xn.a)),
                                  pack::select(too_long, step.b, full * (-Xr.b - d_flow * Xn.b)) };
          step_flow           = pack::select(too_long, step_flow, full * d_flow);
          // The error left by so small a full step is its square, and the derivatives are exact to its size.
          const Pack change = square(step.m) + square(step.a) + square(step.b)
                              + 1e-2 * goal * square(step_flow / pack::select(s.active, s.flow, Pack(1.)));
          PackMask last = s.active && !cut && !too_long && change < square(1e-8) * goal;
          if (iteration == 0)
            last = last && !last;
          s.stress.m          = pack::select(s.active, base.m + length * step.m, s.stress.m);
          s.stress.a          = pack::select(s.active, base.a + length * step.a, s.stress.a);
          s.stress.b          = pack::select(s.active, base.b + length * step.b, s.stress.b);
          s.flow              = pack::select(s.active, base_flow + length * step_flow, s.flow);
          s.active            = s.active && !last;
          if (!pack::any(s.active))
            return;
        }
      s.failed = s.failed || s.active;
    }

    // (A^-1 + n n^T / h)^-1 with A = (D^-1 + flow H)^-1 and the hardening slope h; at points that do not flow A = D.
    TRIBODRAW_INLINE inline void
    Solver::tangent(const State &s, SymmetricPack &result) const
    {
      const SymmetricPack X  = stiffness(mean_modulus, shear_modulus, s.flow, s.d);
      const auto          Xn = product(X, s.d.m, s.d.a, s.d.b);
      const Pack rate_part   = options.loading_tangent ? Pack(0.) : Pack(s.f.rate_slope * (1 / options.time_increment));
      const PackMask flows   = options.loading_tangent ? (s.plastic || s.on_surface) : s.plastic;
      const Pack     w       = pack::select(
                    flows, 1. / (s.d.m * Xn.m + s.d.a * Xn.a + s.d.b * Xn.b + s.f.strain_slope + rate_part), Pack(0.));
      const Pack    wm = w * Xn.m, wa = w * Xn.a, wb = w * Xn.b;
      SymmetricPack T{ X.mm - wm * Xn.m, X.aa - wa * Xn.a, X.bb - wb * Xn.b,
                       X.ma - wm * Xn.a, X.mb - wm * Xn.b, X.ab - wa * Xn.b };
      if (options.elastic_blend > 0)
        {
          const Pack k = options.loading_tangent ? Pack(options.elastic_blend)
                                                 : pack::select(s.plastic, Pack(options.elastic_blend), Pack(0.));
          T            = { T.mm + k * (mean_modulus - T.mm),
                           T.aa + k * (shear_modulus - T.aa),
                           T.bb + k * (shear_modulus - T.bb),
                           T.ma - k * T.ma,
                           T.mb - k * T.mb,
                           T.ab - k * T.ab };
        }
      result = T;
    }

  } // namespace

  void
  PackUpdate::solve(const MohrStrainPack &trial, const Pack &eps_p, Result &result) const
  {
    const Solver solver{ locus, hardening, options, trial, eps_p, mean_modulus, shear_modulus };
    pack::vectorised([&]() TRIBODRAW_INLINE {
      State s;
      solver.start(s);
      result.plastic_work = Pack(0.);
      if (pack::any(s.plastic))
        {
          const Pack initial = s.f.value;
          solver.iterate(s);
          // The end stress alone would overstate the work of large increments by half their hardening.
          const Pack mean     = pack::max(initial, s.f.value - 0.5 * s.f.strain_slope * s.flow);
          result.plastic_work = pack::select(s.plastic, mean * s.flow, Pack(0.));
        }
      if (options.tangent)
        solver.tangent(s, result.tangent);
      result.stress   = s.stress;
      result.stress.m = pack::select(s.zero, Pack(0.), s.stress.m);
      result.flow     = s.flow;
      result.plastic  = s.plastic;
      result.failed   = s.failed;
    });
  }
} // namespace tribodraw
