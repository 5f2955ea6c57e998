#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/roughness.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tribodraw
{
  namespace
  {
    using Heights = Eigen::Map<const Eigen::ArrayXd>;

    double
    mean_of(const HeightMap &map)
    {
      return Heights(map.z.data(), map.z.size()).mean();
    }

    double
    variance_of(const HeightMap &map, double mean)
    {
      return (Heights(map.z.data(), map.z.size()) - mean).square().mean();
    }

    void
    check_not_empty(const HeightMap &map)
    {
      if (map.size() == 0)
        throw InputError(describe_error("the surface has no heights.", map.description));
    }
  } // namespace

  Roughness
  roughness(const HeightMap &map)
  {
    check_not_empty(map);
    const double         mean = mean_of(map), variance = variance_of(map, mean);
    const Eigen::ArrayXd z = Heights(map.z.data(), map.z.size()) - mean;
    if (!(variance > 0.))
      throw InputError(describe_error("all heights of the surface are equal.", map.description));
    Roughness r;
    r.sq  = std::sqrt(variance);
    r.sa  = z.abs().mean();
    r.ssk = (z * z * z).mean() / (variance * r.sq);
    r.sku = z.square().square().mean() / (variance * variance);
    r.sp  = z.maxCoeff();
    r.sv  = -z.minCoeff();
    r.sz  = r.sp + r.sv;
    return r;
  }

  HeightHistogram
  height_histogram(const HeightMap &map, unsigned n_bins)
  {
    check_not_empty(map);
    if (n_bins == 0)
      throw InputError(describe_error("a histogram needs bins.", map.description, "0", "at least 1"));
    const double um = units::factor("um"), mean = mean_of(map);
    const auto   extremes = std::minmax_element(map.z.begin(), map.z.end());
    const double low = (*extremes.first - mean) / um, high = (*extremes.second - mean) / um,
                 width = (high - low) / n_bins;
    if (!(width > 0.))
      throw InputError(describe_error("all heights of the surface are equal.", map.description));

    HeightHistogram histogram;
    for (unsigned i = 0; i <= n_bins; ++i)
      histogram.edges.push_back(i < n_bins ? low + i * width : high);
    histogram.density.assign(n_bins, 0.);
    const double share = 1. / (static_cast<double>(map.size()) * width);
    for (const double z : map.z)
      {
        const auto bin = static_cast<unsigned>(std::max(0., ((z - mean) / um - low) / width));
        histogram.density[std::min(bin, n_bins - 1)] += share;
      }
    return histogram;
  }

  AbbottCurve
  abbott_curve(const HeightMap &map, unsigned n_points)
  {
    check_not_empty(map);
    if (n_points < 2)
      throw InputError(
          describe_error("an Abbott curve needs points.", map.description, std::to_string(n_points), "at least 2"));
    const double        um = units::factor("um"), mean = mean_of(map);
    std::vector<double> sorted = map.z;
    std::sort(sorted.begin(), sorted.end(), std::greater<double>());
    AbbottCurve curve;
    for (unsigned i = 0; i < n_points; ++i)
      {
        const double ratio = static_cast<double>(i) / (n_points - 1);
        const double at    = ratio * static_cast<double>(sorted.size() - 1);
        const auto   k     = std::min(static_cast<std::size_t>(at), sorted.size() - 1);
        const auto   next  = std::min(k + 1, sorted.size() - 1);
        const double part  = at - static_cast<double>(k);
        curve.material_ratio.push_back(ratio);
        curve.height.push_back(((1. - part) * sorted[k] + part * sorted[next] - mean) / um);
      }
    return curve;
  }
} // namespace tribodraw
