#ifndef tribodraw_surface_roughness_h
#define tribodraw_surface_roughness_h

#include <tribodraw/surface/height_map.h>

#include <optional>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Areal height parameters of ISO 25178-2 about the mean of the map (no filter is applied) and autocorrelation
  /// lengths. Lengths in mm.
  struct Roughness
  {
    double sa  = 0; ///< mean of |z|
    double sq  = 0; ///< root mean square of z
    double ssk = 0; ///< skewness, mean of z^3 / Sq^3
    double sku = 0; ///< kurtosis, mean of z^4 / Sq^4
    double sp  = 0; ///< highest peak above the mean
    double sv  = 0; ///< deepest valley below the mean, positive
    double sz  = 0; ///< Sp + Sv
    /// Shortest lag along x (y) at which the normalised autocorrelation function falls to 0.2, linear between pixels;
    /// nothing if it does not within half the map. Unlike Sal of ISO 25178-2, which is the shortest over all
    /// directions, these are along the axes. Periodic maps are continued; in others the mean is over the overlapping
    /// part.
    std::optional<double> autocorrelation_length_x, autocorrelation_length_y;
  };

  /// Throws InputError if the map is empty or all heights are equal.
  Roughness roughness(const HeightMap &map);

  /// Normalised autocorrelation function at a lag of whole pixels along x or y.
  double autocorrelation_x(const HeightMap &map, std::size_t lag);
  double autocorrelation_y(const HeightMap &map, std::size_t lag);

  /// One line of surface.csv: `parameter,value,unit`.
  struct RoughnessRow
  {
    std::string parameter;
    double      value;
    std::string unit;
  };
  /// Size of the map and its roughness, in um and mm as the units say (`1`: dimensionless).
  std::vector<RoughnessRow> roughness_rows(const HeightMap &map, const Roughness &values);

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
