#ifndef tribodraw_flow_factors_cell_problem_h
#define tribodraw_flow_factors_cell_problem_h

#include <tribodraw/flow_factors/cell_gap.h>
#include <tribodraw/flow_factors/cell_grid.h>
#include <tribodraw/flow_factors/flow_factors.h>

namespace tribodraw
{
  /// Flow factors of one gap on one process. @p grid must be periodic exactly if the boundary conditions are.
  /// Throws ConvergenceError if the flux through the sections of the cell is not the same to 1e-8.
  FlowFactors solve_cell_problem(const CellGrid &grid, const CellGap &gap, const CellSettings &settings,
                                 double sq_reference);
} // namespace tribodraw

#endif
