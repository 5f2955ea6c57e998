#ifndef tribodraw_flow_factors_cell_multigrid_h
#define tribodraw_flow_factors_cell_multigrid_h

#include <tribodraw/flow_factors/cell_conductances.h>

#include <array>
#include <memory>

namespace tribodraw
{
  class CellCoarsening;
  class GraphMultigrid;

  /// Conjugate gradients for the five-point system of a local Reynolds cell, preconditioned by one multigrid V-cycle in
  /// single precision. Solution and residual are in double precision. Several right-hand sides are solved at once.
  ///
  /// The finest level works on the arrays of the map: red-black Gauss-Seidel, and the interpolation of CellCoarsening,
  /// which follows the jumps of h^3. All coarser levels are those of GraphMultigrid.
  class CellMultigrid
  {
  public:
    static constexpr int min_width = 8; ///< least number of pixels along each axis

    explicit CellMultigrid(const CellConductances &conductances);
    ~CellMultigrid();

    /// Add the solutions of @p n right-hand sides (1, 2 or 4) to @p x; @p rhs becomes the residual. Stops when the norm
    /// of each residual is at most its @p goal. Returns the number of iterations, max_iterations + 1 if they were not
    /// enough.
    unsigned solve(int n, AlignedArray<double> &rhs, AlignedArray<double> &x, const std::array<double, 4> &goal,
                   unsigned max_iterations) const;

  private:
    class Cycle;

    const CellConductances         &k;
    std::unique_ptr<CellCoarsening> coarsening;
    std::unique_ptr<GraphMultigrid> coarse;
    // Single precision copies, in the layout of the conductances: conductances and inverse of their sum
    AlignedArray<float> kx, ky, inverse;
  };
} // namespace tribodraw

#endif
