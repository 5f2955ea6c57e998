#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/outline.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Eigen::Matrix2d;
    using Eigen::Vector2d;

    std::string
    mm(const double value)
    {
      return units::number(value) + " mm";
    }

    /// Conditions that hold with equality must survive the rounding of an offset or of a unit.
    constexpr double rounding = 1e-9;

    void
    require(const bool holds, const std::string &what, const std::string &value, const std::string &allowed)
    {
      if (!holds)
        throw InputError(describe_error(what, "", value, allowed));
    }

    /// Straight piece of a curve, @p direction outwards.
    PlanDistance
    line(const double distance, const Vector2d &direction)
    {
      return { distance, direction, Matrix2d::Zero() };
    }

    /// Arc about the origin of @p v. @p side +1: the body of the outline is inside the circle, -1: outside.
    PlanDistance
    arc(const Vector2d &v, const double radius, const double side)
    {
      const double length = v.norm();
      // At the centre any direction is as good as another; it lies on the medial axis.
      if (length < 1e-12 * radius)
        return { -side * radius, Vector2d::UnitX(), Matrix2d::Zero() };
      const Vector2d n = v / length;
      return { side * (length - radius), side * n, side / length * (Matrix2d::Identity() - n * n.transpose()) };
    }

    /// From the quadrant of |x|, |y| back to that of x, y.
    PlanDistance
    reflect(PlanDistance d, const Vector2d &x)
    {
      const Vector2d sign(x[0] < 0 ? -1. : 1., x[1] < 0 ? -1. : 1.);
      d.gradient = sign.cwiseProduct(d.gradient).eval();
      d.hessian(0, 1) *= sign[0] * sign[1];
      d.hessian(1, 0) *= sign[0] * sign[1];
      return d;
    }
  } // namespace

  CircleOutline::CircleOutline(const double radius) : r(radius)
  {
    require(radius > 0, "Circular outline: the radius must be positive.", mm(radius), "more than 0 mm");
  }

  PlanDistance
  CircleOutline::distance(const Vector2d &x) const
  {
    return arc(x, r, 1);
  }

  std::unique_ptr<Outline>
  CircleOutline::offset(const double clearance) const
  {
    return std::make_unique<CircleOutline>(r + clearance);
  }

  std::string
  CircleOutline::describe() const
  {
    return "circle of diameter " + mm(2 * r);
  }

  StripOutline::StripOutline(const double half_width) : a(half_width)
  {
    require(half_width > 0, "Strip outline: the width must be positive.", mm(2 * half_width), "more than 0 mm");
  }

  PlanDistance
  StripOutline::distance(const Vector2d &x) const
  {
    return reflect(line(std::abs(x[0]) - a, Vector2d::UnitX()), x);
  }

  std::unique_ptr<Outline>
  StripOutline::offset(const double clearance) const
  {
    return std::make_unique<StripOutline>(a + clearance);
  }

  std::string
  StripOutline::describe() const
  {
    return "strip of width " + mm(2 * a) + " in x, endless in y";
  }

  RoundedRectangleOutline::RoundedRectangleOutline(const double half_width_x, const double half_width_y,
                                                   const double corner_radius)
      : a(half_width_x), b(half_width_y), corner(corner_radius)
  {
    const double smaller = std::min(half_width_x, half_width_y);
    require(corner_radius > 0 && corner_radius <= smaller * (1 + rounding),
            "Rectangular outline: the corner radius must be positive and not more than half the smaller width.",
            mm(corner_radius), "more than 0 to " + mm(smaller));
  }

  PlanDistance
  RoundedRectangleOutline::distance(const Vector2d &x) const
  {
    // From the centre of the corner arc.
    const Vector2d v = x.cwiseAbs() - Vector2d(a - corner, b - corner);
    if (v[0] > 0 && v[1] > 0)
      return reflect(arc(v, corner, 1), x);
    if (v[0] > v[1])
      return reflect(line(v[0] - corner, Vector2d::UnitX()), x);
    return reflect(line(v[1] - corner, Vector2d::UnitY()), x);
  }

  std::unique_ptr<Outline>
  RoundedRectangleOutline::offset(const double clearance) const
  {
    return std::make_unique<RoundedRectangleOutline>(a + clearance, b + clearance, corner + clearance);
  }

  std::string
  RoundedRectangleOutline::describe() const
  {
    return "rectangle " + units::number(2 * a) + " x " + mm(2 * b) + ", corner radius " + mm(corner);
  }

  CrossOutline::CrossOutline(const double arm_reach, const double half_arm_width, const double corner_radius,
                             const double fillet_radius)
      : reach(arm_reach), half_width(half_arm_width), corner(corner_radius), fillet(fillet_radius)
  {
    require(corner_radius > 0 && corner_radius <= half_arm_width * (1 + rounding),
            "Cross outline: the convex corner radius must be positive and not more than the half arm width.",
            mm(corner_radius), "more than 0 to " + mm(half_arm_width));
    require(fillet_radius > 0, "Cross outline: the fillet radius must be positive.", mm(fillet_radius),
            "more than 0 mm (for a die the clearance has been subtracted from it)");
    require(half_arm_width + fillet_radius <= arm_reach - corner_radius + rounding * arm_reach,
            "Cross outline: fillet and corner overlap, because the arms are too short.",
            "half arm width + fillet radius = " + mm(half_arm_width + fillet_radius),
            "at most arm reach - convex corner radius = " + mm(arm_reach - corner_radius));
  }

  PlanDistance
  CrossOutline::distance_in_octant(const Vector2d &x) const
  {
    // The arm along x: tip, corner arc, side, fillet arc, in this order along the curve. The nearest of the
    // pieces that the point can be projected on is the nearest of all: a point whose projection misses a
    // piece is nearer to one of its neighbours, because the pieces join tangentially.
    const double fillet_centre = half_width + fillet;
    const double corner_x = reach - corner, corner_y = half_width - corner;

    PlanDistance nearest{ std::numeric_limits<double>::infinity(), Vector2d::UnitX(), Matrix2d::Zero() };
    const auto   consider = [&nearest](const PlanDistance &d) {
      if (std::abs(d.distance) < std::abs(nearest.distance))
        nearest = d;
    };
    if (x[1] <= corner_y)
      consider(line(x[0] - reach, Vector2d::UnitX()));
    if (x[0] >= corner_x && x[1] >= corner_y)
      consider(arc(x - Vector2d(corner_x, corner_y), corner, 1));
    if (x[0] >= fillet_centre && x[0] <= corner_x)
      consider(line(x[1] - half_width, Vector2d::UnitY()));
    if (x[0] <= fillet_centre)
      consider(arc(x - Vector2d(fillet_centre, fillet_centre), fillet, -1));
    return nearest;
  }

  PlanDistance
  CrossOutline::distance(const Vector2d &x) const
  {
    const Vector2d absolute = x.cwiseAbs();
    if (absolute[0] >= absolute[1])
      return reflect(distance_in_octant(absolute), x);
    PlanDistance d = distance_in_octant({ absolute[1], absolute[0] });
    std::swap(d.gradient[0], d.gradient[1]);
    std::swap(d.hessian(0, 0), d.hessian(1, 1));
    return reflect(d, x);
  }

  std::unique_ptr<Outline>
  CrossOutline::offset(const double clearance) const
  {
    return std::make_unique<CrossOutline>(reach + clearance, half_width + clearance, corner + clearance,
                                          fillet - clearance);
  }

  std::string
  CrossOutline::describe() const
  {
    return "cross of reach " + mm(reach) + ", arm width " + mm(2 * half_width) + ", corner radius " + mm(corner)
           + ", fillet radius " + mm(fillet);
  }
} // namespace tribodraw
