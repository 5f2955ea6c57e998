#ifndef tribodraw_surface_missing_points_h
#define tribodraw_surface_missing_points_h

#include <tribodraw/surface/height_map.h>

#include <cstddef>

namespace tribodraw
{
  struct OutlierReport
  {
    std::size_t found  = 0;
    double      spread = 0; ///< robust standard deviation of the distances from the local median [mm]
  };

  /// Mark as missing (NaN) every point whose distance from the median of the measured points in the window
  /// (@p window x @p window pixels around it) exceeds @p threshold times the robust spread of these distances over the
  /// map: 1.4826 times their median absolute value, which is the standard deviation if they are normally distributed.
  /// If more than half of the distances are zero (a smooth map stored with few digits) it is 1.2533 times the mean
  /// absolute value instead.
  OutlierReport mark_outliers(HeightMap &map, double threshold, unsigned window);

  /// Fill missing points harmonically: each becomes the mean of its four neighbours, weighted for the pixel sizes, so
  /// that holes continue their surroundings without new extremes (Laplace's equation with the measured points around a
  /// hole given; no slope across the border of an open map). Conjugate gradients to a relative residual of 1e-10.
  /// @return number of points filled. Throws InputError if all points are missing or more than @p largest_share of
  /// them.
  std::size_t fill_missing(HeightMap &map, double largest_share);
} // namespace tribodraw

#endif
