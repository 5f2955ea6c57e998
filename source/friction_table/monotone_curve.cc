#include <tribodraw/friction_table/monotone_curve.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  MonotoneCurve::MonotoneCurve(std::vector<double> x_points, std::vector<double> y_points)
      : x(std::move(x_points)), y(std::move(y_points)), slope(x.size(), 0.)
  {
    const std::size_t n = x.size();
    if (n < 2)
      return;
    std::vector<double> secant(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i)
      secant[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    slope.front() = secant.front();
    slope.back()  = secant.back();
    for (std::size_t i = 1; i + 1 < n; ++i)
      if (secant[i - 1] * secant[i] > 0)
        {
          // weighted harmonic mean (Fritsch and Butland 1984): second order and within the monotone region
          const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
          slope[i] = 3. * (h0 + h1) / ((2. * h1 + h0) / secant[i - 1] + (h1 + 2. * h0) / secant[i]);
        }
  }

  double
  MonotoneCurve::operator()(const double at) const
  {
    if (at <= x.front())
      return y.front();
    if (at >= x.back())
      return y.back();
    const std::size_t i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin()) - 1;
    const double      h = x[i + 1] - x[i], t = (at - x[i]) / h;
    const double      value = y[i] * (1. + 2. * t) * (1. - t) * (1. - t) + h * slope[i] * t * (1. - t) * (1. - t)
                         + y[i + 1] * t * t * (3. - 2. * t) - h * slope[i + 1] * t * t * (1. - t);
    return std::clamp(value, std::min(y[i], y[i + 1]), std::max(y[i], y[i + 1])); // round-off only
  }
} // namespace tribodraw
