#ifndef tribodraw_tools_drawing_tools_h
#define tribodraw_tools_drawing_tools_h

#include <tribodraw/tools/outline.h>
#include <tribodraw/tools/tool_geometry.h>

#include <memory>

namespace tribodraw
{
  class Parameters;

  /// A die: the half space z < 0 without the opening, the edge of which is rounded. The vertical wall follows the
  /// outline; the flange begins one edge radius outside of it.
  class DrawingDie : public ToolGeometry
  {
  public:
    /// Throws InputError if the edge radius is larger than a re-entrant radius of the opening: the rounded edge
    /// would have a crease there, which tears the sheet.
    DrawingDie(std::shared_ptr<const Outline> opening, double edge_radius);
    ToolDistance distance(const Eigen::Vector3d &x) const override;
    double       smallest_radius() const override;
    std::string  describe() const override;
    const Outline &
    outline() const
    {
      return *opening;
    }

  private:
    std::shared_ptr<const Outline> opening;
    double                         edge;
  };

  /// A punch: a prism above z = 0 with the outline as its wall and a rounded lower edge. The flat face ends one
  /// edge radius inside of the outline.
  class DrawingPunch : public ToolGeometry
  {
  public:
    /// Throws InputError if the edge radius is larger than a convex radius of the outline.
    DrawingPunch(std::shared_ptr<const Outline> outline, double edge_radius);
    ToolDistance distance(const Eigen::Vector3d &x) const override;
    double       smallest_radius() const override;
    std::string  describe() const override;
    const Outline &
    outline() const
    {
      return *wall;
    }

  private:
    std::shared_ptr<const Outline> wall;
    double                         edge;
  };

  /// A ridge of circular section along an outline, a tool of its own beside the die: its top touches z = 0, its centre
  /// line lies one radius below.
  class DrawBead : public ToolGeometry
  {
  public:
    /// Throws InputError if the radius is larger than a radius of the line.
    DrawBead(std::shared_ptr<const Outline> line, double radius);
    ToolDistance distance(const Eigen::Vector3d &x) const override;
    double
    smallest_radius() const override
    {
      return radius;
    }
    std::string describe() const override;

  private:
    std::shared_ptr<const Outline> line;
    double                         radius;
  };

  /// The half space z < 0 with a groove of vertical walls and rounded edges along an outline, endlessly deep: upside
  /// down the blank holder over a bead.
  class BeadGroove : public ToolGeometry
  {
  public:
    /// @param width between the walls [mm]. Throws InputError if half of it and the edge are more than a radius of
    /// the line.
    BeadGroove(std::shared_ptr<const Outline> line, double width, double edge_radius);
    ToolDistance distance(const Eigen::Vector3d &x) const override;
    double
    smallest_radius() const override
    {
      return edge;
    }
    std::string describe() const override;

  private:
    std::shared_ptr<const Outline> line;
    double                         width, edge;
  };
} // namespace tribodraw

#endif
