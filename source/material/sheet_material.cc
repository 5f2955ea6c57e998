#include <tribodraw/base/parameters.h>
#include <tribodraw/material/return_mapping.h>
#include <tribodraw/material/sheet_material.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  SheetMaterial
  SheetMaterial::read(Parameters &parameters)
  {
    const double young = parameters.quantity("Young's modulus", "GPa", Range::positive().usual(10., 500.),
                                             "Isotropic elastic modulus of the sheet.");
    const double poisson
        = parameters.quantity("Poisson's ratio", "", Range{ 0., 0.5 }.usual(0.2, 0.4), "Isotropic Poisson's ratio.");
    std::shared_ptr<const YieldLocus> locus
        = parameters.model<YieldLocus>("Yield locus", "Shape of the yield surface in plane stress.");
    std::shared_ptr<const HardeningLaw> law
        = parameters.model<HardeningLaw>("Hardening", "Flow stress in rolling direction over plastic strain and rate.");
    return SheetMaterial(young, poisson, std::move(locus), std::move(law));
  }

  SheetMaterial::SheetMaterial(const double youngs_modulus, const double poissons_ratio,
                               std::shared_ptr<const YieldLocus> locus, std::shared_ptr<const HardeningLaw> hardening)
      : E(youngs_modulus), nu(poissons_ratio), yield_locus(std::move(locus)), hardening_law(std::move(hardening))
  {
    D << 1., nu, 0., nu, 1., 0., 0., 0., 0.5 * (1 - nu);
    D *= E / (1 - nu * nu);
    D_inverse << 1., -nu, 0., -nu, 1., 0., 0., 0., 2 * (1 + nu);
    D_inverse /= E;
  }

  namespace
  {
    /// (A^-1 + n n^T / h)^-1 with A = @p stiffness: the tangent when plastic flow along n hardens with slope @p
    /// hardening.
    Matrix3
    plastic_tangent(const Matrix3 &stiffness, const Vector3 &n, const double hardening)
    {
      const Vector3 An = stiffness * n;
      return stiffness - An * An.transpose() / (n.dot(An) + hardening);
    }

    Matrix3
    symmetric_inverse(const Matrix3 &a)
    {
      const double c00 = a(1, 1) * a(2, 2) - a(1, 2) * a(1, 2), c01 = a(0, 2) * a(1, 2) - a(0, 1) * a(2, 2),
                   c02 = a(0, 1) * a(1, 2) - a(0, 2) * a(1, 1), c11 = a(0, 0) * a(2, 2) - a(0, 2) * a(0, 2),
                   c12 = a(0, 1) * a(0, 2) - a(0, 0) * a(1, 2), c22 = a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1);
      Matrix3 result;
      result << c00, c01, c02, c01, c11, c12, c02, c12, c22;
      return result / (a(0, 0) * c00 + a(0, 1) * c01 + a(0, 2) * c02);
    }
  } // namespace

  StressUpdate
  SheetMaterial::update(const Vector3 &strain, const PlasticState &old_state, const double time_increment,
                        PlasticState &new_state, const bool loading_tangent) const
  {
    StressUpdate  result;
    const Vector3 elastic_trial = strain - old_state.plastic_strain;
    result.stress               = D * elastic_trial;
    result.tangent              = D;
    const double trial          = yield_locus->equivalent_stress(result.stress);
    if (!std::isfinite(trial) || !(time_increment > 0))
      {
        result.converged = false;
        new_state        = old_state;
        return result;
      }
    const HardeningLaw::FlowStress limit = hardening_law->flow_stress(old_state.eps_p, 0.);
    if (trial <= limit.value)
      {
        if (loading_tangent && old_state.eps_p > 0 && trial >= (1 - loading_tolerance) * limit.value)
          {
            Vector3 n;
            Matrix3 H;
            yield_locus->evaluate(result.stress, n, H);
            result.tangent = plastic_tangent(D, n, limit.strain_slope);
          }
        result.elastic_energy = 0.5 * result.stress.dot(elastic_trial);
        new_state             = old_state;
        return result;
      }

    const ReturnMapping         mapping(D, D_inverse, *yield_locus, *hardening_law);
    const ReturnMapping::Result flow = mapping.solve({ elastic_trial, old_state.eps_p, time_increment });
    if (!flow.converged)
      {
        result.converged = update_in_parts(strain, old_state, time_increment, new_state, result);
        if (!result.converged)
          new_state = old_state;
        return result;
      }
    result.plastic         = true;
    result.stress          = flow.stress;
    const double rate_part = loading_tangent ? 0. : flow.flow_stress.rate_slope / time_increment;
    result.tangent
        = plastic_tangent(symmetric_inverse(flow.compliance), flow.normal, flow.flow_stress.strain_slope + rate_part);
    // The end stress alone would overstate the work of large increments by half their hardening.
    const double mean_stress
        = std::max(limit.value, flow.flow_stress.value - 0.5 * flow.flow_stress.strain_slope * flow.flow);
    result.plastic_work          = mean_stress * flow.flow;
    result.elastic_energy        = 0.5 * flow.stress.dot(D_inverse * flow.stress);
    const Vector3 plastic_strain = old_state.plastic_strain + flow.flow * flow.normal;
    new_state.eps_p              = old_state.eps_p + flow.flow;
    new_state.plastic_strain     = plastic_strain;
    return result;
  }

  bool
  SheetMaterial::run_parts(const Vector3 &elastic_trial, const PlasticState &old_state, const double time_increment,
                           const unsigned n, PlasticState &new_state, StressUpdate &result) const
  {
    const ReturnMapping mapping(D, D_inverse, *yield_locus, *hardening_law);
    PlasticState        state = old_state;
    result.plastic_work       = 0;
    for (unsigned k = 1; k <= n; ++k)
      {
        const Vector3 trial = old_state.plastic_strain + elastic_trial * (double(k) / n) - state.plastic_strain;
        result.stress       = D * trial;
        if (yield_locus->equivalent_stress(result.stress) <= hardening_law->flow_stress(state.eps_p, 0).value)
          continue;
        const ReturnMapping::Result part = mapping.solve({ trial, state.eps_p, time_increment / n });
        if (!part.converged)
          return false;
        result.stress = part.stress;
        result.plastic_work += part.flow * (part.flow_stress.value - 0.5 * part.flow_stress.strain_slope * part.flow);
        state.eps_p += part.flow;
        state.plastic_strain += trial - D_inverse * part.stress;
      }
    result.elastic_energy = 0.5 * result.stress.dot(D_inverse * result.stress);
    new_state             = state;
    return true;
  }

  bool
  SheetMaterial::update_in_parts(const Vector3 &strain, const PlasticState &old_state, const double time_increment,
                                 PlasticState &new_state, StressUpdate &result) const
  {
    const Vector3 elastic_trial = strain - old_state.plastic_strain;
    for (unsigned n : { 4, 16, 64 })
      {
        if (!run_parts(elastic_trial, old_state, time_increment, n, new_state, result))
          continue;
        const double h = 1e-6 * elastic_trial.norm();
        Matrix3      tangent;
        PlasticState unused;
        StressUpdate up, down;
        bool         good = true;
        for (int j = 0; j < 3 && good; ++j)
          {
            const Vector3 step = h * Vector3::Unit(j);
            good               = run_parts(elastic_trial + step, old_state, time_increment, n, unused, up)
                   && run_parts(elastic_trial - step, old_state, time_increment, n, unused, down);
            tangent.col(j) = (up.stress - down.stress) / (2 * h);
          }
        if (!good)
          continue;
        result.tangent   = 0.5 * (tangent + tangent.transpose());
        result.plastic   = true;
        result.sub_steps = n;
        return true;
      }
    return false;
  }

  double
  SheetMaterial::thickness_strain(const Vector3 &strain, const PlasticState &state) const
  {
    const double plastic = state.plastic_strain[0] + state.plastic_strain[1];
    return -nu / (1 - nu) * (strain[0] + strain[1] - plastic) - plastic;
  }
} // namespace tribodraw
