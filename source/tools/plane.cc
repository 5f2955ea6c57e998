#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/plane.h>

namespace tribodraw
{
  namespace
  {
    Plane::Facing
    read_facing(Parameters &parameters)
    {
      const std::string facing = parameters.choice(
          "Facing", { "down", "up" },
          "Where the flat surface looks: `down` for a blank holder above the sheet, `up` for a plate below it.");
      return facing == "up" ? Plane::Facing::up : Plane::Facing::down;
    }
  } // namespace

  Plane::Plane(const Facing facing) : normal_z(facing == Facing::up ? 1 : -1)
  {
  }

  Plane::Plane(Parameters &parameters) : Plane(read_facing(parameters))
  {
  }

  ToolDistance
  Plane::distance(const Eigen::Vector3d &x) const
  {
    return { normal_z * x[2], normal_z * Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero() };
  }

  double
  Plane::smallest_radius() const
  {
    return std::numeric_limits<double>::infinity();
  }

  std::string
  Plane::describe() const
  {
    return normal_z > 0 ? "flat plate facing up" : "flat plate facing down";
  }

  TRIBODRAW_REGISTER(ToolGeometry, Plane, "plane", "A flat tool: blank holder or plate.", "")
} // namespace tribodraw
