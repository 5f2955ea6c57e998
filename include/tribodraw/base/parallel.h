#ifndef tribodraw_base_parallel_h
#define tribodraw_base_parallel_h

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tribodraw
{
  /// The few collective operations that physics code needs, without MPI headers. All work on the
  /// world communicator and also when MPI was never started (one rank).
  namespace parallel
  {
    unsigned rank();
    unsigned size();
    /// Element-wise sum over ranks, the same bits on every rank.
    void sum(std::vector<double> &values);
    double sum(double value);
    double max(double value);
    double min(double value);
    void barrier();
    /// Values of rank @p root on every rank.
    void broadcast(std::vector<double> &values, unsigned root = 0);
    void broadcast(std::string &text, unsigned root = 0);
    /// True on every rank if it is true on any.
    bool any(bool value);

    /// Run body(begin, end) over [0, n) on the threads of this process (grain: smallest piece worth a thread).
    /// The pieces are disjoint; results must not depend on how the range is cut.
    void for_range(std::size_t                                           n,
                   std::size_t                                           grain,
                   const std::function<void(std::size_t, std::size_t)> &body);
    unsigned n_threads();
    /// The blocks of a sheet's factorisation are small: a second BLAS thread only waits, at full load. Whoever has a very
    /// large mesh can ask for threads in the environment (OPENBLAS_NUM_THREADS). Does nothing with other libraries than
    /// OpenBLAS. Every DirectSolver calls this.
    void use_one_blas_thread();
  } // namespace parallel
} // namespace tribodraw

#endif
