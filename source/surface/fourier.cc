#include <tribodraw/surface/fourier.h>

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Complex = FourierTransform::Complex;

    std::size_t
    largest_prime_factor(std::size_t n)
    {
      std::size_t largest = 1;
      for (std::size_t p = 2; p * p <= n; ++p)
        while (n % p == 0)
          {
            largest = p;
            n /= p;
          }
      return std::max(largest, n);
    }

    /// kissfft's general butterfly costs n times the factor: above this Bluestein's detour is shorter.
    constexpr std::size_t largest_direct_factor = 100;
  } // namespace

  struct FourierTransform::Implementation
  {
    explicit Implementation(std::size_t length) : n(length)
    {
      fft.SetFlag(Eigen::FFT<double>::Unscaled);
      if (largest_prime_factor(n) <= largest_direct_factor)
        {
          buffer.resize(n);
          return;
        }
      // exp(-pi i k^2 / n): k^2 is reduced modulo 2 n in integers, so that no accuracy is lost for large k.
      chirp.resize(n);
      for (std::size_t k = 0; k < n; ++k)
        chirp[k] = std::polar(1., -M_PI * static_cast<double>(k * k % (2 * n)) / static_cast<double>(n));
      const std::size_t padded = good_length(2 * n - 1);
      kernel.assign(padded, 0.);
      for (std::size_t k = 0; k < n; ++k)
        kernel[k] = kernel[(padded - k) % padded] = std::conj(chirp[k]);
      buffer.resize(padded);
      work.resize(padded);
      fft.fwd(buffer.data(), kernel.data(), static_cast<int>(padded));
      kernel = buffer;
    }

    void
    forward(Complex *values)
    {
      if (n == 1) // which kissfft does not know
        return;
      if (chirp.empty())
        {
          fft.fwd(buffer.data(), values, static_cast<int>(n));
          std::copy(buffer.begin(), buffer.end(), values);
          return;
        }
      const int padded = static_cast<int>(kernel.size());
      std::fill(work.begin(), work.end(), 0.);
      for (std::size_t k = 0; k < n; ++k)
        work[k] = values[k] * chirp[k];
      fft.fwd(buffer.data(), work.data(), padded);
      for (std::size_t k = 0; k < kernel.size(); ++k)
        buffer[k] *= kernel[k];
      fft.inv(work.data(), buffer.data(), padded);
      for (std::size_t k = 0; k < n; ++k)
        values[k] = work[k] * chirp[k] / static_cast<double>(padded);
    }

    std::size_t          n;
    Eigen::FFT<double>   fft;
    std::vector<Complex> buffer, work, chirp, kernel;
  };

  FourierTransform::FourierTransform(std::size_t length) : data(std::make_unique<Implementation>(length))
  {
  }

  FourierTransform::~FourierTransform() = default;

  std::size_t
  FourierTransform::length() const
  {
    return data->n;
  }

  void
  FourierTransform::forward(Complex *values)
  {
    data->forward(values);
  }

  void
  FourierTransform::inverse(Complex *values)
  {
    const double scale = 1. / static_cast<double>(data->n);
    for (std::size_t k = 0; k < data->n; ++k)
      values[k] = std::conj(values[k]);
    data->forward(values);
    for (std::size_t k = 0; k < data->n; ++k)
      values[k] = scale * std::conj(values[k]);
  }

  std::size_t
  FourierTransform::good_length(std::size_t n)
  {
    for (std::size_t candidate = std::max<std::size_t>(n, 1);; ++candidate)
      {
        std::size_t rest = candidate;
        for (const std::size_t p : { 2, 3, 5 })
          while (rest % p == 0)
            rest /= p;
        if (rest == 1)
          return candidate;
      }
  }

  HalfSpectrum
  transform_rows(const std::vector<double> &values, std::size_t nx, std::size_t rows, double mean, std::size_t px,
                 std::size_t py, const std::vector<double> &weight_x, const std::vector<double> &weight_y)
  {
    HalfSpectrum spectrum;
    spectrum.px            = px;
    spectrum.py            = py;
    spectrum.rows          = rows;
    const std::size_t n_kx = spectrum.n_kx();
    spectrum.values.resize(rows * n_kx);
    // Two real rows are the real and imaginary part of one complex row.
    parallel::for_range((rows + 1) / 2, 8, [&](std::size_t begin, std::size_t end) {
      FourierTransform     transform(px);
      std::vector<Complex> line(px);
      for (std::size_t pair = begin; pair < end; ++pair)
        {
          const std::size_t a = 2 * pair, b = a + 1;
          const bool        both   = b < rows;
          const auto        weight = [&](std::size_t row, std::size_t i) {
            return (weight_y.empty() ? 1. : weight_y[row]) * (weight_x.empty() ? 1. : weight_x[i]);
          };
          std::fill(line.begin(), line.end(), 0.);
          for (std::size_t i = 0; i < nx; ++i)
            line[i] = Complex((values[a * nx + i] - mean) * weight(a, i),
                              both ? (values[b * nx + i] - mean) * weight(b, i) : 0.);
          transform.forward(line.data());
          for (std::size_t k = 0; k < n_kx; ++k)
            {
              const Complex here = line[k], mirror = std::conj(line[(px - k) % px]);
              spectrum.values[a * n_kx + k] = 0.5 * (here + mirror);
              if (both)
                spectrum.values[b * n_kx + k] = Complex(0., -0.5) * (here - mirror);
            }
        }
    });
    return spectrum;
  }

  std::vector<double>
  inverse_transform_rows(const HalfSpectrum &spectrum, std::size_t nx)
  {
    const std::size_t   rows = spectrum.rows, n_kx = spectrum.n_kx(), px = spectrum.px;
    std::vector<double> result(rows * nx);
    parallel::for_range((rows + 1) / 2, 8, [&](std::size_t begin, std::size_t end) {
      FourierTransform     transform(px);
      std::vector<Complex> line(px);
      for (std::size_t pair = begin; pair < end; ++pair)
        {
          const std::size_t a = 2 * pair, b = a + 1;
          const bool        both = b < rows;
          for (std::size_t k = 0; k < px; ++k)
            {
              const bool        half  = k < n_kx;
              const std::size_t at    = half ? k : px - k;
              const auto        value = [&](std::size_t row) {
                const Complex v = spectrum.values[row * n_kx + at];
                return half ? v : std::conj(v);
              };
              line[k] = value(a);
              if (both)
                line[k] += Complex(0., 1.) * value(b);
            }
          transform.inverse(line.data());
          for (std::size_t i = 0; i < nx; ++i)
            {
              result[a * nx + i] = line[i].real();
              if (both)
                result[b * nx + i] = line[i].imag();
            }
        }
    });
    return result;
  }
} // namespace tribodraw
