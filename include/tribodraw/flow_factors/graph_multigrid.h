#ifndef tribodraw_flow_factors_graph_multigrid_h
#define tribodraw_flow_factors_graph_multigrid_h

#include <tribodraw/flow_factors/graph_matrix.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace tribodraw
{
  /// V-cycle of classical algebraic multigrid in single precision for a network of conductances: GraphCoarsening level by
  /// level, one Gauss-Seidel sweep forward before and one backward after the coarse correction, a direct solution of
  /// the last some hundred nodes.
  class GraphMultigrid
  {
  public:
    /// @param spacing distance of the rows and columns of nodes in pixels.
    GraphMultigrid(GraphMatrix matrix, int spacing);
    ~GraphMultigrid();
    /// Approximate solutions of @p n right-hand sides (1, 2 or 4); the values of one node stand side by side.
    void cycle(int n, const float *rhs, float *x) const;

  private:
    struct Level;
    struct Coarsest;
    std::vector<std::unique_ptr<Level>> levels;
    std::unique_ptr<Coarsest>           coarsest;

    template <int n>
    void cycle_at(std::size_t level, const float *rhs, float *x) const;
  };
} // namespace tribodraw

#endif
