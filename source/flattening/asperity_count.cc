#include <tribodraw/base/errors.h>
#include <tribodraw/flattening/asperity_count.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tribodraw
{
  namespace
  {
    std::uint32_t
    find_root(std::vector<std::uint32_t> &parent, std::uint32_t i)
    {
      while (parent[i] != i)
        {
          parent[i] = parent[parent[i]];
          i         = parent[i];
        }
      return i;
    }

    /// Flood the map from above. Roots are the highest pixels of the pieces; where two meet, the lower one ends.
    /// Returns for each pixel, in the order from the highest on, the change of the number of pieces that count.
    std::vector<std::int32_t>
    changes(const HeightMap &map, const std::vector<std::uint32_t> &order, const double threshold)
    {
      const std::uint32_t        none = UINT32_MAX;
      const std::size_t          n = map.size(), nx = map.nx, ny = map.ny;
      std::vector<std::uint32_t> parent(n, none), place(n);
      std::vector<std::int32_t>  change(n, 0);
      for (std::size_t k = 0; k < n; ++k)
        place[order[k]] = static_cast<std::uint32_t>(k);
      // A piece that lives from its summit to the saddle counts from the threshold below the summit to the saddle.
      const auto count = [&](const std::uint32_t summit, const std::size_t end) {
        const auto from = std::lower_bound(
            order.begin() + place[summit], order.begin() + end, threshold,
            [&](const std::uint32_t i, const double depth) { return map.z[summit] - map.z[i] < depth; });
        const auto start = static_cast<std::size_t>(from - order.begin());
        if (start < end)
          {
            ++change[start];
            if (end < n)
              --change[end];
          }
      };
      for (std::size_t k = 0; k < n; ++k)
        {
          const std::uint32_t p  = order[k];
          const std::size_t   ix = p % nx, iy = p / nx;
          parent[p] = p;
          for (int jy = -1; jy <= 1; ++jy)
            for (int jx = -1; jx <= 1; ++jx)
              {
                std::size_t qx = ix + nx + jx, qy = iy + ny + jy;
                if (!map.periodic && (qx < nx || qx >= 2 * nx || qy < ny || qy >= 2 * ny))
                  continue;
                const auto q = static_cast<std::uint32_t>((qy % ny) * nx + qx % nx);
                if (parent[q] == none)
                  continue;
                const std::uint32_t a = find_root(parent, p), b = find_root(parent, q);
                if (a == b)
                  continue;
                const bool          a_higher = place[a] < place[b];
                const std::uint32_t survivor = a_higher ? a : b, ends = a_higher ? b : a;
                parent[ends] = survivor;
                if (ends != p) // the pixel itself was never a summit
                  count(ends, k);
              }
        }
      count(order[0], n);
      return change;
    }
  } // namespace

  AsperityCount
  count_asperities(const HeightMap &map, const double pruning)
  {
    if (map.size() == 0 || map.z.size() != map.size())
      throw InputError(describe_error("Asperities can be counted on a rough map only", "flattening", "no heights"));
    std::vector<std::uint32_t> order(map.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](const std::uint32_t i, const std::uint32_t j) {
      return map.z[i] > map.z[j] || (map.z[i] == map.z[j] && i < j);
    });
    const double range = map.z[order.front()] - map.z[order.back()];
    const auto   steps = changes(map, order, pruning * range);

    std::int64_t number = 0, most = 0;
    std::size_t  at = 0;
    for (std::size_t k = 0; k < steps.size(); ++k)
      {
        number += steps[k];
        if (number > most)
          {
            most = number;
            at   = k;
          }
      }
    AsperityCount result;
    const double  area      = static_cast<double>(map.size()) * map.dx * map.dy;
    result.density          = static_cast<double>(std::max<std::int64_t>(most, 1)) / area;
    result.half_spacing     = 0.5 / std::sqrt(result.density);
    result.cut_height       = map.z[order[at]];
    result.contact_fraction = static_cast<double>(at + 1) / static_cast<double>(map.size());
    return result;
  }
} // namespace tribodraw
