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

    /// Sum over all pairs of pixels @p lag apart, along x or y.
    double
    pair_sum(const HeightMap &map, double mean, std::size_t lag, bool along_x)
    {
      double     sum = 0;
      const auto row
          = [&](std::size_t ix, std::size_t iy, std::size_t n) { return Heights(map.z.data() + iy * map.nx + ix, n); };
      const auto add = [&](const Heights &a, const Heights &b) { sum += ((a - mean) * (b - mean)).sum(); };
      if (along_x)
        for (std::size_t iy = 0; iy < map.ny; ++iy)
          {
            add(row(0, iy, map.nx - lag), row(lag, iy, map.nx - lag));
            if (map.periodic)
              add(row(map.nx - lag, iy, lag), row(0, iy, lag));
          }
      else
        for (std::size_t iy = 0; iy < map.ny; ++iy)
          if (iy + lag < map.ny || map.periodic)
            add(row(0, iy, map.nx), row(0, (iy + lag) % map.ny, map.nx));
      return sum;
    }

    double
    autocorrelation(const HeightMap &map, double mean, double variance, std::size_t lag, bool along_x)
    {
      const std::size_t n = along_x ? map.nx : map.ny, other = along_x ? map.ny : map.nx;
      const double      pairs = static_cast<double>(map.periodic ? n : n - lag) * static_cast<double>(other);
      return pair_sum(map, mean, lag, along_x) / (pairs * variance);
    }

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

    double
    autocorrelation(const HeightMap &map, std::size_t lag, bool along_x)
    {
      if (lag >= (along_x ? map.nx : map.ny))
        throw InputError(describe_error("the lag exceeds the map.", map.description, std::to_string(lag) + " pixels"));
      const double mean = mean_of(map);
      return autocorrelation(map, mean, variance_of(map, mean), lag, along_x);
    }

    std::optional<double>
    decay_length(const HeightMap &map, double mean, double variance, bool along_x)
    {
      constexpr double  threshold = 0.2;
      const std::size_t n         = along_x ? map.nx : map.ny;
      double            last      = 1.;
      for (std::size_t lag = 1; lag <= n / 2 && lag < n; ++lag)
        {
          const double value = autocorrelation(map, mean, variance, lag, along_x);
          if (value <= threshold)
            {
              const double part = (last - threshold) / (last - value);
              return (static_cast<double>(lag - 1) + part) * (along_x ? map.dx : map.dy);
            }
          last = value;
        }
      return {};
    }

    void
    check_not_empty(const HeightMap &map)
    {
      if (map.size() == 0)
        throw InputError(describe_error("the surface has no heights.", map.description));
    }
  } // namespace

  double
  autocorrelation_x(const HeightMap &map, std::size_t lag)
  {
    return autocorrelation(map, lag, true);
  }

  double
  autocorrelation_y(const HeightMap &map, std::size_t lag)
  {
    return autocorrelation(map, lag, false);
  }

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

    r.autocorrelation_length_x = decay_length(map, mean, variance, true);
    r.autocorrelation_length_y = decay_length(map, mean, variance, false);
    return r;
  }

  std::vector<RoughnessRow>
  roughness_rows(const HeightMap &map, const Roughness &r)
  {
    const double              um = units::factor("um");
    std::vector<RoughnessRow> rows{ { "pixels_x", static_cast<double>(map.nx), "1" },
                                    { "pixels_y", static_cast<double>(map.ny), "1" },
                                    { "pixel_size_x", map.dx / um, "um" },
                                    { "pixel_size_y", map.dy / um, "um" },
                                    { "Sa", r.sa / um, "um" },
                                    { "Sq", r.sq / um, "um" },
                                    { "Ssk", r.ssk, "1" },
                                    { "Sku", r.sku, "1" },
                                    { "Sp", r.sp / um, "um" },
                                    { "Sv", r.sv / um, "um" },
                                    { "Sz", r.sz / um, "um" } };
    if (r.autocorrelation_length_x)
      rows.push_back({ "autocorrelation_length_x", *r.autocorrelation_length_x / um, "um" });
    if (r.autocorrelation_length_y)
      rows.push_back({ "autocorrelation_length_y", *r.autocorrelation_length_y / um, "um" });
    return rows;
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
