#include "large_system.h"

#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>

#include <algorithm>

namespace tribodraw
{
  namespace
  {
    constexpr unsigned max_iterations = 500; // usual: 15 to 25, with a strong lay up to 100

    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// A scalar elliptic problem on triangles. W-cycles cost an eighth more than V-cycles (each level has a ninth of the
    /// unknowns of the finer one) and keep the number of iterations: 16, 16, 16 instead of 16, 17, 18 at 1e5, 1e6 and 4e6
    /// unknowns, 25, 21, 27 instead of 26, 24, 34 with an oblique lay. Two steps of the smoother instead of one save too few
    /// iterations, and so does neglecting weak connections.
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData
    multigrid_settings()
    {
      dealii::TrilinosWrappers::PreconditionAMG::AdditionalData settings;
      settings.elliptic              = true;
      settings.higher_order_elements = false;
      settings.w_cycle               = true;
      settings.smoother_sweeps       = 1; // degree of the Chebyshev polynomial
      settings.aggregation_threshold = 0;
      return settings;
    }

    /// What the solver needs of a matrix, without deal.II's copy of it.
    struct Operator
    {
      const Epetra_CrsMatrix &matrix;

      void
      vmult(Vector &y, const Vector &x) const
      {
        matrix.Apply(x.trilinos_vector(), y.trilinos_vector());
      }
    };
  } // namespace

  struct LargeSystem::Distributed
  {
    Epetra_MpiComm   communicator;
    Epetra_Map       map;
    Epetra_CrsMatrix matrix;
    std::vector<int> source; // of each entry of this rank among the values of the whole matrix
    std::vector<int> column; // its column in the whole matrix

    Distributed(const Matrix &pattern, const int begin, const int end)
        : communicator(MPI_COMM_WORLD), map(static_cast<int>(pattern.rows()), end - begin, 0, communicator),
          matrix(make_matrix(pattern, begin, end, map))
    {
      // The order of the entries of a row, by columns on this rank, is Epetra's.
      const int *start = pattern.outerIndexPtr(), *row = pattern.innerIndexPtr();
      source.reserve(matrix.NumMyNonzeros());
      column.reserve(matrix.NumMyNonzeros());
      for (int i = 0; i < matrix.NumMyRows(); ++i)
        {
          int     n_entries;
          double *values;
          int    *indices;
          matrix.ExtractMyRowView(i, n_entries, values, indices);
          const int *first = row + start[begin + i], *last = row + start[begin + i + 1];
          for (int k = 0; k < n_entries; ++k)
            {
              column.push_back(matrix.Graph().GCID(indices[k]));
              source.push_back(static_cast<int>(std::lower_bound(first, last, column.back()) - row));
            }
        }
    }

    static Epetra_CrsMatrix
    make_matrix(const Matrix &pattern, const int begin, const int end, const Epetra_Map &map)
    {
      const int       *start = pattern.outerIndexPtr(), *row = pattern.innerIndexPtr();
      std::vector<int> length;
      for (int i = begin; i < end; ++i)
        length.push_back(start[i + 1] - start[i]);
      Epetra_CrsGraph graph(Copy, map, length.data(), true);
      // Symmetric: columns are rows.
      for (int i = begin; i < end; ++i)
        graph.InsertGlobalIndices(i, start[i + 1] - start[i], const_cast<int *>(row) + start[i]);
      graph.FillComplete();
      graph.OptimizeStorage();
      Epetra_CrsMatrix matrix(Copy, graph);
      matrix.FillComplete();
      matrix.OptimizeStorage();
      return matrix;
    }

    void
    set_values(const Matrix &A, const std::vector<char> &held, const int begin)
    {
      int          *start, *local;
      double       *target;
      const double *value = A.valuePtr();
      matrix.ExtractCrsDataPointers(start, local, target);
      for (int i = 0; i < matrix.NumMyRows(); ++i)
        for (int k = start[i]; k < start[i + 1]; ++k)
          if (column[k] == begin + i)
            target[k] = value[source[k]];
          else
            target[k] = held[begin + i] || held[column[k]] ? 0. : value[source[k]];
    }
  };

  LargeSystem::LargeSystem(const Matrix &pattern)
  {
    const auto [begin, end] = own_range(static_cast<int>(pattern.rows()));
    data                    = std::make_unique<Distributed>(pattern, begin, end);
  }

  LargeSystem::~LargeSystem() = default;

  std::pair<int, int>
  LargeSystem::own_range(const int n)
  {
    const long size = parallel::size(), rank = parallel::rank();
    return { static_cast<int>(n * rank / size), static_cast<int>(n * (rank + 1) / size) };
  }

  void
  LargeSystem::gather(Eigen::VectorXd &x)
  {
    if (parallel::size() == 1)
      return;
    const auto [begin, end] = own_range(static_cast<int>(x.size()));
    std::vector<double> whole(x.size(), 0.);
    std::copy(x.data() + begin, x.data() + end, whole.begin() + begin);
    parallel::sum(whole);
    x = Eigen::Map<const Eigen::VectorXd>(whole.data(), x.size());
  }

  bool
  LargeSystem::solve(const Matrix &A, const std::vector<char> &held, const Eigen::VectorXd &b, const double tolerance,
                     Eigen::VectorXd &x)
  {
    const timing::Scope timer("lubrication/multigrid");
    // Idle threads wait for vectors that are too short to be shared.
    parallel::use_one_blas_thread();
    const int n             = static_cast<int>(b.size());
    const auto [begin, end] = own_range(n);
    dealii::TrilinosWrappers::PreconditionAMG preconditioner;
    {
      const timing::Scope levels("lubrication/multigrid levels");
      data->set_values(A, held, begin);
      preconditioner.initialize(data->matrix, multigrid_settings());
    }

    dealii::IndexSet own(n);
    own.add_range(begin, end);
    Vector solution(own, MPI_COMM_WORLD), rhs(own, MPI_COMM_WORLD);
    std::copy(x.data() + begin, x.data() + end, solution.begin());
    std::copy(b.data() + begin, b.data() + end, rhs.begin());
    dealii::SolverControl    control(max_iterations, tolerance * rhs.l2_norm());
    dealii::SolverCG<Vector> cg(control);
    bool                     converged = true;
    try
      {
        cg.solve(Operator{ data->matrix }, solution, rhs, preconditioner);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        converged = false;
      }
    std::copy(solution.begin(), solution.end(), x.data() + begin);
    gather(x);
    return converged;
  }
} // namespace tribodraw
