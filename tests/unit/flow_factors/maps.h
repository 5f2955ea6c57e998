#ifndef tribodraw_tests_flow_factors_maps_h
#define tribodraw_tests_flow_factors_maps_h

#include <tribodraw/flow_factors/cell_gap.h>
#include <tribodraw/flow_factors/cell_grid.h>
#include <tribodraw/flow_factors/cell_problem.h>
#include <tribodraw/surface/height_map.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace tribodraw::test
{
  constexpr double pi = 3.14159265358979323846;

  /// Sheet whose gap at cut height 0 is gap(x, y), at pixel centres of the unit square.
  inline HeightMap
  map_of_gap(const std::size_t nx, const std::size_t ny, const std::function<double(double, double)> &gap)
  {
    HeightMap map;
    map.nx       = nx;
    map.ny       = ny;
    map.dx       = 1. / static_cast<double>(nx);
    map.dy       = 1. / static_cast<double>(ny);
    map.periodic = true;
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix)
        map.z.push_back(-gap((static_cast<double>(ix) + 0.5) * map.dx, (static_cast<double>(iy) + 0.5) * map.dy));
    return map;
  }

  /// One cell on this process, smooth tool unless given.
  inline FlowFactors
  solve(const HeightMap &sheet, const double cut_height, const double sq, const CellSettings &settings,
        const HeightMap &tool = {}, const double closed_gap = 0)
  {
    const bool     periodic = settings.boundary_conditions == CellBoundaryConditions::periodic;
    const CellGrid grid     = make_cell_grid(sheet.nx, sheet.ny, sheet.dx, sheet.dy, periodic);
    return solve_cell_problem(grid, make_cell_gap(sheet, tool, cut_height, closed_gap * sq), settings, sq);
  }

  inline CellSettings
  periodic(const CellDiscretisation d = CellDiscretisation::mean_gap)
  {
    return { CellBoundaryConditions::periodic, d };
  }

  /// Periodic Gaussian field, zero mean, Sq = 1, autocorrelation exp(-r^2 / (2 length^2)) with the length in pixels:
  /// white noise smoothed with a Gaussian of standard deviation length / sqrt 2.
  inline HeightMap
  gaussian_map(const std::size_t n, const double length, const std::uint64_t seed)
  {
    HeightMap map;
    map.nx = map.ny = n;
    map.dx = map.dy = 1;
    map.periodic    = true;
    map.z.resize(n * n);
    std::mt19937_64 random(seed); // its sequence is fixed by the standard, that of normal_distribution is not
    const auto      uniform = [&random]() { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
    for (double &z : map.z)
      z = std::sqrt(-2 * std::log(uniform())) * std::cos(2 * pi * uniform());

    const double        width = length / std::sqrt(2.);
    const int           reach = static_cast<int>(std::ceil(5 * width));
    std::vector<double> line(n), kernel;
    for (int k = -reach; k <= reach; ++k)
      kernel.push_back(std::exp(-k * k / (2 * width * width)));
    const auto smooth = [&](double *first, const std::size_t stride) {
      for (std::size_t i = 0; i < n; ++i)
        {
          line[i] = 0;
          for (int k = -reach; k <= reach; ++k)
            line[i] += kernel[static_cast<std::size_t>(k + reach)]
                       * first[((i + 2 * n + static_cast<std::size_t>(k)) % n) * stride];
        }
      for (std::size_t i = 0; i < n; ++i)
        first[i * stride] = line[i];
    };
    for (std::size_t i = 0; i < n; ++i)
      smooth(&map.z[i * n], 1);
    for (std::size_t i = 0; i < n; ++i)
      smooth(&map.z[i], n);
    double mean = 0, square = 0;
    for (const double z : map.z)
      mean += z / static_cast<double>(n * n);
    for (double &z : map.z)
      {
        z -= mean;
        square += z * z / static_cast<double>(n * n);
      }
    for (double &z : map.z)
      z /= std::sqrt(square);
    return map;
  }

  /// Order of convergence from two errors, the second with half the pixel size.
  inline double
  order(const double coarse_error, const double fine_error)
  {
    return std::log2(std::abs(coarse_error / fine_error));
  }
} // namespace tribodraw::test

#endif
