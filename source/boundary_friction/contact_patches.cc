#include <tribodraw/base/errors.h>
#include <tribodraw/boundary_friction/contact_patches.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// Sums over the pixels of a patch; coordinates in pixels, so that the sums are exact integers.
    struct Sums
    {
      double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, height = 0;
      double lowest = 0, tool_rim = 0, plateau_rim = 0;

      void
      add(const double px, const double py, const double t)
      {
        n += 1;
        x += px;
        y += py;
        xx += px * px;
        xy += px * py;
        yy += py * py;
        height += t;
        lowest = t; // pixels come from the highest to the lowest
      }
    };

    /// Below this number of pixels the second moments say more of the pixels than of the patch.
    constexpr double smallest_ellipse = 6;

    void
    fit_ellipse(const Sums &sums, const double dx, const double dy, ContactPatch &patch)
    {
      const double radius = std::sqrt(patch.area / pi);
      patch.a = patch.b = radius;
      patch.psi         = 0;
      if (sums.n < smallest_ellipse)
        return;
      const double mx = sums.x / sums.n, my = sums.y / sums.n;
      // The area of a pixel is not in its centre: + dx^2/12.
      const double vxx  = (sums.xx / sums.n - mx * mx + 1. / 12.) * dx * dx;
      const double vyy  = (sums.yy / sums.n - my * my + 1. / 12.) * dy * dy;
      const double vxy  = (sums.xy / sums.n - mx * my) * dx * dy;
      const double mean = 0.5 * (vxx + vyy), deviation = std::hypot(0.5 * (vxx - vyy), vxy);
      const double large = mean + deviation, small = (vxx * vyy - vxy * vxy) / large;
      const double slenderness = std::sqrt(std::sqrt(large / small)); // sqrt(a/b)
      patch.a                  = radius * slenderness;
      patch.b                  = radius / slenderness;
      patch.psi                = 0.5 * std::atan2(2. * vxy, vxx - vyy);
    }

    std::int32_t
    find_root(std::vector<std::int32_t> &parent, std::int32_t i)
    {
      while (parent[i] != i)
        {
          parent[i] = parent[parent[i]];
          i         = parent[i];
        }
      return i;
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

  PlateauContact::PlateauContact(const HeightMap &sheet, const HeightMap &tool,
                                 const std::vector<std::uint32_t> &tool_order, const double cut_height)
      : map(tool), rank(tool.size(), -1)
  {
    if (sheet.nx != tool.nx || sheet.ny != tool.ny || tool_order.size() != tool.size())
      throw InputError(describe_error("Contact patches need sheet and tool heights on the same grid",
                                      "boundary friction",
                                      std::to_string(sheet.nx) + " x " + std::to_string(sheet.ny) + " and "
                                          + std::to_string(tool.nx) + " x " + std::to_string(tool.ny) + " pixels"));
    for (const std::uint32_t i : tool_order)
      if (sheet.z[i] >= cut_height)
        {
          rank[i] = static_cast<std::int32_t>(pixel.size());
          pixel.push_back(i);
        }
  }

  std::vector<ContactPatch>
  PlateauContact::patches(const std::size_t n_pixels) const
  {
    const std::size_t n = std::min(n_pixels, pixel.size());
    if (n == 0)
      return {};
    const auto for_neighbours = [&](const std::uint32_t p, const auto &visit) {
      const std::size_t nx = map.nx, ix = p % nx, iy = p / nx;
      for (std::size_t jy = iy > 0 ? iy - 1 : 0; jy <= std::min(iy + 1, map.ny - 1); ++jy)
        for (std::size_t jx = ix > 0 ? ix - 1 : 0; jx <= std::min(ix + 1, nx - 1); ++jx)
          visit(rank[jy * nx + jx]);
    };

    std::vector<std::int32_t> parent(n);
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(n); ++k)
      {
        parent[k] = k;
        for_neighbours(pixel[k], [&](const std::int32_t neighbour) {
          if (neighbour < 0 || neighbour >= k)
            return;
          // The earlier pixel becomes the root: results do not depend on the order of the unions.
          const std::int32_t r = find_root(parent, k), q = find_root(parent, neighbour);
          parent[std::max(r, q)] = std::min(r, q);
        });
      }

    const double              plane = map.z[pixel[std::min(n, pixel.size() - 1)]];
    std::vector<std::int32_t> patch_of(n, -1);
    std::vector<Sums>         sums;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(n); ++k)
      {
        const std::int32_t root = find_root(parent, k);
        if (patch_of[root] < 0)
          {
            patch_of[root] = static_cast<std::int32_t>(sums.size());
            sums.emplace_back();
          }
        Sums &s = sums[patch_of[root]];
        s.add(pixel[k] % map.nx, pixel[k] / map.nx, map.z[pixel[k]] - plane);
        for_neighbours(pixel[k], [&](const std::int32_t neighbour) {
          s.tool_rim += neighbour >= static_cast<std::int32_t>(n);
          s.plateau_rim += neighbour < 0;
        });
      }

    std::vector<ContactPatch> result;
    result.reserve(sums.size());
    for (const Sums &s : sums)
      {
        const double rim         = s.tool_rim + s.plateau_rim;
        const double base        = rim > 0 ? s.lowest * s.plateau_rim / rim : s.lowest; // above the plane
        const double mean_height = std::max(0., s.height / s.n - base);
        ContactPatch patch;
        patch.pixels   = static_cast<std::size_t>(s.n);
        patch.area     = s.n * pixel_area();
        patch.volume   = mean_height * patch.area;
        patch.centre_x = s.x / s.n * map.dx;
        patch.centre_y = s.y / s.n * map.dy;
        patch.w        = 2. * mean_height;
        fit_ellipse(s, map.dx, map.dy, patch);
        result.push_back(patch);
      }
    return result;
  }
} // namespace tribodraw
