#ifndef tribodraw_flow_factors_cell_gap_h
#define tribodraw_flow_factors_cell_gap_h

#include <tribodraw/flow_factors/cell_grid.h>
#include <tribodraw/surface/height_map.h>

#include <array>
#include <vector>

namespace tribodraw
{
  /// Gap between sheet and tool on the pixels of a map, and what the walls drag along.
  ///
  /// The gap h = s - z - t is shared out between the surfaces, h = g1 + g2, g1 = w s - z, g2 = (1 - w) s - t,
  /// w = Sq1^2 / (Sq1^2 + Sq2^2). With U1 = -U2 = Us/2 each share travels with its surface, and the paper's Eq. 12
  /// reads dh/dt = -(Us/2) d(g1 - g2)/dx. The carried thickness is c = g1 - g2; with a smooth tool c = h. The constants
  /// w s and (1 - w) s have no effect without contact; with contact this choice makes both one-sided limits exact,
  /// gives zero for equal surfaces and changes sign when the surfaces are exchanged.
  struct CellGap
  {
    std::vector<double> gap;     ///< h >= 0 [mm]
    std::vector<double> carried; ///< c [mm], 0 in contact
    double              mean_gap         = 0;
    double              mean_carried     = 0;
    double              contact_fraction = 0; ///< pixels with s - z - t <= 0
    double              closed_gap       = 0; ///< pixels with a gap up to this [mm] let nothing through

    bool
    open(int cell) const
    {
      return gap[cell] > closed_gap;
    }
  };

  /// @param tool empty z: smooth. @param closed_gap [mm]
  CellGap make_cell_gap(const HeightMap &sheet, const HeightMap &tool, double cut_height, double closed_gap);

  /// Connected regions of open pixels that lead from one side of the cell to the opposite one.
  ///
  /// Only these carry a mean flow. In an isolated pool the pressure flow is zero, and the flow relative to the
  /// carrying wall is divergence-free without flow through its border, so its mean is zero too: the pool moves
  /// with the wall and needs no unknowns.
  class CellConnectivity
  {
  public:
    CellConnectivity(const CellGrid &grid, const CellGap &gap);
    /// Per pixel the number of its conducting region, or -1. On a periodic grid a region conducts if it meets its own
    /// periodic image, whatever @p axis; otherwise if it touches both boundaries of @p axis.
    std::vector<int> conducting_regions(int axis) const;
    /// Some region leads through the cell along @p axis.
    bool conducts(int axis) const;

  private:
    const CellGrid                  &grid;
    const CellGap                   &gap;
    std::vector<int>                 root;  // region of each pixel, named by one of its pixels
    std::array<std::vector<char>, 2> wraps; // by axis, per root: meets its own image in that direction

    void              label_regions();
    std::vector<char> conducting_roots(int axis) const;
  };
} // namespace tribodraw

#endif
