#ifndef tribodraw_forming_tool_set_h
#define tribodraw_forming_tool_set_h

#include <tribodraw/contact/contact.h>
#include <tribodraw/tools/time_table.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// A rigid tool of the process: shape, place and what the press does with it.
  struct ProcessTool
  {
    enum class Control
    {
      fixed,
      motion, ///< displacement over time
      force   ///< force over time: the tool is a rigid body that moves along its direction
    };

    std::string                         name;
    std::shared_ptr<const ToolGeometry> geometry;
    Face                                face        = Face::die_side;
    bool                                upside_down = false;
    std::optional<Eigen::Vector3d>      place; ///< origin of the shape's frame [mm]; without: touching the flat blank
    Control                             control   = Control::fixed;
    Eigen::Vector3d                     direction = -Eigen::Vector3d::UnitZ(); ///< of motion and force, unit vector
    std::optional<TimeTable>            curve;    ///< displacement [mm] or force on the full part [N] over process time [s]
    std::optional<double>               friction; ///< Coulomb coefficient of its own
  };

  /// The tools as described in section `Tools`: the roles of a drawing process, each of which may be missing, and any
  /// number of further tools. Motion and force of punch and blank holder stand in section `Process`.
  struct ToolSet
  {
    std::vector<ProcessTool> tools;                         ///< the roles first, in the order die, punch, holder
    int                      die = -1, punch = -1, holder = -1; ///< positions in the list, -1: none

    static ToolSet read(Parameters &parameters);
    /// Names of the roles without a tool, as `Tools/Without` says; for sections that depend on it.
    static std::vector<std::string> absent_roles(Parameters &parameters);

    const ToolGeometry *geometry(int role) const { return role < 0 ? nullptr : tools[role].geometry.get(); }
    /// Places the tools so that they touch the flat blank, which lies at z = 0, where no place is given.
    /// @param nodes of the blank; @param thickness of it [mm]
    std::vector<ContactTool> place(double thickness, const std::vector<Eigen::Vector3d> &nodes) const;
  };
} // namespace tribodraw

#endif
