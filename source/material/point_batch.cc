#include <tribodraw/material/point_batch.h>

#include <algorithm>

#include "log_strain_pack.h"
#include "pack_update.h"

namespace tribodraw
{
  namespace
  {
    static_assert(PointBatch::lanes == pack::lanes && PointBatch::capacity % PointBatch::lanes == 0);

    TRIBODRAW_INLINE inline Pack
    load(const PointBatch::Row &row, const unsigned first)
    {
      Pack x;
      std::memcpy(&x.v, row.data() + first, sizeof x);
      return x;
    }
    TRIBODRAW_INLINE inline void
    store(const Pack &x, PointBatch::Row &row, const unsigned first)
    {
      std::memcpy(row.data() + first, &x.v, sizeof x);
    }

    /// Old states of four points, component by component.
    struct OldStates
    {
      MohrStrainPack plastic_strain;
      Pack           eps_p;

      OldStates(const PlasticState *states, const unsigned n)
      {
        for (unsigned i = 0; i < pack::lanes; ++i)
          {
            const PlasticState &s = states[std::min(i, n - 1)];
            plastic_strain.m[i]   = s.plastic_strain[0] + s.plastic_strain[1];
            plastic_strain.a[i]   = s.plastic_strain[0] - s.plastic_strain[1];
            plastic_strain.b[i]   = s.plastic_strain[2];
            eps_p[i]              = s.eps_p;
          }
      }
    };

    /// Where the vectorised iteration did not converge: the slow way, which starts anew.
    bool
    repair(const SheetMaterial &material, const PointOptions &options, const MohrStrainPack &elastic,
           const PlasticState *old_states, const unsigned n, PackUpdate::Result &r, MohrStrainPack &plastic_flow,
           PointBatch &batch)
    {
      for (unsigned i = 0; i < n; ++i)
        if (r.failed[i])
          {
            const Vector3 trial(0.5 * (elastic.m[i] + elastic.a[i]), 0.5 * (elastic.m[i] - elastic.a[i]), elastic.b[i]);
            PlasticState  next;
            StressUpdate  u = material.update(trial + old_states[i].plastic_strain, old_states[i],
                                              options.time_increment, next, options.loading_tangent);
            ++batch.slow;
            batch.sub_steps += u.sub_steps;
            if (!u.converged)
              return false;
            if (options.elastic_blend > 0 && (u.plastic || options.loading_tangent))
              u.tangent += options.elastic_blend * (material.elasticity() - u.tangent);
            const Vector3 flow = next.plastic_strain - old_states[i].plastic_strain;
            r.stress.m[i]      = 0.5 * (u.stress[0] + u.stress[1]);
            r.stress.a[i]      = 0.5 * (u.stress[0] - u.stress[1]);
            r.stress.b[i]      = u.stress[2];
            r.flow[i]          = next.eps_p - old_states[i].eps_p;
            r.plastic_work[i]  = u.plastic_work;
            plastic_flow.m[i]  = flow[0] + flow[1];
            plastic_flow.a[i]  = flow[0] - flow[1];
            plastic_flow.b[i]  = flow[2];
            const Matrix3 &T   = u.tangent;
            r.tangent.mm[i]    = 0.25 * (T(0, 0) + 2 * T(0, 1) + T(1, 1));
            r.tangent.aa[i]    = 0.25 * (T(0, 0) - 2 * T(0, 1) + T(1, 1));
            r.tangent.ma[i]    = 0.25 * (T(0, 0) - T(1, 1));
            r.tangent.mb[i]    = 0.5 * (T(0, 2) + T(1, 2));
            r.tangent.ab[i]    = 0.5 * (T(0, 2) - T(1, 2));
            r.tangent.bb[i]    = T(2, 2);
          }
      return true;
    }

    /// Four points from @p first on, @p n of them in use.
    bool
    evaluate_four(const SheetMaterial &material, const PackUpdate &update, const PointOptions &options,
                  PointBatch &batch, const unsigned first, const unsigned n, const PlasticState *old_states,
                  PlasticState *new_states)
    {
      const OldStates    old(old_states, n);
      MohrStrainPack     elastic, flow;
      PackUpdate::Result r;
      bool               good = true;
      pack::vectorised([&]() TRIBODRAW_INLINE {
        const LogarithmicStrainPack E(load(batch.C[0], first), load(batch.C[1], first), load(batch.C[2], first));
        if (pack::any(!E.valid))
          {
            good = false;
            return;
          }
        elastic.m = E.strain.m - old.plastic_strain.m;
        elastic.a = E.strain.a - old.plastic_strain.a;
        elastic.b = E.strain.b - old.plastic_strain.b;
        update.solve(elastic, old.eps_p, r);
        const double cm = 1 / update.mean_modulus, ca = 1 / update.shear_modulus;
        flow.m = pack::select(r.plastic, elastic.m - cm * r.stress.m, Pack(0.));
        flow.a = pack::select(r.plastic, elastic.a - ca * r.stress.a, Pack(0.));
        flow.b = pack::select(r.plastic, elastic.b - ca * r.stress.b, Pack(0.));
        if (pack::any(r.failed) && !repair(material, options, elastic, old_states, n, r, flow, batch))
          {
            good = false;
            return;
          }
        const MohrStress<Pack> &T = r.stress;
        store(T.m + T.a, batch.logarithmic_stress[0], first);
        store(T.m - T.a, batch.logarithmic_stress[1], first);
        store(T.b, batch.logarithmic_stress[2], first);
        Pack s11, s22, s12;
        E.pull_back(T, s11, s22, s12);
        store(s11, batch.stress[0], first);
        store(s22, batch.stress[1], first);
        store(s12, batch.stress[2], first);
        store(0.5 * (cm * T.m * T.m + ca * (T.a * T.a + T.b * T.b)), batch.elastic_energy, first);
        store(r.plastic_work, batch.plastic_work, first);
        const double poisson = material.poissons_ratio() / (1 - material.poissons_ratio());
        store(-poisson * (elastic.m - flow.m) - old.plastic_strain.m - flow.m, batch.thickness_strain, first);
        if (options.tangent)
          {
            Pack K[6];
            E.pull_back(T, r.tangent, K);
            for (unsigned k = 0; k < 6; ++k)
              store(K[k], batch.tangent[k], first);
          }
      });
      if (!good)
        return false;
      for (unsigned i = 0; i < n; ++i)
        {
          new_states[i].plastic_strain[0] = old_states[i].plastic_strain[0] + 0.5 * (flow.m[i] + flow.a[i]);
          new_states[i].plastic_strain[1] = old_states[i].plastic_strain[1] + 0.5 * (flow.m[i] - flow.a[i]);
          new_states[i].plastic_strain[2] = old_states[i].plastic_strain[2] + flow.b[i];
          new_states[i].eps_p             = old_states[i].eps_p + r.flow[i];
        }
      return true;
    }
  } // namespace

  bool
  evaluate(const SheetMaterial &material, PointBatch &batch, const PlasticState *old_states, PlasticState *new_states,
           const PointOptions &options)
  {
    if (!(options.time_increment > 0))
      return false;
    const PackUpdate update(material, options);
    batch.slow = batch.sub_steps = 0;
    // Fill up with copies of the last point.
    for (unsigned i = batch.n; i % pack::lanes != 0; ++i)
      for (auto &row : batch.C)
        row[i] = row[batch.n - 1];
    for (unsigned first = 0; first < batch.n; first += pack::lanes)
      if (!evaluate_four(material, update, options, batch, first, std::min(pack::lanes, batch.n - first),
                         old_states + first, new_states + first))
        return false;
    return true;
  }
} // namespace tribodraw
