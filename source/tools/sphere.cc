#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/shape_entries.h>
#include <tribodraw/tools/tool_geometry.h>

namespace tribodraw
{
  namespace
  {
    using Eigen::Matrix3d;
    using Eigen::Vector3d;

    /// The point that touches the sheet lies in the origin.
    class Sphere : public ToolGeometry
    {
    public:
      explicit Sphere(Parameters &p)
          : normal(normal_z(read_facing(p))), radius(0.5 * read_diameter(p, "Diameter of the sphere."))
      {
      }

      ToolDistance
      distance(const Vector3d &x) const override
      {
        const Vector3d v      = x - Vector3d(0, 0, -normal * radius);
        const double   length = v.norm();
        if (length < 1e-12 * radius) // in the centre every direction is as good as another
          return { -radius, Vector3d::UnitZ(), Matrix3d::Zero() };
        const Vector3d n = v / length;
        return { length - radius, n, (Matrix3d::Identity() - n * n.transpose()) / length };
      }

      double
      smallest_radius() const override
      {
        return radius;
      }

      std::string
      describe() const override
      {
        return "sphere of diameter " + units::format(2 * radius, "mm") + ", touching from "
               + (normal > 0 ? "below" : "above");
      }

    private:
      const double normal, radius;
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, Sphere, "sphere", "A sphere: ball indenter, stretching with a ball.", "")
} // namespace tribodraw
