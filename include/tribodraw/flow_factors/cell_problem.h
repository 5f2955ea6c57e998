#ifndef tribodraw_flow_factors_cell_problem_h
#define tribodraw_flow_factors_cell_problem_h

#include <tribodraw/flow_factors/cell_gap.h>
#include <tribodraw/flow_factors/cell_grid.h>
#include <tribodraw/flow_factors/flow_factors.h>

namespace tribodraw
{
  /// Flow factors of one gap on one process. @p grid must be periodic exactly if the boundary conditions are.
  ///
  /// Boundary conditions `paper` follow Eqs. 3-12 with these corrections of the printed text: the smooth flux of Eq. 4
  /// has the sign of the rough one; the prefactor of Eq. 5 is 1/(0.8^2 Lx Ly), so fluxes are means over the central
  /// window, divided by the smooth flux of the mean gap of the whole map under the mean gradient of the whole map (the
  /// gradient in the window differs by chance: up to some per cent, which `periodic` avoids); half-pixel shifts in Eq.
  /// 12 are means of neighbours; the right-hand side A.7 contains the pixel area. The pressure is fixed on the edge of
  /// the map. Only diagonal components are determined; the others are zero.
  ///
  /// `periodic`: PhiP_ij = <h^3 (delta_ij + d_i chi_j)>/h_avg^3, Sq PhiS = h_avg I - B, B_ij = <h delta_ij - h^3 d_i
  /// psi_j> for a smooth tool; with a rough tool the carried thickness of CellGap takes the place of h in the shear
  /// problem. PhiS > 0 when the sheet, which moves with +Us/2, is the rough surface. Below percolation PhiP = 0 and Sq
  /// PhiS = h_avg exactly.
  ///
  /// With two rough surfaces the result belongs to the given relative position of the maps.
  FlowFactors solve_cell_problem(const CellGrid &grid, const CellGap &gap, const CellSettings &settings,
                                 double sq_reference);
} // namespace tribodraw

#endif
