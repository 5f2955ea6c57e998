#ifndef tribodraw_tools_corner_normals_h
#define tribodraw_tools_corner_normals_h

#include <tribodraw/tools/triangle_mesh.h>

#include <array>
#include <vector>

namespace tribodraw
{
  /// Normals of a smooth surface through the corners of a triangle mesh.
  struct CornerNormals
  {
    /// Corners of triangles around a vertex that are joined by smooth edges share one entry of `normals`.
    std::vector<std::array<unsigned, 3>> index;
    std::vector<Eigen::Vector3d>         normals;
    std::vector<std::array<bool, 3>>     sharp; ///< edge k of a triangle has a neighbour, but is not smooth

    const Eigen::Vector3d &
    of(const std::size_t triangle, const unsigned corner) const
    {
      return normals[index[triangle][corner % 3]];
    }
  };

  /// Normals given by the file, or estimated from the triangles.
  ///
  /// The estimate demands of every edge e between two corners that e.(n1 + n2) = 0: on circles and parabolas the chord
  /// is perpendicular to the mean of the end normals. Where a fillet runs into a flat a mean of facet normals is wrong
  /// by a quarter of the angle between facets, and the condition puts it right. What it leaves free, a corrugation
  /// through the same corners, is set by the edges of the facets around a corner, to which the normal shall be
  /// perpendicular. Both are sums of squares in mm, so that a large facet, which a mesh within a tolerance only has on
  /// a flat, keeps its normal.
  /// @param feature_angle [rad] from which on the edge between two triangles is sharp.
  CornerNormals estimate_normals(const TriangleMesh &mesh, const MeshTopology &topology, double feature_angle);
} // namespace tribodraw

#endif
