#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/drawing_tools.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Eigen::Matrix3d;
    using Eigen::Vector2d;
    using Eigen::Vector3d;

    std::string
    mm(const double value)
    {
      return units::number(value) + " mm";
    }

    void
    check_edge(const double edge_radius, const double limit, const std::string &where, const std::string &limited_by)
    {
      if (!(edge_radius > 0))
        throw InputError(describe_error(where + ": the edge radius must be positive.", "", mm(edge_radius)));
      if (edge_radius > limit * (1 + 1e-9)) // rounding of an offset or of a unit
        throw InputError(describe_error(where + ": the edge radius is larger than " + limited_by
                                            + ", so that the rounded edge would have a sharp crease.",
                                        "", mm(edge_radius), "at most " + mm(limit)));
    }

    /// A coordinate that grows from the centre line of the rounded edge into the body-free side.
    struct EdgeCoordinate
    {
      double   value;
      Vector3d gradient;
      Matrix3d hessian;
    };

    /// Distance to the circle of radius @p r about (0,0) in the plane of two coordinates.
    ToolDistance
    circle(const EdgeCoordinate &a, const EdgeCoordinate &b, const double r)
    {
      const double   rho = std::hypot(a.value, b.value);
      const Vector3d n   = (a.value * a.gradient + b.value * b.gradient) / rho;
      const Matrix3d section
          = a.gradient * a.gradient.transpose() + b.gradient * b.gradient.transpose() - n * n.transpose();
      return { rho - r, n, (section + a.value * a.hessian + b.value * b.hessian) / rho };
    }

    /// Distance to the quarter circle of radius @p r about (0,0) in the plane of two coordinates, continued by the
    /// straight lines a = r (for b < 0) and b = r (for a < 0).
    ToolDistance
    round_edge(const EdgeCoordinate &a, const EdgeCoordinate &b, const double r)
    {
      // Deep inside the body, and on the centre line itself, where the curvature of the circles has no limit.
      if (a.value <= 0 || b.value <= 0 || std::hypot(a.value, b.value) < 1e-9 * r)
        {
          const EdgeCoordinate &larger = a.value > b.value ? a : b;
          return { larger.value - r, larger.gradient, larger.hessian };
        }
      return circle(a, b, r);
    }

    /// @p sign * (plan distance) + @p shift as a coordinate in space.
    EdgeCoordinate
    plan_coordinate(const Outline &outline, const Vector3d &x, const double sign, const double shift)
    {
      const PlanDistance q = outline.distance(x.head<2>());
      EdgeCoordinate     c{ sign * q.distance + shift, Vector3d::Zero(), Matrix3d::Zero() };
      c.gradient.head<2>()            = sign * q.gradient;
      c.hessian.topLeftCorner<2, 2>() = sign * q.hessian;
      return c;
    }

    EdgeCoordinate
    height_coordinate(const Vector3d &x, const double sign, const double shift)
    {
      return { sign * x[2] + shift, sign * Vector3d::UnitZ(), Matrix3d::Zero() };
    }
  } // namespace

  DrawingDie::DrawingDie(std::shared_ptr<const Outline> opening_outline, const double edge_radius)
      : opening(std::move(opening_outline)), edge(edge_radius)
  {
    check_edge(edge_radius, opening->smallest_concave_radius(), "Die", "the fillet radius of the opening");
  }

  ToolDistance
  DrawingDie::distance(const Vector3d &x) const
  {
    return round_edge(plan_coordinate(*opening, x, -1, edge), height_coordinate(x, 1, edge), edge);
  }

  double
  DrawingDie::smallest_radius() const
  {
    return std::min(edge, opening->smallest_concave_radius());
  }

  std::string
  DrawingDie::describe() const
  {
    return "die with edge radius " + mm(edge) + " and the opening: " + opening->describe();
  }

  DrawingPunch::DrawingPunch(std::shared_ptr<const Outline> outline, const double edge_radius)
      : wall(std::move(outline)), edge(edge_radius)
  {
    check_edge(edge_radius, wall->smallest_convex_radius(), "Punch", "the corner radius of its outline");
  }

  ToolDistance
  DrawingPunch::distance(const Vector3d &x) const
  {
    return round_edge(plan_coordinate(*wall, x, 1, edge), height_coordinate(x, -1, edge), edge);
  }

  double
  DrawingPunch::smallest_radius() const
  {
    return std::min(edge, wall->smallest_convex_radius());
  }

  std::string
  DrawingPunch::describe() const
  {
    return "punch with edge radius " + mm(edge) + " and the outline: " + wall->describe();
  }

  DrawBead::DrawBead(std::shared_ptr<const Outline> bead_line, const double bead_radius)
      : line(std::move(bead_line)), radius(bead_radius)
  {
    check_edge(radius, std::min(line->smallest_convex_radius(), line->smallest_concave_radius()), "Bead",
               "a radius of its line");
  }

  ToolDistance
  DrawBead::distance(const Vector3d &x) const
  {
    const EdgeCoordinate outwards = plan_coordinate(*line, x, 1, 0), upwards = height_coordinate(x, 1, radius);
    if (std::hypot(outwards.value, upwards.value) < 1e-9 * radius) // every direction is as good as another
      return { -radius, Vector3d::UnitZ(), Matrix3d::Zero() };
    return circle(outwards, upwards, radius);
  }

  std::string
  DrawBead::describe() const
  {
    return "bead of radius " + mm(radius) + " along a " + line->describe();
  }

  BeadGroove::BeadGroove(std::shared_ptr<const Outline> groove_line, const double groove_width,
                         const double edge_radius)
      : line(std::move(groove_line)), width(groove_width), edge(edge_radius)
  {
    if (!(width > 0))
      throw InputError(describe_error("Groove: the width must be positive.", "", mm(width)));
    check_edge(edge, std::min(line->smallest_convex_radius(), line->smallest_concave_radius()) - 0.5 * width, "Groove",
               "a radius of its line less half the width");
  }

  ToolDistance
  BeadGroove::distance(const Vector3d &x) const
  {
    // A die on either side of the line. In the middle of the groove the normal jumps, which no sheet comes near to.
    const double side = line->distance(x.head<2>()).distance < 0 ? 1 : -1;
    return round_edge(plan_coordinate(*line, x, side, edge + 0.5 * width), height_coordinate(x, 1, edge), edge);
  }

  std::string
  BeadGroove::describe() const
  {
    return "plate with a groove of width " + mm(width) + " and edge radius " + mm(edge) + " along a "
           + line->describe();
  }
} // namespace tribodraw
