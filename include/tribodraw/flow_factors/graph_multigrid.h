#ifndef tribodraw_flow_factors_graph_multigrid_h
#define tribodraw_flow_factors_graph_multigrid_h

#include <tribodraw/flow_factors/graph_matrix.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace tribodraw
{
  /// Cycle of classical algebraic multigrid for a network of conductances: GraphCoarsening level by level, one
  /// Gauss-Seidel sweep forward before and one backward after the coarse correction, a direct solution of the last some
  /// hundred nodes.
  ///
  /// The finest level, most of the work, is kept in single precision and visited once. The levels below are visited in
  /// a W-cycle, which takes a quarter fewer iterations, and therefore in double precision: residuals in single
  /// precision would hide the weak connections of pools behind narrow necks.
  class GraphMultigrid
  {
  public:
    /// @param spacing distance of the rows and columns of nodes in pixels.
    GraphMultigrid(GraphMatrix matrix, int spacing);
    ~GraphMultigrid();
    /// Approximate solutions of @p n right-hand sides (1, 2 or 4); the values of one node stand side by side.
    void cycle(int n, const float *rhs, float *x) const;

  private:
    template <class Real>
    struct Level;
    struct Coarsest;
    std::unique_ptr<Level<float>>               finest;
    std::vector<std::unique_ptr<Level<double>>> levels;
    std::unique_ptr<Coarsest>                   coarsest;

    template <int n>
    void cycle_from_finest(const float *rhs, float *x) const;
    template <int n>
    void cycle_at(std::size_t level, const double *rhs, double *x) const;
    template <int n>
    void solve_coarsest(const double *rhs, double *x) const;
  };
} // namespace tribodraw

#endif
