#ifndef tribodraw_tools_outline_h
#define tribodraw_tools_outline_h

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <string>

namespace tribodraw
{
  /// Signed distance in plan with its derivatives.
  struct PlanDistance
  {
    double          distance; ///< [mm], negative inside the outline
    Eigen::Vector2d gradient; ///< unit vector
    Eigen::Matrix2d hessian;  ///< [1/mm]
  };

  /// Curve in the blank's plane around a region symmetric about x and y: the wall of a punch or of the opening of a die
  /// seen from above. The distance is exact everywhere; its gradient jumps only on the medial axis, which stays
  /// smallest_convex_radius() (inside) and smallest_concave_radius() (outside) away from the curve.
  class Outline
  {
  public:
    virtual ~Outline()                                            = default;
    virtual PlanDistance distance(const Eigen::Vector2d &x) const = 0;
    /// Radius of the sharpest outward corner [mm].
    virtual double smallest_convex_radius() const = 0;
    /// Radius of the sharpest re-entrant corner [mm], infinity if there is none.
    virtual double
    smallest_concave_radius() const
    {
      return std::numeric_limits<double>::infinity();
    }
    /// The parallel curve at distance @p clearance outwards: convex radii grow by it, re-entrant ones shrink.
    virtual std::unique_ptr<Outline> offset(double clearance) const = 0;
    virtual std::string              describe() const               = 0;
  };

  class CircleOutline : public Outline
  {
  public:
    explicit CircleOutline(double radius);
    PlanDistance distance(const Eigen::Vector2d &x) const override;
    double
    smallest_convex_radius() const override
    {
      return r;
    }
    std::unique_ptr<Outline> offset(double clearance) const override;
    std::string              describe() const override;

  private:
    double r;
  };

  /// Two lines along y: tools of plane strain.
  class StripOutline : public Outline
  {
  public:
    explicit StripOutline(double half_width);
    PlanDistance distance(const Eigen::Vector2d &x) const override;
    double
    smallest_convex_radius() const override
    {
      return std::numeric_limits<double>::infinity();
    }
    std::unique_ptr<Outline> offset(double clearance) const override;
    std::string              describe() const override;

  private:
    double a;
  };

  /// A rectangle with rounded corners.
  class RoundedRectangleOutline : public Outline
  {
  public:
    RoundedRectangleOutline(double half_width_x, double half_width_y, double corner_radius);
    PlanDistance distance(const Eigen::Vector2d &x) const override;
    double
    smallest_convex_radius() const override
    {
      return corner;
    }
    std::unique_ptr<Outline> offset(double clearance) const override;
    std::string              describe() const override;

  private:
    double a, b, corner; ///< half widths and corner radius
  };

  /// A plus with four equal arms along x and y, rounded at the eight outer corners and filleted at the four
  /// re-entrant ones.
  class CrossOutline : public Outline
  {
  public:
    /// Throws InputError unless corner radius <= half arm width and
    /// half arm width + fillet radius <= arm reach - corner radius: beyond, the arcs overlap and the curve
    /// has kinks.
    CrossOutline(double arm_reach, double half_arm_width, double corner_radius, double fillet_radius);
    PlanDistance distance(const Eigen::Vector2d &x) const override;
    double
    smallest_convex_radius() const override
    {
      return corner;
    }
    double
    smallest_concave_radius() const override
    {
      return fillet;
    }
    std::unique_ptr<Outline> offset(double clearance) const override;
    std::string              describe() const override;

  private:
    double reach, half_width, corner, fillet;
    /// For x >= y >= 0.
    PlanDistance distance_in_octant(const Eigen::Vector2d &x) const;
  };
} // namespace tribodraw

#endif
