#include <tribodraw/base/errors.h>
#include <tribodraw/flow_factors/cell_multigrid.h>
#include <tribodraw/flow_factors/cell_solver.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>

namespace tribodraw
{
  // Unknowns are the pixels with an open face, in the order of the pixels.
  struct CellSolver::Factors
  {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double, Eigen::ColMajor, int>, Eigen::Lower> ldlt;
    std::vector<int>                                                                       unknown; // -1: none
    Eigen::Index                                                                           n_unknowns = 0;
  };

  CellSolver::CellSolver(const CellConductances &conductances, std::vector<int> floating_in,
                         const CellSolverChoice choice)
      : k(conductances), floating(std::move(floating_in))
  {
    // Measured on random surfaces: below some 100 x 100 pixels the factorisation is as fast, and exact.
    constexpr double  min_pixels = 10000;
    const CellLayout &layout     = k.layout;
    const bool        possible   = std::min(layout.nx, layout.ny) >= CellMultigrid::min_width;
    const bool        pays       = static_cast<double>(layout.nx) * layout.ny >= min_pixels;
    if (possible && (choice == CellSolverChoice::multigrid || (choice == CellSolverChoice::automatic && pays)))
      multigrid = std::make_unique<CellMultigrid>(k);
    else
      factorise();
  }

  CellSolver::~CellSolver() = default;

  void
  CellSolver::factorise()
  {
    factors                  = std::make_unique<Factors>();
    const CellLayout   &l    = k.layout;
    const auto          cell = [&l](const int ix, const int iy) { return static_cast<std::size_t>(iy) * l.nx + ix; };
    std::vector<double> diagonal;
    factors->unknown.assign(cell(0, l.ny), -1);
    for (int iy = 0; iy < l.ny; ++iy)
      for (int ix = 0; ix < l.nx; ++ix)
        {
          const double sum = (k.x_row(iy)[ix] + k.x_row(iy)[ix + 1]) + (k.y_row(iy)[ix] + k.y_row(iy + 1)[ix]);
          if (sum > 0)
            {
              factors->unknown[cell(ix, iy)] = static_cast<int>(diagonal.size());
              diagonal.push_back(sum);
            }
        }
    // Doubling a diagonal entry of a consistent singular system sets that unknown to zero.
    for (const int pixel : floating)
      diagonal[static_cast<std::size_t>(factors->unknown[pixel])] *= 2;

    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(3 * diagonal.size());
    const auto couple = [&](const int ix, const int iy, const int jx, const int jy, const double c) {
      if (c > 0 && jx >= 0 && jy >= 0)
        {
          const auto [low, high] = std::minmax(factors->unknown[cell(ix, iy)], factors->unknown[cell(jx, jy)]);
          entries.emplace_back(high, low, -c);
        }
    };
    for (int iy = 0; iy < l.ny; ++iy)
      for (int ix = 0; ix < l.nx; ++ix)
        {
          couple(ix, iy, CellLayout::wrapped(ix - 1, l.nx, l.periodic), iy, k.x_row(iy)[ix]);
          couple(ix, iy, ix, CellLayout::wrapped(iy - 1, l.ny, l.periodic), k.y_row(iy)[ix]);
        }
    for (std::size_t i = 0; i < diagonal.size(); ++i)
      entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal[i]);

    factors->n_unknowns = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SparseMatrix<double, Eigen::ColMajor, int> matrix(factors->n_unknowns, factors->n_unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factors->ldlt.compute(matrix);
    if (factors->ldlt.info() != Eigen::Success)
      throw ConvergenceError(
          describe_error("The matrix of a local Reynolds cell could not be factorised", "flow factors",
                         std::to_string(factors->n_unknowns) + " open pixels", "",
                         "Raise 'Closed gap' so that channels of vanishing height count as closed."));
  }

  unsigned
  CellSolver::solve(const int n, AlignedArray<double> &rhs, AlignedArray<double> &x,
                    const std::array<double, max_rhs> &goal)
  {
    if (multigrid)
      {
        constexpr unsigned max_iterations = 150; // 10 to 20 are usual
        const unsigned     needed         = multigrid->solve(n, rhs, x, goal, max_iterations);
        if (needed <= max_iterations)
          return needed;
        // The factors of larger maps would need too much memory.
        constexpr double max_pixels = 4e6;
        if (static_cast<double>(k.layout.nx) * k.layout.ny > max_pixels)
          throw ConvergenceError(describe_error(
              "The linear system of a local Reynolds cell did not converge", "flow factors",
              std::to_string(max_iterations) + " iterations", "",
              "Raise 'Closed gap' so that channels of vanishing height count as closed, or use a smaller map."));
        multigrid.reset();
        factorise(); // for what is left, the residual
      }
    const CellLayout &l = k.layout;
    Eigen::MatrixXd   b(factors->n_unknowns, n);
    const auto        each = [&](const auto &action) {
      for (int iy = 0; iy < l.ny; ++iy)
        for (int ix = 0; ix < l.nx; ++ix)
          {
            const int i = factors->unknown[static_cast<std::size_t>(iy) * l.nx + ix];
            for (int r = 0; i >= 0 && r < n; ++r)
              action(b(i, r), l.row(n, iy, r) + ix);
          }
    };
    each([&rhs](double &value, const std::size_t place) { value = rhs[place]; });
    b = factors->ldlt.solve(b).eval();
    each([&x](const double value, const std::size_t place) { x[place] += value; });
    return 0;
  }
} // namespace tribodraw
