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

    /// Distance from the axis above the centre and from the centre below it, less the radius.
    class HemisphericalPunch : public ToolGeometry
    {
    public:
      explicit HemisphericalPunch(Parameters &p)
          : radius(0.5 * read_diameter(p, "Diameter of the punch and of the half sphere at its end."))
      {
      }

      ToolDistance
      distance(const Vector3d &x) const override
      {
        const bool     beside = x[2] > radius;
        const Vector3d v(x[0], x[1], beside ? 0 : x[2] - radius);
        const double   length = v.norm();
        if (length < 1e-12 * radius)
          return { -radius, -Vector3d::UnitZ(), Matrix3d::Zero() };
        const Vector3d n         = v / length;
        Matrix3d       curvature = (Matrix3d::Identity() - n * n.transpose()) / length;
        if (beside)
          curvature(2, 2) = 0;
        return { length - radius, n, curvature };
      }

      double
      smallest_radius() const override
      {
        return radius;
      }

      std::string
      describe() const override
      {
        return "punch of diameter " + units::format(2 * radius, "mm") + " with a hemispherical end";
      }

    private:
      const double radius;
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, HemisphericalPunch, "hemispherical punch",
                     "Circular punch that ends in a half sphere: stretching, forming limits.", "")
} // namespace tribodraw
