#ifndef tribodraw_flow_factors_cell_flow_h
#define tribodraw_flow_factors_cell_flow_h

#include <tribodraw/flow_factors/cell_conductances.h>
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
  /// set up once for all driving directions.
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
    /// Keeps references to @p grid and @p gap.
    /// @param driven_axis axis whose two boundaries have fixed pressures (ignored on a periodic grid).
    /// @param tolerance largest residual and largest difference of the fluxes through sections (multigrid; the direct
    /// solution goes on to round-off).
    CellFlow(const CellGrid &grid, const CellGap &gap, CellDiscretisation discretisation, int driven_axis,
             CellSolverChoice choice = CellSolverChoice::automatic, double tolerance = 1e-10);
    ~CellFlow();
    CellFlow(const CellFlow &)            = delete;
    CellFlow &operator=(const CellFlow &) = delete;

    /// Part of the map over which fluxes are averaged: pixels first <= i < last along each axis.
    struct Window
    {
      std::array<std::size_t, 2> first, last;
    };

    /// What drives the flow: a pressure gradient along an axis, or sliding.
    struct Drive
    {
      int  axis;
      bool shear;
    };

    struct Solution
    {
      double   residual   = 0; ///< divergence of the flux relative to what drives it (Euclidean norms)
      unsigned iterations = 0; ///< of conjugate gradients, or of iterative refinement
      /// Fluctuation of the pressure in each cell, 0 in cells without flow. Its gradient is the deviation from the mean
      /// gradient; lengths in mm. Free up to a constant in each region of a periodic cell.
      std::vector<double> pressure;
      /// Flux per unit of mean gap over the upper face of each cell in positive direction, by axis (periodic: the last
      /// face leads to the first cell; else there is a flux over the edge of the map only along the driven axis).
      std::array<std::vector<double>, 2> upper_flux;
      /// Flux over the lower edge of the map along the driven axis; empty on a periodic grid.
      std::vector<double> inflow;
    };

    /// No open way through the cell in any direction of driving: all fluxes are zero.
    bool
    blocked() const
    {
      return solver == nullptr;
    }
    /// An open way leads through the cell along @p axis. If not, the pressure flow is exactly zero.
    bool
    conducts(const int axis) const
    {
      return conducting[axis];
    }
    Solution pressure_flow(int axis) const;
    Solution shear_flow(int axis) const;
    /// Several flows at once, which costs less than one after the other, but needs the memory for all.
    std::vector<Solution> solve(const std::vector<Drive> &drives) const;

    /// Mean flux along @p axis: pixel values, each the mean of its two faces.
    double mean_flux(const Solution &solution, int axis, const Window &window) const;
    /// Largest difference between the flux through one section across @p axis and the mean of all sections, per area.
    double section_mismatch(const Solution &solution, int axis) const;
    /// The same across the axis of its drive, for a pressure flow relative to the mean flux. Just above percolation the
    /// flux is tiny and its relative error without meaning: below 1e-4 of the smooth flux errors count absolutely.
    double imbalance(const Solution &solution, const Drive &drive) const;
    /// Mean of carried thickness times pressure gradient of a pressure flow: by reciprocity the mean flux along the
    /// driving direction of that pressure flow that sliding along @p axis causes. Independent check of the shear
    /// solution.
    double shear_flux_by_reciprocity(const Solution &pressure_solution, int axis) const;

  private:
    struct Fields;

    const CellGrid             &grid;
    const CellGap              &gap;
    const int                   driven_axis;
    const double                tolerance;
    CellConductances            k; ///< h^3 * width / distance of each face
    std::array<bool, 2>         conducting{};
    std::unique_ptr<CellSolver> solver;

    void                set_conductances(const std::vector<int> &region, CellDiscretisation discretisation);
    void                add_drive(const Drive &drive, int axis, int row, double *flux) const;
    void                evaluate(Fields &fields) const;
    void                solve_group(const Drive *drives, int n, Solution *solutions) const;
    std::vector<double> flux_through_sections(const Solution &solution, int axis) const;
  };
} // namespace tribodraw

#endif
