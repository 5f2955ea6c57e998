#include <tribodraw/base/errors.h>
#include <tribodraw/flow_factors/cell_solver.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>

namespace tribodraw
{
  namespace
  {
    using DirectMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

    // Lower triangle, or the whole matrix, from the couplings.
    template <class Matrix>
    Matrix
    assemble(const CellSolver::System &system, const bool whole)
    {
      std::vector<double>                 diagonal(system.size(), 0.);
      std::vector<Eigen::Triplet<double>> entries;
      entries.reserve(system.couplings.size() * (whole ? 2 : 1) + system.size());
      for (const auto &[a, b, conductance] : system.couplings)
        {
          diagonal[static_cast<std::size_t>(a)] += conductance;
          if (b < 0)
            continue;
          diagonal[static_cast<std::size_t>(b)] += conductance;
          entries.emplace_back(std::max(a, b), std::min(a, b), -conductance);
          if (whole)
            entries.emplace_back(std::min(a, b), std::max(a, b), -conductance);
        }
      // Doubling a diagonal entry of a consistent singular system sets that unknown to zero.
      for (const int i : system.floating)
        diagonal[static_cast<std::size_t>(i)] *= 2;
      for (std::size_t i = 0; i < system.size(); ++i)
        entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
      const auto n = static_cast<Eigen::Index>(system.size());
      Matrix     matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }

    bool
    multigrid_pays(const CellMultigrid::Layout &layout)
    {
      // Measured on random surfaces: below some 300 x 300 pixels the factorisation is as fast; with much contact it
      // has little fill, while multigrid converges slowly around the contacts.
      constexpr double min_pixels = 90000, min_open = 0.9;
      const double     pixels = static_cast<double>(layout.nx) * layout.ny;
      return pixels >= min_pixels && static_cast<double>(layout.x.size()) >= min_open * pixels;
    }
  } // namespace

  struct CellSolver::Factors
  {
    Eigen::SimplicialLDLT<DirectMatrix, Eigen::Lower> ldlt;
  };

  CellSolver::CellSolver(System system_in, const CellSolverChoice choice) : system(std::move(system_in))
  {
    if (choice == CellSolverChoice::multigrid
        || (choice == CellSolverChoice::automatic && multigrid_pays(system.layout)))
      multigrid = std::make_unique<CellMultigrid>(assemble<CellMultigrid::Matrix>(system, true), system.layout);
    else
      factorise();
  }

  CellSolver::~CellSolver() = default;

  void
  CellSolver::factorise()
  {
    factors = std::make_unique<Factors>();
    factors->ldlt.compute(assemble<DirectMatrix>(system, false));
    if (factors->ldlt.info() != Eigen::Success)
      throw ConvergenceError(
          describe_error("The matrix of a local Reynolds cell could not be factorised", "flow factors",
                         std::to_string(system.size()) + " open pixels", "",
                         "Raise 'Closed gap' so that channels of vanishing height count as closed."));
  }

  Eigen::VectorXd
  CellSolver::solve(const Eigen::VectorXd &rhs, unsigned &iterations)
  {
    if (multigrid)
      {
        // 10 to 15 iterations are usual; beyond this limit the factorisation is faster
        constexpr double   tolerance      = 1e-8; // the caller refines the solution
        constexpr unsigned max_iterations = 60;
        Eigen::VectorXd    x;
        const unsigned     needed = multigrid->solve(rhs, x, tolerance, max_iterations);
        iterations += needed == 0 ? max_iterations : needed;
        if (needed > 0)
          return x;
        multigrid.reset();
        factorise();
      }
    return factors->ldlt.solve(rhs);
  }
} // namespace tribodraw
