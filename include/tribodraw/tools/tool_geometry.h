#ifndef tribodraw_tools_tool_geometry_h
#define tribodraw_tools_tool_geometry_h

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <limits>
#include <string>

namespace tribodraw
{
  class Parameters;

  /// Distance to a rigid tool at a point, in the tool's own frame.
  struct ToolDistance
  {
    double          distance;  ///< signed [mm]: positive outside the tool body, negative inside
    Eigen::Vector3d normal;    ///< gradient of the distance: unit vector out of the tool
    Eigen::Matrix3d curvature; ///< second derivative of the distance [1/mm]
  };

  /// Surface of a rigid tool by its signed distance function. Frame: x, y in the blank's plane
  /// (x = rolling direction), z upwards; the die's flange surface (or the punch's face) lies at z = 0.
  class ToolGeometry
  {
  public:
    virtual ~ToolGeometry() = default;
    static const char *
    kind()
    {
      return "tool shape";
    }
    /// Must be continuous with |d(x) - d(y)| <= |x - y|; exact near the surface.
    virtual ToolDistance distance(const Eigen::Vector3d &x) const = 0;
    /// Smallest convex radius of the surface [mm]: the mesh must resolve it (infinity for a plane).
    virtual double smallest_radius() const = 0;
    /// Box around the surface [mm]; without bounds where a shape has none. A check of units compares it with the blank.
    virtual Eigen::AlignedBox3d
    extent() const
    {
      const Eigen::Vector3d endless = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
      return { -endless, endless };
    }
    /// One sentence for the log.
    virtual std::string describe() const = 0;
  };
} // namespace tribodraw

#endif
