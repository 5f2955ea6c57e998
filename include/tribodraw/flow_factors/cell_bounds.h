#ifndef tribodraw_flow_factors_cell_bounds_h
#define tribodraw_flow_factors_cell_bounds_h

#include <tribodraw/flow_factors/cell_trial_fields.h>
#include <tribodraw/flow_factors/flow_factors.h>

namespace tribodraw
{
  /// Enclosures of the effective tensors of a cell, mean over the whole map, gaps over the mean gap.
  struct CellBounds
  {
    using Matrix = std::array<std::array<double, 2>, 2>;
    /// K_ij = <k (delta_ij + d_i chi_j)>: conductance, symmetric
    Matrix conductance_lower{}, conductance_upper{};
    /// B_ij = <c (delta_ij + d_j chi_i)>: flux along i that sliding along j causes, seen from the carrying wall
    Matrix carried_lower{}, carried_upper{};
  };

  /// Bounds from primal and dual energies, guaranteed for the gap that is constant in each pixel, with round-off
  /// included.
  ///
  /// For admissible fields (CellTrialFields) U = primal and D = gap, the exact matrix K of the quadratic form
  /// min <k |g + grad u|^2> over all four problems fulfils 0 <= U - K <= D in the sense of quadratic forms: Dirichlet's
  /// principle on the left, Thomson's principle and <q . grad u> = 0 (Prager and Synge 1947) on the right. Hence
  /// K_aa lies in [U_aa - D_aa, U_aa], and K_ab within sqrt(D_aa D_bb)/2 of U_ab - D_ab/2. Pairs of a pressure
  /// and a shear field give -B. Where it is the better one, K_aa >= <q_a . e_a>^2 / <q_a . q_a / k> is used.
  ///
  /// @param longest_sum number of terms of a row plus rows of the map, for the round-off.
  CellBounds bounds_from_energies(const CellEnergies &energies, std::size_t longest_sum);

  class CellFlow;

  /// Bounds of the solutions of one gap. A direction that is blocked has the exact value zero in its rows and columns.
  /// Solutions are handed over one at a time, so that a caller need not keep them.
  class CellBounding
  {
  public:
    /// @param driven_axis as for CellFlow.
    CellBounding(const CellGrid &grid, const CellGap &gap, int driven_axis);
    void add_pressure_flow(int axis, const std::vector<double> &pressure,
                           const std::array<std::vector<double>, 2> &upper_flux);
    void add_shear_flow(int axis, const std::vector<double> &pressure,
                        const std::array<std::vector<double>, 2> &upper_flux);
    /// Write the bounds of all components (periodic), or of the diagonal component of the driven axis, into @p result.
    void finish(FlowFactors &result, double sq_reference);

  private:
    const CellGrid     &grid;
    const CellGap      &gap;
    const int           driven_axis;
    std::array<bool, 2> conducts;
    CellTrialFields     fields;
  };
} // namespace tribodraw

#endif
