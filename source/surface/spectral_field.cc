#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/fourier.h>
#include <tribodraw/surface/spectral_field.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Power spectrum of the autocorrelation function (up to a factor) at the wave numbers of the periodic grid: the
    /// Gaussian exp(-(l_a^2 k_a^2 + l_b^2 k_b^2) / 2).
    double
    power(const LayCorrelation &c, double kx, double ky)
    {
      const double cosine = std::cos(c.angle), sine = std::sin(c.angle);
      const double a = c.lengths[0] * (kx * cosine + ky * sine), b = c.lengths[1] * (-kx * sine + ky * cosine);
      return std::exp(-0.5 * (a * a + b * b));
    }

    double
    wave_number(std::size_t k, std::size_t n, double step)
    {
      const double index = static_cast<double>(k) - (2 * k > n ? static_cast<double>(n) : 0.);
      return 2. * M_PI * index / (static_cast<double>(n) * step);
    }

    /// The power at every point of the half spectrum.
    HalfSpectrum
    gaussian_power(const Grid &grid, const LayCorrelation &correlation)
    {
      HalfSpectrum s;
      s.px   = grid.nx;
      s.py   = grid.ny;
      s.rows = grid.ny;
      s.values.resize(s.rows * s.n_kx());
      for (std::size_t row = 0; row < s.rows; ++row)
        for (std::size_t k = 0; k < s.n_kx(); ++k)
          s.values[row * s.n_kx() + k]
              = power(correlation, wave_number(k, grid.nx, grid.dx), wave_number(row, grid.ny, grid.dy));
      return s;
    }

    void
    transform_columns(HalfSpectrum &spectrum, bool forward)
    {
      for_each_column(spectrum, true, [&](std::size_t, std::complex<double> *column, FourierTransform &transform) {
        forward ? transform.forward(column) : transform.inverse(column);
      });
    }

    /// Power spectrum of change(autocorrelation function).
    HalfSpectrum
    changed_power(HalfSpectrum spectrum, const Grid &grid, const CorrelationMap &change)
    {
      transform_columns(spectrum, false);
      std::vector<double> correlation = inverse_transform_rows(spectrum, grid.nx);
      const double        variance    = correlation[0];
      for (double &c : correlation)
        c = change(std::clamp(c / variance, 0., 1.));
      spectrum = transform_rows(correlation, grid.nx, grid.ny, 0., grid.nx, grid.ny);
      transform_columns(spectrum, true);
      return spectrum;
    }
  } // namespace

  std::vector<double>
  spectral_field(const Grid &grid, const LayCorrelation &correlation, NormalDeviates &deviates,
                 const CorrelationMap &change)
  {
    std::vector<double> noise(grid.nx * grid.ny);
    std::generate(noise.begin(), noise.end(), [&] { return deviates(); });
    HalfSpectrum target = gaussian_power(grid, correlation);
    if (change)
      target = changed_power(std::move(target), grid, change);
    HalfSpectrum spectrum = transform_rows(noise, grid.nx, grid.ny, 0., grid.nx, grid.ny);
    transform_columns(spectrum, true);
    for (std::size_t i = 0; i < spectrum.values.size(); ++i)
      spectrum.values[i] *= std::sqrt(std::max(0., target.values[i].real()));
    transform_columns(spectrum, false);
    std::vector<double> field = inverse_transform_rows(spectrum, grid.nx);
    normalise(field);
    return field;
  }

  LayCorrelation
  read_lay_correlation(Parameters &parameters)
  {
    LayCorrelation c;
    c.lengths = read_correlation_lengths(parameters, "Correlation length",
                                         "Correlation length of the heights; with a lay angle x means along the lay.");
    c.angle
        = parameters.quantity("Lay angle", "deg", Range::between(-180., 180.),
                              "Angle of the lay, along which the first correlation length holds, against x (rolling "
                              "direction), counter-clockwise.",
                              Default{ "0 deg", "the lay is along x" });
    return c;
  }

  std::string
  correlation_problem(const std::string &entry, const Grid &grid, const LayCorrelation &c)
  {
    // Extent of the ellipse of the two lengths along the axes of the grid; the longest and shortest are the lengths.
    const double cosine = std::cos(c.angle), sine = std::sin(c.angle);
    const double along_x        = std::hypot(c.lengths[0] * cosine, c.lengths[1] * sine),
                 along_y        = std::hypot(c.lengths[0] * sine, c.lengths[1] * cosine);
    const std::string name      = "`" + entry + "`";
    constexpr double  tolerance = 1e-9;
    for (const double length : c.lengths)
      if (length < std::max(grid.dx, grid.dy) * (1. - tolerance))
        return name + " of " + units::format(length, "um") + " is below the pixel size "
               + units::format(std::max(grid.dx, grid.dy), "um");
    const double extent[] = { static_cast<double>(grid.nx) * grid.dx, static_cast<double>(grid.ny) * grid.dy };
    if (4. * along_x > extent[0] * (1. + tolerance) || 4. * along_y > extent[1] * (1. + tolerance))
      return name + " is more than a quarter of the map (" + units::format(extent[0], "um") + ")";
    return {};
  }
} // namespace tribodraw
