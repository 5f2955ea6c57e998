#ifndef tribodraw_flow_factors_graph_coarsening_h
#define tribodraw_flow_factors_graph_coarsening_h

#include <tribodraw/flow_factors/graph_matrix.h>

#include <vector>

namespace tribodraw
{
  /// One step of classical algebraic multigrid (Ruge, Stueben 1987) for a network of conductances on a map.
  ///
  /// Kept are the nodes on every other row and column of the level's raster, and those that would be badly seen from
  /// them. The others are means of the kept neighbours; what couples a dropped node to another dropped one is passed on
  /// to the kept neighbours that both have.
  class GraphCoarsening
  {
  public:
    /// @param spacing distance of the level's rows and columns in pixels. Keeps a reference to @p matrix.
    GraphCoarsening(const GraphMatrix &matrix, int spacing);

    // Interpolation, row by row
    std::vector<int>    begin, column;
    std::vector<double> weight;
    int                 n_coarse = 0;

    /// Galerkin product.
    GraphMatrix coarse_matrix() const;

  private:
    struct Rows
    {
      std::vector<int>    begin, column;
      std::vector<double> value;
    };

    const GraphMatrix &m;
    std::vector<int>   coarse_number; // -1: dropped
    std::vector<int>   seen_from;     // last node whose kept neighbours were marked

    bool
    kept(const int i) const
    {
      return coarse_number[i] >= 0;
    }
    void   mark_kept_neighbours(int i);
    double coupling_to_marked(int i, int j) const;
    void   select(int spacing);
    bool   well_seen(int i);
    void   interpolate();
    Rows   transposed() const;
    Rows   image() const;
    void   set_ground(GraphMatrix &coarse, const Rows &transposed) const;
  };
} // namespace tribodraw

#endif
