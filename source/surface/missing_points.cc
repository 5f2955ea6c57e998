#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/surface/missing_points.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

namespace tribodraw
{
  namespace
  {
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();

    double
    median(std::vector<double> &values)
    {
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      return *middle;
    }

    /// Distance of each measured point from the median of its window; NaN where nothing was measured.
    std::vector<double>
    distances_from_local_median(const HeightMap &map, unsigned window)
    {
      const auto          nx = static_cast<std::ptrdiff_t>(map.nx), ny = static_cast<std::ptrdiff_t>(map.ny);
      const auto          reach = static_cast<std::ptrdiff_t>(window / 2);
      std::vector<double> distance(map.size(), missing);
      parallel::for_range(map.ny, 8, [&](std::size_t begin, std::size_t end) {
        std::vector<double> near;
        for (auto iy = static_cast<std::ptrdiff_t>(begin); iy < static_cast<std::ptrdiff_t>(end); ++iy)
          for (std::ptrdiff_t ix = 0; ix < nx; ++ix)
            {
              const std::size_t at = static_cast<std::size_t>(iy * nx + ix);
              if (std::isnan(map.z[at]))
                continue;
              near.clear();
              for (std::ptrdiff_t jy = iy - reach; jy <= iy + reach; ++jy)
                for (std::ptrdiff_t jx = ix - reach; jx <= ix + reach; ++jx)
                  {
                    const bool inside = jx >= 0 && jx < nx && jy >= 0 && jy < ny;
                    if (!inside && !map.periodic)
                      continue;
                    const double z = map.z[static_cast<std::size_t>(((jy + ny) % ny) * nx + (jx + nx) % nx)];
                    if (!std::isnan(z))
                      near.push_back(z);
                  }
              distance[at] = map.z[at] - median(near);
            }
      });
      return distance;
    }

    double
    robust_spread(const std::vector<double> &distance)
    {
      std::vector<double> absolute;
      absolute.reserve(distance.size());
      double sum = 0;
      for (const double d : distance)
        if (!std::isnan(d))
          {
            absolute.push_back(std::abs(d));
            sum += std::abs(d);
          }
      if (absolute.empty())
        return 0.;
      const double middle = 1.4826 * median(absolute);
      return middle > 0. ? middle : 1.2533 * sum / static_cast<double>(absolute.size());
    }

    /// The neighbours of a pixel with their weights 1/dx^2, 1/dy^2; absent beyond the border of an open map.
    class Neighbours
    {
    public:
      explicit Neighbours(const HeightMap &m) : map(m), wx(1. / (m.dx * m.dx)), wy(1. / (m.dy * m.dy)) {}

      template <class Visit>
      void
      visit(std::size_t at, const Visit &v) const
      {
        const std::size_t ix = at % map.nx, iy = at / map.nx;
        if (ix > 0 || map.periodic)
          v(iy * map.nx + (ix + map.nx - 1) % map.nx, wx);
        if (ix + 1 < map.nx || map.periodic)
          v(iy * map.nx + (ix + 1) % map.nx, wx);
        if (iy > 0 || map.periodic)
          v((iy + map.ny - 1) % map.ny * map.nx + ix, wy);
        if (iy + 1 < map.ny || map.periodic)
          v((iy + 1) % map.ny * map.nx + ix, wy);
      }

    private:
      const HeightMap &map;
      double           wx, wy;
    };

    /// A first guess: the mean of the measured points in squares of growing size, finest last.
    void
    guess(const HeightMap &map, const std::vector<std::size_t> &holes, Eigen::VectorXd &values)
    {
      std::vector<bool> done(holes.size(), false);
      std::size_t       left = holes.size();
      for (std::size_t edge = 2; left > 0; edge *= 2)
        {
          const std::size_t   nx = (map.nx + edge - 1) / edge, ny = (map.ny + edge - 1) / edge;
          std::vector<double> sum(nx * ny, 0.), count(nx * ny, 0.);
          for (std::size_t iy = 0; iy < map.ny; ++iy)
            for (std::size_t ix = 0; ix < map.nx; ++ix)
              if (const double z = map(ix, iy); !std::isnan(z))
                {
                  sum[iy / edge * nx + ix / edge] += z;
                  count[iy / edge * nx + ix / edge] += 1.;
                }
          for (std::size_t i = 0; i < holes.size(); ++i)
            if (!done[i])
              {
                const std::size_t cell = holes[i] / map.nx / edge * nx + holes[i] % map.nx / edge;
                if (count[cell] > 0.)
                  {
                    values[static_cast<Eigen::Index>(i)] = sum[cell] / count[cell];
                    done[i]                              = true;
                    --left;
                  }
              }
        }
    }

