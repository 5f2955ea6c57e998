#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/forming/tangent_solver.h>

#include <Eigen/LU>

#include <cmath>


namespace tribodraw
{
  namespace
  {
    /// New factors cost as much as ten or more solutions with old ones.
    constexpr unsigned most_iterations = 6;
  } // namespace

  TangentSolver::TangentSolver()
    : direct(DirectSolver::Symmetry::unsymmetric)
  {}

  bool
  TangentSolver::factor(const Contact::Tangent &tangent, const std::vector<bool> &held)
  {
    const timing::Scope scope("forming/factorisation");
    has_factors = direct.factor(tangent.sheet, held);
    if (!has_factors)
      return false;
    row = tangent.row;
    by_travel.resize(tangent.column.rows(), tangent.column.cols());
    for (Eigen::Index f = 0; f < by_travel.cols() && !tools_held; ++f)
      {
        Eigen::VectorXd x = tangent.column.col(f);
        direct.solve(x);
        by_travel.col(f) = x;
      }
    schur = tangent.corner - row.transpose() * by_travel;
    return true;
  }

  Eigen::VectorXd
  TangentSolver::multiply(const Contact::Tangent &tangent, const Eigen::VectorXd &x) const
  {
    const Eigen::Index  n = tangent.column.rows(), n_free = tangent.column.cols();
    Eigen::VectorXd     result(n + n_free);
    result.head(n) = tangent.sheet.multiply(x.head(n));
    if (parallel::size() > 1)
      {
        std::vector<double> sum(result.data(), result.data() + n);
        parallel::sum(sum);
        result.head(n) = Eigen::Map<const Eigen::VectorXd>(sum.data(), n);
      }
    if (n_free == 0)
      return result;
    if (tools_held)
      {
        result.tail(n_free) = x.tail(n_free);
        return result;
      }
    result.head(n) += tangent.column * x.tail(n_free);
    result.tail(n_free) = tangent.row.transpose() * x.head(n) + tangent.corner * x.tail(n_free);
    return result;
  }

  Eigen::VectorXd
  TangentSolver::precondition(const Eigen::VectorXd &b)
  {
    const Eigen::Index n = by_travel.rows(), n_free = by_travel.cols();
    Eigen::VectorXd    x = b, sheet = b.head(n);
    direct.solve(sheet);
    if (n_free > 0 && !tools_held)
      {
        x.tail(n_free) = schur.fullPivLu().solve(b.tail(n_free) - row.transpose() * sheet);
        sheet -= by_travel * x.tail(n_free);
      }
    x.head(n) = sheet;
    return x;
  }

  bool
  TangentSolver::iterate(const Contact::Tangent &tangent, const double tolerance, Eigen::VectorXd &b)
  {
    const double norm = b.norm();
    if (norm == 0)
      return true;
    // Right preconditioning: the residual is that of the system itself.
    std::vector<Eigen::VectorXd> basis{b / norm}, direction;
    Eigen::MatrixXd              H = Eigen::MatrixXd::Zero(most_iterations + 1, most_iterations);
    Eigen::VectorXd              g = Eigen::VectorXd::Zero(most_iterations + 1);
    std::vector<double>          cosine, sine;
    g[0] = norm;
    for (unsigned k = 0; k < most_iterations; ++k)
      {
        direction.push_back(precondition(basis[k]));
        Eigen::VectorXd w = multiply(tangent, direction[k]);
        for (unsigned i = 0; i <= k; ++i)
          {
            H(i, k) = basis[i].dot(w);
            w -= H(i, k) * basis[i];
          }
        const double rest = w.norm();
        H(k + 1, k)       = rest;
        for (unsigned i = 0; i < k; ++i)
          {
            const double above = H(i, k), below = H(i + 1, k);
            H(i, k)     = cosine[i] * above + sine[i] * below;
            H(i + 1, k) = cosine[i] * below - sine[i] * above;
          }
        const double length = std::hypot(H(k, k), H(k + 1, k));
        if (!(length > 0) || !std::isfinite(length))
          return false;
        cosine.push_back(H(k, k) / length);
        sine.push_back(H(k + 1, k) / length);
        H(k, k)  = length;
        g[k + 1] = -sine[k] * g[k];
        g[k] *= cosine[k];
        const double error = std::abs(g[k + 1]) / norm;
        if (error <= tolerance)
          {
            const Eigen::VectorXd y = H.topLeftCorner(k + 1, k + 1).triangularView<Eigen::Upper>().solve(g.head(k + 1));
            b.setZero();
            for (unsigned i = 0; i <= k; ++i)
              b += y[i] * direction[i];
            return b.allFinite();
          }
        // Give up as soon as the mean gain so far will not do.
        const double needed = std::log(tolerance) / most_iterations * (k + 1);
        if (k >= 1 && std::log(error) > 0.6 * needed)
          return false;
        basis.push_back(w / rest);
      }
    return false;
  }

  bool
  TangentSolver::solve(Contact::Tangent &tangent, const std::vector<bool> &held, const double tolerance, const bool similar, Eigen::VectorXd &b)
  {
    const timing::Scope scope("forming/linear solver");
    const auto          n      = static_cast<std::size_t>(tangent.column.rows());
    const bool          before = tools_held;
    tools_held                 = held.size() > n && held[n];
    if (tools_held != before)
      has_factors = false;
    const std::vector<bool> held_sheet(held.begin(), held.begin() + static_cast<std::ptrdiff_t>(n));
    tangent.sheet.eliminate(held_sheet, parallel::rank() == 0 ? 1. : 0.);
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i])
        {
          b[i] = 0;
          if (i < n && tangent.column.cols() > 0) // one for each tool moved by a force
            tangent.column.row(i).setZero(), tangent.row.row(i).setZero();
        }
    if (has_factors && similar && iterate(tangent, tolerance, b))
      return true;
    if (!factor(tangent, held_sheet))
      return false;
    b = precondition(b);
    return b.allFinite();
  }
} // namespace tribodraw
