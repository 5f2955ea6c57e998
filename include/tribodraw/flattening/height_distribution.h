#ifndef tribodraw_flattening_height_distribution_h
#define tribodraw_flattening_height_distribution_h

#include <tribodraw/surface/height_map.h>

#include <cstddef>
#include <vector>

namespace tribodraw
{
  /// The height distribution of a sheet and the geometry of its volume-conserving flattening by a flat tool with
  /// uniform rise (paper, Eqs. 13-14). Exact for the discrete map: one sort and prefix sums, no histogram.
  /// The only state is the cut height s: everything above s is contact. [model.md 1.1: h_avg = s + u]
  class HeightDistribution
  {
  public:
    /// Heights in mm; the mean is subtracted.
    explicit HeightDistribution(const HeightMap &map);

    double highest() const; ///< [mm]
    double lowest() const;  ///< [mm]
    double sq() const;      ///< root mean square height [mm]
    double mean() const;    ///< of the map as given, before it was subtracted [mm]
    /// Height of the pixel that is the @p n-th from the top, n = 1 ... number of pixels [mm].
    double nth_highest(std::size_t n) const;
    std::size_t
    size() const
    {
      return height.size();
    }

    double contact_fraction(double cut_height) const;
    /// Mean gap h_avg = integral of (s - z) over z < s, per nominal area [mm].
    double mean_gap(double cut_height) const;
    /// Uniform rise u of the valleys [mm].
    double uniform_rise(double cut_height) const;
    double cut_height_for_mean_gap(double h_avg) const;
    double cut_height_for_contact_fraction(double contact_fraction) const;

  private:
    std::vector<double> height;     // sorted, ascending
    std::vector<double> prefix_sum; // prefix_sum[k] = sum of the k lowest
    double              root_mean_square = 0, mean_height = 0;
  };
} // namespace tribodraw

#endif
