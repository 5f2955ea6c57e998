#ifndef tribodraw_tools_rigid_tool_h
#define tribodraw_tools_rigid_tool_h

#include <tribodraw/tools/tool_geometry.h>

#include <memory>
#include <string>

namespace tribodraw
{
  /// A tool in the press: its surface, where its frame is and how it moves. Tools translate; they do not turn.
  struct RigidTool
  {
    std::string                         name; ///< `Die`, `Punch`, `Blank holder`: zone of the friction tables
    std::shared_ptr<const ToolGeometry> geometry;
    Eigen::Vector3d                     position = Eigen::Vector3d::Zero(); ///< of the tool's frame [mm]
    Eigen::Vector3d                     velocity = Eigen::Vector3d::Zero(); ///< [mm/s]

    /// Distance of point @p x of the press to the tool where it is now.
    ToolDistance
    distance(const Eigen::Vector3d &x) const
    {
      return geometry->distance(x - position);
    }
  };
} // namespace tribodraw

#endif
