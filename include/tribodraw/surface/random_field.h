#ifndef tribodraw_surface_random_field_h
#define tribodraw_surface_random_field_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// A regular grid of pixels; lengths in mm.
  struct Grid
  {
    std::size_t nx = 0, ny = 0;
    double      dx = 0, dy = 0;
  };

  /// Standard normal deviates, the same sequence on every machine: the Mersenne twister std::mt19937_64 (its bits are
  /// fixed by the C++ standard; the standard's distributions are not and are therefore not used), two draws a and b
  /// turned into u = ((a >> 11) + 1) / 2^53 in (0, 1] and v = (b >> 11) / 2^53 in [0, 1), and the Box-Muller pair
  /// sqrt(-2 ln u) cos(2 pi v), sqrt(-2 ln u) sin(2 pi v), in this order. Only the last bit may depend on the
  /// mathematical library.
  class NormalDeviates
  {
  public:
    explicit NormalDeviates(std::uint64_t seed);
    double operator()();
    /// A number in [0, 1): one draw a, (a >> 11) / 2^53. Does not disturb the pairs of normal deviates.
    double uniform();

  private:
    std::mt19937_64 engine;
    double          second     = 0;
    bool            has_second = false;
  };

  /// Correlation lengths along x and y in mm: the autocorrelation function is
  /// exp(-(x^2 / (2 lx^2) + y^2 / (2 ly^2))), which is exp(-1/2) = 0.607 at x = lx.
  using CorrelationLengths = std::array<double, 2>;

  /// Periodic Gaussian random field with that autocorrelation, zero mean and unit variance (exactly, for the discrete
  /// map). White noise is filtered with the Gaussian whose self-convolution is the autocorrelation, separably and
  /// without Fourier transform, so that any number of pixels is equally fast.
  std::vector<double> gaussian_field(const Grid &grid, const CorrelationLengths &lengths, NormalDeviates &deviates);

  /// Shift and scale to zero mean and unit variance. Throws InputError if all values are equal.
  void normalise(std::vector<double> &values);

  /// Reads a correlation length: one value (isotropic) or two (along x and y).
  CorrelationLengths read_correlation_lengths(Parameters &parameters, const std::string &entry,
                                              const std::string &documentation);

  /// The grid must resolve the correlation lengths (at least one pixel) and hold at least four of them, otherwise the
  /// map has another autocorrelation than asked for. @return what is wrong, or nothing.
  std::string correlation_problem(const std::string &entry, const Grid &grid, const CorrelationLengths &lengths);
} // namespace tribodraw

#endif
