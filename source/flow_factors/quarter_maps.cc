#include <tribodraw/base/errors.h>
#include <tribodraw/flattening/height_distribution.h>
#include <tribodraw/flow_factors/cell_flow.h>
#include <tribodraw/flow_factors/quarter_maps.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    HeightMap
    quarter_of(const HeightMap &map, const std::size_t number)
    {
      HeightMap         quarter = map;
      const std::size_t nx = map.nx / 2, ny = map.ny / 2;
      const std::size_t x0 = number % 2 == 0 ? 0 : map.nx - nx, y0 = number < 2 ? 0 : map.ny - ny;
      quarter.nx       = nx;
      quarter.ny       = ny;
      quarter.periodic = false;
      quarter.z.clear();
      double mean = 0;
      for (std::size_t iy = 0; iy < ny; ++iy)
        for (std::size_t ix = 0; ix < nx; ++ix)
          {
            quarter.z.push_back(map(x0 + ix, y0 + iy));
            mean += quarter.z.back();
          }
      mean /= static_cast<double>(nx * ny);
      for (double &z : quarter.z)
        z -= mean;
      return quarter;
    }

    double
    mean_over(const CellGrid &grid, const CellFlow::Window &window, const std::vector<double> &values)
    {
      double sum = 0;
      for (std::size_t iy = window.first[1]; iy < window.last[1]; ++iy)
        for (std::size_t ix = window.first[0]; ix < window.last[0]; ++ix)
          sum += values[iy * grid.nx + ix];
      return sum / static_cast<double>((window.last[0] - window.first[0]) * (window.last[1] - window.first[1]));
    }

    // Components xx, yy of the pressure factor, then of the shear factor.
    std::array<double, 4>
    factors_of_quarter(const CellGrid &grid, const CellGap &gap, const CellSettings &settings,
                       const double sq_reference)
    {
      CellFlow::Window window{ { { 0, 0 } }, { { grid.nx, grid.ny } } };
      if (settings.boundary_conditions == CellBoundaryConditions::paper)
        for (const int axis : { 0, 1 })
          {
            window.first[axis] = static_cast<std::size_t>(std::lround(0.1 * static_cast<double>(grid.n(axis))));
            window.last[axis]  = grid.n(axis) - window.first[axis];
          }
      const double          carried = mean_over(grid, window, gap.carried);
      std::array<double, 4> result{ { 0, 0, carried / sq_reference, carried / sq_reference } };
      for (const int axis : { 0, 1 })
        {
          const CellFlow flow(grid, gap, settings.discretisation, axis);
          if (flow.blocked())
            continue;
          result[axis] = -flow.mean_flux(flow.pressure_flow(axis), axis, window);
          result[2 + axis] -= gap.mean_gap * flow.mean_flux(flow.shear_flow(axis), axis, window) / sq_reference;
        }
      return result;
    }
  } // namespace

  void
  add_quarter_maps(FlowFactors &result, const HeightMap &sheet, const HeightMap &tool, const CellSettings &settings,
                   const double closed_gap, const double sq_reference)
  {
    if (sheet.nx < 20 || sheet.ny < 20)
      throw InputError(describe_error("The map is too small to be divided into quarters", "Flow factors/Quarter maps",
                                      std::to_string(sheet.nx) + " x " + std::to_string(sheet.ny) + " pixels",
                                      "at least 20 x 20", "Set 'Quarter maps' to false."));
    const CellGrid        grid = make_cell_grid(sheet.nx / 2, sheet.ny / 2, sheet.dx, sheet.dy, false);
    std::array<double, 4> sum{}, squares{};
    for (std::size_t number = 0; number < 4; ++number)
      {
        const HeightMap quarter = quarter_of(sheet, number), counter = tool.z.empty() ? HeightMap() : quarter_of(tool, number);
        const double    cut
            = cut_heights_for_separations(quarter, counter, sq_reference, { result.h_avg / sq_reference }).front();
        const auto factors
            = factors_of_quarter(grid, make_cell_gap(quarter, counter, cut, closed_gap), settings, sq_reference);
        for (std::size_t k = 0; k < 4; ++k)
          {
            sum[k] += factors[k];
            squares[k] += factors[k] * factors[k];
          }
      }
    for (std::size_t k = 0; k < 4; ++k)
      {
        const double mean = sum[k] / 4, sd = std::sqrt(std::max(0., (squares[k] - 4 * mean * mean) / 3));
        (k < 2 ? result.phi_p_quarter_mean : result.phi_s_quarter_mean)[k % 2] = mean;
        (k < 2 ? result.phi_p_quarter_sd : result.phi_s_quarter_sd)[k % 2]     = sd;
      }
    result.quartered = true;
  }
} // namespace tribodraw
