#ifndef tribodraw_source_flow_factors_corner_differences_h
#define tribodraw_source_flow_factors_corner_differences_h

namespace tribodraw
{
  /// Differences of the four corner values of a pixel: along x below and above, along y left and right, twist.
  /// Corners: (0,0), (1,0), (0,1), (1,1).
  template <class Values>
  struct Differences
  {
    Values below, above, left, right, twist;

    Differences(const Values &v0, const Values &v1, const Values &v2, const Values &v3)
        : below(v1 - v0), above(v3 - v2), left(v2 - v0), right(v3 - v1), twist(above - below)
    {
    }
  };
} // namespace tribodraw

#endif
