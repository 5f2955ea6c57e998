#ifndef tribodraw_flow_factors_cell_coarsening_h
#define tribodraw_flow_factors_cell_coarsening_h

#include <tribodraw/flow_factors/cell_conductances.h>
#include <tribodraw/flow_factors/graph_matrix.h>

#include <vector>

namespace tribodraw
{
  /// The first coarsening of the five-point system: which pixels are kept, how the others follow from them, and the
  /// Galerkin matrix of the kept ones.
  ///
  /// Corners (both coordinates even) are kept. A pixel between two corners, an edge, is the mean of both, weighted with
  /// its conductances to them (Alcouffe, Brandt, Dendy, Painter 1981). If these are small compared with its other two,
  /// it is kept too: otherwise narrow channels and pools would be invisible on the coarse level. A centre (both
  /// coordinates odd) fulfils its own equation, which is exact.
  class CellCoarsening
  {
  public:
    explicit CellCoarsening(const CellConductances &conductances);

    /// Columns of the kept pixels, row by row, and the first of each row.
    std::vector<int> site, first_site;
    /// In the layout of the conductances: what a sum of conductance times value at the neighbours in question is
    /// multiplied with to interpolate; 0 in kept and closed pixels.
    AlignedArray<float> weight;

    GraphMatrix coarse_matrix() const;

  private:
    class Assembler;

    const CellConductances &k;

    void choose_sites();
  };
} // namespace tribodraw

#endif
