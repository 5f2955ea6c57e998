#include <tribodraw/base/parallel.h>
#include <tribodraw/boundary_friction/tool_surface.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// Slope from pixel i to its neighbour in direction @p step along an axis of @p n pixels that are @p stride apart
    /// in the map; at a border without continuation the slope of the other side.
    double
    one_sided(const HeightMap &map, const std::size_t at, const std::size_t i, const std::size_t n,
              const std::size_t stride, const double length, int step)
    {
      if (n < 2)
        return 0.;
      const bool leaves = step > 0 ? i + 1 == n : i == 0;
      if (leaves && !map.periodic)
        step = -step;
      const std::size_t j = (i + n + step) % n, neighbour = at + j * stride - i * stride;
      return step * (map.z[neighbour] - map.z[at]) / length;
    }
  } // namespace

  std::vector<std::uint32_t>
  pixels_by_height(const HeightMap &map)
  {
    std::vector<std::uint32_t> order(map.z.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](const std::uint32_t i, const std::uint32_t j) {
      return map.z[i] > map.z[j] || (map.z[i] == map.z[j] && i < j);
    });
    return order;
  }

  ToolSurface::ToolSurface(const HeightMap &tool, const unsigned int directions)
      : map(tool), n_directions(directions), order(pixels_by_height(tool)), frontal(tool.size()),
        shear_drag(tool.size()), shear_support(tool.size()), square_slope(tool.size())
  {
    std::vector<double> cosine, sine;
    for (unsigned int d = 0; d < directions; ++d)
      {
        cosine.push_back(std::cos(pi * d / directions));
        sine.push_back(std::sin(pi * d / directions));
      }
    const double share = 0.25 / (2. * directions); // of a quarter and one of the directions, opposites included
    parallel::for_range(tool.ny, 8, [&](const std::size_t begin, const std::size_t end) {
      for (std::size_t iy = begin; iy < end; ++iy)
        for (std::size_t ix = 0; ix < tool.nx; ++ix)
          {
            const std::size_t i     = iy * tool.nx + ix;
            double            front = 0, drag = 0, support = 0, square = 0;
            for (const int sx : { -1, 1 })
              for (const int sy : { -1, 1 })
                {
                  const double gx = one_sided(tool, i, ix, tool.nx, 1, tool.dx, sx);
                  const double gy = one_sided(tool, i, iy, tool.ny, tool.nx, tool.dy, sy);
                  square += 0.25 * (gx * gx + gy * gy);
                  for (unsigned int d = 0; d < directions; ++d)
                    {
                      const double along = gx * cosine[d] + gy * sine[d], across = gy * cosine[d] - gx * sine[d];
                      const double root = std::sqrt(1. + across * across);
                      front += share * std::abs(along);
                      drag += share * root;
                      support += share * std::abs(along) / root;
                    }
                }
            frontal[i]       = static_cast<float>(front);
            shear_drag[i]    = static_cast<float>(drag);
            shear_support[i] = static_cast<float>(support);
            square_slope[i]  = static_cast<float>(square);
          }
    });
  }
} // namespace tribodraw