    std::string
    percent(std::size_t part, std::size_t whole)
    {
      char text[64];
      std::snprintf(text, sizeof text, "%zu of %zu (%.3g %%)", part, whole,
                    100. * static_cast<double>(part) / static_cast<double>(whole));
      return text;
    }
  } // namespace

  OutlierReport
  mark_outliers(HeightMap &map, double threshold, unsigned window)
  {
    if (!(threshold > 0.) || window % 2 == 0 || window < 3)
      throw InputError(describe_error("outliers need a positive threshold and an odd window of at least 3 pixels.",
                                      map.description));
    OutlierReport report;
    const auto    distance = distances_from_local_median(map, window);
    report.spread          = robust_spread(distance);
    for (std::size_t i = 0; i < distance.size(); ++i)
      if (std::abs(distance[i]) > threshold * report.spread)
        {
          map.z[i] = missing;
          ++report.found;
        }
    return report;
  }

  std::size_t
  fill_missing(HeightMap &map, double largest_share)
  {
    std::vector<std::size_t> holes;
    for (std::size_t i = 0; i < map.size(); ++i)
      if (std::isnan(map.z[i]))
        holes.push_back(i);
    if (holes.empty())
      return 0;
    if (holes.size() == map.size())
      throw InputError(describe_error("all points of the surface are missing.", map.description));
    if (static_cast<double>(holes.size()) > largest_share * static_cast<double>(map.size()))
      {
        char limit[64];
        std::snprintf(limit, sizeof limit, "at most %.3g %%", 100. * largest_share);
        throw InputError(describe_error("too many points of the surface are missing.", map.description,
                                        percent(holes.size(), map.size()), limit,
                                        "Measure again, crop in the measuring software, or raise "
                                        "`Processing/Maximum missing fraction`."));
      }

    constexpr std::uint32_t    known = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> unknown(map.size(), known);
    for (std::size_t i = 0; i < holes.size(); ++i)
      unknown[holes[i]] = static_cast<std::uint32_t>(i);

    using Matrix       = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    const auto       n = static_cast<Eigen::Index>(holes.size());
    const Neighbours neighbours(map);
    Matrix           matrix(n, n);
    matrix.reserve(Eigen::VectorXi::Constant(n, 5));
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n), values = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i)
      {
        double diagonal = 0.;
        neighbours.visit(holes[static_cast<std::size_t>(i)], [&](std::size_t at, double weight) {
          diagonal += weight;
          if (unknown[at] == known)
            right[i] += weight * map.z[at];
          else
            matrix.coeffRef(i, static_cast<Eigen::Index>(unknown[at])) -= weight;
        });
        matrix.coeffRef(i, i) += diagonal;
      }
    matrix.makeCompressed();
    guess(map, holes, values);

    // The error of a hole of m pixels falls by a constant factor in O(m) steps at worst.
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(1e-10);
    solver.setMaxIterations(static_cast<Eigen::Index>(20 * (map.nx + map.ny) + 1000));
    solver.compute(matrix);
    values = solver.solveWithGuess(right, values);
    if (solver.info() != Eigen::Success)
      throw ConvergenceError(describe_error("missing points could not be filled: the conjugate gradients did not end.",
                                            map.description, percent(holes.size(), map.size())));
    for (std::size_t i = 0; i < holes.size(); ++i)
      map.z[holes[i]] = values[static_cast<Eigen::Index>(i)];
    return holes.size();
  }
} // namespace tribodraw
