#include <tribodraw/base/errors.h>
#include <tribodraw/shell/static_analysis_mesh.h>

#include <Eigen/Geometry>

#include <cmath>
#include <sstream>
#include <string>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// Parameters of the nodes; what lies on which side.
    struct Grid
    {
      std::vector<std::array<double, 2>>   parameters; ///< in [0, 1]^2
      std::vector<std::array<unsigned, 3>> triangles;
    };

    Grid
    grid_of_squares(const unsigned n_u, const unsigned n_v, const GridPattern pattern)
    {
      Grid grid;
      for (unsigned j = 0; j <= n_v; ++j)
        for (unsigned i = 0; i <= n_u; ++i)
          grid.parameters.push_back({ i / static_cast<double>(n_u), j / static_cast<double>(n_v) });
      for (unsigned j = 0; j < n_v; ++j)
        for (unsigned i = 0; i < n_u; ++i)
          {
            const unsigned a = j * (n_u + 1) + i, b = a + 1, c = b + n_u + 1, d = c - 1;
            if (pattern == GridPattern::crossed)
              {
                const unsigned m = static_cast<unsigned>(grid.parameters.size());
                grid.parameters.push_back({ (i + 0.5) / n_u, (j + 0.5) / n_v });
                for (const std::array<unsigned, 2> &side :
                     std::array<std::array<unsigned, 2>, 4>{ { { a, b }, { b, c }, { c, d }, { d, a } } })
                  grid.triangles.push_back({ side[0], side[1], m });
              }
            else if (pattern == GridPattern::alternating && (i + j) % 2 == 1)
              {
                grid.triangles.push_back({ a, b, d });
                grid.triangles.push_back({ b, c, d });
              }
            else
              {
                grid.triangles.push_back({ a, b, c });
                grid.triangles.push_back({ a, c, d });
              }
          }
      return grid;
    }

    /// Ring k has k n_v sides, so that triangles have about the same size everywhere.
    Grid
    grid_of_rings(const unsigned n_u, const unsigned n_v)
    {
      Grid                  grid;
      std::vector<unsigned> first; // node of each ring
      for (unsigned k = 0; k <= n_u; ++k)
        {
          first.push_back(static_cast<unsigned>(grid.parameters.size()));
          for (unsigned j = 0; j <= k * n_v; ++j)
            grid.parameters.push_back({ k / static_cast<double>(n_u), k == 0 ? 0. : j / static_cast<double>(k * n_v) });
        }
      for (unsigned k = 1; k <= n_u; ++k)
        for (unsigned sector = 0; sector < n_v; ++sector)
          for (unsigned j = 0; j < k; ++j)
            {
              const unsigned outer = first[k] + sector * k + j, inner = first[k - 1] + sector * (k - 1) + j;
              grid.triangles.push_back({ inner, outer, outer + 1 });
              if (j + 1 < k)
                grid.triangles.push_back({ inner, outer + 1, inner + 1 });
            }
      return grid;
    }

    /// Fourth-order central difference. With steps of 1e-3 of the range round-off and truncation are both near 1e-12.
    Vector3d
    central_difference(const std::function<Vector3d(double)> &f, const double range)
    {
      const double h = 1e-3 * range;
      return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
    }

    Vector3d
    unit_normal(const ParametricSurface &surface, const double u, const double v, const bool pole)
    {
      Vector3d normal;
      if (pole)
        normal = surface.u_tangent(u, surface.v_min)
                     .cross(surface.u_tangent(
                         u, surface.v_min + std::min(0.5 * (surface.v_max - surface.v_min), /* quarter turn */ 1.57)));
      else
        normal = surface.u_tangent(u, v).cross(surface.v_tangent(u, v));
      const double size = normal.norm();
      if (!(size > 0) || !std::isfinite(size))
        {
          std::ostringstream where;
          where << "u = " << u << ", v = " << v;
          throw InputError(describe_error("The surface has no normal.", "shell mesh", where.str(), "a regular surface",
                                          "The pattern `polar` allows one pole, at the smallest u."));
        }
      normal /= size;
      // Planes of symmetry are found by exact zeros.
      for (double &component : normal)
        if (std::abs(component) < 1e-10)
          component = 0;
      return normal.normalized();
    }
  } // namespace

  Vector3d
  ParametricSurface::u_tangent(const double u, const double v) const
  {
    return central_difference([&](const double du) { return position(u + du, v); }, u_max - u_min);
  }

  Vector3d
  ParametricSurface::v_tangent(const double u, const double v) const
  {
    return central_difference([&](const double dv) { return position(u, v + dv); }, v_max - v_min);
  }

  void
  SurfaceMesh::mirror(const Side at, const unsigned axis)
  {
    std::vector<bool> &on_plane = axis == 0 ? mesh.on_x_plane : axis == 1 ? mesh.on_y_plane : mesh.on_z_plane;
    on_plane.resize(mesh.nodes.size(), false);
    for (const unsigned node : side[at])
      on_plane[node] = true;
  }

  unsigned
  SurfaceMesh::nearest(const Vector3d &point) const
  {
    unsigned best = 0;
    for (unsigned node = 1; node < mesh.nodes.size(); ++node)
      if ((mesh.nodes[node] - point).squaredNorm() < (mesh.nodes[best] - point).squaredNorm())
        best = node;
    return best;
  }

  SurfaceMesh
  make_surface_mesh(const ParametricSurface &surface, const unsigned n_u, const unsigned n_v, const GridPattern pattern)
  {
    if (n_u == 0 || n_v == 0)
      throw InputError(describe_error("A surface needs at least one element in each direction.", "shell mesh",
                                      std::to_string(n_u) + " x " + std::to_string(n_v), "1 or more"));
    const bool  polar = pattern == GridPattern::polar;
    const Grid  grid  = polar ? grid_of_rings(n_u, n_v) : grid_of_squares(n_u, n_v, pattern);
    SurfaceMesh result;
    result.mesh.triangles = grid.triangles;
    for (unsigned node = 0; node < grid.parameters.size(); ++node)
      {
        const auto  &p    = grid.parameters[node];
        const double u    = surface.u_min + p[0] * (surface.u_max - surface.u_min);
        const double v    = surface.v_min + p[1] * (surface.v_max - surface.v_min);
        const bool   pole = polar && p[0] == 0;
        result.mesh.nodes.push_back(surface.position(u, v));
        result.mesh.normals.push_back(unit_normal(surface, u, v, pole));
        const std::array<bool, SurfaceMesh::n_sides> on{ p[0] == 0, p[0] == 1, p[1] == 0 || pole, p[1] == 1 || pole };
        for (unsigned s = 0; s < SurfaceMesh::n_sides; ++s)
          if (on[s])
            {
              result.side[s].push_back(node);
              Vector3d tangent = Vector3d::Zero();
              if (s >= SurfaceMesh::v_min)
                tangent = surface.u_tangent(u, pole && s == SurfaceMesh::v_max ? surface.v_max : v).normalized();
              else if (!pole)
                tangent = surface.v_tangent(u, v).normalized();
              result.tangent[s].push_back(tangent);
            }
        result.mesh.on_outer_edge.push_back(on[0] || on[1] || on[2] || on[3]);
      }
    result.mesh.on_x_plane.assign(grid.parameters.size(), false);
    result.mesh.on_y_plane.assign(grid.parameters.size(), false);
    return result;
  }

  SideSupport
  SideSupport::clamped()
  {
    SideSupport s = hinged();
    s.hold_across = true;
    return s;
  }

  SideSupport
  SideSupport::hinged()
  {
    return supported({ { true, true, true } });
  }

  SideSupport
  SideSupport::supported(const std::array<bool, 3> &axes)
  {
    SideSupport s;
    s.displacement = axes;
    s.hold_along   = true;
    return s;
  }

  SideSupport
  SideSupport::diaphragm(const unsigned axis)
  {
    return supported({ { axis != 0, axis != 1, axis != 2 } });
  }

  SideSupport
  SideSupport::symmetry(const unsigned axis)
  {
    SideSupport s;
    s.mirror = static_cast<int>(axis);
    return s;
  }

  void
  apply_support(Supports &supports, const SurfaceMesh &surface, const SurfaceMesh::Side side,
                const SideSupport &support)
  {
    const NodeSet &nodes = surface.side[side];
    if (support.mirror >= 0)
      supports.mirror(nodes, static_cast<unsigned>(support.mirror));
    for (std::size_t k = 0; k < nodes.size(); ++k)
      {
        for (unsigned c = 0; c < 3; ++c)
          if (support.displacement[c])
            supports.fix(nodes[k], c);
        const Vector3d &tangent = surface.tangent[side][k];
        if (tangent.isZero())
          continue;
        if (support.hold_along)
          supports.hold_director(nodes[k], tangent);
        if (support.hold_across)
          supports.hold_director(nodes[k], surface.mesh.normals[nodes[k]].cross(tangent));
      }
  }
} // namespace tribodraw
