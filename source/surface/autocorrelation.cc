#include <tribodraw/base/errors.h>
#include <tribodraw/surface/autocorrelation.h>
#include <tribodraw/surface/fourier.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Heights = Eigen::Map<const Eigen::ArrayXd>;

    double
    mean_of(const HeightMap &map)
    {
      return Heights(map.z.data(), static_cast<Eigen::Index>(map.z.size())).mean();
    }

    std::vector<double>
    hann_window(std::size_t n)
    {
      std::vector<double> w(n);
      for (std::size_t i = 0; i < n; ++i)
        w[i] = std::pow(std::sin(M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(n)), 2);
      return w;
    }

    constexpr std::size_t n_angles = 360; ///< bins of the angular spectrum over 180 degrees

    /// Add @p power, spread evenly over the angles [centre - half, centre + half] in units of bins.
    void
    spread(double *bins, double centre, double half, double power)
    {
      half               = std::clamp(half, 0.5, 0.5 * n_angles);
      const double begin = centre - half, end = centre + half;
      const auto   n       = static_cast<std::ptrdiff_t>(n_angles);
      const double density = power / (2. * half);
      for (auto i = static_cast<std::ptrdiff_t>(std::floor(begin)); static_cast<double>(i) < end; ++i)
        bins[((i % n) + n) % n]
            += density * (std::min(end, static_cast<double>(i + 1)) - std::max(begin, static_cast<double>(i)));
    }

    /// Angle of the maximum of the smoothed spectrum, in degrees.
    double
    direction_of_maximum(const std::vector<double> &spectrum)
    {
      const auto          n = static_cast<std::ptrdiff_t>(spectrum.size());
      std::vector<double> smooth(spectrum.size(), 0.);
      constexpr double    deviation = 4.; // bins, that is 2 degrees
      for (std::ptrdiff_t i = 0; i < n; ++i)
        for (std::ptrdiff_t k = -12; k <= 12; ++k)
          smooth[static_cast<std::size_t>(i)] += spectrum[static_cast<std::size_t>((i + k + n) % n)]
                                                 * std::exp(-0.5 * std::pow(static_cast<double>(k) / deviation, 2));
      const auto   top   = std::max_element(smooth.begin(), smooth.end()) - smooth.begin();
      const double limit = 0.9 * smooth[static_cast<std::size_t>(top)];
      // The centre of gravity of the summit: a plateau, as of one wave of low frequency, has no distinct maximum.
      double     weight = 0., moment = 0.;
      const auto add = [&](std::ptrdiff_t k) {
        const double value = smooth[static_cast<std::size_t>((top + k + n) % n)];
        if (value < limit)
          return false;
        weight += value;
        moment += value * static_cast<double>(k);
        return true;
      };
      for (std::ptrdiff_t k = 0; k < n / 2 && add(k); ++k)
        ;
      for (std::ptrdiff_t k = -1; k > -n / 2 && add(k); --k)
        ;
      return (static_cast<double>(top) + 0.5 + moment / weight) * 180. / static_cast<double>(n);
    }
  } // namespace

  Autocorrelation::Autocorrelation(const HeightMap &map) : dx(map.dx), dy(map.dy)
  {
    if (map.size() == 0)
      throw InputError(describe_error("the surface has no heights.", map.description));
    mx                         = std::min(map.nx / 2, map.nx - 1);
    my                         = (map.ny - 1) / 2; // both signs fit into the rows of the spectrum
    const std::size_t px       = map.periodic ? map.nx : FourierTransform::good_length(map.nx + mx),
                      py       = map.periodic ? map.ny : FourierTransform::good_length(map.ny + my);
    HalfSpectrum      spectrum = transform_rows(map.z, map.nx, map.ny, mean_of(map), px, py);
    const std::size_t rows     = 2 * my + 1;
    for_each_column(spectrum, true, [&](std::size_t, std::complex<double> *column, FourierTransform &transform) {
      transform.forward(column);
      for (std::size_t i = 0; i < py; ++i)
        column[i] = std::norm(column[i]);
      transform.inverse(column);
      std::rotate(column, column + (py - my) % py, column + py); // the first rows are now the lags -my ... my
    });
    spectrum.rows = rows;
    spectrum.values.resize(rows * spectrum.n_kx());
    values = inverse_transform_rows(spectrum, mx + 1);

    const double variance = values[my * (mx + 1)] / static_cast<double>(map.size());
    if (!(variance > 0.))
      throw InputError(describe_error("all heights of the surface are equal.", map.description));
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t lx = 0; lx <= mx; ++lx)
        {
          const std::size_t ly    = row > my ? row - my : my - row;
          const double      pairs = map.periodic ? static_cast<double>(map.size())
                                                 : static_cast<double>(map.nx - lx) * static_cast<double>(map.ny - ly);
          values[row * (mx + 1) + lx] /= pairs * variance;
        }
  }

  double
  Autocorrelation::operator()(std::ptrdiff_t lag_x, std::ptrdiff_t lag_y) const
  {
    if (lag_x < 0)
      {
        lag_x = -lag_x;
        lag_y = -lag_y;
      }
    return values[static_cast<std::size_t>(lag_y + static_cast<std::ptrdiff_t>(my)) * (mx + 1)
                  + static_cast<std::size_t>(lag_x)];
  }

  double
  Autocorrelation::interpolate(double lag_x, double lag_y) const
  {
    // Lags at the edge of the domain may lie beyond it by rounding; maps of two rows have no lag along y at all.
    const double far_x = static_cast<double>(mx), far_y = static_cast<double>(my);
    lag_x           = std::min(lag_x, far_x);
    lag_y           = std::clamp(lag_y, -far_y, far_y);
    const double bx = std::min(std::floor(lag_x), std::max(far_x - 1., 0.)),
                 by = std::clamp(std::floor(lag_y), -far_y, std::max(far_y - 1., -far_y));
    const double tx = lag_x - bx, ty = lag_y - by;
    const auto   ix = static_cast<std::ptrdiff_t>(bx), iy = static_cast<std::ptrdiff_t>(by);
    const auto   row
        = [&](std::ptrdiff_t y) { return (1. - tx) * (*this)(ix, y) + (tx > 0. ? tx * (*this)(ix + 1, y) : 0.); };
    return (1. - ty) * row(iy) + (ty > 0. ? ty * row(iy + 1) : 0.);
  }

  std::optional<double>
  Autocorrelation::decay_length(double angle, double level) const
  {
    double cx = std::cos(angle) / dx, cy = std::sin(angle) / dy;
    if (std::abs(cx) < 1e-12 * std::abs(cy))
      cx = 0.;
    if (std::abs(cy) < 1e-12 * std::abs(cx))
      cy = 0.;
    const double sign = cx < 0. ? -1. : 1.; // the function is even
    // steps of one pixel along the faster axis
    const double step = 1. / std::max(std::abs(cx), std::abs(cy));
    double       last = 1.;
    for (std::size_t k = 1;; ++k)
      {
        const double r = static_cast<double>(k) * step, x = sign * cx * r, y = sign * cy * r;
        if (x > static_cast<double>(mx) + 1e-9 || std::abs(y) > static_cast<double>(my) + 1e-9)
          return {};
        const double value = interpolate(x, y);
        if (value <= level)
          return (static_cast<double>(k - 1) + (last - level) / (last - value)) * step;
        last = value;
      }
  }

  std::vector<double>
  angular_spectrum(const HeightMap &map)
  {
    const auto   window = [&](std::size_t n) { return map.periodic ? std::vector<double>{} : hann_window(n); };
    HalfSpectrum spectrum
        = transform_rows(map.z, map.nx, map.ny, mean_of(map), map.nx, map.ny, window(map.nx), window(map.ny));
    const std::size_t n_kx = spectrum.n_kx(), ny = map.ny;
    const double      dp = 1. / (static_cast<double>(map.nx) * map.dx), dq = 1. / (static_cast<double>(ny) * map.dy);
    const double      nyquist = 0.5 / std::max(map.dx, map.dy);
    // One histogram a column and one sum over them, so that the order does not depend on the number of threads.
    std::vector<double> bins(n_kx * n_angles, 0.);
    for_each_column(spectrum, false, [&](std::size_t kx, std::complex<double> *column, FourierTransform &transform) {
      transform.forward(column);
      double *own = bins.data() + kx * n_angles;
      for (std::size_t k = 0; k < ny; ++k)
        {
          const double p = static_cast<double>(kx) * dp,
                       q = (static_cast<double>(k) - (2 * k > ny ? static_cast<double>(ny) : 0.)) * dq;
          const double r = std::hypot(p, q);
          if (r == 0. || r > nyquist)
            continue;
          const double angle = std::atan2(q, p);
          const double width = std::hypot(dp * q, dq * p) / (r * r); // angle covered by the point
          spread(own, angle / M_PI * n_angles, 0.5 * width / M_PI * n_angles,
                 (kx == 0 ? 0.5 : 1.) * std::norm(column[k])); // kx = 0 holds both ends of each direction
        }
    });
    std::vector<double> sum(n_angles, 0.);
    for (std::size_t kx = 0; kx < n_kx; ++kx)
      for (std::size_t i = 0; i < n_angles; ++i)
        sum[i] += bins[kx * n_angles + i];
    return sum;
  }

  SpatialParameters
  spatial_parameters(const HeightMap &map)
  {
    SpatialParameters     s;
    const Autocorrelation acf(map);
    s.length_x      = acf.decay_length(0., 0.2);
    s.length_y      = acf.decay_length(M_PI / 2., 0.2);
    s.half_length_x = acf.decay_length(0., 0.5);
    s.half_length_y = acf.decay_length(M_PI / 2., 0.5);
    if (s.half_length_x && s.half_length_y)
      s.peklenik = *s.half_length_x / *s.half_length_y;

    double             longest = 0.;
    bool               all     = true;
    constexpr unsigned n       = 1440; // an eighth of a degree
    for (unsigned i = 0; i < n; ++i)
      {
        const auto length = acf.decay_length((static_cast<double>(i) / n - 0.5) * M_PI, 0.2);
        all               = all && length;
        if (!length)
          continue;
        longest = std::max(longest, *length);
        if (!s.sal || *length < *s.sal)
          s.sal = length;
      }
    if (all)
      s.str = *s.sal / longest;

    const double normal = direction_of_maximum(angular_spectrum(map)), lay = normal + 90.;
    s.std_angle = lay - 180. * std::ceil((lay - 90.) / 180.);
    return s;
  }
} // namespace tribodraw
