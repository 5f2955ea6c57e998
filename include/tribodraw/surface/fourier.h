#ifndef tribodraw_surface_fourier_h
#define tribodraw_surface_fourier_h

#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

namespace tribodraw
{
  /// Discrete Fourier transform of any length in O(n log n): Eigen's (kissfft), and for lengths with a prime factor
  /// above 100 Bluestein's algorithm on top of it (L. Bluestein, IEEE Trans. Audio Electroacoust. 18 (1970) 451-455).
  /// An object may be used by one thread at a time.
  class FourierTransform
  {
  public:
    using Complex = std::complex<double>;

    explicit FourierTransform(std::size_t length);
    ~FourierTransform();

    std::size_t length() const;
    /// values[k] <- sum_j values[j] exp(-2 pi i j k / n).
    void forward(Complex *values);
    /// values[j] <- 1/n sum_k values[k] exp(+2 pi i j k / n).
    void inverse(Complex *values);

    /// The smallest length of at least @p n that has no prime factor above 5.
    static std::size_t good_length(std::size_t n);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };

  /// Non-negative half along x of the two-dimensional transform of real values: n_kx = px / 2 + 1 columns.
  /// Along y the length may be larger than the number of rows that are stored (zeros follow).
  struct HalfSpectrum
  {
    std::size_t                       px = 0, py = 0; ///< lengths of the transform
    std::size_t                       rows = 0;       ///< stored rows
    std::vector<std::complex<double>> values;         ///< values[row * n_kx() + kx]

    std::size_t
    n_kx() const
    {
      return px / 2 + 1;
    }
  };

  /// Transform along x of @p rows rows of @p nx real values each, filled up with zeros to the length @p px.
  /// @param weight_x, weight_y factors of each column and row (a window); empty: one.
  HalfSpectrum transform_rows(const std::vector<double> &values, std::size_t nx, std::size_t rows, double mean,
                              std::size_t px, std::size_t py, const std::vector<double> &weight_x = {},
                              const std::vector<double> &weight_y = {});
  /// The real rows back; the first @p nx values of each.
  std::vector<double> inverse_transform_rows(const HalfSpectrum &spectrum, std::size_t nx);

  /// Calls body(kx, column, transform) for every kx on the threads of the process. The column holds the stored rows,
  /// then zeros up to py; with @p write_back the stored rows are replaced by it afterwards.
  template <class Body>
  void for_each_column(HalfSpectrum &spectrum, bool write_back, const Body &body);
} // namespace tribodraw

#include <tribodraw/base/parallel.h>

#include <algorithm>

namespace tribodraw
{
  template <class Body>
  void
  for_each_column(HalfSpectrum &spectrum, bool write_back, const Body &body)
  {
    constexpr std::size_t block = 16; // columns gathered at once, so that whole cache lines are used
    const std::size_t     n_kx  = spectrum.n_kx();
    parallel::for_range((n_kx + block - 1) / block, 1, [&](std::size_t begin, std::size_t end) {
      FourierTransform                  transform(spectrum.py);
      std::vector<std::complex<double>> columns(block * spectrum.py);
      for (std::size_t b = begin; b < end; ++b)
        {
          const std::size_t first = b * block, n = std::min(block, n_kx - first);
          std::fill(columns.begin(), columns.end(), 0.);
          for (std::size_t row = 0; row < spectrum.rows; ++row)
            for (std::size_t i = 0; i < n; ++i)
              columns[i * spectrum.py + row] = spectrum.values[row * n_kx + first + i];
          for (std::size_t i = 0; i < n; ++i)
            body(first + i, columns.data() + i * spectrum.py, transform);
          if (write_back)
            for (std::size_t row = 0; row < spectrum.rows; ++row)
              for (std::size_t i = 0; i < n; ++i)
                spectrum.values[row * n_kx + first + i] = columns[i * spectrum.py + row];
        }
    });
  }
} // namespace tribodraw

#endif
