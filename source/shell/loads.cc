#include <tribodraw/base/parallel.h>
#include <tribodraw/shell/loads.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>

namespace tribodraw
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  namespace
  {
    /// skew(a) b = a x b.
    Matrix3d
    skew(const Vector3d &a)
    {
      Matrix3d S;
      S << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
      return S;
    }

    double
    length(const BlankMesh &mesh, const Edge &edge)
    {
      return (mesh.nodes[edge[1]] - mesh.nodes[edge[0]]).norm();
    }
  } // namespace

  NodeSet
  nodes_where(const BlankMesh &mesh, const std::function<bool(const Vector3d &)> &condition)
  {
    NodeSet nodes;
    for (unsigned node = 0; node < mesh.nodes.size(); ++node)
      if (condition(mesh.nodes[node]))
        nodes.push_back(node);
    return nodes;
  }

  std::vector<Edge>
  boundary_edges(const BlankMesh &mesh)
  {
    std::map<Edge, unsigned> uses;
    for (const std::array<unsigned, 3> &t : mesh.triangles)
      for (unsigned k = 0; k < 3; ++k)
        ++uses[{ std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3]) }];
    std::vector<Edge> edges;
    for (const std::array<unsigned, 3> &t : mesh.triangles)
      for (unsigned k = 0; k < 3; ++k)
        if (uses[{ std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3]) }] == 1)
          edges.push_back({ t[k], t[(k + 1) % 3] });
    return edges;
  }

  std::vector<Edge>
  boundary_edges(const BlankMesh &mesh, const NodeSet &nodes)
  {
    std::vector<bool> inside(mesh.nodes.size(), false);
    for (const unsigned node : nodes)
      inside[node] = true;
    std::vector<Edge> edges = boundary_edges(mesh);
    edges.erase(std::remove_if(edges.begin(), edges.end(),
                               [&](const Edge &edge) { return !(inside[edge[0]] && inside[edge[1]]); }),
                edges.end());
    return edges;
  }

  void
  Loads::add_point_force(const unsigned node, const Vector3d &force)
  {
    point_forces.push_back({ node, force });
  }

  void
  Loads::add_point_moment(const unsigned node, const Vector3d &moment)
  {
    point_moments.push_back({ node, moment });
  }

  void
  Loads::add_edge_force(const BlankMesh &mesh, const std::vector<Edge> &edges, const Vector3d &force_per_length)
  {
    for (const Edge &edge : edges)
      for (const unsigned node : edge)
        add_point_force(node, 0.5 * length(mesh, edge) * force_per_length);
  }

  void
  Loads::add_edge_moment(const BlankMesh &mesh, const std::vector<Edge> &edges, const Vector3d &moment_per_length)
  {
    for (const Edge &edge : edges)
      for (const unsigned node : edge)
        add_point_moment(node, 0.5 * length(mesh, edge) * moment_per_length);
  }

  void
  Loads::add_surface_force(const BlankMesh &mesh, const Vector3d &force_per_area)
  {
    for (const std::array<unsigned, 3> &t : mesh.triangles)
      {
        const double area
            = 0.5 * (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]).norm();
        for (const unsigned node : t)
          add_point_force(node, area / 3 * force_per_area);
      }
  }

  void
  Loads::add_pressure(const BlankMesh &mesh, const double pressure)
  {
    std::vector<unsigned> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    add_pressure(pressure, all);
  }

  void
  Loads::add_pressure(const double pressure, const std::vector<unsigned> &elements)
  {
    for (const unsigned element : elements)
      pressures.push_back({ pressure, element });
  }

  void
  Loads::subtract(const Shell &shell, const double factor, Eigen::VectorXd &residual, SparseMatrix *tangent) const
  {
    if (residual.size() < static_cast<Eigen::Index>(shell.n_dofs()))
      throw std::logic_error("Loads::subtract: the residual has too few entries.");
    const Shell::Configuration &c = shell.trial();
    if (parallel::rank() != 0)
      tangent = nullptr;

    for (const NodeLoad &load : point_forces)
      for (unsigned k = 0; k < 3; ++k)
        residual[shell.dof(load.node, k)] -= factor * load.value[k];

    for (const NodeLoad &load : point_moments)
      {
        // The rotation that belongs to a director increment along e_t is d x e_t.
        const Vector3d &d = c.director[load.node];
        for (unsigned t = 0; t < 2; ++t)
          residual[shell.dof(load.node, 3 + t)] -= factor * load.value.dot(d.cross(c.frame[load.node][t]));
        if (tangent)
          {
            // d (d x e_t) / d w_s = e_s x e_t: the frame moves with the director.
            const int first    = static_cast<int>(shell.dof(load.node, 3)),
                      second   = static_cast<int>(shell.dof(load.node, 4));
            const double along = factor * load.value.dot(d);
            tangent->add(second, first, -along);
            tangent->add(first, second, along);
          }
      }

    for (const Pressure &pressure : pressures)
      {
        const std::array<unsigned, 3> &t    = shell.mesh().triangles[pressure.element];
        const Vector3d                 side = c.position[t[1]] - c.position[t[0]];
        const Vector3d force = factor * pressure.value / 6 * side.cross(c.position[t[2]] - c.position[t[0]]);
        for (const unsigned node : t)
          for (unsigned k = 0; k < 3; ++k)
            residual[shell.dof(node, k)] -= force[k];
        if (!tangent)
          continue;
        for (unsigned j = 0; j < 3; ++j)
          {
            const Matrix3d slope
                = factor * pressure.value / 6 * skew(c.position[t[(j + 2) % 3]] - c.position[t[(j + 1) % 3]]);
            for (const unsigned node : t)
              for (unsigned k = 0; k < 3; ++k)
                for (unsigned l = 0; l < 3; ++l)
                  if (k != l)
                    tangent->add(static_cast<int>(shell.dof(node, k)), static_cast<int>(shell.dof(t[j], l)),
                                 -slope(k, l));
          }
      }
  }

  Eigen::VectorXd
  Loads::forces(const Shell &shell) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(shell.n_dofs());
    subtract(shell, -1, result, nullptr);
    return result;
  }

  bool
  Loads::conservative() const
  {
    return pressures.empty() && point_moments.empty();
  }

  Supports::Supports(Shell &the_shell)
      : shell(the_shell), is_fixed(the_shell.n_dofs(), false), value(Eigen::VectorXd::Zero(the_shell.n_dofs()))
  {
  }

  void
  Supports::fix(const unsigned node, const unsigned component)
  {
    is_fixed[shell.dof(node, component)] = true;
  }

  void
  Supports::fix(const NodeSet &nodes, const std::vector<unsigned> &components)
  {
    for (const unsigned node : nodes)
      for (const unsigned c : components)
        fix(node, c);
  }

  void
  Supports::clamp(const NodeSet &nodes)
  {
    fix(nodes, { 0, 1, 2, 3, 4 });
  }

  void
  Supports::hinge(const NodeSet &nodes)
  {
    fix(nodes, { 0, 1, 2 });
  }

  void
  Supports::hinge(const NodeSet &nodes, const Vector3d &edge_direction)
  {
    hinge(nodes);
    for (const unsigned node : nodes)
      hold_director(node, edge_direction);
  }

  void
  Supports::mirror(const NodeSet &nodes, const unsigned axis)
  {
    const Vector3d normal = Vector3d::Unit(axis);
    for (const unsigned node : nodes)
      {
        if (std::abs(shell.trial().director[node].dot(normal)) > 1e-9)
          throw std::logic_error("Supports::mirror: a director does not lie in the plane of symmetry.");
        fix(node, axis);
        hold_director(node, normal);
      }
  }

  void
  Supports::prescribe(const NodeSet &nodes, const unsigned component, const double new_value)
  {
    for (const unsigned node : nodes)
      {
        fix(node, component);
        value[shell.dof(node, component)] = new_value;
      }
  }

  void
  Supports::hold_director(const unsigned node, const Vector3d &axis)
  {
    const bool first = is_fixed[shell.dof(node, 3)], second = is_fixed[shell.dof(node, 4)];
    if (first && second)
      return;
    if (!first && !second)
      {
        shell.align_director_frame(node, axis);
        fix(node, 3);
        return;
      }
    // One direction is held already: in another one the director has no freedom left.
    const unsigned  held      = first ? 0 : 1;
    const Vector3d &d         = shell.trial().director[node];
    const Vector3d  projected = (axis - axis.dot(d) * d).normalized();
    if (projected.cross(shell.trial().frame[node][held]).norm() > 1e-9)
      fix(node, held == 0 ? 4 : 3);
  }
} // namespace tribodraw
