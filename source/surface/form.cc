#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/form.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribodraw
{
  namespace
  {
    using Heights = Eigen::Map<Eigen::ArrayXd>;
    using Vector  = Eigen::VectorXd;
    using Matrix  = Eigen::MatrixXd;

    std::string
    short_number(double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", value);
      return text;
    }

    double
    centred_x(const HeightMap &map, std::size_t ix)
    {
      return (static_cast<double>(ix) - 0.5 * (static_cast<double>(map.nx) - 1.)) * map.dx;
    }

    double
    centred_y(const HeightMap &map, std::size_t iy)
    {
      return (static_cast<double>(iy) - 0.5 * (static_cast<double>(map.ny) - 1.)) * map.dy;
    }

    void
    check_zero_mean(const HeightMap &map, double mean, double sq)
    {
      if (std::abs(mean) > 1e-6 * sq)
        throw InputError(describe_error("the mean height of the surface is not zero.", map.description,
                                        units::format(mean, "um"), "zero mean, since no form is removed",
                                        "Use `Form = plane` or `mean` in the subsection Processing."));
    }

    /// Sum over all pixels of a contribution (a vector of doubles), row by row, so that the order does not depend on
    /// the number of threads.
    template <class Contribution>
    Vector
    sum_over_pixels(const HeightMap &map, Eigen::Index n, const Contribution &add)
    {
      Matrix rows = Matrix::Zero(n, static_cast<Eigen::Index>(map.ny));
      parallel::for_range(map.ny, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t iy = begin; iy < end; ++iy)
          {
            auto sum = rows.col(static_cast<Eigen::Index>(iy));
            for (std::size_t ix = 0; ix < map.nx; ++ix)
              add(centred_x(map, ix), centred_y(map, iy), map(ix, iy), sum);
          }
      });
      return rows.rowwise().sum();
    }

    /// The centred pixel coordinates are orthogonal to each other and to 1 on a full grid, so that each slope is a
    /// single quotient.
    std::string
    subtract_plane(HeightMap &map)
    {
      const double centre_x = 0.5 * (static_cast<double>(map.nx) - 1.),
                   centre_y = 0.5 * (static_cast<double>(map.ny) - 1.);
      double zx = 0, zy = 0, xx = 0, yy = 0;
      for (std::size_t iy = 0; iy < map.ny; ++iy)
        for (std::size_t ix = 0; ix < map.nx; ++ix)
          {
            const double x = static_cast<double>(ix) - centre_x, y = static_cast<double>(iy) - centre_y,
                         z = map(ix, iy);
            zx += z * x;
            zy += z * y;
            xx += x * x;
            yy += y * y;
          }
      const double slope_x = xx > 0. ? zx / xx : 0., slope_y = yy > 0. ? zy / yy : 0.;
      for (std::size_t iy = 0; iy < map.ny; ++iy)
        for (std::size_t ix = 0; ix < map.nx; ++ix)
          map(ix, iy)
              -= slope_x * (static_cast<double>(ix) - centre_x) + slope_y * (static_cast<double>(iy) - centre_y);
      return "; least-squares plane subtracted (slopes " + short_number(slope_x / map.dx) + ", "
             + short_number(slope_y / map.dy) + ")";
    }

    /// Coefficients of 1, x, y, x^2, xy, y^2 with x and y in mm from the centre.
    Vector
    fit_second_order(const HeightMap &map)
    {
      if (map.nx < 3 || map.ny < 3)
        throw InputError(describe_error("the map has too few points for a curved form.", map.description,
                                        std::to_string(map.nx) + " x " + std::to_string(map.ny), "at least 3 x 3"));
      // Coordinates scaled to [-1, 1] keep the normal equations well conditioned.
      const double ax = centred_x(map, map.nx - 1), ay = centred_y(map, map.ny - 1);
      const auto   sums = sum_over_pixels(map, 27, [&](double x, double y, double z, auto sum) {
        const double u = x / ax, v = y / ay;
        const double basis[6] = { 1., u, v, u * u, u * v, v * v };
        int          k        = 0;
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j <= i; ++j)
            sum[k++] += basis[i] * basis[j];
        for (const double b : basis)
          sum[k++] += b * z;
      });
        Matrix normal(6, 6);
      Vector       right(6);
      int          k = 0;
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j <= i; ++j)
          normal(i, j) = normal(j, i) = sums[k++];
      for (int i = 0; i < 6; ++i)
        right[i] = sums[k++];
      Vector c = normal.ldlt().solve(right);
      c[1] /= ax;
      c[2] /= ay;
      c[3] /= ax * ax;
      c[4] /= ax * ay;
      c[5] /= ay * ay;
      return c;
    }

    std::string
    subtract_second_order(HeightMap &map)
    {
      const Vector c = fit_second_order(map);
      for (std::size_t iy = 0; iy < map.ny; ++iy)
        for (std::size_t ix = 0; ix < map.nx; ++ix)
          {
            const double x = centred_x(map, ix), y = centred_y(map, iy);
            map(ix, iy) -= c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
          }
      return "; least-squares polynomial of second order subtracted (curvatures " + short_number(2. * c[3]) + ", "
             + short_number(2. * c[5]) + " 1/mm)";
    }

    /// Height of a circle of curvature k below its top at distance w from it, and the derivative to w^2 / 2 and to k.
    struct Arc
    {
      double value, to_half_square, to_curvature;
    };
    Arc
    arc(double k, double square)
    {
      // f = k w^2 / (1 + r), r = sqrt(1 - k^2 w^2); df/d(w^2/2) = k / r; df/dk = w^2 / (r (1 + r)).
      const double r = std::sqrt(1. - k * k * square);
      return { k * square / (1. + r), k / r, square / (r * (1. + r)) };
    }

    /// A curved form as a vector of parameters. Positions are not parameters but slopes at the centre of the map, which
    /// stay finite for weakly curved maps: x0 = slope / curvature to first order.
    struct CurvedFit
    {
      bool cylinder;

      CurvedForm
      form(const Vector &p) const
      {
        CurvedForm f;
        f.is_cylinder = cylinder;
        f.height      = p[0];
        f.curvature   = p[1];
        if (cylinder)
          {
            const double u0 = p[2] / p[1];
            f.angle         = p[3];
            f.tilt          = p[4];
            f.x0            = -u0 * std::sin(f.angle);
            f.y0            = u0 * std::cos(f.angle);
          }
        else
          {
            f.x0 = p[2] / p[1];
            f.y0 = p[3] / p[1];
          }
        return f;
      }

      /// Value and gradient to the parameters. The constant is shifted by p2^2 / (2 k), so that p[0] is nearly the
      /// height at the centre of the map and not that of a top far away.
      double
      evaluate(const Vector &p, double x, double y, Vector &gradient) const
      {
        const double k = p[1];
        if (cylinder)
          {
            const double s = std::sin(p[3]), c = std::cos(p[3]);
            const double along = x * c + y * s, u0 = p[2] / k, w = -x * s + y * c - u0;
            const Arc    a = arc(k, w * w);
            gradient[0]    = 1.;
            gradient[1]    = -a.to_curvature - a.to_half_square * w * u0 / k; // dw/dk = u0 / k
            gradient[2]    = a.to_half_square * w / k;                        // dw/dp2 = -1 / k
            gradient[3]    = a.to_half_square * w * along + p[4] * (-x * s + y * c);
            gradient[4]    = along;
            return p[0] + p[4] * along - a.value;
          }
        const double wx = x - p[2] / k, wy = y - p[3] / k;
        const Arc    a = arc(k, wx * wx + wy * wy);
        gradient[0]    = 1.;
        gradient[1]    = -a.to_curvature - a.to_half_square * (wx * p[2] + wy * p[3]) / (k * k);
        gradient[2]    = a.to_half_square * wx / k;
        gradient[3]    = a.to_half_square * wy / k;
        return p[0] - a.value;
      }

      Vector
      start(const Vector &c) const
      {
        Eigen::Matrix2d curvature;
        curvature << 2. * c[3], c[4], c[4], 2. * c[5];
        if (!cylinder)
          {
            Vector p(4);
            p[1] = -0.5 * curvature.trace();
            p[2] = c[1];
            p[3] = c[2];
            p[0] = c[0] + 0.5 * (p[2] * p[2] + p[3] * p[3]) / p[1];
            return p;
          }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(curvature);
        const int             across = std::abs(eigen.eigenvalues()[0]) > std::abs(eigen.eigenvalues()[1]) ? 0 : 1;
        const Eigen::Vector2d n      = eigen.eigenvectors().col(across), axis(n[1], -n[0]); // n = (-sin, cos)
        Vector                p(5);
        p[1] = -eigen.eigenvalues()[across];
        p[2] = c[1] * n[0] + c[2] * n[1];
        p[3] = std::atan2(axis[1], axis[0]);
        p[4] = c[1] * axis[0] + c[2] * axis[1];
        p[0] = c[0] + 0.5 * p[2] * p[2] / p[1];
        return p;
      }
    };

    /// Sum of squares, gradient and normal matrix, packed; the sum is infinite if the form does not cover the map.
    struct Normal
    {
      double cost;
      Vector right;
      Matrix matrix;
    };
    Normal
    normal_equations(const HeightMap &map, const CurvedFit &fit, const Vector &p)
    {
      const Eigen::Index n    = p.size();
      const Vector       sums = sum_over_pixels(map, 1 + n + n * n, [&](double x, double y, double z, auto sum) {
        thread_local Vector gradient;
        gradient.resize(n);
        const double difference = z - fit.evaluate(p, x, y, gradient);
        sum[0] += difference * difference;
        sum.segment(1, n) += difference * gradient;
        for (Eigen::Index i = 0; i < n; ++i)
          sum.segment(1 + n + i * n, n) += gradient[i] * gradient;
      });
      Normal             result{ sums[0], sums.segment(1, n), Matrix(n, n) };
      for (Eigen::Index i = 0; i < n; ++i)
        result.matrix.col(i) = sums.segment(1 + n + i * n, n);
      if (!std::isfinite(result.cost))
        result.cost = INFINITY;
      return result;
    }

    CurvedForm
    fit_curved(const HeightMap &map, bool cylinder)
    {
      const CurvedFit fit{ cylinder };
      Vector          p        = fit.start(fit_second_order(map));
      const double    diagonal = std::hypot(static_cast<double>(map.nx) * map.dx, static_cast<double>(map.ny) * map.dy);
      const auto      flat     = [&] {
        // A sag below a millionth of a micrometre is round-off of the heights, not a radius.
        return !(std::abs(p[1]) * diagonal * diagonal / 8. > 1e-9);
      };
      const std::string name = cylinder ? "cylinder" : "sphere";
      if (flat())
        throw InputError(describe_error("the surface has no curvature that a " + name + " could follow.",
                                        map.description, short_number(p[1]) + " 1/mm", "", "Use `Form = plane`."));
      Normal state = normal_equations(map, fit, p);
      if (!std::isfinite(state.cost))
        throw InputError(describe_error("the surface is too strongly curved for a " + name + " seen from above.",
                                        map.description, short_number(p[1]) + " 1/mm", "",
                                        "Use `Form = second order`."));
      double damping = 1e-6;
      for (int step = 0; step < 50; ++step)
        {
          Matrix damped = state.matrix;
          damped.diagonal() *= 1. + damping;
          const Vector scale = damped.diagonal().cwiseSqrt().cwiseInverse();
          const Vector change
              = scale.asDiagonal()
                * Vector(
                    (scale.asDiagonal() * damped * scale.asDiagonal()).ldlt().solve(scale.cwiseProduct(state.right)));
          const Vector trial = p + change;
          const Normal next  = normal_equations(map, fit, trial);
          const bool   small = change.cwiseProduct(scale.cwiseInverse()).squaredNorm() <= 1e-24 * state.cost + 1e-40;
          if (next.cost <= state.cost)
            {
              p       = trial;
              state   = next;
              damping = std::max(damping / 10., 1e-14);
            }
          else
            damping *= 10.;
          if (small || damping > 1e8)
            break;
        }
      if (flat())
        throw InputError(describe_error("the surface has no curvature that a " + name + " could follow.",
                                        map.description, short_number(p[1]) + " 1/mm", "", "Use `Form = plane`."));
      return fit.form(p);
    }

    std::string
    subtract_curved(HeightMap &map, bool cylinder)
    {
      const CurvedForm form = fit_curved(map, cylinder);
      for (std::size_t iy = 0; iy < map.ny; ++iy)
        for (std::size_t ix = 0; ix < map.nx; ++ix)
          map(ix, iy) -= form(centred_x(map, ix), centred_y(map, iy));
      std::string text = std::string("; least-squares ") + (cylinder ? "cylinder" : "sphere") + " subtracted (radius "
                         + short_number(1. / std::abs(form.curvature)) + " mm, "
                         + (form.curvature > 0. ? "convex" : "concave");
      if (cylinder)
        text += ", axis at " + short_number(std::remainder(form.angle, M_PI) * 180. / M_PI) + " deg, tilt "
                + short_number(form.tilt);
      return text + ")";
    }
  } // namespace

  double
  CurvedForm::operator()(double x, double y) const
  {
    const double s = std::sin(angle), c = std::cos(angle), across = -(x - x0) * s + (y - y0) * c;
    const double square = is_cylinder ? across * across : (x - x0) * (x - x0) + (y - y0) * (y - y0);
    return height + (is_cylinder ? tilt * (x * c + y * s) : 0.) - arc(curvature, square).value;
  }

  CurvedForm
  fit_cylinder(const HeightMap &map)
  {
    return fit_curved(map, true);
  }

  CurvedForm
  fit_sphere(const HeightMap &map)
  {
    return fit_curved(map, false);
  }

  const std::vector<std::string> &
  form_names()
  {
    static const std::vector<std::string> names{ "none", "mean", "plane", "second order", "cylinder", "sphere" };
    return names;
  }

  void
  remove_form(HeightMap &map, const std::string &form)
  {
    const auto &names = form_names();
    if (std::find(names.begin(), names.end(), form) == names.end())
      throw InputError(
          describe_error("unknown form.", map.description, form, "none, mean, plane, second order, cylinder, sphere"));
    if (map.size() == 0)
      return;
    Heights      z(map.z.data(), static_cast<Eigen::Index>(map.z.size()));
    const double mean = z.mean();
    if (form == "none")
      {
        check_zero_mean(map, mean, std::sqrt((z - mean).square().mean()));
        map.description += "; form not removed";
        return;
      }
    z -= mean;
    if (form == "mean")
      {
        map.description += "; mean subtracted";
        return;
      }
    map.description += form == "plane"          ? subtract_plane(map)
                       : form == "second order" ? subtract_second_order(map)
                                                : subtract_curved(map, form == "cylinder");
    // Rounding, and for curved forms the difference between least squares and zero mean.
    z -= z.mean();
    map.periodic = false;
  }
} // namespace tribodraw
