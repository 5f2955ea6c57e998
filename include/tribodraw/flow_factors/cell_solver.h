#ifndef tribodraw_flow_factors_cell_solver_h
#define tribodraw_flow_factors_cell_solver_h

#include <tribodraw/flow_factors/cell_multigrid.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace tribodraw
{
  /// Which linear solver a local Reynolds cell uses.
  enum class CellSolverChoice
  {
    automatic, ///< multigrid for large cells with little contact, else direct
    direct,    ///< sparse LDL^T of the open pixels
    multigrid  ///< conjugate gradients with multigrid; direct if it does not converge
  };

  /// Solver for the pressures in one gap: made once, used for several right-hand sides.
  class CellSolver
  {
  public:
    struct Coupling
    {
      int    a, b; ///< unknowns; b < 0: fixed pressure
      double conductance;
    };

    struct System
    {
      CellMultigrid::Layout layout; ///< position of every unknown
      std::vector<Coupling> couplings;
      /// One unknown of each region whose pressure is nowhere fixed; it is set to zero. The
      /// right-hand side of such a region must sum to zero.
      std::vector<int> floating;

      std::size_t
      size() const
      {
        return layout.x.size();
      }
    };

    CellSolver(System system, CellSolverChoice choice);
    ~CellSolver();

    bool
    is_direct() const
    {
      return multigrid == nullptr;
    }
    /// Iterations of conjugate gradients are added to @p iterations.
    Eigen::VectorXd solve(const Eigen::VectorXd &rhs, unsigned &iterations);

  private:
    struct Factors;

    System                         system;
    std::unique_ptr<CellMultigrid> multigrid;
    std::unique_ptr<Factors>       factors;

    void factorise();
  };
} // namespace tribodraw

#endif
