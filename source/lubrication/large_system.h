#ifndef tribodraw_source_lubrication_large_system_h
#define tribodraw_source_lubrication_large_system_h

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <utility>

namespace tribodraw
{
  /// Films with so many nodes that a direct solution takes longer than multigrid: conjugate gradients preconditioned by
  /// algebraic multigrid (Trilinos ML), the unknowns distributed over the ranks in ranges.
  namespace large_system
  {
    /// More unknowns are solved with multigrid. Measured: at 40 000 the direct solution takes a fifth of the time, at
    /// 400 000 three times.
    constexpr int direct_limit = 100000;

    /// The unknowns [first, second) of this rank.
    std::pair<int, int> own_range(int n);

    /// Solve A x = b, A symmetric and positive definite. Collective; the columns and entries of this rank's range are
    /// read, x (the start) on return is whole on every rank. False if it did not converge.
    /// @param tolerance of the residual relative to the right-hand side.
    bool solve(const Eigen::SparseMatrix<double> &A, const Eigen::VectorXd &b, double tolerance, Eigen::VectorXd &x);
  } // namespace large_system
} // namespace tribodraw

#endif
