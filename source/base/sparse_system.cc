#include <tribodraw/base/parallel.h>
#include <tribodraw/base/sparse_system.h>

#include <dmumps_c.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tribodraw
{
  SparseMatrix::SparseMatrix(const std::vector<std::vector<int>> &columns)
  {
    start.reserve(columns.size() + 1);
    for (const std::vector<int> &row : columns)
      {
        column.insert(column.end(), row.begin(), row.end());
        start.push_back(column.size());
      }
    value.assign(column.size(), 0.);
  }

  void
  SparseMatrix::set_zero()
  {
    std::fill(value.begin(), value.end(), 0.);
  }

  std::size_t
  SparseMatrix::position(const int row, const int col) const
  {
    const auto begin = column.begin() + static_cast<std::ptrdiff_t>(start[row]);
    const auto end   = column.begin() + static_cast<std::ptrdiff_t>(start[row + 1]);
    const auto found = std::lower_bound(begin, end, col);
    if (found == end || *found != col)
      throw std::logic_error("SparseMatrix: entry (" + std::to_string(row) + ", " + std::to_string(col)
                             + ") is not in the pattern.");
    return static_cast<std::size_t>(found - column.begin());
  }

  void
  SparseMatrix::eliminate(const std::vector<bool> &fixed, const double diagonal)
  {
    if (fixed.size() != static_cast<std::size_t>(size()))
      throw std::logic_error("SparseMatrix::eliminate: one mark per row is needed.");
    for (int row = 0; row < size(); ++row)
      for (std::size_t k = start[row]; k < start[row + 1]; ++k)
        if (fixed[row] || fixed[column[k]])
          value[k] = column[k] == row ? diagonal : 0.;
  }

  Eigen::VectorXd
  SparseMatrix::multiply(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd y(size());
    for (int row = 0; row < size(); ++row)
      {
        double sum = 0;
        for (std::size_t k = start[row]; k < start[row + 1]; ++k)
          sum += value[k] * x[column[k]];
        y[row] = sum;
      }
    return y;
  }

  namespace
  {
    // Control numbers as in the MUMPS users' guide, which counts from one.
    MUMPS_INT &
    icntl(DMUMPS_STRUC_C &mumps, const int i)
    {
      return mumps.icntl[i - 1];
    }

    constexpr int job_start = -1, job_end = -2, job_analyse = 1, job_factor = 2, job_solve = 3;

    // MUMPS error numbers.
    constexpr int error_singular = -10;
    bool
    is_memory_error(const int error)
    {
      return error == -8 || error == -9 || error == -14 || error == -15 || error == -17 || error == -20;
    }
  } // namespace

  struct DirectSolver::Implementation
  {
    DMUMPS_STRUC_C           mumps{};
    Symmetry                 symmetry     = Symmetry::unsymmetric;
    bool                     collective   = true; ///< over more than one rank
    MPI_Comm                 communicator = MPI_COMM_SELF;
    bool                     factored     = false;
    std::vector<std::size_t> known_start;
    std::vector<int>         known_column;
    std::vector<bool>        known_trivial;
    std::vector<MUMPS_INT>   rows, columns;
    std::vector<std::size_t> positions; ///< of the entries handed to MUMPS; empty: all in order
    std::vector<double>      values;

    bool
    is_host() const
    {
      int rank;
      MPI_Comm_rank(communicator, &rank);
      return rank == 0;
    }

    int
    run(const int job)
    {
      mumps.job = job;
      dmumps_c(&mumps);
      return mumps.infog[0];
    }

    void
    start()
    {
      parallel::use_one_blas_thread();
      mumps.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(communicator));
      mumps.par          = 1;
      mumps.sym          = symmetry == Symmetry::symmetric ? 2 : 0;
      check(run(job_start), "start");
      for (const int stream : { 1, 2, 3 })
        icntl(mumps, stream) = 0;
      icntl(mumps, 4)  = 0;
      icntl(mumps, 7)  = 4;  // PORD: on the tangent of a sheet, 2 to 3 times fewer operations than the automatic choice
                             // for symmetric matrices (AMF), and within 3 per cent of METIS
      icntl(mumps, 6)  = 0;  // no permutation by values: the analysis serves all matrices of the pattern
      if (symmetry == Symmetry::unsymmetric)
        icntl(mumps, 8) = 1; // by the diagonal, which balances displacements and rotations; the automatic choice iterates
      icntl(mumps, 10) = 0;  // no iterative refinement: the outer Newton iteration does that
      icntl(mumps, 13) = 1;  // no ScaLAPACK at the root: needed for the inertia and for null pivots
      icntl(mumps, 14) = 60; // spare memory in per cent, for delayed pivots
      icntl(mumps, 18) = collective ? 3 : 0;
      icntl(mumps, 24) = 1; // report null pivots instead of dividing by round-off
    }

    static void
    check(const int error, const std::string &action)
    {
      if (error < 0)
        throw std::runtime_error("Direct solver (MUMPS) failed to " + action + ", error " + std::to_string(error)
                                 + ".");
    }

    void
    set_pattern(const SparseMatrix &matrix, const std::vector<bool> &trivial)
    {
      known_trivial = trivial;
      known_start  = matrix.row_start();
      known_column = matrix.columns();
      rows.clear();
      columns.clear();
      positions.clear();
      const bool lower_only = symmetry == Symmetry::symmetric;
      for (int row = 0; row < matrix.size(); ++row)
        for (std::size_t k = known_start[row]; k < known_start[row + 1]; ++k)
          {
            const int  column  = known_column[k];
            const bool cleared = column != row && !trivial.empty() && (trivial[row] || trivial[column]);
            if (cleared || (lower_only && column > row))
              continue;
            rows.push_back(row + 1);
            columns.push_back(column + 1);
            positions.push_back(k);
          }
      values.resize(positions.size());
      mumps.n = matrix.size();
      // A pivot below this share of the (scaled) matrix norm is round-off of a vanishing one: n eliminations leave some
      // sqrt(n) times the machine precision.
      mumps.cntl[2] = 20 * std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(matrix.size()));
      if (collective)
        {
          mumps.nnz_loc = static_cast<MUMPS_INT8>(rows.size());
          mumps.irn_loc = rows.data();
          mumps.jcn_loc = columns.data();
          mumps.a_loc   = values.data();
        }
      else
        {
          mumps.nnz = static_cast<MUMPS_INT8>(rows.size());
          mumps.irn = rows.data();
          mumps.jcn = columns.data();
          mumps.a   = values.data();
        }
      check(run(job_analyse), "analyse the matrix");
    }
  };

  DirectSolver::DirectSolver(const Symmetry symmetry, const bool collective) : data(std::make_unique<Implementation>())
  {
    int started = 0;
    MPI_Initialized(&started);
    if (!started)
      throw std::logic_error("DirectSolver needs MPI to be started.");
    data->symmetry     = symmetry;
    data->collective   = collective && parallel::size() > 1;
    data->communicator = data->collective ? MPI_COMM_WORLD : MPI_COMM_SELF;
    data->start();
  }

  DirectSolver::~DirectSolver()
  {
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended)
      data->run(job_end);
  }

  bool
  DirectSolver::factor(const SparseMatrix &matrix, const std::vector<bool> &trivial)
  {
    Implementation &d = *data;
    d.factored        = false;
    bool changed      = d.known_start != matrix.row_start() || d.known_column != matrix.columns() || d.known_trivial != trivial;
    if (d.collective)
      changed = parallel::any(changed);
    if (changed)
      d.set_pattern(matrix, trivial);
    for (std::size_t k = 0; k < d.positions.size(); ++k)
      d.values[k] = matrix.values()[d.positions[k]];

    int error = d.run(job_factor);
    for (int attempt = 0; attempt < 4 && is_memory_error(error); ++attempt)
      {
        icntl(d.mumps, 14) *= 2;
        error = d.run(job_factor);
      }
    if (error == error_singular)
      return false;
    Implementation::check(error, "factorise the matrix");
    const int null_pivots = d.mumps.infog[27];
    d.factored            = null_pivots == 0;
    return d.factored;
  }

  void
  DirectSolver::solve(Eigen::VectorXd &b)
  {
    Implementation &d = *data;
    if (!d.factored)
      throw std::logic_error("DirectSolver::solve without a valid factorisation.");
    if (b.size() != d.mumps.n)
      throw std::logic_error("DirectSolver::solve: the right-hand side has the wrong size.");
    d.mumps.nrhs = 1;
    d.mumps.lrhs = d.mumps.n;
    d.mumps.rhs  = d.is_host() ? b.data() : nullptr;
    Implementation::check(d.run(job_solve), "solve");
    if (d.collective)
      MPI_Bcast(b.data(), static_cast<int>(b.size()), MPI_DOUBLE, 0, d.communicator);
  }

  int
  DirectSolver::n_negative_pivots() const
  {
    if (data->symmetry != Symmetry::symmetric)
      throw std::logic_error("DirectSolver: negative pivots are counted for symmetric matrices only.");
    return data->mumps.infog[11];
  }
} // namespace tribodraw
