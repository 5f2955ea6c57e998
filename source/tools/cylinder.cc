#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/shape_entries.h>
#include <tribodraw/tools/tool_geometry.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Eigen::Matrix3d;
    using Eigen::Vector3d;

    /// Endless; the line that touches the sheet lies at z = 0 through the origin.
    class Cylinder : public ToolGeometry
    {
    public:
      explicit Cylinder(Parameters &p)
          : normal(normal_z(read_facing(p))),
            radius(0.5 * read_diameter(p, "Diameter of the roller or pin, or twice the radius of a drawing edge.")),
            angle(p.quantity("Axis angle", "deg", Range::between(-180, 180),
                             "Direction of the axis in the plane of the blank, from x (0 deg) towards y (90 deg)."))
      {
      }

      ToolDistance
      distance(const Vector3d &x) const override
      {
        const Vector3d axis(std::cos(angle), std::sin(angle), 0), centre(0, 0, -normal * radius);
        Vector3d       v    = x - centre;
        v                   = (v - axis.dot(v) * axis).eval();
        const double length = v.norm();
        if (length < 1e-12 * radius) // on the axis every direction is as good as another
          return { -radius, Vector3d::UnitZ(), Matrix3d::Zero() };
        const Vector3d n = v / length;
        return { length - radius, n, (Matrix3d::Identity() - axis * axis.transpose() - n * n.transpose()) / length };
      }

      double
      smallest_radius() const override
      {
        return radius;
      }

      std::string
      describe() const override
      {
        return "cylinder of diameter " + units::format(2 * radius, "mm") + " with its axis at "
               + units::format(angle, "deg") + " to x, touching from " + (normal > 0 ? "below" : "above");
      }

    private:
      const double normal, radius, angle;
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, Cylinder, "cylinder",
                     "An endless cylinder with its axis in the plane of the blank: roller, pin, drawing edge.", "")
} // namespace tribodraw
