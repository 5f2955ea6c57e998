#ifndef tribodraw_surface_spectral_field_h
#define tribodraw_surface_spectral_field_h

#include <tribodraw/surface/random_field.h>

#include <functional>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// Gaussian autocorrelation function with a lay: exp(-(a^2 / (2 l_a^2) + b^2 / (2 l_b^2))), a along the lay, which
  /// lies at @p angle (rad, counter-clockwise) to x, b across it.
  struct LayCorrelation
  {
    CorrelationLengths lengths{ 1., 1. }; ///< along and across the lay [mm]
    double             angle = 0;
  };

  /// Reads `Correlation length` (one value, or two: along and across the lay) and `Lay angle`.
  LayCorrelation read_lay_correlation(Parameters &parameters);

  /// Change of the autocorrelation function, applied at each lag: maps [0, 1] to [0, 1].
  using CorrelationMap = std::function<double(double)>;

  /// Periodic Gaussian random field with that autocorrelation function, zero mean and unit variance (exactly, for the
  /// discrete map): white noise times the square root of the power spectrum, by Fourier transform. If @p change is
  /// given, the autocorrelation function is change(that function); parts of its spectrum that are negative, which no
  /// random field has, are left out.
  std::vector<double> spectral_field(const Grid &grid, const LayCorrelation &correlation, NormalDeviates &deviates,
                                     const CorrelationMap &change = {});

  /// What speaks against that autocorrelation on this grid: each correlation length must be at least one pixel and at
  /// most a quarter of the map. Empty if nothing.
  std::string correlation_problem(const std::string &entry, const Grid &grid, const LayCorrelation &correlation);
} // namespace tribodraw

#endif
