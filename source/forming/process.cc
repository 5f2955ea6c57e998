#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/simulation.h>
#include <tribodraw/tools/drawing_tools.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  Process
  Process::read(Parameters &p)
  {
    Process process;
    process.punch_travel       = p.quantity("Punch travel", "mm", Range::positive().usual(0.1, 500), "Travel of the punch from first touch.");
    process.punch_speed        = p.quantity("Punch speed", "mm/s", Range::positive().usual(0.01, 5000), "Constant speed of the punch.");
    process.blank_holder_force = p.quantity("Blank holder force", "kN", Range::positive().usual(0.1, 5000), "Force on the blank holder, full part.");
    return process;
  }

  Blank
  Blank::read(Parameters &p)
  {
    Blank blank;
    blank.length       = p.quantity("Length", "mm", Range::positive().usual(10, 5000), "Length of the rectangular blank along x, the rolling direction (full part; a quarter is modelled).");
    blank.width        = p.quantity("Width", "mm", Range::positive().usual(10, 5000), "Width of the blank along y.");
    blank.thickness    = p.quantity("Thickness", "mm", Range::positive().usual(0.1, 5), "Initial thickness.");
    blank.element_size = p.quantity("Element size", "mm", Range::positive().usual(0.2, 50), "Edge length of the squares that are cut into two triangles.");
    blank.n_thickness_points =
      static_cast<unsigned>(p.integer("Thickness points", Range::between(3, 11), "Gauss points through the thickness.",
                                      Default{"5", "bending moments after yielding are then right to one per cent"}));
    if (!p.has_problems() && blank.element_size > 0.25 * std::min(blank.length, blank.width))
      p.problem("Element size", "the blank would have fewer than two elements along a side of its quarter.",
                "at most " + units::format(0.25 * std::min(blank.length, blank.width), "mm"));
    if (!p.has_problems() && blank.length * blank.width / (blank.element_size * blank.element_size) > 4e6)
      p.problem("Element size", "the quarter would have more than two million elements.");
    return blank;
  }

  BlankMesh
  Blank::quarter_mesh() const
  {
    const auto n = [&](const double side) { return std::max(2u, static_cast<unsigned>(std::lround(0.5 * side / element_size))); };
    return make_quarter_rectangle(0.5 * length, 0.5 * width, n(length), n(width));
  }

  ToolSet
  ToolSet::read(Parameters &p)
  {
    ToolSet tools;
    {
      const auto scope = p.section("Die");
      tools.die        = p.model<ToolGeometry>("Model", "Shape of the die; its flange surface lies below the blank.");
    }
    {
      const auto scope = p.section("Punch");
      tools.punch      = p.model<ToolGeometry>("Model", "Shape of the punch; it moves down from above.");
    }
    // The blank holder is a plate with the die's opening and edge, turned upside down.
    tools.blank_holder = tools.die;
    return tools;
  }

  void
  check_process(Parameters &p, const Blank &blank, const ToolSet &tools)
  {
    if (p.has_problems() || p.documentation_mode() || !tools.die || !tools.punch)
      return;
    // The blank must cover the opening at both ends of its axes, or the die does not hold it.
    const double half[2] = {0.5 * blank.length, 0.5 * blank.width};
    for (int axis = 0; axis < 2; ++axis)
      {
        Eigen::Vector3d end = Eigen::Vector3d::Zero();
        end[axis]           = half[axis];
        if (tools.die->distance(end).distance > 1e-9) // at the height of the flange
          p.problem(axis == 0 ? "Blank/Length" : "Blank/Width", "the blank does not reach over the rounded edge of the die.");
      }
    const double extent = std::max(half[0], half[1]), gap = plan_clearance(*tools.die, *tools.punch, extent, 0.25);
    if (gap < blank.thickness)
      p.problem("Tools",
                gap < 0 ? "the punch does not fit into the die: they overlap by " + units::format(-gap, "mm") + " in plan."
                        : "the gap between punch and die is " + units::format(gap, "mm") + ", less than the sheet is thick.",
                "more than " + units::format(blank.thickness, "mm"), "Raise 'Tools/Die/.../Clearance'.");
    const double radius = std::min(tools.die->smallest_radius(), tools.punch->smallest_radius());
    if (blank.element_size > radius)
      p.problem("Blank/Element size", "the mesh is too coarse for the smallest radius of the tools, " + units::format(radius, "mm") + ".",
                "at most " + units::format(radius, "mm"), "Half the radius or less gives smooth forces.");
    else if (blank.element_size > 0.5 * radius)
      p.warning("'Blank/Element size' is more than half the smallest radius of the tools (" + units::format(radius, "mm") + "): expect ripples in the punch force.");
  }

  std::vector<ContactTool>
  ToolSet::place(const double thickness) const
  {
    std::vector<ContactTool> tools(3);
    const double             half = 0.5 * thickness;
    tools[die_index]              = {"Die", die, Face::die_side, false, -1, -half, -half};
    tools[punch_index]            = {"Punch", punch, Face::punch_side, false, -1, half, half};
    tools[holder_index]           = {"Blank holder", blank_holder, Face::punch_side, true, 0, half, half};
    return tools;
  }
} // namespace tribodraw
