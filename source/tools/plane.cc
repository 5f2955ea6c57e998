#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/plane.h>

namespace tribodraw
{
  Plane::Plane(const Facing facing) : normal(tribodraw::normal_z(facing))
  {
  }

  Plane::Plane(Parameters &parameters) : Plane(read_facing(parameters))
  {
  }

  ToolDistance
  Plane::distance(const Eigen::Vector3d &x) const
  {
    return { normal * x[2], normal * Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero() };
  }

  double
  Plane::smallest_radius() const
  {
    return std::numeric_limits<double>::infinity();
  }

  std::string
  Plane::describe() const
  {
    return normal > 0 ? "flat plate facing up" : "flat plate facing down";
  }

  TRIBODRAW_REGISTER(ToolGeometry, Plane, "plane", "A flat tool: blank holder or plate.", "")
} // namespace tribodraw
