#ifndef tribodraw_tests_flattening_gaussian_map_h
#define tribodraw_tests_flattening_gaussian_map_h

#include <tribodraw/surface/height_map.h>

#include <cmath>

namespace tribodraw::test
{
  inline double
  normal_density(const double x)
  {
    return std::exp(-0.5 * x * x) / std::sqrt(2. * 3.14159265358979323846);
  }

  inline double
  normal_distribution(const double x)
  {
    return 0.5 * std::erfc(-x / std::sqrt(2.));
  }

  /// A map whose heights are the quantiles (i + 1/2)/n of a Gaussian: its distribution is Gaussian to 1/n, without the
  /// scatter of random heights. Where a height lies does not matter to the distribution.
  inline HeightMap
  gaussian_map(const std::size_t pixels, const double sq)
  {
    HeightMap map;
    map.nx = map.ny = pixels;
    map.dx = map.dy     = 3e-3;
    const std::size_t n = pixels * pixels;
    double            x = -6.;
    for (std::size_t i = 0; i < n; ++i)
      {
        const double p = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        for (unsigned int k = 0; k < 50; ++k) // Newton from the previous quantile
          {
            const double step = (normal_distribution(x) - p) / normal_density(x);
            x -= std::fmax(-0.5, std::fmin(0.5, step));
            if (std::abs(step) < 1e-14)
              break;
          }
        map.z.push_back(sq * x);
      }
    return map;
  }
} // namespace tribodraw::test

#endif
