#include <tribodraw/base/errors.h>
#include <tribodraw/surface/closed_voids.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    using Index = std::uint32_t;

    /// Sets of pixels that grow together. On periodic maps each pixel knows its place relative to its parent on the
    /// unrolled map: if two pixels of one set meet at another place than the set says, it leads around the map.
    class Voids
    {
    public:
      explicit Voids(const HeightMap &map)
          : parent(map.size()), area(map.size(), 0), volume(map.size(), 0.), open(map.size(), 0)
      {
        if (map.periodic)
          place.assign(map.size(), { 0, 0 });
        std::iota(parent.begin(), parent.end(), Index(0));
      }

      bool
      exists(Index i) const
      {
        return area[i] > 0;
      }

      void
      add(Index i, double height, bool at_border)
      {
        area[i]   = 1;
        volume[i] = height;
        open[i]   = at_border;
        count(i, +1.);
      }

      /// Connect pixel @p b, which lies (x, y) beside @p a.
      void
      connect(Index a, Index b, std::int32_t x, std::int32_t y)
      {
        Place       pa{ 0, 0 }, pb{ 0, 0 };
        const Index ra = find(a, pa), rb = find(b, pb);
        const Place from_a{ pa.x + x, pa.y + y }; // of b, seen from the root of a
        if (ra == rb)
          {
            if (!open[ra] && !place.empty() && (from_a.x != pb.x || from_a.y != pb.y))
              {
                count(ra, -1.);
                open[ra] = 1;
              }
            return;
          }
        count(ra, -1.);
        count(rb, -1.);
        const bool  a_is_larger = area[ra] >= area[rb];
        const Index root = a_is_larger ? ra : rb, child = a_is_larger ? rb : ra;
        parent[child] = root;
        if (!place.empty())
          place[child]
              = a_is_larger ? Place{ from_a.x - pb.x, from_a.y - pb.y } : Place{ pb.x - from_a.x, pb.y - from_a.y };
        area[root] += area[child];
        volume[root] += volume[child];
        open[root] |= open[child];
        count(root, +1.);
      }

      double closed_area = 0, closed_heights = 0; ///< pixels in closed voids, and the sum of their heights

    private:
      struct Place
      {
        std::int32_t x, y;
      };

      void
      count(Index root, double sign)
      {
        if (open[root])
          return;
        closed_area += sign * static_cast<double>(area[root]);
        closed_heights += sign * volume[root];
      }

      /// Root of a pixel and its place seen from there; halves the path.
      Index
      find(Index i, Place &p)
      {
        while (parent[i] != i)
          {
            const Index up = parent[i];
            if (!place.empty())
              {
                if (parent[up] != up)
                  {
                    place[i].x += place[up].x;
                    place[i].y += place[up].y;
                  }
                p.x += place[i].x;
                p.y += place[i].y;
              }
            parent[i] = parent[up];
            i         = parent[i];
          }
        return i;
      }

      std::vector<Index>  parent, area;
      std::vector<double> volume; ///< sum of the heights
      std::vector<char>   open;
      std::vector<Place>  place;
    };
  } // namespace

  std::vector<VoidState>
  closed_voids(const HeightMap &map, unsigned n)
  {
    if (map.size() == 0 || map.size() > 0xffffffffu || n < 2)
      throw InputError(describe_error("no closed voids on this map.", map.description));
    const auto   nx = static_cast<Index>(map.nx), ny = static_cast<Index>(map.ny);
    const double mean = Eigen::Map<const Eigen::ArrayXd>(map.z.data(), static_cast<Eigen::Index>(map.size())).mean();
    std::vector<Index> order(map.size());
    std::iota(order.begin(), order.end(), Index(0));
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return map.z[a] != map.z[b] ? map.z[a] < map.z[b] : a < b; });

    Voids                  voids(map);
    std::vector<VoidState> states;
    double                 heights = 0.;
    std::size_t            done    = 0;
    const auto             size    = static_cast<double>(map.size());
    for (unsigned k = n - 1; k > 0; --k)
      {
        const double fraction = static_cast<double>(k) / n;
        const auto   end      = std::min(map.size(), static_cast<std::size_t>(std::lround((1. - fraction) * size)));
        for (; done < end; ++done)
          {
            const Index  i = order[done], ix = i % nx, iy = i / nx;
            const double z = map.z[i] - mean;
            heights += z;
            voids.add(i, z, !map.periodic && (ix == 0 || ix + 1 == nx || iy == 0 || iy + 1 == ny));
            const auto meet = [&](bool inside, Index other, std::int32_t x, std::int32_t y) {
              if ((inside || map.periodic) && voids.exists(other))
                voids.connect(i, other, x, y);
            };
            meet(ix > 0, iy * nx + (ix + nx - 1) % nx, -1, 0);
            meet(ix + 1 < nx, iy * nx + (ix + 1) % nx, 1, 0);
            meet(iy > 0, (iy + ny - 1) % ny * nx + ix, 0, -1);
            meet(iy + 1 < ny, (iy + 1) % ny * nx + ix, 0, 1);
          }
        VoidState    s;
        const double height = done > 0 ? map.z[order[done - 1]] - mean : map.z[order[0]] - mean;
        s.contact_fraction  = 1. - static_cast<double>(done) / size;
        s.height            = height;
        s.volume            = (static_cast<double>(done) * height - heights) / size;
        s.closed_volume     = std::max(0., voids.closed_area * height - voids.closed_heights) / size;
        s.closed_area       = voids.closed_area / size;
        states.push_back(s);
      }
    std::reverse(states.begin(), states.end());
    return states;
  }

  VoidState
  state_at(const std::vector<VoidState> &states, double contact_fraction)
  {
    const auto after = std::find_if(states.begin(), states.end(),
                                    [&](const VoidState &s) { return s.contact_fraction >= contact_fraction; });
    if (after == states.begin())
      return states.front();
    if (after == states.end())
      return states.back();
    const VoidState &a = *(after - 1), &b = *after;
    const double     t   = (contact_fraction - a.contact_fraction) / (b.contact_fraction - a.contact_fraction);
    const auto       mix = [t](double u, double v) { return (1. - t) * u + t * v; };
    return { contact_fraction, mix(a.height, b.height), mix(a.volume, b.volume), mix(a.closed_volume, b.closed_volume),
             mix(a.closed_area, b.closed_area) };
  }
} // namespace tribodraw
