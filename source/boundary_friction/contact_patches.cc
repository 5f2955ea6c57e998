#include <tribodraw/base/errors.h>
#include <tribodraw/boundary_friction/contact_patches.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribodraw
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// Sums over the pixels of a patch; coordinates in pixels relative to the patch's first, so that they are exact
    /// integers.
    struct Sums
    {
      std::int64_t first_x = 0, first_y = 0;
      double       n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, height = 0, square_slope = 0;
      double       lowest = std::numeric_limits<double>::infinity(), tool_rim = 0, plateau_rim = 0;

      void
      add(const double px, const double py, const double t, const double slope2)
      {
        n += 1;
        x += px;
        y += py;
        xx += px * px;
        xy += px * py;
        yy += py * py;
        height += t;
        square_slope += slope2;
        lowest = std::min(lowest, t);
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

    /// The earlier pixel of the map becomes the root: results do not depend on the order of the unions.
    void
    unite(std::vector<std::int32_t> &parent, const std::int32_t i, const std::int32_t j)
    {
      const std::int32_t r = find_root(parent, i), q = find_root(parent, j);
      parent[std::max(r, q)] = std::min(r, q);
    }

    /// The image of a distance nearest to zero on a ring of n.
    std::int64_t
    nearest_image(const std::int64_t distance, const std::int64_t n)
    {
      return distance > n / 2 ? distance - n : distance < -(n / 2) ? distance + n : distance;
    }
  } // namespace

  double
  ContactPatch::depth_of_volume() const
  {
    return 2. * volume / area;
  }

  double
  ContactPatch::depth_of_slope() const
  {
    return slope / std::hypot(1. / a, 1. / b);
  }

  PlateauContact::PlateauContact(const HeightMap &sheet, const ToolSurface &tool, const double cut_height)
      : surface(tool), periodic(sheet.periodic && tool.map.periodic), rank(tool.map.size(), -1)
  {
    if (sheet.nx != tool.map.nx || sheet.ny != tool.map.ny)
      throw InputError(
          describe_error("Contact patches need sheet and tool heights on the same grid", "boundary friction",
                         std::to_string(sheet.nx) + " x " + std::to_string(sheet.ny) + " and "
                             + std::to_string(tool.map.nx) + " x " + std::to_string(tool.map.ny) + " pixels"));
    for (const std::uint32_t i : tool.order)
      if (sheet.z[i] >= cut_height)
        {
          rank[i] = static_cast<std::int32_t>(pixel.size());
          pixel.push_back(i);
        }
  }

  std::vector<std::int32_t>
  PlateauContact::label(const std::int32_t n) const
  {
    // Raster scan: a pixel joins its neighbours to the left and in the row before.
    const auto nx = static_cast<std::int32_t>(surface.map.nx), ny = static_cast<std::int32_t>(surface.map.ny);
    std::vector<std::int32_t> parent(surface.map.size(), -1);
    const auto                touches = [&](const std::int32_t i) { return rank[i] >= 0 && rank[i] < n; };
    for (std::int32_t iy = 0; iy < ny; ++iy)
      for (std::int32_t ix = 0; ix < nx; ++ix)
        {
          const std::int32_t i = iy * nx + ix;
          if (!touches(i))
            continue;
          parent[i] = i;
          if (ix > 0 && touches(i - 1))
            unite(parent, i, i - 1);
          for (std::int32_t jx = std::max(ix - 1, 0); iy > 0 && jx <= std::min(ix + 1, nx - 1); ++jx)
            if (touches(i - ix - nx + jx))
              unite(parent, i, i - ix - nx + jx);
        }
    const auto join_across
        = [&](const std::int32_t ix, const std::int32_t iy, const std::int32_t jx, const std::int32_t jy) {
            const std::int32_t i = iy * nx + ix, j = ((jy + ny) % ny) * nx + (jx + nx) % nx;
            if (touches(i) && touches(j))
              unite(parent, i, j);
          };
    for (std::int32_t step = -1; periodic && step <= 1; ++step)
      {
        for (std::int32_t iy = 0; iy < ny; ++iy)
          join_across(0, iy, -1, iy + step);
        for (std::int32_t ix = 0; ix < nx; ++ix)
          join_across(ix, 0, ix + step, -1);
      }
    return parent;
  }

  std::vector<ContactPatch>
  PlateauContact::patches(const std::size_t n_pixels) const
  {
    const std::size_t n = std::min(n_pixels, pixel.size());
    if (n == 0)
      return {};
    const HeightMap          &map = surface.map;
    const auto                nx = static_cast<std::int64_t>(map.nx), ny = static_cast<std::int64_t>(map.ny);
    std::vector<std::int32_t> parent = label(static_cast<std::int32_t>(n));

    const double              plane = map.z[pixel[std::min(n, pixel.size() - 1)]];
    std::vector<std::int32_t> patch_of(map.size(), -1);
    std::vector<Sums>         all;
    for (std::int64_t iy = 0; iy < ny; ++iy)
      for (std::int64_t ix = 0; ix < nx; ++ix)
        {
          const std::int64_t i = iy * nx + ix;
          if (parent[i] < 0)
            continue;
          const std::int32_t root = find_root(parent, static_cast<std::int32_t>(i));
          if (patch_of[root] < 0)
            {
              patch_of[root] = static_cast<std::int32_t>(all.size());
              all.emplace_back();
              all.back().first_x = ix;
              all.back().first_y = iy;
            }
          Sums        &sums = all[patch_of[root]];
          std::int64_t px = ix - sums.first_x, py = iy - sums.first_y;
          if (periodic)
            {
              px = nearest_image(px, nx);
              py = nearest_image(py, ny);
            }
          sums.add(static_cast<double>(px), static_cast<double>(py), map.z[i] - plane, surface.square_slope[i]);
          for (std::int64_t jy = iy - 1; jy <= iy + 1; ++jy)
            for (std::int64_t jx = ix - 1; jx <= ix + 1; ++jx)
              {
                if (!periodic && (jx < 0 || jx >= nx || jy < 0 || jy >= ny))
                  continue;
                const std::int32_t neighbour = rank[((jy + ny) % ny) * nx + (jx + nx) % nx];
                sums.tool_rim += neighbour >= static_cast<std::int32_t>(n);
                sums.plateau_rim += neighbour < 0;
              }
        }

    std::vector<ContactPatch> result;
    result.reserve(all.size());
    for (const Sums &sums : all)
      {
        const double rim         = sums.tool_rim + sums.plateau_rim;
        const double base        = rim > 0 ? sums.lowest * sums.plateau_rim / rim : sums.lowest; // above the plane
        const double mean_height = std::max(0., sums.height / sums.n - base);
        ContactPatch patch;
        patch.pixels   = static_cast<std::size_t>(sums.n);
        patch.area     = sums.n * pixel_area();
        patch.volume   = mean_height * patch.area;
        patch.slope    = std::sqrt(sums.square_slope / sums.n);
        patch.centre_x = (static_cast<double>(sums.first_x) + sums.x / sums.n) * map.dx;
        patch.centre_y = (static_cast<double>(sums.first_y) + sums.y / sums.n) * map.dy;
        fit_ellipse(sums, map.dx, map.dy, patch);
        result.push_back(patch);
      }
    return result;
  }
} // namespace tribodraw
