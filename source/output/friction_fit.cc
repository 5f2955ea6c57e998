#include "friction_fit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribodraw
{
  double
  pressure_scale(const CoefficientTable &table)
  {
    return table.pressures.back();
  }

  double
  speed_scale(const CoefficientTable &table)
  {
    return table.speeds.back() > 0 ? table.speeds.back() : 1.;
  }

  namespace
  {
    constexpr int    grid_points    = 7;
    constexpr int    max_sweeps     = 200;
    constexpr double smallest_step  = 1e-6; // of the range of the exponents
    constexpr int    sampled_points = 40;   // along each axis, to find the smallest value of the formula

    FrictionFit
    solve(const CoefficientTable &table, const FrictionFormula &formula, const std::vector<double> &exponents)
    {
      const double                     ps = pressure_scale(table), vs = speed_scale(table);
      std::vector<std::vector<double>> rows;
      for (const double p : table.pressures)
        for (const double v : table.speeds)
          rows.push_back(formula.terms(p / ps, v / vs, exponents));
      Eigen::MatrixXd A(rows.size(), rows.front().size());
      for (std::size_t i = 0; i < rows.size(); ++i)
        A.row(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::RowVectorXd>(rows[i].data(), A.cols());
      const Eigen::VectorXd mu = Eigen::Map<const Eigen::VectorXd>(table.values.data(), A.rows());
      // Functions that cannot be told apart on few points share their constant (least norm).
      const Eigen::VectorXd x = A.completeOrthogonalDecomposition().solve(mu);
      const Eigen::VectorXd r = A * x - mu;
      FrictionFit           fit;
      fit.constants.assign(x.data(), x.data() + x.size());
      fit.exponents = exponents;
      fit.rms       = std::sqrt(r.squaredNorm() / static_cast<double>(r.size()));
      fit.max       = r.cwiseAbs().maxCoeff();
      return fit;
    }

    double
    smallest_value(const CoefficientTable &table, const FrictionFormula &formula, const FrictionFit &fit)
    {
      const double ps = pressure_scale(table), vs = speed_scale(table);
      double       smallest = std::numeric_limits<double>::infinity();
      for (int i = 0; i <= sampled_points; ++i)
        for (int j = 0; j <= sampled_points; ++j)
          {
            const double p
                = table.pressures.front() + (table.pressures.back() - table.pressures.front()) * i / sampled_points;
            const double v = table.speeds.front() + (table.speeds.back() - table.speeds.front()) * j / sampled_points;
            const auto   terms = formula.terms(p / ps, v / vs, fit.exponents);
            double       mu    = 0;
            for (std::size_t k = 0; k < terms.size(); ++k)
              mu += fit.constants[k] * terms[k];
            smallest = std::min(smallest, mu);
          }
      return smallest;
    }
  } // namespace

  FrictionFit
  fit_friction(const CoefficientTable &table, const FrictionFormula &formula)
  {
    const std::size_t n     = formula.n_exponents;
    const double      range = formula.highest - formula.lowest;
    std::vector<int>  index(n, 0);
    FrictionFit       best;
    best.rms                 = std::numeric_limits<double>::infinity();
    const auto try_exponents = [&](const std::vector<double> &exponents) {
      FrictionFit fit = solve(table, formula, exponents);
      // A hair better does not count: round-off must not decide.
      const bool better = fit.rms < best.rms * (1. - 1e-9);
      if (better)
        best = std::move(fit);
      return better;
    };
    for (bool more = true; more;)
      {
        std::vector<double> exponents;
        for (const int i : index)
          exponents.push_back(formula.lowest + range * i / (grid_points - 1));
        try_exponents(exponents);
        more = false;
        for (std::size_t k = 0; k < n && !more; ++k)
          if (++index[k] < grid_points)
            more = true;
          else
            index[k] = 0;
      }
    double step = range / (grid_points - 1) / 2.;
    for (int sweep = 0; n > 0 && sweep < max_sweeps && step > smallest_step * range; ++sweep)
      {
        bool any = false;
        for (std::size_t k = 0; k < n; ++k)
          for (const double sign : { -1., 1. })
            {
              std::vector<double> exponents = best.exponents;
              exponents[k]                  = std::clamp(exponents[k] + sign * step, formula.lowest, formula.highest);
              any                           = try_exponents(exponents) || any;
            }
        if (!any)
          step /= 2.;
      }
    best.smallest = smallest_value(table, formula, best);
    return best;
  }
} // namespace tribodraw
