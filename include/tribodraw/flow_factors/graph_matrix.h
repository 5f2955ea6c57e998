#ifndef tribodraw_flow_factors_graph_matrix_h
#define tribodraw_flow_factors_graph_matrix_h

#include <vector>

namespace tribodraw
{
  /// Symmetric matrix of a network of conductances: what couples the nodes to each other and to the ground. The
  /// diagonal is the sum of both and never stored, as its small difference to the sum of the couplings would be lost in
  /// round-off: a pool behind a narrow neck would lose its connection.
  struct GraphMatrix
  {
    /// Couplings of one pair may occur several times; they add up.
    struct Triplet
    {
      int    a, b;
      double coupling;
    };

    std::vector<int>    begin; ///< first entry of each row, and the number of entries
    std::vector<int>    column;
    std::vector<double> coupling; ///< minus the off-diagonal entry, positive in a network
    std::vector<double> ground;
    std::vector<int>    x, y; ///< position of each node on the map, in pixels

    int
    size() const
    {
      return static_cast<int>(ground.size());
    }
    double
    diagonal(const int i) const
    {
      double sum = ground[i];
      for (int e = begin[i]; e < begin[i + 1]; ++e)
        sum += coupling[e];
      return sum;
    }
    /// Set the couplings; `ground` fixes the number of nodes.
    void assemble(const std::vector<Triplet> &triplets);
  };
} // namespace tribodraw

#endif
