#include <tribodraw/material/point_batch.h>

namespace tribodraw
{
  bool
  evaluate(const SheetMaterial &material, PointBatch &batch, const PlasticState *old_states, PlasticState *new_states,
           const PointOptions &options)
  {
    for (unsigned i = 0; i < batch.n; ++i)
      {
        const Vector3       C(batch.C[0][i], batch.C[1][i], batch.C[2][i]);
        CauchyGreenResponse point = evaluate_in_cauchy_green(material, C, old_states[i], options.time_increment,
                                                             new_states[i], options.loading_tangent);
        if (!point.update.converged)
          return false;
        if (options.tangent && options.elastic_blend > 0 && (point.update.plastic || options.loading_tangent))
          {
            const Matrix3 P = LogarithmicStrain(C).derivative();
            point.tangent.noalias()
                += options.elastic_blend * P.transpose() * (material.elasticity() - point.update.tangent) * P;
          }
        for (unsigned k = 0; k < 3; ++k)
          {
            batch.stress[k][i]             = point.stress[k];
            batch.logarithmic_stress[k][i] = point.update.stress[k];
            batch.tangent[k][i]            = point.tangent(k, k);
          }
        batch.tangent[3][i]       = point.tangent(0, 1);
        batch.tangent[4][i]       = point.tangent(0, 2);
        batch.tangent[5][i]       = point.tangent(1, 2);
        batch.thickness_strain[i] = material.thickness_strain(point.strain, new_states[i]);
        batch.elastic_energy[i]   = point.update.elastic_energy;
        batch.plastic_work[i]     = point.update.plastic_work;
      }
    return true;
  }
} // namespace tribodraw
