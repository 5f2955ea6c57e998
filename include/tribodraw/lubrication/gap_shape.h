#ifndef tribodraw_lubrication_gap_shape_h
#define tribodraw_lubrication_gap_shape_h

#include <vector>

namespace tribodraw
{
  /// A prescribed gap over the rectangle [0, length] x [0, width] of the lower surface, or over a disc: bearings and test
  /// cases.
  class GapShape
  {
  public:
    virtual ~GapShape() = default;
    static const char *
    kind()
    {
      return "gap shape";
    }

    virtual double length() const = 0; ///< along x, the direction of sliding [mm]
    virtual double width() const  = 0; ///< along y [mm]
    /// Distance of the surfaces [mm].
    virtual double gap(double x, double y) const = 0;
    /// Above zero: the film covers a disc of this radius around the origin [mm].
    virtual double
    disc_radius() const
    {
      return 0;
    }
    /// Direction in which the pressure pushes, from the normal of the lower surface at x = 0: a journal is unrolled [rad].
    virtual double
    direction(double) const
    {
      return 0;
    }
    /// Positions x at which the gap jumps; the mesh gets a line of elements of negligible width there.
    virtual std::vector<double>
    jumps() const
    {
      return {};
    }
  };
} // namespace tribodraw

#endif
