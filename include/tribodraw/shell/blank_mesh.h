#ifndef tribodraw_shell_blank_mesh_h
#define tribodraw_shell_blank_mesh_h

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// Triangles of the undeformed blank (plane z = 0 for a sheet, any surface for shell benchmarks). Lengths in mm.
  struct BlankMesh
  {
    std::vector<Eigen::Vector3d>         nodes;
    std::vector<std::array<unsigned, 3>> triangles; ///< counter-clockwise seen from +z
    /// Quarter models: nodes on the symmetry planes x = 0 and y = 0.
    std::vector<bool> on_x_plane, on_y_plane;
    /// The same for z = 0, for octants of curved shells; may be empty.
    std::vector<bool> on_z_plane;
    /// Nodes on the free outer edge.
    std::vector<bool> on_outer_edge;
    /// Unit normals at the nodes of a curved surface, where they are known exactly; empty: mean of the adjacent
    /// triangles.
    std::vector<Eigen::Vector3d> normals;
    double                       symmetry_factor = 1; ///< full part / modelled part (4 for a quarter)

    /// Node opposite to each side of each triangle in the neighbour across it (side k from node k to node (k + 1) % 3),
    /// -1 at the boundary. Throws InputError where more than two triangles share a side or two neighbours turn in
    /// opposite directions.
    std::vector<std::array<int, 3>> opposite_nodes() const;

    /// Set on_outer_edge: boundary nodes but for those of sides in the planes of symmetry.
    void mark_outer_edge();

    double smallest_edge() const;
    double largest_edge() const;
  };

  /// A rectangle [0, lx] x [0, ly] (quarter of a 2 lx x 2 ly blank) with n_x x n_y squares, each cut in two with
  /// alternating diagonals (the constant-strain membrane is stiff along one diagonal direction otherwise).
  BlankMesh make_quarter_rectangle(double lx, double ly, unsigned n_x, unsigned n_y);

  /// Wanted edge length of the triangles over the blank [mm].
  struct SizeField
  {
    struct Zone
    {
      Eigen::Vector2d low, high; ///< corners of a rectangle along the axes
      double          size;      ///< inside
    };

    double            size = 0; ///< far from all zones
    std::vector<Zone> zones;
    double            growth = 0.3; ///< of the size per distance from a zone: neighbours differ by about this part

    double at(const Eigen::Vector2d &x) const;
    double smallest() const;
  };

  /// Triangles inside a closed polygon with the corners @p outline, counter-clockwise: Delaunay triangulation of points
  /// on the outline and of a lattice inside, smoothed. @p quarter: sides on x = 0 and y = 0 are planes of symmetry.
  /// Throws InputError if the outline is no simple polygon or too narrow for the elements.
  BlankMesh make_outline_mesh(const std::vector<Eigen::Vector2d> &outline, const SizeField &size, bool quarter);

  /// A disc around the origin or its quarter x >= 0, y >= 0.
  BlankMesh make_disc(double radius, const SizeField &size, bool quarter);

  /// Flat mesh from a file of finite elements (formats and @p part: read_face_mesh()). All triangles are turned
  /// counter-clockwise and the plane is moved to z = 0. Boundary sides on x = 0 and y = 0 of a mesh that lies on one side of
  /// them are planes of symmetry.
  /// @param length_unit of the coordinates of the file [mm]
  /// Throws InputError with the place for anything that does not fit.
  BlankMesh read_blank_mesh(const std::filesystem::path &file, double length_unit = 1, const std::string &part = "");

  /// Points on an arc at the distance of the local size, both ends included; angles in rad, from < to.
  std::vector<Eigen::Vector2d> circular_arc(const Eigen::Vector2d &centre, double radius, double from, double to,
                                            const SizeField &size);

  /// Grid of a surface given by a mapping of the unit square, alternating diagonals; for benchmarks.
  BlankMesh make_mapped_grid(unsigned n_u, unsigned n_v,
                             const std::vector<Eigen::Vector3d> &points /* (n_u+1)*(n_v+1), u fastest */,
                             bool                                alternating = true);
} // namespace tribodraw

#endif
