#ifndef tribodraw_tools_triangle_mesh_h
#define tribodraw_tools_triangle_mesh_h

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Triangles in space, counter-clockwise seen from outside of the body.
  struct TriangleMesh
  {
    std::string                                 name;     ///< of the file, for messages
    std::vector<Eigen::Vector3d>                vertices; ///< [mm]
    std::vector<std::array<unsigned, 3>>        triangles;
    std::vector<std::array<Eigen::Vector3d, 3>> normals; ///< of the corners, if the file gives them for all

    Eigen::Vector3d
    corner(const std::size_t t, const unsigned k) const
    {
      return vertices[triangles[t][k % 3]];
    }
  };

  /// Read STL (ASCII or binary) or OBJ (triangles and quadrangles, with or without normals), seen from the content, or a
  /// finite-element mesh, seen from its extension (formats and @p part: read_face_mesh()). @p unit is the length of one
  /// unit of the file [mm]. Corners at the same place become one vertex,
  /// triangles that thereby collapse are left out. Throws InputError naming file and place.
  TriangleMesh read_triangles(const std::filesystem::path &file, double unit, const std::string &part = "");

  /// Make one vertex of all within @p tolerance [mm] of each other, drop collapsed triangles and unused vertices.
  void weld(TriangleMesh &mesh, double tolerance);

  /// The other orientation.
  void turn_over(TriangleMesh &mesh);

  /// Add the reflection in the plane x = 0 (@p axis 0) or y = 0 (1) to a surface that ends there. Throws InputError if
  /// it lies on both sides or does not reach the plane.
  void reflect(TriangleMesh &mesh, int axis);

  /// Which triangles share edges. Edge k of a triangle leads from its corner k to the next.
  class MeshTopology
  {
  public:
    struct Side
    {
      int      triangle = -1; ///< -1: border of the surface
      unsigned edge     = 0;
    };

    /// Throws InputError, with the place, if triangles have no area, an edge belongs to more than two triangles or
    /// neighbours have opposite orientations.
    explicit MeshTopology(const TriangleMesh &mesh);

    const Side &
    opposite(const std::size_t triangle, const unsigned edge) const
    {
      return sides[triangle][edge];
    }
    const std::vector<Eigen::Vector3d> &
    facet_normals() const
    {
      return normals;
    }
    std::size_t n_border_edges() const;

  private:
    std::vector<std::array<Side, 3>> sides;
    std::vector<Eigen::Vector3d>     normals;
  };
} // namespace tribodraw

#endif
