#ifndef tribodraw_flow_factors_cell_flow_h
#define tribodraw_flow_factors_cell_flow_h

#include <tribodraw/flow_factors/cell_gap.h>
#include <tribodraw/flow_factors/cell_grid.h>
#include <tribodraw/flow_factors/cell_solver.h>
#include <tribodraw/flow_factors/flow_factors.h>

#include <array>
#include <memory>
#include <vector>

namespace tribodraw
{
  /// Pressures and fluxes in one gap: cell-centred finite volumes with a two-point flux over every face (Appendix A),
  /// factorised once for all driving directions.
  ///
  /// Everything is dimensionless: gaps over the mean gap, pressure such that the mean gradient is one per length. Two
  /// problems are solved for the fluctuation p of the pressure:
  ///  - pressure: div(h^3 (e + grad p)) = 0, flux -h^3 (e + grad p): minus the pressure factor in the mean;
  ///  - shear: div(h^3 grad p) = dc/de, flux c e - h^3 grad p, seen from the carrying wall (Eqs. 11, 12 in flux form).
  /// A face at a contact pixel has no flux of either kind: the contact stands still for that observer. In the
  /// limit of zero film in the contacts this is what the paper does with its 0.5 nm film.
  class CellFlow
  {
  public:
    /// @param driven_axis axis whose two boundaries have fixed pressures (ignored on a periodic grid).
    CellFlow(const CellGrid &grid, const CellGap &gap, CellDiscretisation discretisation, int driven_axis,
             CellSolverChoice choice = CellSolverChoice::automatic);
    ~CellFlow();
    CellFlow(const CellFlow &)            = delete;
    CellFlow &operator=(const CellFlow &) = delete;

    /// Part of the map over which fluxes are averaged: pixels first <= i < last along each axis.
    struct Window
    {
      std::array<std::size_t, 2> first, last;
    };

    struct Solution
    {
      std::vector<double> flux;       ///< over each face, in positive direction of its axis, per unit of mean gap
      double              residual;   ///< divergence of the flux relative to what drives it (Euclidean norms)
      unsigned            iterations; ///< of conjugate gradients, or of iterative refinement
      /// Fluctuation of the pressure in each cell, 0 in cells without flow. Its gradient is the deviation from the mean
      /// gradient; lengths in mm. Free up to a constant in each region of a periodic cell.
      std::vector<double> pressure;
      /// The same fluxes by cell: over the upper face of each cell, by axis (periodic: the last face leads to the first
      /// cell; else there is a flux over the edge of the map only along the driven axis).
      std::array<std::vector<double>, 2> upper_flux;
    };

    /// No open way through the cell in any direction of driving: all fluxes are zero.
    bool
    blocked() const
    {
      return links.empty();
    }
    /// An open way leads through the cell along @p axis. If not, the pressure flow is exactly zero.
    bool
    conducts(const int axis) const
    {
      return conducting[axis];
    }
    Solution pressure_flow(int axis) const;
    Solution shear_flow(int axis) const;

    /// Mean flux along @p axis: pixel values, each the mean of its two faces.
    double mean_flux(const Solution &solution, int axis, const Window &window) const;
    /// Largest difference between the flux through one section across @p axis and the mean of all sections, per area.
    double section_mismatch(const Solution &solution, int axis) const;
    /// Mean of carried thickness times pressure gradient of a pressure flow: by reciprocity the mean flux along the
    /// driving direction of that pressure flow that sliding along @p axis causes. Independent check of the shear
    /// solution.
    double shear_flux_by_reciprocity(const Solution &pressure_solution, int axis) const;

  private:
    /// Face between two conducting pixels, or between one and the fixed pressure outside (cell number grid.size()).
    struct Link
    {
      int    lower, upper;
      int    axis;
      double conductance; ///< h^3 * width / distance
      double distance;    ///< between the two pressures [mm]
      double carried;     ///< c * width [mm]
    };

    const CellGrid             &grid;
    std::vector<Link>           links;
    std::vector<int>            unknown; // per cell, -1: none; last for the outside
    std::size_t                 n_unknowns = 0;
    std::array<bool, 2>         conducting{};
    std::unique_ptr<CellSolver> solver;

    void                add_links(const CellGap &gap, const std::vector<int> &region, CellDiscretisation discretisation,
                                  int driven_axis);
    CellSolver::System  number_unknowns(const std::vector<int> &region);
    std::vector<double> drive(int axis, bool shear) const;
    Solution            solve(const std::vector<double> &drive) const;
  };
} // namespace tribodraw

#endif
