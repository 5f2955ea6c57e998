#ifndef tribodraw_tools_triangulation_h
#define tribodraw_tools_triangulation_h

#include <tribodraw/tools/placement.h>
#include <tribodraw/tools/triangle_mesh.h>

namespace tribodraw
{
  /// The part of a tool's surface inside a box as triangles, for pictures: one vertex in every cell of a grid that the
  /// surface passes through, moved onto the surface (dual contouring, S. F. F. Gibson, MICCAI 1998). Edges sharper than
  /// the grid are cut off. Where the surface leaves the box it is open. Empty if it does not pass through.
  /// @param n_cells about so many cells in the box
  TriangleMesh triangulate(const PlacedTool &tool, const Eigen::AlignedBox3d &box, unsigned n_cells = 40000);
} // namespace tribodraw

#endif
