#include <tribodraw/base/errors.h>
#include <tribodraw/shell/blank_mesh.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <unordered_map>

namespace tribodraw
{
  namespace
  {
    /// Cut the squares of a grid of nodes, u fastest, into two triangles each.
    std::vector<std::array<unsigned, 3>>
    cut_squares(const unsigned n_u, const unsigned n_v, const bool alternating)
    {
      std::vector<std::array<unsigned, 3>> triangles;
      triangles.reserve(2 * std::size_t(n_u) * n_v);
      for (unsigned j = 0; j < n_v; ++j)
        for (unsigned i = 0; i < n_u; ++i)
          {
            const unsigned a = j * (n_u + 1) + i, b = a + 1, c = b + n_u + 1, d = c - 1;
            if (alternating && (i + j) % 2 == 1)
              {
                triangles.push_back({ a, b, d });
                triangles.push_back({ b, c, d });
              }
            else
              {
                triangles.push_back({ a, b, c });
                triangles.push_back({ a, c, d });
              }
          }
      return triangles;
    }

    void
    require_squares(const unsigned n_u, const unsigned n_v)
    {
      if (n_u == 0 || n_v == 0)
        throw InputError(describe_error("A blank needs at least one element in each direction.", "blank mesh",
                                        std::to_string(n_u) + " x " + std::to_string(n_v), "1 or more"));
    }

    std::string
    side_name(const BlankMesh &mesh, const unsigned from, const unsigned to)
    {
      std::ostringstream text;
      text << "side from (" << mesh.nodes[from].transpose() << ") to (" << mesh.nodes[to].transpose() << ") mm";
      return text.str();
    }

    template <class Better>
    double
    extreme_edge(const BlankMesh &mesh, double best, const Better &better)
    {
      for (const std::array<unsigned, 3> &t : mesh.triangles)
        for (unsigned k = 0; k < 3; ++k)
          {
            const double length = (mesh.nodes[t[k]] - mesh.nodes[t[(k + 1) % 3]]).norm();
            if (better(length, best))
              best = length;
          }
      return best;
    }
  } // namespace

  std::vector<std::array<int, 3>>
  BlankMesh::opposite_nodes() const
  {
    // A side in its direction, with the third node of its triangle; the neighbour runs through it the other way.
    std::unordered_map<std::uint64_t, unsigned> third;
    third.reserve(3 * triangles.size());
    const auto key = [](const unsigned from, const unsigned to) { return (std::uint64_t(from) << 32) | to; };
    for (std::size_t e = 0; e < triangles.size(); ++e)
      for (unsigned k = 0; k < 3; ++k)
        {
          const unsigned from = triangles[e][k], to = triangles[e][(k + 1) % 3];
          if (!third.emplace(key(from, to), triangles[e][(k + 2) % 3]).second)
            throw InputError(describe_error("A side belongs to more than two triangles, or neighbours turn in "
                                            "opposite directions.",
                                            "blank mesh", side_name(*this, from, to), "a surface with one upper side"));
        }
    std::vector<std::array<int, 3>> opposite(triangles.size(), { -1, -1, -1 });
    for (std::size_t e = 0; e < triangles.size(); ++e)
      for (unsigned k = 0; k < 3; ++k)
        {
          const auto found = third.find(key(triangles[e][(k + 1) % 3], triangles[e][k]));
          if (found != third.end())
            opposite[e][k] = static_cast<int>(found->second);
        }
    return opposite;
  }

  void
  BlankMesh::mark_outer_edge()
  {
    const auto opposite = opposite_nodes();
    on_outer_edge.assign(nodes.size(), false);
    for (std::size_t e = 0; e < triangles.size(); ++e)
      for (unsigned k = 0; k < 3; ++k)
        {
          const unsigned a = triangles[e][k], b = triangles[e][(k + 1) % 3];
          if (opposite[e][k] < 0 && !(on_x_plane[a] && on_x_plane[b]) && !(on_y_plane[a] && on_y_plane[b]))
            on_outer_edge[a] = on_outer_edge[b] = true;
        }
  }

  double
  BlankMesh::smallest_edge() const
  {
    return extreme_edge(*this, std::numeric_limits<double>::max(), std::less<double>());
  }

  double
  BlankMesh::largest_edge() const
  {
    return extreme_edge(*this, 0., std::greater<double>());
  }

  BlankMesh
  make_quarter_rectangle(const double lx, const double ly, const unsigned n_x, const unsigned n_y)
  {
    require_squares(n_x, n_y);
    if (!(lx > 0 && ly > 0))
      throw InputError(describe_error("The size of the blank must be positive.", "blank mesh",
                                      std::to_string(lx) + " x " + std::to_string(ly) + " mm", "> 0"));
    BlankMesh mesh;
    for (unsigned j = 0; j <= n_y; ++j)
      for (unsigned i = 0; i <= n_x; ++i)
        {
          mesh.nodes.emplace_back(lx * i / n_x, ly * j / n_y, 0.);
          mesh.on_x_plane.push_back(i == 0);
          mesh.on_y_plane.push_back(j == 0);
          mesh.on_outer_edge.push_back(i == n_x || j == n_y);
        }
    mesh.triangles       = cut_squares(n_x, n_y, true);
    mesh.symmetry_factor = 4;
    return mesh;
  }

  BlankMesh
  make_mapped_grid(const unsigned n_u, const unsigned n_v, const std::vector<Eigen::Vector3d> &points,
                   const bool alternating)
  {
    require_squares(n_u, n_v);
    if (points.size() != std::size_t(n_u + 1) * (n_v + 1))
      throw InputError(describe_error("The number of points does not fit the grid.", "blank mesh",
                                      std::to_string(points.size()), std::to_string(std::size_t(n_u + 1) * (n_v + 1))));
    BlankMesh mesh;
    mesh.nodes = points;
    mesh.on_x_plane.assign(points.size(), false);
    mesh.on_y_plane.assign(points.size(), false);
    for (unsigned j = 0; j <= n_v; ++j)
      for (unsigned i = 0; i <= n_u; ++i)
        mesh.on_outer_edge.push_back(i == 0 || i == n_u || j == 0 || j == n_v);
    mesh.triangles = cut_squares(n_u, n_v, alternating);
    return mesh;
  }
} // namespace tribodraw
