#include "large_system.h"

#include <tribodraw/base/parallel.h>
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
    constexpr double set_tolerance = 1e-11;
    // The same with an iterative solution, in parts of its tolerance.
    constexpr double iterative_set_tolerance = 10;

    bool
    is_large(const Eigen::Index n)
    {
      return n > LargeSystem::direct_limit;
    }

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

  std::pair<int, int>
  BoundedSystem::needed_range(const int n)
  {
    return is_large(n) ? LargeSystem::own_range(n) : std::pair<int, int>(0, n);
  }

  Eigen::VectorXd
  BoundedSystem::multiply(const Matrix &K, const Eigen::VectorXd &x) const
  {
    if (!is_large(x.size()))
      return K * x;
    const auto [begin, end] = needed_range(static_cast<int>(x.size()));
    Eigen::VectorXd y       = Eigen::VectorXd::Zero(x.size());
    for (int j = begin; j < end; ++j) // symmetric
      for (Matrix::InnerIterator entry(K, j); entry; ++entry)
        y[j] += entry.value() * x[entry.index()];
    LargeSystem::gather(y);
    return y;
  }

  BoundedSystem::BoundedSystem()  = default;
  BoundedSystem::~BoundedSystem() = default;

  void
  BoundedSystem::analyse(const Matrix &pattern)
  {
    if (is_large(pattern.cols()))
      {
        large = std::make_unique<LargeSystem>(pattern);
        return;
      }
    factors.analyzePattern(pattern);
    reduced = pattern;
  }

  bool
  BoundedSystem::solve_direct(const Matrix &K, const std::vector<char> &held, const Eigen::VectorXd &rhs,
                              Eigen::VectorXd &x)
  {
    // The pattern (and its ordering) never changes.
    const int    *start = K.outerIndexPtr(), *row = K.innerIndexPtr();
    const double *value  = K.valuePtr();
    double       *target = reduced.valuePtr();
    for (int j = 0; j < K.cols(); ++j)
      for (int k = start[j]; k < start[j + 1]; ++k)
        target[k] = row[k] != j && (held[j] || held[row[k]]) ? 0. : value[k];
    factors.factorize(reduced);
    if (factors.info() != Eigen::Success)
      return false;
    x = factors.solve(rhs);
    return true;
  }

  bool
  BoundedSystem::solve_linear(const Matrix &K, const Eigen::VectorXd &diagonal, const Eigen::VectorXd &f,
                              const std::vector<char> &set, Eigen::VectorXd &x)
  {
    // Unknowns that are held keep their diagonal only.
    std::vector<char> held(set.size());
    Eigen::VectorXd   known(x.size());
    for (int i = 0; i < x.size(); ++i)
      {
        held[i]  = set[i] != free;
        known[i] = held[i] ? x[i] : 0.;
      }
    Eigen::VectorXd rhs = f - multiply(K, known), solution = x;
    for (int i = 0; i < x.size(); ++i)
      if (held[i])
        rhs[i] = diagonal[i] * x[i];
    const bool solved = large ? large->solve(K, held, rhs, tolerance, solution) : solve_direct(K, held, rhs, solution);
    for (int i = 0; i < x.size(); ++i)
      if (set[i] == free) // the others keep their exact values
        x[i] = solution[i];
    return solved;
  }

  BoundedSystem::Result
  BoundedSystem::solve(const Matrix &K, const Eigen::VectorXd &f, const Eigen::VectorXd &upper, std::vector<char> set,
                       Eigen::VectorXd x)
  {
    const int             n        = static_cast<int>(f.size());
    Eigen::VectorXd       diagonal = K.diagonal(), load = f;
    if (large)
      {
        LargeSystem::gather(diagonal);
        LargeSystem::gather(load);
      }
    Result                result;
    std::vector<char>     wanted(n);
    int                   fewest = n + 1;
    unsigned              credit = patience;
    for (result.iterations = 1; result.iterations <= max_iterations; ++result.iterations)
      {
        for (int i = 0; i < n; ++i)
          if (set[i] == at_zero || set[i] == at_upper)
            x[i] = set[i] == at_zero ? 0. : upper[i];
        if (!solve_linear(K, diagonal, load, set, x))
          break;
        result.residual     = load - multiply(K, x);
        const double margin = (large ? iterative_set_tolerance * tolerance : set_tolerance) * pressure_scale(diagonal, load, x, set);

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
    result.residual   = load - multiply(K, x);
    result.x          = std::move(x);
    result.load       = std::move(load);
    result.set        = std::move(set);
    return result;
  }
} // namespace tribodraw
