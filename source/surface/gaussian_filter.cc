#include <tribodraw/base/parallel.h>
#include <tribodraw/surface/fourier.h>
#include <tribodraw/surface/gaussian_filter.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Line      = Eigen::Map<Eigen::ArrayXd>;
    using ConstLine = Eigen::Map<const Eigen::ArrayXd>;

    /// Half of the kernel, from the centre on. pi / alpha^2 = pi^2 / ln 2.
    std::vector<double>
    half_kernel(double cut_off)
    {
      std::vector<double> weights(static_cast<std::size_t>(std::floor(cut_off)) + 1);
      const double        rate = M_PI * M_PI / std::log(2.);
      for (std::size_t k = 0; k < weights.size(); ++k)
        weights[k] = std::exp(-rate * std::pow(static_cast<double>(k) / cut_off, 2));
      return weights;
    }

    /// Reach of the kernel above which a transform is faster than the direct sum.
    constexpr std::size_t longest_direct = 40;
  } // namespace

  struct LineFilter::Implementation
  {
    Implementation(std::size_t points, double cut_off, bool continued)
        : n(points), periodic(continued), weights(half_kernel(cut_off))
    {
      scale.resize(n);
      double              sum = weights[0];
      std::vector<double> up_to(weights.size()); // sum of weights[1..k]
      for (std::size_t k = 1; k < weights.size(); ++k)
        {
          up_to[k] = up_to[k - 1] + weights[k];
          sum += 2. * weights[k];
        }
      for (std::size_t i = 0; i < n; ++i)
        {
          const std::size_t left = std::min(i, weights.size() - 1), right = std::min(n - 1 - i, weights.size() - 1);
          scale[i] = 1. / (periodic ? sum : weights[0] + up_to[left] + up_to[right]);
        }
      if (weights.size() - 1 > longest_direct)
        prepare_transform();
      else
        padded.resize(n + 2 * weights.size());
    }

    void
    prepare_transform()
    {
      const std::size_t reach = weights.size() - 1;
      transform = std::make_unique<FourierTransform>(periodic ? n : FourierTransform::good_length(n + reach));
      const std::size_t length = transform->length();
      kernel.assign(length, 0.);
      kernel[0] = weights[0];
      for (std::size_t k = 1; k <= reach; ++k)
        {
          // Wraps around as often as necessary. In a line that does not repeat itself it meets the zeros behind its
          // end; weights that reach beyond the whole line meet nothing and are left out.
          if (!periodic && k >= n)
            break;
          kernel[k % length] += weights[k];
          kernel[(length - k % length) % length] += weights[k];
        }
      transform->forward(kernel.data());
      line.resize(length);
    }

    void
    apply_transform(double *first, double *second)
    {
      std::fill(line.begin(), line.end(), 0.);
      for (std::size_t i = 0; i < n; ++i)
        line[i] = { first[i], second[i] };
      transform->forward(line.data());
      for (std::size_t k = 0; k < line.size(); ++k)
        line[k] *= kernel[k].real(); // of a symmetric kernel
      transform->inverse(line.data());
      for (std::size_t i = 0; i < n; ++i)
        {
          first[i]  = scale[i] * line[i].real();
          second[i] = scale[i] * line[i].imag();
        }
    }

    void
    apply_directly(double *values)
    {
      const std::size_t reach = weights.size() - 1;
      for (std::size_t i = 0; i < reach; ++i)
        {
          padded[i]             = periodic ? values[(n - reach % n + i) % n] : 0.;
          padded[reach + n + i] = periodic ? values[i % n] : 0.;
        }
      std::copy(values, values + n, padded.begin() + static_cast<std::ptrdiff_t>(reach));
      const auto at = [&](std::size_t shift) { return ConstLine(padded.data() + shift, static_cast<Eigen::Index>(n)); };
      Line       result(values, static_cast<Eigen::Index>(n));
      result = weights[0] * at(reach);
      for (std::size_t k = 1; k <= reach; ++k)
        result += weights[k] * (at(reach - k) + at(reach + k));
      result *= ConstLine(scale.data(), static_cast<Eigen::Index>(n));
    }

    std::size_t                       n;
    bool                              periodic;
    std::vector<double>               weights, scale, padded;
    std::unique_ptr<FourierTransform> transform;
    std::vector<std::complex<double>> kernel, line;
  };

  LineFilter::LineFilter(std::size_t n, double cut_off, bool periodic)
      : data(std::make_unique<Implementation>(n, cut_off, periodic))
  {
  }

  LineFilter::~LineFilter()                      = default;
  LineFilter::LineFilter(LineFilter &&) noexcept = default;

  void
  LineFilter::apply(double *first, double *second)
  {
    if (data->transform)
      return data->apply_transform(first, second);
    data->apply_directly(first);
    if (second != first)
      data->apply_directly(second);
  }

  void
  gaussian_low_pass(HeightMap &map, double cut_off)
  {
    const std::size_t nx = map.nx, ny = map.ny;
    if (map.size() == 0)
      return;
    parallel::for_range((ny + 1) / 2, 8, [&](std::size_t begin, std::size_t end) {
      LineFilter          filter(nx, cut_off / map.dx, map.periodic);
      std::vector<double> spare(nx);
      for (std::size_t pair = begin; pair < end; ++pair)
        filter.apply(map.z.data() + 2 * pair * nx,
                     2 * pair + 1 < ny ? map.z.data() + (2 * pair + 1) * nx : spare.data());
    });
    constexpr std::size_t block = 16; // columns gathered at once, an even number
    parallel::for_range((nx + block - 1) / block, 1, [&](std::size_t begin, std::size_t end) {
      LineFilter          filter(ny, cut_off / map.dy, map.periodic);
      std::vector<double> columns(block * ny);
      for (std::size_t b = begin; b < end; ++b)
        {
          const std::size_t first = b * block, n = std::min(block, nx - first);
          if (n % 2 == 1) // the partner of the last column
            std::fill_n(columns.begin() + static_cast<std::ptrdiff_t>(n * ny), ny, 0.);
          for (std::size_t iy = 0; iy < ny; ++iy)
            for (std::size_t i = 0; i < n; ++i)
              columns[i * ny + iy] = map(first + i, iy);
          for (std::size_t i = 0; i < n; i += 2)
            filter.apply(columns.data() + i * ny, columns.data() + (i + 1) * ny);
          for (std::size_t iy = 0; iy < ny; ++iy)
            for (std::size_t i = 0; i < n; ++i)
              map(first + i, iy) = columns[i * ny + iy];
        }
    });
  }
} // namespace tribodraw
