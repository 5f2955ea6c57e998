#ifndef tribodraw_lubrication_rectangular_gap_h
#define tribodraw_lubrication_rectangular_gap_h

#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/gap_shape.h>

namespace tribodraw
{
  /// A gap over a rectangle whose sides are entries of the parameter file.
  class RectangularGap : public GapShape
  {
  public:
    double
    length() const override
    {
      return l;
    }
    double
    width() const override
    {
      return b;
    }

  protected:
    explicit RectangularGap(Parameters &parameters)
        : l(parameters.quantity("Length", "mm", sides(), "Length along the direction of sliding x.")),
          b(parameters.quantity("Width", "mm", sides(), "Width along y."))
    {
    }

    static Range
    sides()
    {
      return Range::positive().usual(1e-3, 1e5);
    }

    const double l, b; ///< [mm]
  };
} // namespace tribodraw

#endif
