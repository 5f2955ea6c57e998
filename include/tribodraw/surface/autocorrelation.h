#ifndef tribodraw_surface_autocorrelation_h
#define tribodraw_surface_autocorrelation_h

#include <tribodraw/surface/height_map.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace tribodraw
{
  /// Normalised autocorrelation function of the heights about their mean at all lags up to half the map, by Fourier
  /// transform. Periodic maps are continued; in others the mean is over the overlapping part.
  class Autocorrelation
  {
  public:
    /// Throws InputError if the map is empty or all heights are equal.
    explicit Autocorrelation(const HeightMap &map);

    /// Lags in whole pixels; |lag_x| <= largest_lag_x(), |lag_y| <= largest_lag_y().
    double operator()(std::ptrdiff_t lag_x, std::ptrdiff_t lag_y) const;
    std::size_t
    largest_lag_x() const
    {
      return mx;
    }
    std::size_t
    largest_lag_y() const
    {
      return my;
    }

    /// Distance [mm] at which the function first falls to @p level in the direction @p angle (rad, against x), bilinear
    /// between pixels; nothing if it does not within half the map.
    std::optional<double> decay_length(double angle, double level) const;

  private:
    double interpolate(double lag_x, double lag_y) const;

    std::size_t         mx = 0, my = 0;
    double              dx = 0, dy = 0;
    std::vector<double> values; ///< values[(ly + my) * (mx + 1) + lx], lx >= 0
  };

  /// Spatial parameters. Lengths in mm, angles in degrees.
  struct SpatialParameters
  {
    /// Lags along x and y at which the autocorrelation function falls to 0.2 and to 0.5.
    std::optional<double> length_x, length_y, half_length_x, half_length_y;
    /// Peklenik number: ratio of the lags along x and y at 0.5 (Patir and Cheng 1978). Above 1: lay along x.
    std::optional<double> peklenik;
    /// ISO 25178-2 with s = 0.2: shortest distance over all directions at which the function falls to s, and its ratio
    /// to the longest. Sal exists as soon as one direction reaches s; Str needs all.
    std::optional<double> sal, str;
    /// Direction of the lay against x, counter-clockwise, in (-90, 90]: perpendicular to the direction in which the
    /// angular power spectrum of ISO 25178-2 is largest. Without meaning for isotropic surfaces (Str near 1).
    double std_angle = 0;
  };
  SpatialParameters spatial_parameters(const HeightMap &map);

  /// Angular power spectrum in bins of half a degree: power of waves whose direction (normal to their crests) lies
  /// between 0 and 180 degrees. Open maps are multiplied with a Hann window first. The power of each point of the
  /// discrete spectrum is spread over the angle that it covers.
  std::vector<double> angular_spectrum(const HeightMap &map);
} // namespace tribodraw

#endif
