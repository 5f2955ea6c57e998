#include <tribodraw/base/errors.h>
#include <tribodraw/base/face_mesh.h>
#include <tribodraw/shell/blank_mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// Distances below this share of the size of the mesh count as zero.
    constexpr double same_place = 1e-7;

    /// In the unit mm, all triangles counter-clockwise.
    BlankMesh
    upwards(const FaceMesh &faces, const double length_unit)
    {
      BlankMesh mesh;
      for (const Vector3d &x : faces.nodes)
        mesh.nodes.push_back(length_unit * x);
      for (std::size_t e = 0; e < faces.triangles.size(); ++e)
        {
          const auto    &t = faces.triangles[e];
          const Vector3d a = mesh.nodes[t[1]] - mesh.nodes[t[0]], b = mesh.nodes[t[2]] - mesh.nodes[t[0]];
          const Vector3d normal = a.cross(b);
          if (!(normal.norm() > 1e-6 * a.norm() * b.norm()))
            throw InputError(describe_error("An element of the mesh has no area.",
                                            faces.name + ", element " + std::to_string(faces.elements[e])));
          if (normal.z() > 0)
            mesh.triangles.push_back(t);
          else
            mesh.triangles.push_back({ t[0], t[2], t[1] });
        }
      return mesh;
    }

    /// Lowest and highest coordinates.
    std::pair<Vector3d, Vector3d>
    extent(const BlankMesh &mesh)
    {
      Vector3d low = mesh.nodes[0], high = low;
      for (const Vector3d &x : mesh.nodes)
        {
          low  = low.cwiseMin(x);
          high = high.cwiseMax(x);
        }
      return { low, high };
    }

    /// Move the plane to z = 0 and nodes at the planes of symmetry exactly onto them.
    void
    flatten(BlankMesh &mesh, const std::string &name)
    {
      const auto   [low, high] = extent(mesh);
      const double limit = same_place * (high - low).norm();
      if (high.z() - low.z() > limit)
        throw InputError(describe_error("The mesh of a blank must lie in a plane of constant z.", name,
                                        "z from " + std::to_string(low.z()) + " to " + std::to_string(high.z()) + " mm",
                                        "", "If the file holds tools too, name the part of the blank."));
      for (Vector3d &x : mesh.nodes)
        {
          x.z() = 0;
          if (std::abs(x.x()) < limit)
            x.x() = 0;
          if (std::abs(x.y()) < limit)
            x.y() = 0;
        }
    }

    void
    check_distances(const BlankMesh &mesh, const std::string &name)
    {
      const auto [low, high] = extent(mesh);
      const double shortest  = mesh.smallest_edge();
      if (!(shortest > same_place * (high - low).norm()))
        throw InputError(describe_error("An edge of the mesh has no length.", name, std::to_string(shortest) + " mm",
                                        "more than 1e-7 of the size of the mesh", "Is a node far from the others?"));
      // Sorted along x, equal places are neighbours within the limit.
      const double          limit = 1e-3 * shortest;
      std::vector<unsigned> order(mesh.nodes.size());
      for (unsigned i = 0; i < order.size(); ++i)
        order[i] = i;
      std::sort(order.begin(), order.end(),
                [&](const unsigned a, const unsigned b) { return mesh.nodes[a].x() < mesh.nodes[b].x(); });
      // Bins along y keep the comparison short where many nodes have the same x.
      std::map<std::pair<std::int64_t, std::int64_t>, unsigned> seen;
      const auto cell = [&](const double value, const double shift) { return std::llround(value / limit + shift); };
      for (const unsigned node : order)
        for (const double shift_x : { 0., 0.5 })
          for (const double shift_y : { 0., 0.5 })
            {
              const Vector3d &x = mesh.nodes[node];
              // The shift is part of the key, so that the four grids do not mix.
              const auto found = seen.emplace(
                  std::make_pair(4 * cell(x.x() - low.x(), shift_x) + (shift_x > 0 ? 2 : 0) + (shift_y > 0 ? 1 : 0),
                                 cell(x.y() - low.y(), shift_y)),
                  node);
              if (!found.second && found.first->second != node)
                throw InputError(describe_error("Two nodes of the mesh lie at the same place.", name,
                                                "(" + std::to_string(x.x()) + ", " + std::to_string(x.y()) + ") mm", "",
                                                "Remove duplicate nodes before saving the mesh."));
            }
    }

    void
    detect_symmetry(BlankMesh &mesh)
    {
      const auto opposite = mesh.opposite_nodes();
      mesh.on_x_plane.assign(mesh.nodes.size(), false);
      mesh.on_y_plane.assign(mesh.nodes.size(), false);
      for (unsigned axis = 0; axis < 2; ++axis)
        {
          const bool one_side
              = std::all_of(mesh.nodes.begin(), mesh.nodes.end(), [&](const Vector3d &x) { return x[axis] >= 0; });
          bool found = false;
          for (std::size_t e = 0; one_side && e < mesh.triangles.size(); ++e)
            for (unsigned k = 0; k < 3; ++k)
              {
                const unsigned a = mesh.triangles[e][k], b = mesh.triangles[e][(k + 1) % 3];
                if (opposite[e][k] < 0 && mesh.nodes[a][axis] == 0 && mesh.nodes[b][axis] == 0)
                  {
                    auto &on_plane = axis == 0 ? mesh.on_x_plane : mesh.on_y_plane;
                    on_plane[a] = on_plane[b] = found = true;
                  }
              }
          if (found)
            mesh.symmetry_factor *= 2;
        }
      mesh.mark_outer_edge();
    }
  } // namespace

  BlankMesh
  read_blank_mesh(const std::filesystem::path &file, const double length_unit, const std::string &part)
  {
    if (!(length_unit > 0))
      throw InputError(describe_error("The unit of length of a mesh must be positive.", file.string(),
                                      std::to_string(length_unit) + " mm", "> 0"));
    BlankMesh mesh = upwards(read_face_mesh(file, part), length_unit);
    flatten(mesh, file.string());
    check_distances(mesh, file.string());
    detect_symmetry(mesh);
    return mesh;
  }
} // namespace tribodraw
