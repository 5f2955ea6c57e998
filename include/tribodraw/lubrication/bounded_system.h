#ifndef tribodraw_lubrication_bounded_system_h
#define tribodraw_lubrication_bounded_system_h

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <memory>
#include <utility>
#include <vector>

namespace tribodraw
{
  class LargeSystem;

  /// K x = f with 0 <= x <= upper and some x prescribed, K symmetric and positive definite on the free unknowns:
  ///   0 < x_i < upper_i : r_i = 0,   x_i = 0 : r_i <= 0,   x_i = upper_i : r_i >= 0,   r = f - K x.
  /// Primal-dual active set in the form of block principal pivoting (Judice and Pires, Computers & Operations Research
  /// 21, 1994): all wrong nodes change their set at once; if that does not reduce their number for some steps (matrices
  /// that are no M-matrices: obtuse triangles), one at a time (Murty), which always ends.
  class BoundedSystem
  {
  public:
    using Matrix = Eigen::SparseMatrix<double>;

    BoundedSystem();
    ~BoundedSystem();

    /// Unknowns whose columns of K and entries of f this rank must know: all of a small system; of one that is solved
    /// with multigrid (`large_system.h`) its own range.
    static std::pair<int, int> needed_range(int n);
    /// Residual of an iterative solution relative to the right-hand side.
    double tolerance = 1e-10;

    struct Result
    {
      Eigen::VectorXd   x, residual, load; ///< load: f, whole on every rank
      std::vector<char> set; ///< per unknown, one of Set
      unsigned          iterations = 0;
      bool              converged  = false;
    };
    enum Set : char
    {
      prescribed,
      free,
      at_zero,
      at_upper
    };

    /// Ordering and symbolic factorisation of this pattern (both triangles stored), kept for all solutions.
    void analyse(const Matrix &pattern);

    /// @param set where each unknown starts; prescribed ones stay.
    /// @param x   values of the prescribed unknowns; the others are not read.
    Result solve(const Matrix &K, const Eigen::VectorXd &f, const Eigen::VectorXd &upper, std::vector<char> set,
                 Eigen::VectorXd x);

  private:
    Eigen::SimplicialLDLT<Matrix> factors;
    Matrix                        reduced;
    std::unique_ptr<LargeSystem>  large; // instead of these

    Eigen::VectorXd multiply(const Matrix &K, const Eigen::VectorXd &x) const;
    bool            solve_direct(const Matrix &K, const std::vector<char> &held, const Eigen::VectorXd &rhs, Eigen::VectorXd &x);
    bool            solve_linear(const Matrix &K, const Eigen::VectorXd &diagonal, const Eigen::VectorXd &f,
                                 const std::vector<char> &set, Eigen::VectorXd &x);
  };
} // namespace tribodraw

#endif
