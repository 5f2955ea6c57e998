#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/drawing_tools.h>
#include <tribodraw/tools/shape_entries.h>

namespace tribodraw
{
  namespace
  {
    /// A flat face with rounded borders is a rectangular punch; it may look up as well.
    class Plate : public ToolGeometry
    {
    public:
      explicit Plate(Parameters &p) : normal(normal_z(read_facing(p))), punch(read(p)) {}

      ToolDistance
      distance(const Eigen::Vector3d &x) const override
      {
        const Eigen::Vector3d turn(1, 1, -normal); // a punch looks down
        ToolDistance          d = punch.distance(turn.cwiseProduct(x));
        d.normal                = turn.cwiseProduct(d.normal).eval();
        d.curvature             = (turn.asDiagonal() * d.curvature * turn.asDiagonal()).eval();
        return d;
      }

      double
      smallest_radius() const override
      {
        return punch.smallest_radius();
      }

      std::string
      describe() const override
      {
        return std::string("flat plate facing ") + (normal > 0 ? "up" : "down") + ", " + punch.outline().describe();
      }

    private:
      static DrawingPunch
      read(Parameters &p)
      {
        const Range  size  = Range::positive().usual(0.1, 5000);
        const double x     = p.quantity("Width in x", "mm", size, "Width of the plate in the rolling direction.");
        const double y     = p.quantity("Width in y", "mm", size, "Width of the plate across the rolling direction.");
        const double edge  = p.quantity("Edge radius", "mm", size, "Radius between the flat face and its sides.");
        const bool   given = p.has("Width in x") && p.has("Width in y") && p.has("Edge radius") && !p.has_problems();
        if (!given || p.documentation_mode()) // a stand-in while the file's own values cannot be read
          return DrawingPunch(std::make_shared<RoundedRectangleOutline>(50, 30, 5), 5);
        if (2 * edge > std::min(x, y))
          throw InputError(
              describe_error("Plate: the edges overlap.", "", "edge radius " + units::format(edge, "mm"),
                             "at most half of the smaller width, " + units::format(0.5 * std::min(x, y), "mm")));
        return DrawingPunch(std::make_shared<RoundedRectangleOutline>(0.5 * x, 0.5 * y, edge), edge);
      }

      const double       normal;
      const DrawingPunch punch;
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, Plate, "plate",
                     "A flat rectangular face with rounded borders: drawing plates of a strip draw, a pad.", "")
} // namespace tribodraw
