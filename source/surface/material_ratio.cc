#include <tribodraw/base/errors.h>
#include <tribodraw/surface/material_ratio.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tribodraw
{
  MaterialRatioCurve::MaterialRatioCurve(const HeightMap &map) : sorted(map.z)
  {
    if (map.size() == 0)
      throw InputError(describe_error("the surface has no heights.", map.description));
    Eigen::Map<Eigen::ArrayXd> z(sorted.data(), static_cast<Eigen::Index>(sorted.size()));
    z -= z.mean();
    std::sort(sorted.begin(), sorted.end(), std::greater<double>());
    step       = std::max<std::size_t>(1, sorted.size() / 4096);
    double sum = 0.;
    up_to.push_back(0.);
    for (std::size_t i = 0; i < sorted.size(); ++i)
      {
        sum += sorted[i];
        if ((i + 1) % step == 0)
          up_to.push_back(sum);
      }
  }

  double
  MaterialRatioCurve::height(double ratio) const
  {
    const double at
        = std::clamp(ratio * static_cast<double>(sorted.size()) - 0.5, 0., static_cast<double>(sorted.size() - 1));
    const auto        k    = static_cast<std::size_t>(at);
    const std::size_t next = std::min(k + 1, sorted.size() - 1);
    const double      part = at - static_cast<double>(k);
    return (1. - part) * sorted[k] + part * sorted[next];
  }

  double
  MaterialRatioCurve::ratio(double c) const
  {
    const auto n = static_cast<double>(sorted.size());
    if (c >= sorted.front())
      return 0.;
    if (c <= sorted.back())
      return 1.;
    // sorted[k - 1] > c >= sorted[k]; equal heights count as below
    const auto k = std::partition_point(sorted.begin(), sorted.end(), [&](double z) { return z > c; }) - sorted.begin();
    const double above = sorted[static_cast<std::size_t>(k - 1)], below = sorted[static_cast<std::size_t>(k)];
    return (static_cast<double>(k) - 0.5 + (above - c) / (above - below)) / n;
  }

  double
  MaterialRatioCurve::integral(double ratio) const
  {
    const double      points = std::clamp(ratio, 0., 1.) * static_cast<double>(sorted.size());
    const std::size_t whole  = std::min(static_cast<std::size_t>(points), sorted.size());
    double            sum    = up_to[whole / step];
    for (std::size_t i = whole / step * step; i < whole; ++i)
      sum += sorted[i];
    if (whole < sorted.size())
      sum += (points - static_cast<double>(whole)) * sorted[whole];
    return sum / static_cast<double>(sorted.size());
  }

  double
  MaterialRatioCurve::material_volume(double ratio) const
  {
    return integral(ratio) - ratio * height(ratio);
  }

  double
  MaterialRatioCurve::void_volume(double ratio) const
  {
    return (1. - ratio) * height(ratio) - (integral(1.) - integral(ratio));
  }

  FunctionalParameters
  MaterialRatioCurve::functional_parameters() const
  {
    FunctionalParameters f;
    const std::size_t    n = sorted.size(), span = static_cast<std::size_t>(std::lround(0.4 * static_cast<double>(n)));
    if (span >= 1 && span < n)
      {
        std::size_t first = 0;
        for (std::size_t i = 1; i + span < n; ++i)
          if (sorted[i] - sorted[i + span] < sorted[first] - sorted[first + span])
            first = i;
        // least squares over the points first ... first + span
        double       sum = 0., moment = 0., squares = 0.;
        const double centre = 0.5 * static_cast<double>(span);
        for (std::size_t k = 0; k <= span; ++k)
          {
            const double t = static_cast<double>(k) - centre;
            sum += sorted[first + k];
            moment += t * sorted[first + k];
            squares += t * t;
          }
        const double slope = moment / squares * static_cast<double>(n); // per unit of material ratio
        const double mean  = sum / static_cast<double>(span + 1),
                     at    = (static_cast<double>(first) + centre + 0.5) / static_cast<double>(n);
        const double top = mean - slope * at, bottom = top + slope;
        f.sk   = top - bottom;
        f.smr1 = ratio(top);
        f.smr2 = ratio(bottom);
        if (f.smr1 > 0.)
          f.spk = std::max(0., 2. * (integral(f.smr1) / f.smr1 - top));
        if (f.smr2 < 1.)
          f.svk = std::max(0., 2. * (bottom - (integral(1.) - integral(f.smr2)) / (1. - f.smr2)));
      }
    f.vmp = material_volume(0.1);
    f.vmc = material_volume(0.8) - f.vmp;
    f.vvv = void_volume(0.8);
    f.vvc = void_volume(0.1) - f.vvv;
    return f;
  }
} // namespace tribodraw
