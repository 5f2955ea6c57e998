#ifndef tribodraw_flow_factors_quarter_maps_h
#define tribodraw_flow_factors_quarter_maps_h

#include <tribodraw/flow_factors/flow_factors.h>

namespace tribodraw
{
  /// Flow factors of the four quarters of the maps, as though each had been measured alone: mean and standard deviation
  /// of the components xx and yy go into @p result, which must have its mean gap.
  ///
  /// A quarter is levelled to zero mean and cut where its mean gap is that of the whole map, so what differs is the
  /// texture. It is not periodic: pressures are fixed on two sides, nothing flows through the others (`periodic`:
  /// mean over the quarter; `paper`: over its central part), which is the cell of the quarter and its mirror images.
  /// With an odd number of pixels the middle row belongs to no quarter. The scatter of single quarters is about twice
  /// that of the whole map.
  ///
  /// @param closed_gap [mm] Throws InputError for less than 20 x 20 pixels.
  void add_quarter_maps(FlowFactors &result, const HeightMap &sheet, const HeightMap &tool,
                        const CellSettings &settings, double closed_gap, double sq_reference);
} // namespace tribodraw

#endif
