#ifndef tribodraw_output_tool_surfaces_h
#define tribodraw_output_tool_surfaces_h

#include <tribodraw/forming/simulation.h>
#include <tribodraw/output/vtu.h>
#include <tribodraw/tools/triangle_mesh.h>

namespace tribodraw
{
  /// The tools of a forming run as triangles over the blank, for pictures.
  class ToolSurfaces
  {
  public:
    /// Where the tools are now, with their numbers as element field `tool`; a single triangle without area once they
    /// are taken away.
    SurfaceFields at_present(const Simulation &simulation);

  private:
    void triangulate_all(const Simulation &simulation);

    std::vector<TriangleMesh> shapes; ///< around the origins of the tools' frames; made when they are first needed
  };
} // namespace tribodraw

#endif
