#ifndef tribodraw_base_face_mesh_h
#define tribodraw_base_face_mesh_h

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tribodraw
{
  /// The triangles and quadrangles of a finite-element model, quadrangles cut along their shorter diagonal. Lengths in
  /// the unit of the file.
  struct FaceMesh
  {
    std::string                          name; ///< of the file, for messages
    std::vector<Eigen::Vector3d>         nodes;
    std::vector<std::array<unsigned, 3>> triangles; ///< corners in the order of the file
    std::vector<std::int64_t>            elements;  ///< number that the file gives to the element of each triangle
  };

  /// The two triangles, as numbers of corners, into which the shorter diagonal cuts the quadrangle with the corners @p x.
  std::array<std::array<unsigned, 3>, 2> cut_quadrangle(const std::array<Eigen::Vector3d, 4> &x);

  /// The formats of read_face_mesh() for texts, with their extensions.
  extern const char *const face_mesh_formats;

  /// Does the extension belong to one of the formats?
  bool is_face_mesh(const std::filesystem::path &file);

  /// Read first-order triangles and quadrangles:
  /// - Gmsh (.msh): version 2.2 or 4.1, ASCII. @p part: name or number of a physical group.
  /// - Abaqus (.inp): shell, membrane, surface, rigid and plane elements; parts with instances; included files.
  ///   @p part: name of a part, an instance or an element set.
  /// - LS-DYNA (.k, .key, .dyn): *NODE and *ELEMENT_SHELL in fixed (standard, I10, long) or free format; included
  /// files.
  ///   @p part: number or title of a part.
  /// Points and lines are passed over. Everything else that has an extent (solids, elements of second order) is
  /// refused, unless a @p part without such elements is asked for. An empty @p part takes all. Nodes that no triangle
  /// uses are left out. Throws InputError with file and line.
  FaceMesh read_face_mesh(const std::filesystem::path &file, const std::string &part = "");
} // namespace tribodraw

#endif
