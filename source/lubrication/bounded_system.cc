#include <tribodraw/lubrication/bounded_system.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    // Limits of the iteration. Films on a drawn blank need 5 to 8 steps.
    constexpr unsigned max_iterations = 500;
    constexpr unsigned patience       = 10;
    // A node changes its set if that alters its pressure by more than this part of the largest pressure.
    constexpr double tolerance = 1e-11;

    double
    pressure_scale(const Eigen::VectorXd &diagonal, const Eigen::VectorXd &f, const Eigen::VectorXd &x,
                   const std::vector<char> &set)
    {
      double scale = 0;
      for (int i = 0; i < x.size(); ++i)
        {
          scale = std::max(scale, std::abs(x[i]));
          if (set[i] != BoundedSystem::prescribed)
            scale = std::max(scale, std::abs(f[i]) / diagonal[i]);
        }
      return scale;
    }

    /// The set in which unknown i belongs, judged by its value or its multiplier (in units of pressure).
    char
    better_set(const char set, const double x, const double upper, const double multiplier, const double margin)
    {
      switch (set)
        {
        case BoundedSystem::free:
          if (x < -margin)
            return BoundedSystem::at_zero;
          return x > upper + margin ? char(BoundedSystem::at_upper) : set;
        case BoundedSystem::at_zero:
          return multiplier > margin ? char(BoundedSystem::free) : set;
        case BoundedSystem::at_upper:
          return multiplier < -margin ? char(BoundedSystem::free) : set;
        default:
          return set;
        }
    }
  } // namespace

  void
  BoundedSystem::analyse(const Matrix &pattern)
  {
    factors.analyzePattern(pattern);
    reduced = pattern;
  }

  bool
  BoundedSystem::solve_linear(const Matrix &K, const Eigen::VectorXd &f, const std::vector<char> &set,
                              Eigen::VectorXd &x)
  {
    // Unknowns that are held get a row of the identity, so that the pattern (and its ordering) never changes.
    const int    *start = K.outerIndexPtr(), *row = K.innerIndexPtr();
    const double *value  = K.valuePtr();
    double       *target = reduced.valuePtr();
    for (int j = 0; j < K.cols(); ++j)
      if (set[j] == free)
        for (int k = start[j]; k < start[j + 1]; ++k)
          target[k] = set[row[k]] == free ? value[k] : 0.;
      else
        for (int k = start[j]; k < start[j + 1]; ++k)
          target[k] = row[k] == j ? 1. : 0.;

    Eigen::VectorXd held(x.size()), rhs(x.size());
    for (int i = 0; i < x.size(); ++i)
      held[i] = set[i] == free ? 0. : x[i];
    rhs = f - K * held;
    for (int i = 0; i < x.size(); ++i)
      if (set[i] != free)
        rhs[i] = x[i];
    factors.factorize(reduced);
    if (factors.info() != Eigen::Success)
      return false;
    x = factors.solve(rhs);
    return true;
  }

  BoundedSystem::Result
  BoundedSystem::solve(const Matrix &K, const Eigen::VectorXd &f, const Eigen::VectorXd &upper, std::vector<char> set,
                       Eigen::VectorXd x)
  {
    const int             n        = static_cast<int>(f.size());
    const Eigen::VectorXd diagonal = K.diagonal();
    Result                result;
    std::vector<char>     wanted(n);
    int                   fewest = n + 1;
    unsigned              credit = patience;
    for (result.iterations = 1; result.iterations <= max_iterations; ++result.iterations)
      {
        for (int i = 0; i < n; ++i)
          if (set[i] == at_zero || set[i] == at_upper)
            x[i] = set[i] == at_zero ? 0. : upper[i];
        if (!solve_linear(K, f, set, x))
          break;
        result.residual     = f - K * x;
        const double margin = tolerance * pressure_scale(diagonal, f, x, set);

        int n_wrong = 0, last_wrong = -1;
        for (int i = 0; i < n; ++i)
          {
            const double multiplier = set[i] == prescribed ? 0. : result.residual[i] / diagonal[i];
            wanted[i]               = better_set(set[i], x[i], upper[i], multiplier, margin);
            if (wanted[i] != set[i])
              {
                ++n_wrong;
                last_wrong = i;
              }
          }
        if (n_wrong == 0)
          {
            result.converged = true;
            break;
          }
        if (n_wrong < fewest)
          {
            fewest = n_wrong;
            credit = patience;
          }
        else if (credit > 0)
          --credit;
        if (credit > 0)
          set = wanted;
        else
          set[last_wrong] = wanted[last_wrong];
      }
    // What remains outside is within the margin (or the iteration failed, which `converged` tells).
    for (int i = 0; i < n; ++i)
      if (set[i] != prescribed)
        x[i] = std::isfinite(x[i]) ? std::clamp(x[i], 0., upper[i]) : 0.;
    result.iterations = std::min(result.iterations, max_iterations);
    result.residual   = f - K * x;
    result.x          = std::move(x);
    result.set        = std::move(set);
    return result;
  }
} // namespace tribodraw
