#ifndef tribodraw_surface_slopes_h
#define tribodraw_surface_slopes_h

#include <tribodraw/surface/height_map.h>

namespace tribodraw
{
  /// Hybrid parameters of ISO 25178-2 and spectral moments. Lengths in mm.
  struct SlopeParameters
  {
    double sdq = 0; ///< root mean square gradient
    double sdr = 0; ///< developed area / plan area - 1
    /// Spectral moments of profiles (Longuet-Higgins 1957, Nayak 1971): mean squares of height, slope and curvature.
    double m0   = 0;           ///< [mm^2]
    double m2_x = 0, m2_y = 0; ///< profiles along x and y
    double m4_x = 0, m4_y = 0; ///< [1/mm^2]

    double
    m2() const
    {
      return 0.5 * (m2_x + m2_y);
    }
    double
    m4() const
    {
      return 0.5 * (m4_x + m4_y);
    }
  };

  /// Slopes and curvatures from the differences of sixth order over seven points (for the slope the usual one of
  /// profile standards; sampling at less than seven points a wave underestimates them); near an open border, where the
  /// stencil does not fit, the three outermost points are left out. The area is that of the two triangles of each
  /// square of four neighbouring points, averaged over the two ways to cut it. Throws InputError for maps below 7 x 7
  /// pixels.
  SlopeParameters slope_parameters(const HeightMap &map);
} // namespace tribodraw

#endif
