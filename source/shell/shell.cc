#include <tribodraw/base/errors.h>
#include <tribodraw/shell/shell.h>

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>
#include <string>

#include "implementation.h"

namespace tribodraw
{
  using shell_element::frame_along;

  namespace
  {
    Eigen::Vector3d
    area_vector(const std::array<unsigned, 3> &triangle, const std::vector<Eigen::Vector3d> &position)
    {
      return 0.5 * (position[triangle[1]] - position[triangle[0]]).cross(position[triangle[2]] - position[triangle[0]]);
    }

    std::vector<Eigen::Vector3d>
    mean_normals(const BlankMesh &mesh, const std::vector<Eigen::Vector3d> &position)
    {
      std::vector<Eigen::Vector3d> normal(position.size(), Eigen::Vector3d::Zero());
      for (const std::array<unsigned, 3> &triangle : mesh.triangles)
        for (const unsigned node : triangle)
          normal[node] += area_vector(triangle, position);
      for (Eigen::Vector3d &n : normal)
        n.normalize();
      return normal;
    }

    Shell::Configuration
    undeformed(const BlankMesh &mesh)
    {
      Shell::Configuration c;
      c.position = mesh.nodes;
      c.director = mesh.normals.empty() ? mean_normals(mesh, mesh.nodes) : mesh.normals;
      for (const Eigen::Vector3d &d : c.director)
        c.frame.push_back(frame_along(std::abs(d.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY(), d));
      return c;
    }

    shell_element::Neighbours
    neighbours(const BlankMesh &mesh, const std::array<unsigned, 3> &triangle, const std::array<int, 3> &opposite,
               const bool smoothed)
    {
      shell_element::Neighbours result;
      for (unsigned k = 0; k < 3; ++k)
        {
          result.present[k]    = opposite[k] >= 0;
          const auto both_ends = [&](const std::vector<bool> &on_plane) {
            return !on_plane.empty() && on_plane[triangle[k]] && on_plane[triangle[(k + 1) % 3]];
          };
          result.mirrored[k]
              = smoothed && !result.present[k]
                && (both_ends(mesh.on_x_plane) || both_ends(mesh.on_y_plane) || both_ends(mesh.on_z_plane));
        }
      return result;
    }

    void
    check(const BlankMesh &mesh, const double thickness)
    {
      if (mesh.triangles.empty())
        throw InputError(describe_error("The blank mesh has no elements.", "shell"));
      if (!(thickness > 0))
        throw InputError(
            describe_error("The sheet thickness must be positive.", "shell", std::to_string(thickness) + " mm", "> 0"));
      if (!mesh.normals.empty() && mesh.normals.size() != mesh.nodes.size())
        throw std::logic_error("BlankMesh::normals must be empty or hold one normal a node.");
    }
  } // namespace

  Shell::Implementation::Implementation(const BlankMesh &blank, const double sheet_thickness,
                                        std::shared_ptr<const SheetMaterial> sheet_material,
                                        shell_element::ThicknessRule thickness_rule, const Membrane membrane)
      : mesh(blank), thickness(sheet_thickness), material(std::move(sheet_material)), rule(std::move(thickness_rule)),
        discretization(blank, membrane == Membrane::edge_smoothed), node_area(blank.nodes.size(), 0.),
        frame_axis(blank.nodes.size(), Eigen::Vector3d::Zero()), trial(undeformed(blank)), committed(trial),
        stretch(owned().size(), 1.), old_points(owned().size() * n_points()), new_points(old_points),
        old_summary(owned().size()), new_summary(owned().size()), forces(owned().size()), tangents(owned().size())
  {
    for (const std::array<unsigned, 3> &triangle : mesh.triangles)
      {
        element_area.push_back(area_vector(triangle, mesh.nodes).norm());
        if (!(element_area.back() > 0))
          throw InputError(describe_error("The blank mesh has an element without area.", "shell",
                                          "element " + std::to_string(element_area.size() - 1)));
        for (const unsigned node : triangle)
          node_area[node] += element_area.back() / 3;
      }
    for (const unsigned element : owned())
      reference.push_back(shell_element::make_reference(
          node_state(element, trial), neighbours(mesh, mesh.triangles[element], discretization.opposite_nodes(element),
                                                 membrane == Membrane::edge_smoothed)));
    make_contributions();
    make_offsets();
    update_derived();
  }

