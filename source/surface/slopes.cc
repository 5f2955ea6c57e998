#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/surface/slopes.h>

#include <Eigen/Core>

#include <cmath>
#include <string>

namespace tribodraw
{
  namespace
  {
    struct Derivatives
    {
      double slope, curvature;
    };

    /// At a point from three neighbours on either side, distance 1; error of sixth order in the distance.
    template <class Get>
    Derivatives
    seven_points(const Get &z)
    {
      return { (45. * (z(1) - z(-1)) - 9. * (z(2) - z(-2)) + (z(3) - z(-3))) / 60.,
               (270. * (z(1) + z(-1)) - 27. * (z(2) + z(-2)) + 2. * (z(3) + z(-3)) - 490. * z(0)) / 180. };
    }

    /// Area of the surface over one square of points, divided by its plan area.
    double
    developed(double a, double b, double c, double d, double dx, double dy)
    {
      const double low = (b - a) / dx, high = (d - c) / dx, left = (c - a) / dy, right = (d - b) / dy;
      const auto   triangle = [](double sx, double sy) { return std::sqrt(1. + sx * sx + sy * sy); };
      return 0.25 * (triangle(low, right) + triangle(high, left) + triangle(low, left) + triangle(high, right));
    }
  } // namespace

  SlopeParameters
  slope_parameters(const HeightMap &map)
  {
    if (map.nx < 7 || map.ny < 7)
      throw InputError(describe_error("slopes need a larger map.", map.description,
                                      std::to_string(map.nx) + " x " + std::to_string(map.ny), "at least 7 x 7"));
    const std::size_t nx = map.nx, ny = map.ny;
    // One column of sums a row, added in the order of the rows: independent of the number of threads.
    enum
    {
      height,
      square,
      points,
      x_slope,
      y_slope,
      x_curvature,
      y_curvature,
      area,
      cells,
      n_sums
    };
    Eigen::MatrixXd rows   = Eigen::MatrixXd::Zero(n_sums, static_cast<Eigen::Index>(ny));
    const double    origin = map.z[0];
    parallel::for_range(ny, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t iy = begin; iy < end; ++iy)
        {
          auto       s       = rows.col(static_cast<Eigen::Index>(iy));
          const bool inner_y = map.periodic || (iy >= 3 && iy + 3 < ny);
          for (std::size_t ix = 0; ix < nx; ++ix)
            {
              const auto   wrap_x = [&](int k) { return (ix + nx + static_cast<std::size_t>(k + 3) - 3) % nx; };
              const auto   wrap_y = [&](int k) { return (iy + ny + static_cast<std::size_t>(k + 3) - 3) % ny; };
              const double z      = map(ix, iy) - origin;
              s[height] += z;
              s[square] += z * z;
              if (inner_y && (map.periodic || (ix >= 3 && ix + 3 < nx)))
                {
                  const Derivatives x = seven_points([&](int k) { return map(wrap_x(k), iy); });
                  const Derivatives y = seven_points([&](int k) { return map(ix, wrap_y(k)); });
                  s[points] += 1.;
                  s[x_slope] += x.slope * x.slope;
                  s[y_slope] += y.slope * y.slope;
                  s[x_curvature] += x.curvature * x.curvature;
                  s[y_curvature] += y.curvature * y.curvature;
                }
              if (map.periodic || (ix + 1 < nx && iy + 1 < ny))
                {
                  s[cells] += 1.;
                  s[area] += developed(map(ix, iy), map(wrap_x(1), iy), map(ix, wrap_y(1)), map(wrap_x(1), wrap_y(1)),
                                       map.dx, map.dy);
                }
            }
        }
    });
    const Eigen::VectorXd sum  = rows.rowwise().sum();
    const auto            n    = static_cast<double>(map.size());
    const double          mean = sum[height] / n, dx2 = map.dx * map.dx, dy2 = map.dy * map.dy;
    SlopeParameters       p;
    p.m0   = sum[square] / n - mean * mean;
    p.m2_x = sum[x_slope] / (sum[points] * dx2);
    p.m2_y = sum[y_slope] / (sum[points] * dy2);
    p.m4_x = sum[x_curvature] / (sum[points] * dx2 * dx2);
    p.m4_y = sum[y_curvature] / (sum[points] * dy2 * dy2);
    p.sdq  = std::sqrt(p.m2_x + p.m2_y);
    p.sdr  = sum[area] / sum[cells] - 1.;
    return p;
  }
} // namespace tribodraw
