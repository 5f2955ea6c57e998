#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/map_operations.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace tribodraw
{
  namespace
  {
    constexpr double most_pixels = 16384;

    /// One resampled value: a weighted sum of consecutive values, starting at `first` (which may lie outside).
    struct Stencil
    {
      std::ptrdiff_t      first;
      std::vector<double> weights;
    };

    /// Mean over the new pixel, by the share of each old pixel in it. All in units of old pixels.
    Stencil
    area_mean(double begin, double end)
    {
      Stencil s;
      s.first = static_cast<std::ptrdiff_t>(std::floor(begin + 1e-9));
      for (auto i = s.first; static_cast<double>(i) < end - 1e-9; ++i)
        s.weights.push_back((std::min(end, static_cast<double>(i + 1)) - std::max(begin, static_cast<double>(i)))
                            / (end - begin));
      return s;
    }

    /// Keys' kernel with a = -1/2 at the position @p centre, in units of old pixels, whose centres are at 1/2, 3/2, ...
    Stencil
    cubic(double centre)
    {
      const double position = centre - 0.5, base = std::floor(position), t = position - base;
      return { static_cast<std::ptrdiff_t>(base) - 1,
               { ((-0.5 * t + 1.) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1., ((-1.5 * t + 2.) * t + 0.5) * t,
                 (0.5 * t - 0.5) * t * t } };
    }

    struct Axis
    {
      std::size_t          n;    ///< pixels afterwards
      double               step; ///< pixel size afterwards
      std::vector<Stencil> stencils;
    };

    Axis
    plan(std::size_t n, double step, double wanted, bool periodic, const std::string &where)
    {
      const double length = static_cast<double>(n) * step;
      Axis         axis;
      const double count = periodic ? std::round(length / wanted) : std::floor(length / wanted * (1. + 1e-12));
      if (!(count >= 2. && count <= most_pixels))
        throw InputError(
            describe_error("the pixel size to resample to does not suit the map.", where, units::format(wanted, "um"),
                           units::format(length / most_pixels, "um") + " to " + units::format(length / 2., "um")));
      axis.n              = static_cast<std::size_t>(count);
      axis.step           = periodic ? length / count : wanted;
      const double margin = 0.5 * (length - count * axis.step) / step, ratio = axis.step / step;
      for (std::size_t i = 0; i < axis.n; ++i)
        {
          const double begin = margin + static_cast<double>(i) * ratio, end = begin + ratio;
          axis.stencils.push_back(ratio > 1. ? area_mean(begin, end) : cubic(0.5 * (begin + end)));
        }
      return axis;
    }

    /// Apply the stencils to n values that get(i) gives for i inside; outside they are continued periodically or
    /// linearly.
    template <class Get>
    auto
    weighted(const Stencil &stencil, std::size_t n, bool periodic, const Get &get)
    {
      const auto last = static_cast<std::ptrdiff_t>(n) - 1, count = last + 1;
      auto       value = [&](std::ptrdiff_t i) -> Eigen::ArrayXd {
        if (i >= 0 && i <= last)
          return get(static_cast<std::size_t>(i));
        if (periodic)
          return get(static_cast<std::size_t>(((i % count) + count) % count));
        const std::ptrdiff_t border = i < 0 ? 0 : last, inner = i < 0 ? 1 : last - 1;
        const double         beyond = static_cast<double>(std::abs(i - border));
        return (1. + beyond) * get(static_cast<std::size_t>(border)) - beyond * get(static_cast<std::size_t>(inner));
      };
      Eigen::ArrayXd sum = stencil.weights[0] * value(stencil.first);
      for (std::size_t k = 1; k < stencil.weights.size(); ++k)
        if (stencil.weights[k] != 0.)
          sum += stencil.weights[k] * value(stencil.first + static_cast<std::ptrdiff_t>(k));
      return sum;
    }
  } // namespace

  void
  flip_x(HeightMap &map)
  {
    for (std::size_t iy = 0; iy < map.ny; ++iy)
      {
        const auto row = map.z.begin() + static_cast<std::ptrdiff_t>(iy * map.nx);
        std::reverse(row, row + static_cast<std::ptrdiff_t>(map.nx));
      }
  }

  void
  flip_y(HeightMap &map)
  {
    for (std::size_t iy = 0; iy < map.ny / 2; ++iy)
      {
        const auto row   = map.z.begin() + static_cast<std::ptrdiff_t>(iy * map.nx),
                   other = map.z.begin() + static_cast<std::ptrdiff_t>((map.ny - 1 - iy) * map.nx);
        std::swap_ranges(row, row + static_cast<std::ptrdiff_t>(map.nx), other);
      }
  }

  void
  invert_heights(HeightMap &map)
  {
    for (double &z : map.z)
      z = -z;
  }

  void
  turn_y_to_x(HeightMap &map)
  {
    HeightMap turned = map;
    std::swap(turned.nx, turned.ny);
    std::swap(turned.dx, turned.dy);
    // new x = old y, new y = -old x; in blocks, so that neither map is read across whole rows
    constexpr std::size_t block = 32;
    for (std::size_t by = 0; by < map.ny; by += block)
      for (std::size_t bx = 0; bx < map.nx; bx += block)
        for (std::size_t iy = by; iy < std::min(by + block, map.ny); ++iy)
          for (std::size_t ix = bx; ix < std::min(bx + block, map.nx); ++ix)
            turned(iy, map.nx - 1 - ix) = map(ix, iy);
    map = std::move(turned);
  }

  void
  crop(HeightMap &map, const std::array<double, 4> &w)
  {
    const double length_x = static_cast<double>(map.nx) * map.dx, length_y = static_cast<double>(map.ny) * map.dy;
    // A window that ends at the border may differ from it in the last bits.
    const double slack_x = 1e-9 * length_x, slack_y = 1e-9 * length_y;
    const auto   range
        = [](double low, double high) { return units::format(low, "mm") + " to " + units::format(high, "mm"); };
    if (!(w[0] >= -slack_x && w[0] < w[1] && w[1] <= length_x + slack_x && w[2] >= -slack_y && w[2] < w[3]
          && w[3] <= length_y + slack_y))
      throw InputError(describe_error("the window to crop to is not within the map.", map.description,
                                      "x " + range(w[0], w[1]) + ", y " + range(w[2], w[3]),
                                      "x " + range(0., length_x) + ", y " + range(0., length_y)));
    const auto index = [](double position, double step, std::size_t n) {
      // the first pixel whose centre is not left of the position
      const double i = std::ceil(position / step - 0.5 - 1e-9);
      return static_cast<std::size_t>(std::clamp(i, 0., static_cast<double>(n)));
    };
    const std::size_t x0 = index(w[0], map.dx, map.nx), x1 = index(w[1], map.dx, map.nx),
                      y0 = index(w[2], map.dy, map.ny), y1 = index(w[3], map.dy, map.ny);
    if (x1 < x0 + 2 || y1 < y0 + 2)
      throw InputError(describe_error("the window to crop to holds too few pixels.", map.description,
                                      "x " + range(w[0], w[1]) + ", y " + range(w[2], w[3]), "at least 2 x 2"));
    HeightMap kept = map;
    kept.nx        = x1 - x0;
    kept.ny        = y1 - y0;
    kept.periodic  = map.periodic && kept.size() == map.size();
    kept.z.resize(kept.size());
    for (std::size_t iy = 0; iy < kept.ny; ++iy)
      std::copy_n(map.z.begin() + static_cast<std::ptrdiff_t>((iy + y0) * map.nx + x0), kept.nx,
                  kept.z.begin() + static_cast<std::ptrdiff_t>(iy * kept.nx));
    map = std::move(kept);
  }

  void
  resample(HeightMap &map, const std::array<double, 2> &pixel_size)
  {
    const Axis x = plan(map.nx, map.dx, pixel_size[0], map.periodic, map.description),
               y = plan(map.ny, map.dy, pixel_size[1], map.periodic, map.description);
    check_memory(static_cast<double>(std::max(x.n, map.nx)), static_cast<double>(std::max(y.n, map.ny)),
                 map.description);
    using ConstRow = Eigen::Map<const Eigen::ArrayXd>;
    HeightMap result;
    result.nx          = x.n;
    result.ny          = y.n;
    result.dx          = x.step;
    result.dy          = y.step;
    result.periodic    = map.periodic;
    result.description = map.description;
    result.z.resize(result.size());
    const auto nx = static_cast<Eigen::Index>(map.nx);
    Eigen::Map<Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> out(
        result.z.data(), static_cast<Eigen::Index>(y.n), static_cast<Eigen::Index>(x.n));
    for (std::size_t iy = 0; iy < y.n; ++iy)
      {
        const Eigen::ArrayXd row = weighted(y.stencils[iy], map.ny, map.periodic,
                                            [&](std::size_t i) { return ConstRow(map.z.data() + i * map.nx, nx); });
        for (std::size_t ix = 0; ix < x.n; ++ix)
          {
            const Stencil &s    = x.stencils[ix];
            const auto     last = s.first + static_cast<std::ptrdiff_t>(s.weights.size());
            double         sum  = 0.;
            if (s.first >= 0 && last <= static_cast<std::ptrdiff_t>(map.nx))
              for (std::size_t k = 0; k < s.weights.size(); ++k)
                sum += s.weights[k] * row[s.first + static_cast<Eigen::Index>(k)];
            else
              sum = weighted(s, map.nx, map.periodic,
                             [&](std::size_t i) { return row.segment(static_cast<Eigen::Index>(i), 1); })[0];
            out(static_cast<Eigen::Index>(iy), static_cast<Eigen::Index>(ix)) = sum;
          }
      }
    map = std::move(result);
  }

  std::string
  memory_problem(double nx, double ny)
  {
    const double needed    = 48. * nx * ny;
    const double available = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (!(needed > available))
      return {};
    char text[160];
    std::snprintf(text, sizeof text, "a map of %.0f x %.0f pixels needs about %.1f GB, this machine has %.1f GB", nx,
                  ny, needed / 1e9, available / 1e9);
    return text;
  }

  void
  check_memory(double nx, double ny, const std::string &where)
  {
    if (const std::string problem = memory_problem(nx, ny); !problem.empty())
      throw InputError(describe_error(problem + ".", where, "", "", "Use fewer pixels."));
  }
} // namespace tribodraw
