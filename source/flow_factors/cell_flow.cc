#include "row_kernels.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/flow_factors/cell_flow.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    double
    cube(const double x)
    {
      return x * x * x;
    }

    // Mean of h^3 on a face; both gaps positive.
    double
    face_conductivity(const double h1, const double h2, const CellDiscretisation discretisation)
    {
      if (discretisation == CellDiscretisation::mean_gap)
        return cube(0.5 * (h1 + h2));
      return 2 / (1 / cube(h1) + 1 / cube(h2));
    }

    CellLayout
    layout_of(const CellGrid &grid)
    {
      return { static_cast<int>(grid.nx), static_cast<int>(grid.ny), grid.periodic };
    }

    void
    close_row(double *x, const CellLayout &layout)
    {
      x[-1]        = layout.periodic ? x[layout.nx - 1] : 0.;
      x[layout.nx] = layout.periodic ? x[0] : 0.;
    }
  } // namespace

  CellFlow::CellFlow(const CellGrid &grid_in, const CellGap &gap_in, const CellDiscretisation discretisation,
                     const int driven_axis_in, const CellSolverChoice choice, const double tolerance_in)
      : grid(grid_in), gap(gap_in), driven_axis(driven_axis_in), tolerance(tolerance_in), k(layout_of(grid_in))
  {
    std::vector<int> floating;
    {
      const CellConnectivity connectivity(grid, gap);
      const std::vector<int> region = connectivity.conducting_regions(driven_axis);
      for (const int axis : { 0, 1 })
        conducting[axis] = connectivity.conducts(axis);
      set_conductances(region, discretisation);
      // Regions are numbered in the order of their first pixels. On a periodic grid their pressures are free.
      int n_regions = 0;
      for (std::size_t i = 0; i < region.size(); ++i)
        if (region[i] == n_regions)
          {
            ++n_regions;
            if (grid.periodic)
              floating.push_back(static_cast<int>(i));
          }
      if (n_regions == 0)
        return;
    }
    solver = std::make_unique<CellSolver>(k, std::move(floating), choice);
  }

  CellFlow::~CellFlow() = default;

  void
  CellFlow::set_conductances(const std::vector<int> &region, const CellDiscretisation discretisation)
  {
    const int    nx = k.layout.nx, ny = k.layout.ny;
    const double over_mean = 1 / gap.mean_gap, along_x = grid.dy / grid.dx, along_y = grid.dx / grid.dy;
    const auto   face = [&](const std::size_t a, const std::size_t b, const double shape) {
      return region[a] >= 0 && region[b] >= 0
                   ? shape * face_conductivity(gap.gap[a] * over_mean, gap.gap[b] * over_mean, discretisation)
                   : 0.;
    };
    // The pressure is given on the edge of the map, half a pixel from the first pixel's centre.
    const auto end_face = [&](const std::size_t a, const int axis, const double shape) {
      return axis == driven_axis && region[a] >= 0 ? 2 * shape * cube(gap.gap[a] * over_mean) : 0.;
    };
    for (int iy = 0; iy < ny; ++iy)
      {
        const std::size_t first = static_cast<std::size_t>(iy) * grid.nx, last = first + grid.nx - 1;
        double           *x = k.x_row(iy), *y = k.y_row(iy);
        for (int ix = 1; ix < nx; ++ix)
          x[ix] = face(first + ix - 1, first + ix, along_x);
        x[0]  = grid.periodic ? face(last, first, along_x) : end_face(first, 0, along_x);
        x[nx] = grid.periodic ? x[0] : end_face(last, 0, along_x);
        for (int ix = 0; ix < nx; ++ix)
          {
            const std::size_t here = first + ix, below = here + (iy > 0 ? 0 : grid.size()) - grid.nx;
            y[ix] = iy > 0 || grid.periodic ? face(below, here, along_y) : end_face(here, 1, along_y);
          }
      }
    for (int ix = 0; ix < nx; ++ix)
      k.y_row(ny)[ix] = grid.periodic ? k.y_row(0)[ix] : end_face(grid.size() - grid.nx + ix, 1, along_y);
  }

  // Add what flows at zero pressure fluctuation over the faces of row @p row: those below its pixels in y, or all of
  // the row in x.
  void
  CellFlow::add_drive(const Drive &drive, const int axis, const int row, double *flux) const
  {
    if (axis != drive.axis)
      return;
    const int     nx = k.layout.nx, ny = k.layout.ny, n_faces = axis == 0 ? nx + 1 : nx;
    const double *conductance = axis == 0 ? k.x_row(row) : k.y_row(row);
    const double  distance = grid.spacing(axis), carried = 0.5 * grid.spacing(1 - axis) / gap.mean_gap;
    const bool    at_end = !grid.periodic && axis == 1 && (row == 0 || row == ny);
    const double  part   = at_end ? 0.5 : 1; // of the distance between two pixels
    if (!drive.shear)
      {
        for (int i = 0; i < n_faces; ++i)
          flux[i] -= conductance[i] * (part * distance);
        if (!grid.periodic && axis == 0)
          for (const int i : { 0, nx })
            flux[i] += conductance[i] * (0.5 * distance);
        return;
      }
    const auto c = [&](const int ix, const int iy) { return gap.carried[static_cast<std::size_t>(iy) * grid.nx + ix]; };
    const auto add = [&](const int i, const double sum) {
      if (conductance[i] > 0)
        flux[i] += carried * sum;
    };
    if (axis == 0)
      {
        for (int i = 1; i < nx; ++i)
          add(i, c(i - 1, row) + c(i, row));
        add(0, c(grid.periodic ? nx - 1 : 0, row) + c(0, row));
        add(nx, c(nx - 1, row) + c(grid.periodic ? 0 : nx - 1, row));
      }
    else
      {
        const int below = row > 0 ? row - 1 : grid.periodic ? ny - 1 : 0;
        const int above = row < ny ? row : grid.periodic ? 0 : ny - 1;
        for (int i = 0; i < nx; ++i)
          add(i, c(i, below) + c(i, above));
      }
  }

  // Pressures of several flows and what follows from them. The correction is kept apart from the first solution:
  // behind a narrow neck the pressure is a large constant plus small differences, and a single number could not hold
  // both. The differences of the first solution are exact, those of the correction need no more digits.
  struct CellFlow::Fields
  {
    int                                     n;
    const Drive                            *drives;
    AlignedArray<double>                    pressure, correction; // empty: zero
    AlignedArray<double>                    excess;               // what flows into each pixel more than out of it
    Solution                               *solutions;
    std::array<double, CellSolver::max_rhs> drive_norm{};
  };

  // Excess and its norm relative to that of the drive; the fluxes themselves once there is a pressure.
  void
  CellFlow::evaluate(Fields &fields) const
  {
    const CellLayout          &l = k.layout;
    const int                  n = fields.n, nx = l.nx, ny = l.ny;
    const AlignedArray<double> zero(l.stride(), 0.);
    std::vector<double>        x_flux(nx + 1), below_flux(nx), above_flux(nx);
    const bool                 keep = !fields.pressure.empty();
    for (AlignedArray<double> *values : { &fields.pressure, &fields.correction })
      for (int iy = 0; iy < ny && !values->empty(); ++iy)
        for (int r = 0; r < n; ++r)
          close_row(&(*values)[l.row(n, iy, r)], l);
    for (int r = 0; r < n; ++r)
      {
        Solution &solution = fields.solutions[r];
        double    square = 0, drive_square = 0;
        if (keep)
          for (std::vector<double> &flux : solution.upper_flux)
            flux.resize(grid.size());
        const auto row = [&](const AlignedArray<double> &values, const int iy) {
          const int w = CellLayout::wrapped(iy, ny, l.periodic);
          return w < 0 || values.empty() ? &zero[CellLayout::margin] : &values[l.row(n, w, r)];
        };
        const auto y_flux = [&](const int iy, std::vector<double> &flux) {
          std::fill(flux.begin(), flux.end(), 0.);
          add_drive(fields.drives[r], 1, iy, flux.data());
          const double *p0 = row(fields.pressure, iy - 1), *p1 = row(fields.pressure, iy),
                       *c0 = row(fields.correction, iy - 1), *c1 = row(fields.correction, iy), *y = k.y_row(iy);
          const double driven = row_kernels::add_flux(nx, flux.data(), y, p0, p1, c0, c1);
          if (iy < ny || !grid.periodic)
            drive_square += driven;
        };
        y_flux(0, below_flux);
        if (!grid.periodic && driven_axis == 1)
          solution.inflow = below_flux;
        for (int iy = 0; iy < ny; ++iy)
          {
            y_flux(iy + 1, above_flux);
            std::fill(x_flux.begin(), x_flux.end(), 0.);
            add_drive(fields.drives[r], 0, iy, x_flux.data());
            const double  at_end = x_flux[nx]; // on a periodic map the first face once more
            const double *p = row(fields.pressure, iy), *c = row(fields.correction, iy), *x = k.x_row(iy);
            drive_square += row_kernels::add_flux(nx + 1, x_flux.data(), x, p - 1, p, c - 1, c)
                            - (grid.periodic ? at_end * at_end : 0.);
            if (!grid.periodic && driven_axis == 0)
              solution.inflow[iy] = x_flux[0];
            const std::size_t first = static_cast<std::size_t>(iy) * nx;
            square += row_kernels::excess(nx, &fields.excess[l.row(n, iy, r)], x_flux.data(), below_flux.data(),
                                          above_flux.data());
            if (keep)
              {
                std::copy(x_flux.begin() + 1, x_flux.end(), &solution.upper_flux[0][first]);
                std::copy(above_flux.begin(), above_flux.end(), &solution.upper_flux[1][first]);
              }
            std::swap(below_flux, above_flux);
          }
        fields.drive_norm[r] = std::sqrt(drive_square);
        solution.residual    = drive_square > 0 ? std::sqrt(square / drive_square) : 0.;
      }
  }

  double
  CellFlow::imbalance(const Solution &solution, const Drive &drive) const
  {
    constexpr double tiny = 1e-4;
    const Window     all{ { { 0, 0 } }, { { grid.nx, grid.ny } } };
    const double     scale = drive.shear ? 1. : std::max(tiny, std::abs(mean_flux(solution, drive.axis, all)));
    return section_mismatch(solution, drive.axis) / scale;
  }

  void
  CellFlow::solve_group(const Drive *drives, const int n, Solution *solutions) const
  {
    const CellLayout &l = k.layout;
    Fields            fields{ n, drives, {}, {}, AlignedArray<double>(l.size(n)), solutions, {} };
    for (int r = 0; r < n && !grid.periodic; ++r)
      solutions[r].inflow.assign(grid.n(1 - driven_axis), 0.);
    evaluate(fields);
    // The residual hardly shows the error behind a narrow neck. With factors two corrections are made in any case: they
    // are good to 5 digits at least (the least film is 3e-4 of the roughness), each gains as many.
    constexpr unsigned max_passes = 5;
    const bool         direct     = solver->is_direct();
    // 1e-14: just above rounding. The balance of fluxes is some times worse than the residual, and one more iteration
    // costs less than another pass.
    constexpr double part = 0.15;
    double           goal = direct ? 1e-14 : part * tolerance;
    for (unsigned pass = 1; pass <= max_passes; ++pass)
      {
        std::array<double, CellSolver::max_rhs> goals{};
        for (int r = 0; r < n; ++r)
          goals[r] = goal * fields.drive_norm[r];
        AlignedArray<double> &target = pass == 1 ? fields.pressure : fields.correction;
        target.resize(l.size(n), 0.);
        const unsigned iterations = solver->solve(n, fields.excess, target, goals);
        evaluate(fields);
        bool done = !direct || pass > 2;
        for (int r = 0; r < n; ++r)
          {
            solutions[r].iterations += iterations > 0 ? iterations : pass > 1;
            done = done && solutions[r].residual <= (direct ? goal : tolerance)
                   && (direct || imbalance(solutions[r], drives[r]) <= tolerance);
          }
        if (done)
          break;
        if (!direct)
          goal *= 0.01;
      }
    for (int r = 0; r < n; ++r)
      {
        std::vector<double> &p = solutions[r].pressure;
        p.resize(grid.size());
        for (int iy = 0; iy < l.ny; ++iy)
          for (int ix = 0; ix < l.nx; ++ix)
            {
              const std::size_t i = l.row(n, iy, r) + ix;
              p[static_cast<std::size_t>(iy) * l.nx + ix]
                  = fields.pressure[i] + (fields.correction.empty() ? 0. : fields.correction[i]);
            }
      }
  }

  std::vector<CellFlow::Solution>
  CellFlow::solve(const std::vector<Drive> &drives) const
  {
    std::vector<Solution>    result(drives.size());
    std::vector<Drive>       todo;
    std::vector<std::size_t> place;
    for (std::size_t i = 0; i < drives.size(); ++i)
      if (!blocked() && (drives[i].shear || conducts(drives[i].axis)))
        {
          todo.push_back(drives[i]);
          place.push_back(i);
        }
      else
        {
          result[i].pressure.assign(grid.size(), 0.);
          result[i].upper_flux.fill(result[i].pressure);
          if (!grid.periodic)
            result[i].inflow.assign(grid.n(1 - driven_axis), 0.);
        }
    for (std::size_t first = 0; first < todo.size();)
      {
        const std::size_t                         left = todo.size() - first, n = left >= 4 ? 4 : left >= 2 ? 2 : 1;
        std::array<Solution, CellSolver::max_rhs> group;
        solve_group(&todo[first], static_cast<int>(n), group.data());
        for (std::size_t r = 0; r < n; ++r)
          result[place[first + r]] = std::move(group[r]);
        first += n;
      }
    return result;
  }

  CellFlow::Solution
  CellFlow::pressure_flow(const int axis) const
  {
    return std::move(solve({ { axis, false } })[0]);
  }

  CellFlow::Solution
  CellFlow::shear_flow(const int axis) const
  {
    return std::move(solve({ { axis, true } })[0]);
  }

  // Each pixel's value is the mean of its lower and its upper face.
  double
  CellFlow::mean_flux(const Solution &solution, const int axis, const Window &window) const
  {
    const std::vector<double> &upper = solution.upper_flux[axis];
    const std::size_t          nx = grid.nx, step = axis == 0 ? 1 : nx;
    const std::size_t          over_the_end = axis == 0 ? nx : grid.size();
    double                     sum          = 0;
    for (std::size_t iy = window.first[1]; iy < window.last[1]; ++iy)
      for (std::size_t ix = window.first[0]; ix < window.last[0]; ++ix)
        {
          const std::size_t cell = iy * nx + ix, i = axis == 0 ? ix : iy;
          double            lower = 0;
          if (i > 0)
            lower = upper[cell - step];
          else if (grid.periodic)
            lower = upper[cell + over_the_end - step];
          else if (axis == driven_axis)
            lower = solution.inflow[axis == 0 ? iy : ix];
          sum += lower + upper[cell];
        }
    const double n_pixels
        = static_cast<double>(window.last[0] - window.first[0]) * static_cast<double>(window.last[1] - window.first[1]);
    return 0.5 * sum / (n_pixels * grid.spacing(1 - axis));
  }

  std::vector<double>
  CellFlow::flux_through_sections(const Solution &solution, const int axis) const
  {
    std::vector<double> through;
    if (!grid.periodic) // a periodic grid has no section before its first pixel
      through.push_back(axis == driven_axis ? std::accumulate(solution.inflow.begin(), solution.inflow.end(), 0.) : 0.);
    const std::size_t offset = through.size();
    through.resize(offset + grid.n(axis), 0.);
    for (std::size_t iy = 0; iy < grid.ny; ++iy)
      for (std::size_t ix = 0; ix < grid.nx; ++ix)
        through[offset + (axis == 0 ? ix : iy)] += solution.upper_flux[axis][iy * grid.nx + ix];
    return through;
  }

  double
  CellFlow::section_mismatch(const Solution &solution, const int axis) const
  {
    const std::vector<double> through = flux_through_sections(solution, axis);
    const double mean  = std::accumulate(through.begin(), through.end(), 0.) / static_cast<double>(through.size());
    double       worst = 0;
    for (const double q : through)
      worst = std::max(worst, std::abs(q - mean));
    return worst / (static_cast<double>(grid.n(1 - axis)) * grid.spacing(1 - axis));
  }

  double
  CellFlow::shear_flux_by_reciprocity(const Solution &solution, const int axis) const
  {
    const int nx = k.layout.nx, ny = k.layout.ny, n_lines = axis == 0 ? ny : ny + 1;
    double    sum = 0;
    for (int iy = grid.periodic ? (axis == 0 ? 0 : 1) : 0; iy < n_lines; ++iy)
      {
        std::vector<double> carried(nx + 1, 0.);
        add_drive({ axis, true }, axis, iy, carried.data());
        const double *conductance = axis == 0 ? k.x_row(iy) : k.y_row(iy);
        const int     first = axis == 0 && grid.periodic ? 1 : 0, last = axis == 0 ? nx : nx - 1;
        for (int i = first; i <= last; ++i)
          if (conductance[i] > 0)
            {
              const bool   at_edge = axis == 0 ? i == 0 : iy == 0;
              const double flux    = at_edge     ? solution.inflow[axis == 0 ? iy : i]
                                     : axis == 0 ? solution.upper_flux[0][static_cast<std::size_t>(iy) * nx + i - 1]
                                                 : solution.upper_flux[1][static_cast<std::size_t>(iy - 1) * nx + i];
              sum -= carried[i] * flux / conductance[i];
            }
      }
    return sum / grid.area();
  }
} // namespace tribodraw
