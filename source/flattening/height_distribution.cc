#include <tribodraw/base/errors.h>
#include <tribodraw/flattening/height_distribution.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    /// Sum with a running correction (Neumaier), so that identities hold to round-off for a million pixels.
    class CompensatedSum
    {
    public:
      void
      add(const double x)
      {
        const double t = sum + x;
        correction += std::abs(sum) >= std::abs(x) ? (sum - t) + x : (x - t) + sum;
        sum = t;
      }
      double
      value() const
      {
        return sum + correction;
      }

    private:
      double sum = 0, correction = 0;
    };
  } // namespace

  HeightDistribution::HeightDistribution(const HeightMap &map) : height(map.z)
  {
    if (height.empty() || height.size() != map.size())
      throw InputError(describe_error(
          "A height map without heights, or with the wrong number of them, has no distribution", "flattening",
          std::to_string(height.size()) + " heights", std::to_string(map.nx) + " x " + std::to_string(map.ny)));
    CompensatedSum sum;
    for (const double z : height)
      {
        if (!std::isfinite(z))
          throw InputError(describe_error("A height is not a finite number", "flattening", "", "finite heights"));
        sum.add(z);
      }
    const double n = static_cast<double>(height.size());
    mean_height    = sum.value() / n;
    CompensatedSum squares;
    for (double &z : height)
      {
        z -= mean_height;
        squares.add(z * z);
      }
    root_mean_square = std::sqrt(squares.value() / n);

    std::sort(height.begin(), height.end());
    prefix_sum.reserve(height.size() + 1);
    CompensatedSum below;
    prefix_sum.push_back(0.);
    for (const double z : height)
      {
        below.add(z);
        prefix_sum.push_back(below.value());
      }
  }

  double
  HeightDistribution::highest() const
  {
    return height.back();
  }

  double
  HeightDistribution::lowest() const
  {
    return height.front();
  }

  double
  HeightDistribution::sq() const
  {
    return root_mean_square;
  }

  double
  HeightDistribution::mean() const
  {
    return mean_height;
  }

  double
  HeightDistribution::nth_highest(const std::size_t n) const
  {
    return height[height.size() - n];
  }

  double
  HeightDistribution::contact_fraction(const double s) const
  {
    const auto k = std::lower_bound(height.begin(), height.end(), s) - height.begin();
    return 1. - static_cast<double>(k) / static_cast<double>(height.size());
  }

  double
  HeightDistribution::mean_gap(const double s) const
  {
    const auto k = std::lower_bound(height.begin(), height.end(), s) - height.begin();
    return (static_cast<double>(k) * s - prefix_sum[k]) / static_cast<double>(height.size());
  }

  double
  HeightDistribution::uniform_rise(const double s) const
  {
    const auto k = std::lower_bound(height.begin(), height.end(), s) - height.begin();
    const auto n = height.size();
    return ((prefix_sum[n] - prefix_sum[k]) - static_cast<double>(n - k) * s) / static_cast<double>(n);
  }

  double
  HeightDistribution::cut_height_for_mean_gap(const double h_avg) const
  {
    // The mean gap is piecewise linear in s: find the segment between two heights, then invert it.
    const std::size_t n       = height.size();
    const double      n_times = static_cast<double>(n) * h_avg;
    if (h_avg <= 0)
      return lowest();
    std::size_t low = 0, high = n; // n * gap(height[low]) < n_times
    while (high - low > 1)
      {
        const std::size_t mid = low + (high - low) / 2;
        if (static_cast<double>(mid) * height[mid] - prefix_sum[mid] < n_times)
          low = mid;
        else
          high = mid;
      }
    return (n_times + prefix_sum[low + 1]) / static_cast<double>(low + 1);
  }

  double
  HeightDistribution::cut_height_for_contact_fraction(const double contact_fraction) const
  {
    const double n = static_cast<double>(height.size());
    // A fraction that is a whole number of pixels up to round-off must not ask for one more.
    const double pixels = std::clamp(std::ceil(contact_fraction * n * (1. - 1e-14)), 1., n);
    return height[height.size() - static_cast<std::size_t>(pixels)];
  }
} // namespace tribodraw
