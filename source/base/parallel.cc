#include <tribodraw/base/parallel.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/parallel.h>

#include <dlfcn.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>

namespace tribodraw::parallel
{
  namespace
  {
    bool running()
    {
      int started = 0, ended = 0;
      MPI_Initialized(&started);
      MPI_Finalized(&ended);
      return started && !ended;
    }

    double reduce(double value, MPI_Op operation)
    {
      if (size() > 1)
        MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, operation, MPI_COMM_WORLD);
      return value;
    }
  } // namespace

  unsigned
  rank()
  {
    int r = 0;
    if (running())
      MPI_Comm_rank(MPI_COMM_WORLD, &r);
    return static_cast<unsigned>(r);
  }

  unsigned
  size()
  {
    int n = 1;
    if (running())
      MPI_Comm_size(MPI_COMM_WORLD, &n);
    return static_cast<unsigned>(n);
  }

  void
  sum(std::vector<double> &values)
  {
    if (size() == 1)
      return;
    // Reduce to one rank and broadcast, so that every rank has the same bits.
    const int n = static_cast<int>(values.size());
    if (rank() == 0)
      MPI_Reduce(MPI_IN_PLACE, values.data(), n, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    else
      MPI_Reduce(values.data(), nullptr, n, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    MPI_Bcast(values.data(), n, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  }

  double
  sum(const double value)
  {
    std::vector<double> one{value};
    sum(one);
    return one[0];
  }

  double
  max(const double value)
  {
    return reduce(value, MPI_MAX);
  }

  double
  min(const double value)
  {
    return reduce(value, MPI_MIN);
  }

  bool
  any(const bool value)
  {
    return max(value ? 1. : 0.) > 0.5;
  }

  void
  barrier()
  {
    if (size() > 1)
      MPI_Barrier(MPI_COMM_WORLD);
  }

  void
  broadcast(std::vector<double> &values, const unsigned root)
  {
    if (size() == 1)
      return;
    unsigned long n = values.size();
    MPI_Bcast(&n, 1, MPI_UNSIGNED_LONG, static_cast<int>(root), MPI_COMM_WORLD);
    values.resize(n);
    MPI_Bcast(values.data(), static_cast<int>(n), MPI_DOUBLE, static_cast<int>(root), MPI_COMM_WORLD);
  }

  void
  broadcast(std::string &text, const unsigned root)
  {
    if (size() == 1)
      return;
    unsigned long n = text.size();
    MPI_Bcast(&n, 1, MPI_UNSIGNED_LONG, static_cast<int>(root), MPI_COMM_WORLD);
    text.resize(n);
    MPI_Bcast(text.data(), static_cast<int>(n), MPI_CHAR, static_cast<int>(root), MPI_COMM_WORLD);
  }

  unsigned
  n_threads()
  {
    return std::max(1u, dealii::MultithreadInfo::n_threads());
  }

  void
  use_one_blas_thread()
  {
    if (std::getenv("OPENBLAS_NUM_THREADS"))
      return;
    if (auto *const set_threads = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
      set_threads(1);
  }

  void
  for_range(const std::size_t n, const std::size_t grain, const std::function<void(std::size_t, std::size_t)> &body)
  {
    if (n == 0)
      return;
    if (n_threads() == 1 || n <= grain)
      return body(0, n);
    dealii::parallel::apply_to_subranges(std::size_t(0), n, body, static_cast<unsigned>(std::max<std::size_t>(1, grain)));
  }
} // namespace tribodraw::parallel
