#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/process.h>
#include <tribodraw/tools/placement.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector3d;

    /// Gaps are searched on cells of this size [mm].
    constexpr double search_spacing = 0.5;
    /// Moments between start and end at which moving tools are compared, besides the corners of their tables.
    constexpr int n_moments = 4;
    /// How far a tool may stand in the sheet at the start [mm], and how much narrower than the sheet a gap may be.
    constexpr double allowed_penetration = 0.01, allowed_squeeze = 0.02;

    /// Three digits: the searches are no better.
    std::string mm(const double value)
    {
      char text[40];
      std::snprintf(text, sizeof(text), "%.3g mm", value);
      return text;
    }

    std::string at(const Vector3d &x)
    {
      char text[100];
      std::snprintf(text, sizeof(text), "(%.1f, %.1f, %.1f) mm", x[0], x[1], x[2]);
      return text;
    }

    PlacedTool placed(const ContactTool &tool, const Vector3d &moved = Vector3d::Zero())
    {
      return {tool.geometry.get(), tool.place + moved, tool.mirrored};
    }

    struct Case
    {
      Parameters              &p;
      const Blank             &blank;
      const ToolSet           &tools;
      const Process           &process;
      BlankMesh                mesh;
      std::vector<ContactTool> start;
    };

    /// The blank must cover the opening at both ends of its axes, or the die does not hold it.
    void check_opening(const Case &c)
    {
      if (c.tools.die < 0 || c.tools.punch < 0)
        return;
      const ToolGeometry &die     = *c.tools.geometry(c.tools.die);
      const double        half[2] = {0.5 * c.blank.length, 0.5 * c.blank.width};
      const bool          held[2] = {c.blank.edges.side[BlankEdges::x].condition != BlankEdges::Condition::free, c.blank.edges.side[BlankEdges::y].condition != BlankEdges::Condition::free};
      for (int axis = 0; axis < 2; ++axis)
        {
          Vector3d end = Vector3d::Zero();
          end[axis]    = half[axis];
          if (!held[axis] && die.distance(end).distance > 1e-9) // at the height of the flange
            c.p.problem(c.blank.shape == "rectangle" ? (axis == 0 ? "Blank/Length" : "Blank/Width") : "Blank", "the blank does not reach over the rounded edge of the die.",
                        "half of it, " + units::format(half[axis], "mm") + ", beyond the edge",
                        mm(die.distance(end).distance) + " are missing.");
        }
    }

    void check_radii(const Case &c)
    {
      double size = c.blank.element_size;
      for (const auto &zone : c.blank.zones)
        size = std::min(size, zone.size);
      double radius = 1e300;
      for (const auto &tool : c.tools.tools)
        radius = std::min(radius, tool.geometry->smallest_radius());
      const std::string entry = c.blank.given_mesh ? "Blank/Mesh file" : "Blank/Element size";
      if (size > radius)
        c.p.problem(entry,
                    "the mesh, of " + units::format(size, "mm") + ", is too coarse for the smallest radius of the tools, " + units::format(radius, "mm") + ".",
                    "at most " + units::format(radius, "mm"), "Half the radius or less gives smooth forces.");
      else if (size > 0.5 * radius)
        c.p.warning("'" + entry + "': the elements, of " + units::format(size, "mm") + ", are larger than half the smallest radius of the tools (" + units::format(radius, "mm") + "): expect ripples in the punch force.");
    }

    /// A surface from a file in the wrong unit.
    void check_sizes(const Case &c)
    {
      for (const auto &tool : c.tools.tools)
        {
          const std::string wrong = implausible_size(*tool.geometry, std::max(c.blank.length, c.blank.width));
          if (!wrong.empty())
            c.p.problem("Tools/" + tool.name, wrong);
        }
    }

    void check_holder(const Case &c)
    {
      if (c.tools.holder < 0 || c.process.holder_control != Process::HolderControl::gap)
        return;
      if (c.tools.die < 0)
        c.p.problem("Process/Blank holder control", "a gap is measured from the die, and there is none.");
      if (c.process.holder_gap < c.blank.thickness)
        c.p.problem("Process/Blank holder gap", "the gap is smaller than the sheet is thick.", "at least " + units::format(c.blank.thickness, "mm"));
    }

    /// Where the tools stand at the start: none in the sheet.
    void check_start(const Case &c)
    {
      for (const ContactTool &tool : c.start)
        {
          const double penetration = initial_penetration(placed(tool), c.mesh.nodes, 0.5 * c.blank.thickness);
          if (penetration > allowed_penetration)
            c.p.problem("Tools/" + tool.name, "the tool stands in the sheet at the start, by " + mm(penetration) + ".", "no penetration",
                        "Move 'Place', or leave it out: the tool then touches the sheet.");
        }
    }

    /// Prescribed displacement of a tool at a time; nothing if it moves by a force.
    std::optional<Vector3d> displacement(const Case &c, const std::size_t i, const double time)
    {
      const ProcessTool &tool = c.tools.tools[i];
      const int          role = static_cast<int>(i);
      if (role == c.tools.punch)
        return Vector3d(0, 0, -std::min(c.process.punch_travel, c.process.punch_speed * time));
      if (tool.control == ProcessTool::Control::force || (role == c.tools.holder && c.process.holder_control == Process::HolderControl::force))
        return time == 0 ? std::optional<Vector3d>(Vector3d::Zero()) : std::nullopt;
      if (role == c.tools.holder)
        return Vector3d(0, 0, c.process.holder_gap - c.blank.thickness);
      return tool.control == ProcessTool::Control::motion ? Vector3d((tool.curve->value(time) - tool.curve->value(0)) * tool.direction) : Vector3d::Zero();
    }

    /// Moments at which the gap between two tools is looked at: one is enough if they do not move against each other.
    std::vector<double> moments(const Case &c, const std::size_t a, const std::size_t b)
    {
      std::vector<double> times = {0};
      for (int k = 1; k <= n_moments; ++k)
        times.push_back(k * c.process.duration / n_moments);
      for (const std::size_t i : {a, b})
        if (c.tools.tools[i].control == ProcessTool::Control::motion)
          for (const double t : c.tools.tools[i].curve->breakpoints())
            if (t > 0 && t < c.process.duration && times.size() < 50)
              times.push_back(t);
      std::sort(times.begin(), times.end());
      std::vector<double>     distinct;
      std::optional<Vector3d> last;
      for (const double t : times)
        {
          const auto of_a = displacement(c, a, t), of_b = displacement(c, b, t);
          if (!of_a || !of_b || (last && (*of_a - *of_b - *last).norm() < 1e-9))
            continue;
          last = *of_a - *of_b;
          distinct.push_back(t);
        }
      return distinct;
    }

    /// Tools on both faces leave room for the sheet, tools on one face do not run into each other.
    void check_gap(const Case &c, const std::size_t a, const std::size_t b)
    {
      const ContactTool &tool_a = c.start[a], &tool_b = c.start[b];
      const bool         sheet_between = tool_a.face != tool_b.face;
      const double       needed        = sheet_between ? c.blank.thickness : 0.;
      const bool         punch_in_die  = (static_cast<int>(a) == c.tools.die && static_cast<int>(b) == c.tools.punch);
      Clearance          worst{needed * (1 - allowed_squeeze) - allowed_penetration, Vector3d::Zero()};
      std::string        when;
      for (const double t : moments(c, a, b))
        {
          const Vector3d moved_a = *displacement(c, a, t), moved_b = *displacement(c, b, t);
          const double   reach = std::max(moved_a.norm(), moved_b.norm()) + 2 * c.blank.thickness;
          const Vector3d low(c.blank.mirrored(0) ? 0 : -0.5 * c.blank.length, c.blank.mirrored(1) ? 0 : -0.5 * c.blank.width, -reach), high(0.5 * c.blank.length, 0.5 * c.blank.width, reach);
          const Clearance found = smallest_clearance(placed(tool_a, moved_a), placed(tool_b, moved_b), low, high, search_spacing);
          if (found.gap < worst.gap)
            {
              worst = found;
              when  = " at " + units::format(t, "s") + ", " + at(found.place);
            }
        }
      if (when.empty())
        return;
      const std::string names = tool_b.name + " and " + tool_a.name;
      c.p.problem("Tools",
                  worst.gap < 0 ? (punch_in_die ? "the punch does not fit into the die: they overlap by " : names + " run into each other: they overlap by ") + mm(-worst.gap) + when + "."
                                : "the gap between " + (punch_in_die ? "punch and die" : names) + " is " + mm(worst.gap) + ", less than the sheet is thick," + when + ".",
                  "at least " + units::format(needed, "mm"), punch_in_die ? "Raise 'Tools/Die/.../Clearance'." : "Change shape, place or motion of one of them.");
    }
  } // namespace

  void
  check_process(Parameters &p, const Blank &blank, const ToolSet &tools, const Process &process)
  {
    if (p.has_problems() || p.documentation_mode())
      return;
    try
      {
        if (tools.tools.empty() && !process.fluid_pressure && !blank.edges.any())
          p.problem("Tools", "nothing acts on the blank.", "a tool, a fluid pressure or an edge that is pulled", "Name a tool in 'More tools', or remove a role from 'Without'.");
        Case c{p, blank, tools, process, blank.mesh(), {}};
        c.start = tools.place(blank.thickness, c.mesh.nodes);
        check_sizes(c);
        check_opening(c);
        check_radii(c);
        check_holder(c);
        check_start(c);
        for (std::size_t a = 0; a < tools.tools.size(); ++a)
          for (std::size_t b = a + 1; b < tools.tools.size(); ++b)
            check_gap(c, a, b);
      }
    catch (const InputError &e) // a mesh that cannot be made, a tool that faces the wrong way
      {
        p.problem("", e.what());
      }
  }
} // namespace tribodraw
