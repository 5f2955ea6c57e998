#ifndef tribodraw_shell_blank_mesh_h
#define tribodraw_shell_blank_mesh_h

#include <Eigen/Core>

#include <array>
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

    double smallest_edge() const;
    double largest_edge() const;
  };

  /// A rectangle [0, lx] x [0, ly] (quarter of a 2 lx x 2 ly blank) with n_x x n_y squares, each cut in two with
  /// alternating diagonals (the constant-strain membrane is stiff along one diagonal direction otherwise).
  BlankMesh make_quarter_rectangle(double lx, double ly, unsigned n_x, unsigned n_y);

  /// Grid of a surface given by a mapping of the unit square, alternating diagonals; for benchmarks.
  BlankMesh make_mapped_grid(unsigned n_u, unsigned n_v,
                             const std::vector<Eigen::Vector3d> &points /* (n_u+1)*(n_v+1), u fastest */,
                             bool                                alternating = true);
} // namespace tribodraw

#endif
