#ifndef tribodraw_forming_process_h
#define tribodraw_forming_process_h

#include <tribodraw/forming/blank.h>
#include <tribodraw/forming/tool_set.h>

#include <optional>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// What the press does, as described in section `Process`.
  struct Process
  {
    enum class HolderControl
    {
      force, ///< pressed down with a force, a rigid body with its own equilibrium
      gap    ///< at a fixed distance from the die
    };

    double                   punch_travel = 0; ///< [mm]; 0: there is no punch
    double                   punch_speed  = 0; ///< [mm/s]
    double                   duration     = 0; ///< of the drawing [s]
    HolderControl            holder_control = HolderControl::force;
    std::vector<double>      holder_forces;    ///< of the full part [N]
    std::vector<double>      holder_travels;   ///< punch travel at each of them [mm]; empty: one constant force
    double                   holder_gap  = 0;  ///< between the faces of holder and die [mm]
    double                   holder_stop = 0;  ///< share of the thickness at which spacers stop a pressed holder
    std::optional<TimeTable> fluid_pressure;   ///< on the lower face over process time [MPa]
    bool                     unloading       = false; ///< the tools are taken away at the end
    bool                     stop_at_necking = true;

    static Process read(Parameters &parameters);
    double         holder_force(double travel) const; ///< of the full part [N]
  };

  /// Mistakes that show only when blank, tools and process are seen together, found before the run: tools that overlap or
  /// stand in the sheet at any time, too little clearance, a mesh too coarse for a radius, a blank smaller than the opening.
  /// Recorded in @p parameters; call at the top level.
  void check_process(Parameters &parameters, const Blank &blank, const ToolSet &tools, const Process &process);
} // namespace tribodraw

#endif
