#ifndef tribodraw_flow_factors_cell_multigrid_h
#define tribodraw_flow_factors_cell_multigrid_h

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace tribodraw
{
  /// Conjugate gradients with one multigrid V-cycle as preconditioner, for systems on the pixels of a map in which
  /// only neighbours (corners included) are coupled.
  ///
  /// Every other pixel row and column is kept on the next level. The interpolation solves the equations of
  /// the dropped pixels with the coefficients of the matrix, so that it follows the jumps of h^3, and coarse matrices
  /// are Galerkin products (Alcouffe, Brandt, Dendy, Painter 1981; Dendy 1982). Smoother: Gauss-Seidel, forward before
  /// and backward after the coarse correction.
  class CellMultigrid
  {
  public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

    /// Positions of the unknowns on a grid of nx x ny pixels.
    struct Layout
    {
      int              nx = 0, ny = 0;
      bool             periodic = false;
      std::vector<int> x, y;
    };

    /// @param matrix symmetric, positive definite, off-diagonals not positive.
    CellMultigrid(Matrix matrix, Layout layout);
    ~CellMultigrid();

    /// Solve to a relative reduction @p tolerance of the energy norm of the error, as estimated by the preconditioner.
    /// Returns the number of iterations, 0 if @p max_iterations were
    /// not enough.
    unsigned solve(const Eigen::VectorXd &rhs, Eigen::VectorXd &solution, double tolerance,
                   unsigned max_iterations) const;

  private:
    struct Level;
    struct Coarsest;
    std::vector<std::unique_ptr<Level>> levels;
    std::unique_ptr<Coarsest>           coarsest;

    void            cycle(std::size_t level, const Eigen::VectorXd &rhs, Eigen::VectorXd &x) const;
    Eigen::VectorXd precondition(const Eigen::VectorXd &residual) const;
  };
} // namespace tribodraw

#endif
