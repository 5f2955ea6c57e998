#include "large_system.h"

#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>

#include <vector>

namespace tribodraw::large_system
{
  namespace
  {
    constexpr unsigned max_iterations = 300; // usual: 15 to 25

    /// A scalar elliptic problem on triangles: defaults of ML, one sweep of a cheap smoother.
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData
    multigrid_settings()
    {
      dealii::TrilinosWrappers::PreconditionAMG::AdditionalData settings;
      settings.elliptic              = true;
      settings.higher_order_elements = false;
      settings.smoother_sweeps       = 2; // degree of the Chebyshev polynomial
      settings.aggregation_threshold = 1e-3;
      return settings;
    }
  } // namespace

  std::pair<int, int>
  own_range(const int n)
  {
    const long size = parallel::size(), rank = parallel::rank();
    return { static_cast<int>(n * rank / size), static_cast<int>(n * (rank + 1) / size) };
  }

  bool
  solve(const Eigen::SparseMatrix<double> &A, const Eigen::VectorXd &b, const double tolerance, Eigen::VectorXd &x)
  {
    const timing::Scope timer("lubrication/multigrid");
    const int           n            = static_cast<int>(b.size());
    const auto [begin, end]          = own_range(n);
    const int               *start   = A.outerIndexPtr();
    const Epetra_MpiComm     communicator(MPI_COMM_WORLD);
    const Epetra_Map         map(n, end - begin, 0, communicator);
    std::vector<int>         row_length;
    for (int i = begin; i < end; ++i)
      row_length.push_back(start[i + 1] - start[i]);
    Epetra_CrsMatrix epetra(Copy, map, row_length.data(), true);
    // Symmetric: columns are rows.
    for (int i = begin; i < end; ++i)
      epetra.InsertGlobalValues(i, start[i + 1] - start[i], A.valuePtr() + start[i], A.innerIndexPtr() + start[i]);
    epetra.FillComplete();
    epetra.OptimizeStorage();

    dealii::TrilinosWrappers::SparseMatrix matrix;
    matrix.reinit(epetra);
    dealii::TrilinosWrappers::PreconditionAMG preconditioner;
    preconditioner.initialize(matrix, multigrid_settings());

    dealii::IndexSet own(n);
    own.add_range(begin, end);
    dealii::TrilinosWrappers::MPI::Vector solution(own, MPI_COMM_WORLD), rhs(own, MPI_COMM_WORLD);
    double *const                         s = solution.begin(), *const r = rhs.begin();
    for (int i = begin; i < end; ++i)
      {
        s[i - begin] = x[i];
        r[i - begin] = b[i];
      }
    dealii::SolverControl                                      control(max_iterations, tolerance * rhs.l2_norm());
    dealii::SolverCG<dealii::TrilinosWrappers::MPI::Vector>    cg(control);
    bool                                                       converged = true;
    try
      {
        cg.solve(matrix, solution, rhs, preconditioner);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        converged = false;
      }
    std::vector<double> whole(n, 0.);
    std::copy(solution.begin(), solution.end(), whole.begin() + begin);
    if (parallel::size() > 1)
      parallel::sum(whole);
    x = Eigen::Map<const Eigen::VectorXd>(whole.data(), n);
    return converged;
  }
} // namespace tribodraw::large_system
