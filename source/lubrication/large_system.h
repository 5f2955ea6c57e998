#ifndef tribodraw_source_lubrication_large_system_h
#define tribodraw_source_lubrication_large_system_h

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <utility>
#include <vector>

namespace tribodraw
{
  /// Films with so many nodes that a direct solution takes longer than multigrid: conjugate gradients preconditioned by
  /// algebraic multigrid (Trilinos ML), the unknowns distributed over the ranks in ranges.
  class LargeSystem
  {
  public:
    using Matrix = Eigen::SparseMatrix<double>;

    /// More unknowns are solved with multigrid. Measured: at 40 000 the direct solution takes a fifth of the time, at
    /// 400 000 three times.
    static constexpr int direct_limit = 100000;

    /// The unknowns [first, second) of this rank.
    static std::pair<int, int> own_range(int n);
    /// A vector of which each rank knows its own range becomes whole.
    static void gather(Eigen::VectorXd &x);

    /// Takes the pattern (both triangles). Collective.
    explicit LargeSystem(const Matrix &pattern);
    ~LargeSystem();

    /// Solve A x = b, A symmetric and positive definite on the unknowns that are not held. Collective; the columns and
    /// entries of this rank's range are read, x (the start) on return is whole on every rank. False if it did not
    /// converge.
    /// @param held one entry an unknown. If not 0, nothing but the diagonal is taken from its row and column.
    /// @param tolerance of the residual relative to the right-hand side.
    bool solve(const Matrix &A, const std::vector<char> &held, const Eigen::VectorXd &b, double tolerance,
               Eigen::VectorXd &x);

  private:
    struct Distributed;
    std::unique_ptr<Distributed> data;
  };
} // namespace tribodraw

#endif
