#include <tribodraw/base/errors.h>
#include <tribodraw/flow_factors/cell_flow.h>

#include <algorithm>
#include <cmath>

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

    bool
    inside(const CellFlow::Window &window, const CellGrid &grid, const int cell)
    {
      for (int axis = 0; axis < 2; ++axis)
        {
          const std::size_t i = grid.coordinate(cell, axis);
          if (i < window.first[axis] || i >= window.last[axis])
            return false;
        }
      return true;
    }

    double
    norm(const std::vector<double> &values)
    {
      double sum = 0;
      for (const double v : values)
        sum += v * v;
      return std::sqrt(sum);
    }
  } // namespace

  CellFlow::CellFlow(const CellGrid &grid_in, const CellGap &gap, const CellDiscretisation discretisation,
                     const int driven_axis, const CellSolverChoice choice)
      : grid(grid_in)
  {
    const CellConnectivity connectivity(grid, gap);
    const std::vector<int> region = connectivity.conducting_regions(driven_axis);
    for (const int axis : { 0, 1 })
      conducting[axis] = connectivity.conducts(axis);
    add_links(gap, region, discretisation, driven_axis);
    if (!blocked())
      solver = std::make_unique<CellSolver>(number_unknowns(region), choice);
  }

  CellFlow::~CellFlow() = default;

  void
  CellFlow::add_links(const CellGap &gap, const std::vector<int> &region, const CellDiscretisation discretisation,
                      const int driven_axis)
  {
    const int outside = static_cast<int>(grid.size());
    for (int axis = 0; axis < 2; ++axis)
      {
        const double distance = grid.spacing(axis), width = grid.spacing(1 - axis);
        for (const auto &[a, b] : grid.faces[axis])
          if (region[a] >= 0 && region[b] >= 0)
            {
              const double k = face_conductivity(gap.gap[a] / gap.mean_gap, gap.gap[b] / gap.mean_gap, discretisation);
              const double c = 0.5 * (gap.carried[a] + gap.carried[b]) / gap.mean_gap;
              links.push_back({ a, b, axis, k * width / distance, distance, c * width });
            }
        if (grid.periodic || axis != driven_axis)
          continue;
        // The pressure is given on the edge of the map, half a pixel from the first pixel's centre.
        const auto boundary_link = [&](const int a, const int b, const int cell) {
          const double h = gap.gap[cell] / gap.mean_gap, c = gap.carried[cell] / gap.mean_gap;
          links.push_back({ a, b, axis, cube(h) * width / (distance / 2), distance / 2, c * width });
        };
        for (const int cell : grid.lower_boundary[axis])
          if (region[cell] >= 0)
            boundary_link(outside, cell, cell);
        for (const int cell : grid.upper_boundary[axis])
          if (region[cell] >= 0)
            boundary_link(cell, outside, cell);
      }
  }

  // Each conducting pixel is an unknown. On a periodic grid the pressure of a region is free up to a constant.
  CellSolver::System
  CellFlow::number_unknowns(const std::vector<int> &region)
  {
    CellSolver::System system;
    system.layout.nx       = static_cast<int>(grid.nx);
    system.layout.ny       = static_cast<int>(grid.ny);
    system.layout.periodic = grid.periodic;
    unknown.assign(grid.size() + 1, -1);
    int next = 0, n_floating = 0;
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (region[i] >= 0)
        {
          // regions are numbered in the order of their first pixels
          if (grid.periodic && region[i] == n_floating)
            {
              system.floating.push_back(next);
              ++n_floating;
            }
          system.layout.x.push_back(static_cast<int>(grid.coordinate(static_cast<int>(i), 0)));
          system.layout.y.push_back(static_cast<int>(grid.coordinate(static_cast<int>(i), 1)));
          unknown[i] = next++;
        }
    n_unknowns = system.size();
    system.couplings.reserve(links.size());
    for (const Link &link : links)
      {
        const int a = unknown[link.lower], b = unknown[link.upper];
        system.couplings.push_back({ std::max(a, b), std::min(a, b), link.conductance });
      }
    return system;
  }

  // What flows over each face at zero pressure fluctuation.
  std::vector<double>
  CellFlow::drive(const int axis, const bool shear) const
  {
    std::vector<double> result(links.size(), 0.);
    for (std::size_t l = 0; l < links.size(); ++l)
      if (links[l].axis == axis)
        result[l] = shear ? links[l].carried : -links[l].conductance * links[l].distance;
    return result;
  }

  // Solution with iterative refinement. The correction is kept apart from the first solution: behind a narrow neck the
  // pressure is a large constant plus small differences, and a single number could not hold both. The differences
  // of the first solution are exact, those of the correction need no more digits.
  CellFlow::Solution
  CellFlow::solve(const std::vector<double> &drive) const
  {
    // The residual hardly shows the error behind a narrow neck, therefore two steps are always made: the factors are
    // good to 5 digits at least (the least film is 3e-4 of the roughness), each step gains as many. Multigrid is used
    // where the film is thick, and stops by the energy of the error.
    const unsigned      min_refinements = solver->is_direct() ? 2 : 1;
    constexpr unsigned  max_refinements = 4;
    constexpr double    target          = 1e-14; // of the residual, just above rounding
    Solution            result{ drive, 0., 0, {}, {} };
    std::vector<double> pressure(unknown.size(), 0.), correction(unknown.size(), 0.), excess(unknown.size());
    const double        scale = norm(drive);

    const auto by_cell = [&]() {
      result.pressure.assign(grid.size(), 0.);
      for (std::size_t i = 0; i < grid.size(); ++i)
        result.pressure[i] = pressure[i] + correction[i];
      for (std::vector<double> &flux : result.upper_flux)
        flux.assign(grid.size(), 0.);
      for (std::size_t l = 0; l < links.size(); ++l)
        if (links[l].lower < static_cast<int>(grid.size()))
          result.upper_flux[links[l].axis][links[l].lower] = result.flux[l];
    };
    if (!(scale > 0))
      {
        by_cell();
        return result;
      }

    const auto update_flux = [&]() {
      std::fill(excess.begin(), excess.end(), 0.);
      for (std::size_t l = 0; l < links.size(); ++l)
        {
          const Link  &link = links[l];
          const double fall
              = (pressure[link.lower] - pressure[link.upper]) + (correction[link.lower] - correction[link.upper]);
          result.flux[l] = link.conductance * fall + drive[l];
          excess[link.lower] -= result.flux[l];
          excess[link.upper] += result.flux[l];
        }
      excess.back()   = 0; // the outside takes everything
      result.residual = norm(excess) / scale;
    };
    const auto add_solution = [&](std::vector<double> &to) {
      std::size_t     i = 0;
      Eigen::VectorXd rhs(static_cast<Eigen::Index>(n_unknowns));
      for (std::size_t cell = 0; cell < grid.size(); ++cell)
        if (unknown[cell] >= 0)
          rhs[static_cast<Eigen::Index>(i++)] = excess[cell];
      const Eigen::VectorXd x = solver->solve(rhs, result.iterations);
      for (std::size_t cell = 0; cell < grid.size(); ++cell)
        if (unknown[cell] >= 0)
          to[cell] += x[unknown[cell]];
    };

    update_flux();
    add_solution(pressure);
    update_flux();
    for (unsigned step = 0; step < max_refinements && (step < min_refinements || result.residual > target); ++step)
      {
        add_solution(correction);
        update_flux();
        if (solver->is_direct())
          ++result.iterations;
      }
    by_cell();
    return result;
  }

  CellFlow::Solution
  CellFlow::pressure_flow(const int axis) const
  {
    if (conducts(axis))
      return solve(drive(axis, false));
    const std::vector<double> zero(grid.size(), 0.);
    return Solution{ std::vector<double>(links.size(), 0.), 0., 0, zero, { { zero, zero } } };
  }

  CellFlow::Solution
  CellFlow::shear_flow(const int axis) const
  {
    return solve(drive(axis, true));
  }

  double
  CellFlow::mean_flux(const Solution &solution, const int axis, const Window &window) const
  {
    const int outside = static_cast<int>(grid.size());
    double    sum     = 0;
    for (std::size_t l = 0; l < links.size(); ++l)
      if (links[l].axis == axis)
        {
          const int lower = links[l].lower, upper = links[l].upper;
          const int pixels
              = (lower != outside && inside(window, grid, lower)) + (upper != outside && inside(window, grid, upper));
          sum += 0.5 * pixels * solution.flux[l] * grid.spacing(axis);
        }
    const double width = static_cast<double>(window.last[0] - window.first[0]) * grid.dx;
    const double depth = static_cast<double>(window.last[1] - window.first[1]) * grid.dy;
    return sum / (width * depth);
  }

  double
  CellFlow::section_mismatch(const Solution &solution, const int axis) const
  {
    const int           outside = static_cast<int>(grid.size());
    std::vector<double> through(grid.n(axis) + 1, 0.);
    for (std::size_t l = 0; l < links.size(); ++l)
      if (links[l].axis == axis)
        through[links[l].lower == outside ? 0 : grid.coordinate(links[l].lower, axis) + 1] += solution.flux[l];
    const auto first
        = through.begin() + (grid.periodic ? 1 : 0); // a periodic grid has no section before its first pixel
    double mean = 0;
    for (auto q = first; q != through.end(); ++q)
      mean += *q / static_cast<double>(through.end() - first);
    double worst = 0;
    for (auto q = first; q != through.end(); ++q)
      worst = std::max(worst, std::abs(*q - mean));
    return worst / (static_cast<double>(grid.n(1 - axis)) * grid.spacing(1 - axis));
  }

  double
  CellFlow::shear_flux_by_reciprocity(const Solution &pressure_solution, const int axis) const
  {
    double sum = 0;
    for (std::size_t l = 0; l < links.size(); ++l)
      if (links[l].axis == axis)
        sum -= links[l].carried * pressure_solution.flux[l] / links[l].conductance;
    return sum / grid.area();
  }
} // namespace tribodraw
