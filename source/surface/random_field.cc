#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/random_field.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Row      = Eigen::Map<Eigen::ArrayXd>;
    using ConstRow = Eigen::Map<const Eigen::ArrayXd>;

    constexpr double two_pi = 6.283185307179586476925286766559;

    /// One half (index 0 is the centre) of the Gaussian whose self-convolution is exp(-x^2 / (2 l^2)): its standard
    /// deviation is l / sqrt(2). Beyond 6.5 standard deviations it is below 1e-9.
    std::vector<double>
    half_kernel(double length_in_pixels)
    {
      const double        deviation = length_in_pixels / std::sqrt(2.);
      std::vector<double> weights(static_cast<std::size_t>(std::ceil(6.5 * deviation)) + 1);
      for (std::size_t k = 0; k < weights.size(); ++k)
        weights[k] = std::exp(-0.5 * std::pow(static_cast<double>(k) / deviation, 2));
      return weights;
    }

    void
    filter_along_x(const Grid &grid, const std::vector<double> &weights, std::vector<double> &values)
    {
      const std::size_t n = grid.nx, reach = weights.size() - 1;
      parallel::for_range(grid.ny, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<double> padded(n + 2 * reach);
        for (std::size_t iy = begin; iy < end; ++iy)
          {
            double *row = values.data() + iy * n;
            // The map repeats itself: pixel i of the padded row is pixel i - reach of the periodic one. The kernel may
            // be longer than the map.
            const std::size_t first = n - 1 - (reach + n - 1) % n;
            for (std::size_t i = 0; i < padded.size(); ++i)
              padded[i] = row[(first + i) % n];
            Row result(row, n);
            result = weights[0] * ConstRow(padded.data() + reach, n);
            for (std::size_t k = 1; k <= reach; ++k)
              result += weights[k] * (ConstRow(padded.data() + reach - k, n) + ConstRow(padded.data() + reach + k, n));
          }
      });
    }

    void
    filter_along_y(const Grid &grid, const std::vector<double> &weights, std::vector<double> &values)
    {
      const std::size_t         nx = grid.nx, ny = grid.ny, reach = weights.size() - 1;
      const std::vector<double> old = values;
      parallel::for_range(ny, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t iy = begin; iy < end; ++iy)
          {
            const auto row = [&](std::size_t i) { return ConstRow(old.data() + (i % ny) * nx, nx); };
            Row        result(values.data() + iy * nx, nx);
            result = weights[0] * row(iy);
            for (std::size_t k = 1; k <= reach; ++k)
              result += weights[k] * (row(iy + k) + row(iy + ny - k % ny));
          }
      });
    }
  } // namespace

  NormalDeviates::NormalDeviates(std::uint64_t seed) : engine(seed)
  {
  }

  double
  NormalDeviates::operator()()
  {
    if (has_second)
      {
        has_second = false;
        return second;
      }
    constexpr double unit   = 1. / 9007199254740992.; // 2^-53
    const double     u      = static_cast<double>((engine() >> 11) + 1) * unit;
    const double     v      = static_cast<double>(engine() >> 11) * unit;
    const double     radius = std::sqrt(-2. * std::log(u));
    second                  = radius * std::sin(two_pi * v);
    has_second              = true;
    return radius * std::cos(two_pi * v);
  }

  double
  NormalDeviates::uniform()
  {
    return static_cast<double>(engine() >> 11) / 9007199254740992.; // 2^53
  }

  void
  normalise(std::vector<double> &values)
  {
    Row array(values.data(), values.size());
    array -= array.mean();
    const double deviation = std::sqrt(array.square().mean());
    if (!(deviation > 0.))
      throw InputError(describe_error("all generated heights are equal.", "surface texture"));
    array /= deviation;
  }

  std::vector<double>
  gaussian_field(const Grid &grid, const CorrelationLengths &lengths, NormalDeviates &deviates)
  {
    std::vector<double> values(grid.nx * grid.ny);
    std::generate(values.begin(), values.end(), [&] { return deviates(); });
    filter_along_x(grid, half_kernel(lengths[0] / grid.dx), values);
    filter_along_y(grid, half_kernel(lengths[1] / grid.dy), values);
    normalise(values);
    return values;
  }

  CorrelationLengths
  read_correlation_lengths(Parameters &parameters, const std::string &entry, const std::string &documentation)
  {
    const auto lengths
        = parameters.quantity_list(entry, "um", Range::positive().usual(0.1, 1000.),
                                   documentation
                                       + " One value, or two: along x (rolling direction) and y. The autocorrelation "
                                         "function is exp(-(x^2/(2 lx^2) + y^2/(2 ly^2))).");
    if (lengths.size() > 2 && !parameters.documentation_mode())
      parameters.problem(entry, std::to_string(lengths.size()) + " values are given.", "one value, or two (x, y)");
    if (lengths.empty())
      return { 1., 1. }; // the list was wrong and is reported
    return { lengths[0], lengths.size() > 1 ? lengths[1] : lengths[0] };
  }

  std::string
  correlation_problem(const std::string &entry, const Grid &grid, const CorrelationLengths &lengths)
  {
    const std::array<double, 2>       step{ grid.dx, grid.dy }, extent{ grid.nx * grid.dx, grid.ny * grid.dy };
    const std::array<const char *, 2> axis{ " along x", " along y" };
    // Lengths and pixel sizes that are meant to be equal may differ in the last bit.
    constexpr double tolerance = 1e-9;
    for (int i = 0; i < 2; ++i)
      {
        const std::string name = "`" + entry + "`" + axis[i] + " of " + units::format(lengths[i], "um");
        if (lengths[i] < step[i] * (1. - tolerance))
          return name + " is below the pixel size " + units::format(step[i], "um");
        if (4. * lengths[i] > extent[i] * (1. + tolerance))
          return name + " is more than a quarter of the map (" + units::format(extent[i], "um") + ")";
      }
    return {};
  }
} // namespace tribodraw
