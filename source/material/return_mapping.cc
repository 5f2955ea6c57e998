#include <tribodraw/material/return_mapping.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribodraw
{
  ReturnMapping::ReturnMapping(const Matrix3 &elasticity, const Matrix3 &compliance, const YieldLocus &yield_locus,
                               const HardeningLaw &hardening_law)
      : D(elasticity), D_inverse(compliance), locus(yield_locus), hardening(hardening_law)
  {
  }

  inline Vector3
  ReturnMapping::evaluate(const Input &input, Result &result, double &yield) const
  {
    Matrix3      H;
    const double e     = locus.evaluate(result.stress, result.normal, H);
    result.flow_stress = hardening.flow_stress(input.eps_p + result.flow, result.flow / input.time_increment);
    result.compliance  = D_inverse + result.flow * H;
    ++result.n_evaluations;
    yield                  = e - result.flow_stress.value;
    const Vector3 residual = D_inverse * result.stress + result.flow * result.normal - input.elastic_trial_strain;
    result.error           = std::sqrt((D * residual).squaredNorm() + yield * yield) / result.flow_stress.value;
    return residual;
  }

  ReturnMapping::Result
  ReturnMapping::solve(const Input &input) const
  {
    Result result;
    if (newton(input, result))
      {
        result.converged = true;
        return result;
      }
    const unsigned spent = result.n_evaluations;
    result               = robust(input);
    result.n_evaluations += spent;
    return result;
  }

  bool
  ReturnMapping::newton(const Input &input, Result &result) const
  {
    const unsigned max_iterations = 25, max_halvings = 5;
    // Start: elastic cutting along the normal at the trial stress, then the trial stress scaled to the flow stress. A
    // trial stress far outside would make the first linearisation useless.
    result.stress    = D * input.elastic_trial_strain;
    result.flow      = 0;
    double  yield    = 0;
    Vector3 residual = evaluate(input, result, yield);
    {
      const double e           = yield + result.flow_stress.value;
      const double guess       = yield / (result.normal.dot(D * result.normal) + result.flow_stress.strain_slope);
      result.flow              = guess;
      const double flow_stress = hardening.flow_stress(input.eps_p + guess, guess / input.time_increment).value;
      result.stress *= std::min(1., flow_stress / e);
      residual = evaluate(input, result, yield);
    }
    for (unsigned iteration = 0; iteration < max_iterations; ++iteration)
      {
        if (result.error < tolerance)
          return true;
        const Matrix3 Xi    = result.compliance.inverse();
        const Vector3 Xi_r  = Xi * residual;
        const Vector3 Xi_n  = Xi * result.normal;
        const double  slope = result.flow_stress.strain_slope + result.flow_stress.rate_slope / input.time_increment;
        const double  denominator = result.normal.dot(Xi_n) + slope;
        if (!(denominator > 0) || !std::isfinite(denominator))
          return false;
        const double  d_flow   = (yield - result.normal.dot(Xi_r)) / denominator;
        const Vector3 d_stress = -Xi_r - d_flow * Xi_n;
        // The flow stays positive: at most 80 per cent down at a time.
        double step = d_flow < -0.8 * result.flow ? -0.8 * result.flow / d_flow : 1.;

        const Result old      = result;
        bool         accepted = false;
        for (unsigned i = 0; i <= max_halvings && !accepted; ++i, step *= 0.5)
          {
            result.stress = old.stress + step * d_stress;
            result.flow   = old.flow + step * d_flow;
            residual      = evaluate(input, result, yield);
            // A clipped step need not reduce the error (the rate term is steep at small flow), a plain one must.
            accepted = std::isfinite(result.error) && result.error < (1 - 1e-4 * step) * old.error;
          }
        if (!accepted)
          return old.error < 10 * tolerance;
      }
    return false;
  }

  // Turn the stress (of size @p scale) until eps_tr.s/e(s) exceeds the flow, so that the function below has its minimum
  // away from zero. Returns false if even the largest ratio does not: then the minimum is at zero. Damped Newton.
  bool
  ReturnMapping::leave_origin(const Input &input, const double flow, const double scale, Result &result) const
  {
    const unsigned max_iterations = 60, max_halvings = 30;
    const Vector3 &eps   = input.elastic_trial_strain;
    const auto     ratio = [&](const Vector3 &s) { return eps.dot(s) / locus.equivalent_stress(s); };
    double         rho   = ratio(result.stress);
    for (unsigned iteration = 0; iteration < max_iterations && rho <= flow; ++iteration)
      {
        result.stress *= scale / locus.equivalent_stress(result.stress);
        double yield;
        evaluate(input, result, yield);
        const Vector3 ascent = eps - rho * result.normal;
        const Vector3 d      = result.compliance.inverse() * ascent;
        const Vector3 old    = result.stress;
        const double  gain = ascent.dot(d) / scale, before = rho;
        double        step = 1;
        for (unsigned i = 0; i < max_halvings; ++i, step *= 0.5)
          {
            result.stress = old + step * d;
            rho           = ratio(result.stress);
            if (rho >= before + 1e-4 * step * gain)
              break;
          }
        if (!(rho - before > 1e-13 * std::abs(before)))
          break;
      }
    return rho > flow;
  }

  // Minimum over s of 1/2 s.D^-1 s - eps_tr.s + dg e(s). Returns false if not found; a minimum at s = 0 (flow too
  // large) is reported by equivalent stress zero.
  bool
  ReturnMapping::minimise(const Input &input, const double flow, Result &result, double &equivalent_stress) const
  {
    const unsigned max_iterations = 60, max_halvings = 40;
    result.flow            = flow;
    const double scale     = hardening.flow_stress(input.eps_p, 0).value;
    const auto   potential = [&](const Vector3 &s) {
      return 0.5 * s.dot(D_inverse * s) - input.elastic_trial_strain.dot(s) + flow * locus.equivalent_stress(s);
    };
    for (unsigned iteration = 0; iteration < max_iterations; ++iteration)
      {
        if (!leave_origin(input, flow, scale, result))
          {
            equivalent_stress = 0;
            return true;
          }
        // Exact minimum along the ray through the origin, where the function is a parabola.
        result.stress *= (input.elastic_trial_strain.dot(result.stress) - flow * locus.equivalent_stress(result.stress))
                         / result.stress.dot(D_inverse * result.stress);
        double        yield;
        const Vector3 residual = evaluate(input, result, yield);
        equivalent_stress      = yield + result.flow_stress.value;
        if ((D * residual).norm() < 0.1 * tolerance * result.flow_stress.value)
          return true;
        const Vector3 d_stress = -(result.compliance.inverse() * residual);
        const double  slope    = residual.dot(d_stress);
        const double  current  = potential(result.stress);
        // Below round-off of the potential its decrease cannot be seen; the full Newton step is right there.
        const double  blur = 1e-14 * (std::abs(current) + std::abs(input.elastic_trial_strain.dot(result.stress)));
        const Vector3 old  = result.stress;
        double        step = 1;
        unsigned      i    = 0;
        for (; i < max_halvings; ++i, step *= 0.5)
          {
            result.stress = old + step * d_stress;
            if (potential(result.stress) <= current + 1e-4 * step * slope + blur)
              break;
          }
        if (i == max_halvings || !(slope < 0))
          return (D * residual).norm() < tolerance * result.flow_stress.value;
      }
    return false;
  }

  ReturnMapping::Result
  ReturnMapping::robust(const Input &input) const
  {
    const unsigned max_iterations = 200;
    Result         result;
    const Vector3  trial   = D * input.elastic_trial_strain;
    const double   e_trial = locus.equivalent_stress(trial);
    const double   sigma_y = hardening.flow_stress(input.eps_p, 0).value;
    result.stress          = trial * (sigma_y / e_trial);
    double lower = 0, upper = std::numeric_limits<double>::infinity();
    double flow = (e_trial - sigma_y) / (D(0, 0) + D(0, 1));
    for (unsigned iteration = 0; iteration < max_iterations; ++iteration)
      {
        const Vector3 start = result.stress;
        double        e;
        if (!minimise(input, flow, result, e))
          return result;
        const double yield = e - result.flow_stress.value;
        if (e > 0)
          {
            result.error = std::abs(yield) / result.flow_stress.value;
            if (result.error < tolerance || upper - lower < 1e-15 * upper)
              {
                result.converged = result.error < 10 * tolerance;
                return result;
              }
          }
        (e > 0 && yield > 0 ? lower : upper) = flow;
        double next                          = 0;
        if (e > 0)
          {
            const double slope = result.flow_stress.strain_slope + result.flow_stress.rate_slope / input.time_increment;
            next = flow + yield / (result.normal.dot(result.compliance.inverse() * result.normal) + slope);
          }
        else
          result.stress = start;
        if (std::isinf(upper))
          flow = next > 1.001 * lower ? std::min(next, 10 * lower) : 2 * lower;
        else if (next > lower && next < upper)
          flow = next;
        else // the flow may span many decades (rate term): halve in the logarithm when possible
          flow = lower > 0 && upper > 4 * lower ? std::sqrt(lower * upper)
                 : lower > 0                    ? 0.5 * (lower + upper)
                                                : 0.1 * upper;
      }
    return result;
  }
} // namespace tribodraw
