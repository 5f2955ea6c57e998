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
      : map(tool), position(tool.size(), -1)
  {
    if (sheet.nx != tool.nx || sheet.ny != tool.ny || tool_order.size() != tool.size())
      throw InputError(describe_error("Contact patches need sheet and tool heights on the same grid",
                                      "boundary friction",
                                      std::to_string(sheet.nx) + " x " + std::to_string(sheet.ny) + " and "
                                          + std::to_string(tool.nx) + " x " + std::to_string(tool.ny) + " pixels"));
    for (const std::uint32_t i : tool_order)
      if (sheet.z[i] >= cut_height)
        pixel.push_back(i);
  }

  std::vector<ContactPatch>
  PlateauContact::patches(const std::size_t n_pixels) const
  {
    const std::size_t n  = std::min(n_pixels, pixel.size());
    const auto        nx = static_cast<std::int64_t>(map.nx), ny = static_cast<std::int64_t>(map.ny);
    if (n == 0)
      return {};

    std::vector<std::int32_t> parent(n);
    for (std::size_t k = 0; k < n; ++k)
      {
        parent[k]             = static_cast<std::int32_t>(k);
        position[pixel[k]]    = static_cast<std::int32_t>(k);
        const std::int64_t ix = pixel[k] % nx, iy = pixel[k] / nx;
        for (std::int64_t jy = std::max<std::int64_t>(iy - 1, 0); jy <= std::min(iy + 1, ny - 1); ++jy)
          for (std::int64_t jx = std::max<std::int64_t>(ix - 1, 0); jx <= std::min(ix + 1, nx - 1); ++jx)
            if (const std::int32_t neighbour = position[jy * nx + jx]; neighbour >= 0)
              {
                // The earlier pixel becomes the root: results do not depend on the order of the unions.
                const std::int32_t r   = find_root(parent, static_cast<std::int32_t>(k)),
                                   q   = find_root(parent, neighbour);
                parent[std::max(r, q)] = std::min(r, q);
              }
      }

    const double              level = map.z[pixel[std::min(n, pixel.size() - 1)]];
    std::vector<std::int32_t> patch_of(n, -1);
    std::vector<Sums>         sums;
    for (std::size_t k = 0; k < n; ++k)
      {
        const std::int32_t root = find_root(parent, static_cast<std::int32_t>(k));
        if (patch_of[root] < 0)
          {
            patch_of[root] = static_cast<std::int32_t>(sums.size());
            sums.emplace_back();
          }
        sums[patch_of[root]].add(pixel[k] % nx, pixel[k] / nx, map.z[pixel[k]] - level);
        position[pixel[k]] = -1; // leave the work space clean
      }

    std::vector<ContactPatch> result;
    result.reserve(sums.size());
    for (const Sums &s : sums)
      {
        ContactPatch patch;
        patch.pixels   = static_cast<std::size_t>(s.n);
        patch.area     = s.n * pixel_area();
        patch.volume   = s.height * pixel_area();
        patch.centre_x = s.x / s.n * map.dx;
        patch.centre_y = s.y / s.n * map.dy;
        patch.w        = 2. * s.height / s.n;
        fit_ellipse(s, map.dx, map.dy, patch);
        result.push_back(patch);
      }
    return result;
  }
} // namespace tribodraw
