#include <tribodraw/base/errors.h>
#include <tribodraw/flow_factors/cell_flow.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  struct CellFlow::Factors
  {
    using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower> ldlt;
  };

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
                     const int driven_axis)
      : grid(grid_in), factors(std::make_unique<Factors>())
  {
    const CellConnectivity connectivity(grid, gap);
    const std::vector<int> region = connectivity.conducting_regions(driven_axis);
    for (const int axis : { 0, 1 })
      conducting[axis] = connectivity.conducts(axis);
    add_links(gap, region, discretisation, driven_axis);
    number_unknowns(region);
    if (n_free > 0)
      factorise();
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

  // On a periodic grid the pressure of each region is defined up to a constant: its first pixel is set to zero.
  void
  CellFlow::number_unknowns(const std::vector<int> &region)
  {
    unknown.assign(grid.size() + 1, -1);
    int next = 0, n_pinned = 0;
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (region[i] >= 0)
        {
          // regions are numbered in the order of their first pixels
          if (grid.periodic && region[i] == n_pinned)
            ++n_pinned;
          else
            unknown[i] = next++;
        }
    n_free = static_cast<std::size_t>(next);
  }

  void
  CellFlow::factorise()
  {
    std::vector<double>                 diagonal(n_free, 0.);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(links.size() + n_free);
    for (const Link &link : links)
      {
        const int a = unknown[link.lower], b = unknown[link.upper];
        if (a >= 0)
          diagonal[a] += link.conductance;
        if (b >= 0)
          diagonal[b] += link.conductance;
        if (a >= 0 && b >= 0)
          entries.emplace_back(std::max(a, b), std::min(a, b), -link.conductance);
      }
    for (std::size_t i = 0; i < n_free; ++i)
      entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
    const auto      n = static_cast<Eigen::Index>(n_free);
    Factors::Matrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factors->ldlt.compute(matrix);
    if (factors->ldlt.info() != Eigen::Success)
      throw ConvergenceError(
          describe_error("The matrix of a local Reynolds cell could not be factorised", "flow factors",
                         std::to_string(n_free) + " open pixels", "",
                         "Raise 'Closed gap' so that channels of vanishing height count as closed."));
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

  // Direct solution with iterative refinement. The correction is kept apart from the first solution: behind a narrow
  // neck the pressure is a large constant plus small differences, and a single number could not hold both. The
  // differences of the first solution are exact, those of the correction need no more digits.
  CellFlow::Solution
  CellFlow::solve(const std::vector<double> &drive) const
  {
    // The residual hardly shows the error behind a narrow neck, therefore two steps are always made: the factors are
    // good to 5 digits at least (the least film is 3e-4 of the roughness), each step gains as many.
    constexpr unsigned  min_refinements = 2, max_refinements = 4;
    constexpr double    target = 1e-14; // of the residual, just above rounding
    Solution            result{ drive, 0., 0 };
    std::vector<double> pressure(unknown.size(), 0.), correction(unknown.size(), 0.), excess(unknown.size());
    const double        scale = norm(drive);
    if (!(scale > 0))
      return result;

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
      Eigen::VectorXd rhs(static_cast<Eigen::Index>(n_free));
      for (std::size_t i = 0; i < unknown.size(); ++i)
        if (unknown[i] >= 0)
          rhs[unknown[i]] = excess[i];
      rhs = factors->ldlt.solve(rhs).eval();
      for (std::size_t i = 0; i < unknown.size(); ++i)
        if (unknown[i] >= 0)
          to[i] += rhs[unknown[i]];
    };

    update_flux();
    if (n_free > 0)
      add_solution(pressure);
    update_flux();
    while (
        n_free > 0
        && (result.refinements < min_refinements || (result.residual > target && result.refinements < max_refinements)))
      {
        add_solution(correction);
        update_flux();
        ++result.refinements;
      }
    return result;
  }

  CellFlow::Solution
  CellFlow::pressure_flow(const int axis) const
  {
    if (conducts(axis))
      return solve(drive(axis, false));
    return Solution{ std::vector<double>(links.size(), 0.), 0., 0 };
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
