#ifndef tribodraw_surface_roughness_h
#define tribodraw_surface_roughness_h

#include <tribodraw/surface/height_map.h>

#include <vector>

namespace tribodraw
{
  /// Areal height parameters of ISO 25178-2 about the mean of the map (no filter is applied). Lengths in mm.
  struct Roughness
  {
    double sa  = 0; ///< mean of |z|
    double sq  = 0; ///< root mean square of z
    double ssk = 0; ///< skewness, mean of z^3 / Sq^3
    double sku = 0; ///< kurtosis, mean of z^4 / Sq^4
    double sp  = 0; ///< highest peak above the mean
    double sv  = 0; ///< deepest valley below the mean, positive
    double sz  = 0; ///< Sp + Sv
  };

  /// Throws InputError if the map is empty or all heights are equal.
  Roughness roughness(const HeightMap &map);

  /// Height distribution as a histogram of equal bins from the lowest to the highest point, about the mean.
  struct HeightHistogram
  {
    std::vector<double> edges;   ///< [um], one more than bins
    std::vector<double> density; ///< [1/um], integral 1
  };
  HeightHistogram height_histogram(const HeightMap &map, unsigned n_bins = 100);

  /// Abbott curve: height above which the stated fraction of the area lies.
  struct AbbottCurve
  {
    std::vector<double> material_ratio; ///< 0 (highest point) to 1 (lowest point)
    std::vector<double> height;         ///< about the mean [um]
  };
  AbbottCurve abbott_curve(const HeightMap &map, unsigned n_points = 201);
} // namespace tribodraw

#endif
