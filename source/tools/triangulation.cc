#include <tribodraw/tools/triangulation.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector3d;
    using Index = std::array<unsigned, 3>;

    /// Distances at the corners of a grid of cubes around a box, one cell wider than it on all sides.
    class DistanceGrid
    {
    public:
      DistanceGrid(const PlacedTool &tool, const Eigen::AlignedBox3d &box, const unsigned n_cells)
          : spacing(std::cbrt(box.volume() / n_cells)), origin(box.min() - Vector3d::Constant(spacing))
      {
        for (int d = 0; d < 3; ++d)
          n[d] = static_cast<unsigned>(std::ceil(box.sizes()[d] / spacing)) + 3;
        for (Index i{}; i[2] < n[2]; ++i[2])
          for (i[1] = 0; i[1] < n[1]; ++i[1])
            for (i[0] = 0; i[0] < n[0]; ++i[0])
              value.push_back(tool.distance(corner(i)).distance);
      }

      Vector3d
      corner(const Index &i) const
      {
        return origin + spacing * Vector3d(i[0], i[1], i[2]);
      }

      std::size_t
      number(const Index &i) const
      {
        return (static_cast<std::size_t>(i[2]) * n[1] + i[1]) * n[0] + i[0];
      }

      double
      at(const Index &i) const
      {
        return value[number(i)];
      }

      const double   spacing;
      const Vector3d origin;
      Index          n{}; ///< corners along each axis

    private:
      std::vector<double> value;
    };

    Index
    shifted(Index i, const int axis, const int by)
    {
      i[axis] += by;
      return i;
    }

    /// Mean of the places where the edges of a cell meet the surface; false if none does.
    bool
    mean_crossing(const DistanceGrid &grid, const Index &cell, Vector3d &mean)
    {
      Vector3d sum   = Vector3d::Zero();
      int      count = 0;
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 4; ++k)
          {
            const Index  a  = shifted(shifted(cell, (axis + 1) % 3, k % 2), (axis + 2) % 3, k / 2);
            const Index  b  = shifted(a, axis, 1);
            const double da = grid.at(a), db = grid.at(b);
            if ((da < 0) == (db < 0))
              continue;
            sum += grid.corner(a) + da / (da - db) * (grid.corner(b) - grid.corner(a));
            ++count;
          }
      if (count > 0)
        mean = sum / count;
      return count > 0;
    }

    /// The distance is exact near the surface: two steps along the normal reach it, within the neighbouring cells.
    Vector3d
    on_surface(const PlacedTool &tool, const Vector3d &start, const double spacing)
    {
      Vector3d x = start;
      for (int step = 0; step < 2; ++step)
        {
          const ToolDistance d = tool.distance(x);
          x -= d.distance * d.normal;
        }
      return (x - start).norm() < spacing ? x : start;
    }
  } // namespace

  TriangleMesh
  triangulate(const PlacedTool &tool, const Eigen::AlignedBox3d &box, const unsigned n_cells)
  {
    const DistanceGrid grid(tool, box, n_cells);
    TriangleMesh       mesh;
    std::vector<int>   vertex(static_cast<std::size_t>(grid.n[0]) * grid.n[1] * grid.n[2], -1); // by the lowest corner
    for (Index i{}; i[2] + 1 < grid.n[2]; ++i[2])
      for (i[1] = 0; i[1] + 1 < grid.n[1]; ++i[1])
        for (i[0] = 0; i[0] + 1 < grid.n[0]; ++i[0])
          if (Vector3d x; mean_crossing(grid, i, x))
            {
              vertex[grid.number(i)] = static_cast<int>(mesh.vertices.size());
              mesh.vertices.push_back(on_surface(tool, x, grid.spacing));
            }
    // Each edge of the grid that meets the surface is crossed by a quadrangle between the four cells around it.
    for (int axis = 0; axis < 3; ++axis)
      {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (Index i{}; i[2] < grid.n[2]; ++i[2])
          for (i[1] = 0; i[1] < grid.n[1]; ++i[1])
            for (i[0] = 0; i[0] < grid.n[0]; ++i[0])
              {
                if (i[axis] + 1 == grid.n[axis] || i[u] == 0 || i[v] == 0 || i[u] + 1 == grid.n[u]
                    || i[v] + 1 == grid.n[v])
                  continue;
                const bool inside = grid.at(i) < 0;
                if (inside == (grid.at(shifted(i, axis, 1)) < 0))
                  continue;
                const Index             low = shifted(shifted(i, u, -1), v, -1);
                std::array<unsigned, 4> q{};
                for (int k = 0; k < 4; ++k) // counter-clockwise about the axis
                  q[k] = vertex[grid.number(shifted(shifted(low, u, k == 1 || k == 2), v, k / 2))];
                if (!inside) // the outside is below
                  std::swap(q[1], q[3]);
                mesh.triangles.push_back({ q[0], q[1], q[2] });
                mesh.triangles.push_back({ q[0], q[2], q[3] });
              }
      }
    return mesh;
  }
} // namespace tribodraw
