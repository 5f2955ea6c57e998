#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/tool_set.h>
#include <tribodraw/tools/placement.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector3d;

    const char *const                  die_name = "Die", *const punch_name = "Punch", *const holder_name = "Blank holder";
    const std::vector<std::string>     controls = {"fixed", "motion", "force"}; // in the order of ProcessTool::Control

    /// Names separated by commas, without blanks around them.
    std::vector<std::string> split_names(const std::string &text)
    {
      std::vector<std::string> names;
      std::istringstream       in(text);
      for (std::string name; std::getline(in, name, ',');)
        {
          const auto from = name.find_first_not_of(' '), to = name.find_last_not_of(' ');
          names.push_back(from == std::string::npos ? "" : name.substr(from, to - from + 1));
        }
      return names;
    }

    Vector3d read_vector(Parameters &p, const std::string &entry, const std::string &unit, const Range &range, const std::string &documentation, const std::optional<Default> &otherwise = {})
    {
      const auto values = p.quantity_list(entry, unit, range, documentation, otherwise);
      if (values.size() == 3)
        return {values[0], values[1], values[2]};
      if (!p.documentation_mode())
        p.problem(entry, "three numbers are needed: x, y, z.");
      return Vector3d::Zero();
    }

    std::optional<double> read_friction(Parameters &p)
    {
      const auto values = p.quantity_list("Friction coefficient", "", Range::non_negative().usual(0, 0.5), "Coulomb coefficient of this tool, for 'Coupling/Friction = constant'.",
                                          Default{"", "that of 'Coupling/Constant friction coefficient'"});
      if (values.size() > 1)
        p.problem("Friction coefficient", "more than one number is given.", "one number");
      return values.empty() ? std::nullopt : std::optional<double>(values[0]);
    }

    ProcessTool read_role(Parameters &p, const std::string &name, const Face face, const std::string &documentation)
    {
      ProcessTool tool;
      const auto  scope = p.section(name);
      tool.name         = name;
      tool.face         = face;
      tool.geometry     = p.model<ToolGeometry>("Model", documentation);
      tool.friction     = read_friction(p);
      return tool;
    }

    /// The blank holder is a plate with the die's opening and edge, turned upside down, unless it has a shape of its own.
    ProcessTool read_holder(Parameters &p, const ToolSet &tools)
    {
      ProcessTool tool;
      const auto  scope = p.section(holder_name);
      tool.name         = holder_name;
      tool.face         = Face::punch_side;
      tool.upside_down  = true;
      if (p.has("Model"))
        {
          tool.geometry    = p.model<ToolGeometry>("Model", "Shape of the blank holder; without it the die's shape is taken, upside down.");
          tool.upside_down = p.flag("Upside down", "The shape of the blank holder is turned over (z -> -z), as that of a die has to be.",
                                    Default{"true", "shapes of dies face up"});
        }
      else if (tools.die >= 0)
        tool.geometry = tools.tools[tools.die].geometry;
      else
        p.problem("Model", "without a die the blank holder needs a shape of its own.");
      tool.friction = read_friction(p);
      return tool;
    }

    ProcessTool read_further_tool(Parameters &p, const std::string &name)
    {
      ProcessTool tool;
      const auto  scope = p.section(name);
      tool.name         = name;
      tool.geometry     = p.model<ToolGeometry>("Model", "Shape of this tool.");
      tool.face         = p.choice("Side", {"above", "below"}, "Where the tool is: it touches the upper face of the blank from above or the lower from below.") == "above" ? Face::punch_side : Face::die_side;
      tool.upside_down  = p.flag("Upside down", "The shape is turned over (z -> -z).", Default{"false", "the shape as it is described"});
      const auto place = p.quantity_list("Place", "mm", Range::between(-1e5, 1e5), "Origin of the shape's frame: x, y, z; the middle of the blank is at 0, 0, 0.",
                                         Default{"", "centred and touching the flat blank"});
      if (place.size() == 3)
        tool.place = Vector3d(place[0], place[1], place[2]);
      else if (!place.empty() && !p.documentation_mode())
        p.problem("Place", "three numbers are needed: x, y, z.");
      const std::string control = p.choice("Control", controls, "fixed; motion: moved along 'Direction' as 'Motion' says; force: a rigid body that 'Force' pushes along 'Direction'.",
                                           Default{"fixed", "a die"});
      tool.control              = static_cast<ProcessTool::Control>(std::max<long>(0, std::find(controls.begin(), controls.end(), control) - controls.begin()));
      if (tool.control != ProcessTool::Control::fixed || p.documentation_mode())
        {
          tool.direction = read_vector(p, "Direction", "", Range::between(-1e3, 1e3), "Direction of motion and force: x, y, z of any length.", Default{"0, 0, -1", "down"});
          if (tool.direction.norm() > 0)
            tool.direction.normalize();
          else if (!p.documentation_mode())
            p.problem("Direction", "the direction has no length.");
        }
      else
        p.mark_unselected("Direction");
      if (tool.control == ProcessTool::Control::motion || p.documentation_mode())
        tool.curve = Motion::read(p, "Motion", "Displacement of the tool along its direction, from the start of the drawing on.");
      else
        p.mark_unselected("Motion");
      if (tool.control == ProcessTool::Control::force || p.documentation_mode())
        tool.curve = read_force_table(p, "Force", "Force on the tool along its direction, full part, from the start of the drawing on.");
      else
        p.mark_unselected("Force");
      tool.friction = read_friction(p);
      return tool;
    }

    void read_further_tools(Parameters &p, ToolSet &tools)
    {
      const std::string list = p.text("More tools", "Names of further tools, separated by commas; each has a subsection of its name.", Default{"", "the tools of a drawing process"});
      std::vector<std::string> names = split_names(list);
      if (p.documentation_mode())
        names = {"Name of a further tool"};
      for (const std::string &name : names)
        if (name.empty())
          p.problem("More tools", "a name is missing.", "names separated by commas");
        else if (std::count(names.begin(), names.end(), name) > 1 || name == die_name || name == punch_name || name == holder_name)
          p.problem("More tools", "two tools are called '" + name + "'.");
        else
          tools.tools.push_back(read_further_tool(p, name));
    }
  } // namespace

  std::vector<std::string>
  ToolSet::absent_roles(Parameters &p)
  {
    const auto scope = p.top_section("Tools");
    const auto names = split_names(p.text("Without", "Tools that the process does not have, separated by commas: Die, Punch, Blank holder.", Default{"", "a drawing process has all three"}));
    for (const std::string &name : names)
      if (name != die_name && name != punch_name && name != holder_name)
        p.problem("Without", "there is no such role of a tool.", "Die, Punch, Blank holder");
    return names;
  }

  ToolSet
  ToolSet::read(Parameters &p)
  {
    ToolSet    tools;
    const auto absent  = absent_roles(p);
    const auto present = [&](const std::string &name) {
      const bool none = std::find(absent.begin(), absent.end(), name) != absent.end();
      if (none)
        p.mark_unselected(name);
      return !none;
    };
    const auto add = [&](ProcessTool tool) {
      tools.tools.push_back(std::move(tool));
      return static_cast<int>(tools.tools.size()) - 1;
    };
    if (present(die_name))
      tools.die = add(read_role(p, die_name, Face::die_side, "Shape of the die; its flange surface lies below the blank."));
    if (present(punch_name))
      tools.punch = add(read_role(p, punch_name, Face::punch_side, "Shape of the punch; it moves down from above."));
    if (present(holder_name))
      tools.holder = add(read_holder(p, tools));
    read_further_tools(p, tools);
    return tools;
  }

  std::vector<ContactTool>
  ToolSet::place(const double thickness, const std::vector<Vector3d> &nodes) const
  {
    std::vector<ContactTool> placed;
    for (const ProcessTool &tool : tools)
      {
        ContactTool t;
        t.name              = tool.name;
        t.geometry          = tool.geometry;
        t.face              = tool.face;
        t.mirrored          = tool.upside_down;
        t.axis              = tool.direction;
        const double   side = tool.face == Face::punch_side ? 1 : -1;
        const Vector3d at_zero(0, 0, side * 0.5 * thickness); // if it passes beside the blank, which is found elsewhere
        t.place             = tool.place ? *tool.place : touching_place({tool.geometry.get(), at_zero, tool.upside_down}, {0, 0, -side}, nodes, 0.5 * thickness).value_or(at_zero);
        placed.push_back(t);
      }
    return placed;
  }
} // namespace tribodraw