  shell_element::NodeState
  Shell::Implementation::node_state(const unsigned element, const Configuration &configuration) const
  {
    shell_element::NodeState state;
    for (unsigned i = 0; i < shell_element::n_nodes; ++i)
      {
        const unsigned node = mesh.triangles[element][i];
        state.position[i]   = configuration.position[node];
        state.director[i]   = configuration.director[node];
        state.frame[i]      = configuration.frame[node];
        const int opposite  = discretization.opposite_nodes(element)[i];
        if (opposite >= 0)
          state.opposite[i] = configuration.position[opposite];
      }
    return state;
  }

  Shell::Shell(const BlankMesh &mesh, const double thickness, std::shared_ptr<const SheetMaterial> material,
               const unsigned n_thickness_points, const ThicknessPoints kind, const Membrane membrane)
  {
    check(mesh, thickness);
    data = std::make_unique<Implementation>(
        mesh, thickness, std::move(material),
        kind == ThicknessPoints::halves
            ? shell_element::make_halved_thickness_rule(n_thickness_points)
            : shell_element::make_thickness_rule(n_thickness_points, kind == ThicknessPoints::lobatto),
        membrane);
  }

  Shell::~Shell() = default;

  const BlankMesh &
  Shell::mesh() const
  {
    return data->mesh;
  }

  unsigned
  Shell::n_nodes() const
  {
    return static_cast<unsigned>(data->mesh.nodes.size());
  }

  unsigned
  Shell::n_elements() const
  {
    return static_cast<unsigned>(data->mesh.triangles.size());
  }

  unsigned
  Shell::n_dofs() const
  {
    return data->discretization.n_dofs();
  }

  unsigned
  Shell::dof(const unsigned node, const unsigned component) const
  {
    return data->discretization.dof(node, component);
  }

  SparseMatrix
  Shell::make_matrix(const unsigned n_extra) const
  {
    return SparseMatrix(data->discretization.columns(n_extra));
  }

  void
  Shell::align_director_frame(const unsigned node, const Eigen::Vector3d &axis)
  {
    for (Configuration *c : { &data->trial, &data->committed })
      {
        if (axis.cross(c->director[node]).norm() < 1e-6 * axis.norm())
          throw std::logic_error("Shell::align_director_frame: the axis is parallel to the director.");
        c->frame[node] = frame_along(axis, c->director[node]);
      }
    data->frame_axis[node] = axis.normalized();
  }

  void
  Shell::move(const Eigen::VectorXd &increment)
  {
    if (increment.size() < static_cast<Eigen::Index>(n_dofs()))
      throw std::logic_error("Shell::move: the increment has too few entries.");
    Configuration &c = data->trial;
    for (unsigned node = 0; node < n_nodes(); ++node)
      {
        for (unsigned k = 0; k < 3; ++k)
          c.position[node][k] += increment[dof(node, k)];
        shell_element::turn(c.director[node], c.frame[node], increment[dof(node, 3)], increment[dof(node, 4)]);
        if (data->frame_axis[node] != Eigen::Vector3d::Zero())
          c.frame[node] = frame_along(data->frame_axis[node], c.director[node]);
      }
    data->assembled = false;
  }

  void
  Shell::revert()
  {
    set_trial(data->committed);
  }

  const Shell::Configuration &
  Shell::trial() const
  {
    return data->trial;
  }

  void
  Shell::set_trial(const Configuration &configuration)
  {
    data->trial     = configuration;
    data->assembled = false;
  }

  const Shell::Configuration &
  Shell::committed() const
  {
    return data->committed;
  }

  std::vector<double>
  Shell::node_current_area() const
  {
    std::vector<double> area(n_nodes(), 0.);
    for (const std::array<unsigned, 3> &triangle : data->mesh.triangles)
      for (const unsigned node : triangle)
        area[node] += area_vector(triangle, data->trial.position).norm() / 3;
    return area;
  }

  std::vector<Eigen::Vector3d>
  Shell::node_normals() const
  {
    return mean_normals(data->mesh, data->trial.position);
  }
} // namespace tribodraw
