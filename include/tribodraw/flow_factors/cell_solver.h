#ifndef tribodraw_flow_factors_cell_solver_h
#define tribodraw_flow_factors_cell_solver_h

#include <tribodraw/flow_factors/cell_conductances.h>

#include <array>
#include <memory>
#include <vector>

namespace tribodraw
{
  class CellMultigrid;

  /// Which linear solver a local Reynolds cell uses.
  enum class CellSolverChoice
  {
    automatic, ///< direct for small cells, else multigrid
    direct,    ///< sparse LDL^T of the open pixels
    multigrid  ///< conjugate gradients with multigrid; direct if they do not converge
  };

  /// Solver for the pressures in one gap: made once, used for several right-hand sides.
  class CellSolver
  {
  public:
    static constexpr int max_rhs = 4;

    /// @param floating one pixel, iy * nx + ix, of each region whose pressure is nowhere fixed. The right-hand side of
    /// such a region must sum to zero; its solution is free up to a constant.
    CellSolver(const CellConductances &conductances, std::vector<int> floating, CellSolverChoice choice);
    ~CellSolver();

    bool
    is_direct() const
    {
      return multigrid == nullptr;
    }
    /// Solve for @p n = 1, 2 or 4 right-hand sides in the layout of the conductances and add to @p x, whose values
    /// must be 0 where nothing flows.
    /// @param rhs is overwritten. @param goal norms of the residual to reach (multigrid).
    /// @return iterations of conjugate gradients
    unsigned solve(int n, AlignedArray<double> &rhs, AlignedArray<double> &x, const std::array<double, max_rhs> &goal);

  private:
    struct Factors;

    const CellConductances        &k;
    std::vector<int>               floating;
    std::unique_ptr<CellMultigrid> multigrid;
    std::unique_ptr<Factors>       factors;

    void factorise();
  };
} // namespace tribodraw

#endif
