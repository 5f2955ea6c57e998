#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/process.h>

#include <algorithm>

namespace tribodraw
{
  namespace
  {
    template <class... Names>
    void mark_unselected(Parameters &p, const Names &...names)
    {
      (p.mark_unselected(names), ...);
    }

    void read_punch(Parameters &p, const bool present, Process &process)
    {
      if (present || p.documentation_mode())
        {
          process.punch_travel = p.quantity("Punch travel", "mm", Range::positive().usual(0.1, 500), "Travel of the punch from first touch.");
          process.punch_speed  = p.quantity("Punch speed", "mm/s", Range::positive().usual(0.01, 5000), "Constant speed of the punch.");
          process.duration     = process.punch_travel / process.punch_speed;
        }
      else
        mark_unselected(p, "Punch travel", "Punch speed");
      if (!present || p.documentation_mode())
        process.duration = p.quantity("Duration", "s", Range::positive(), "Of a process without a punch: time after the closing.");
      else
        p.mark_unselected("Duration");
    }

    void read_holder_force(Parameters &p, Process &process)
    {
      process.holder_forces = p.quantity_list("Blank holder force", "kN", Range::positive().usual(0.1, 5000),
                                              "Force on the blank holder, full part: one value, or one for each of 'Blank holder travels'.");
      process.holder_travels = p.quantity_list("Blank holder travels", "mm", Range::non_negative(),
                                               "Punch travel at each of the blank holder forces; between them the force is linear, before and after constant.",
                                               Default{"", "a constant force"});
      process.holder_stop = p.quantity("Blank holder stop", "", Range::between(0, 1),
                                       "Distance of blank holder and die over the thickness of the blank at which spacers between them stop the holder: when the sheet has left it.",
                                       Default{"0.9", "a sheet that is held is thicker"});
      if (p.documentation_mode())
        return;
      if (process.holder_travels.empty() && process.holder_forces.size() > 1)
        p.problem("Blank holder travels", "more than one force needs as many travels.", std::to_string(process.holder_forces.size()) + " values");
      else if (!process.holder_travels.empty() && process.holder_travels.size() != process.holder_forces.size())
        p.problem("Blank holder travels", "there must be as many travels as forces.", std::to_string(process.holder_forces.size()) + " values");
      else if (std::adjacent_find(process.holder_travels.begin(), process.holder_travels.end(), std::greater_equal<double>()) != process.holder_travels.end())
        p.problem("Blank holder travels", "the travels must increase.");
    }

    void read_holder(Parameters &p, const bool present, Process &process)
    {
      if (!present && !p.documentation_mode())
        return mark_unselected(p, "Blank holder control", "Blank holder force", "Blank holder travels", "Blank holder stop", "Blank holder gap");
      const bool gap = p.choice("Blank holder control", {"force", "gap"}, "force: the blank holder is a rigid body pressed down with a force; gap: it stands at a fixed distance from the die.",
                                Default{"force", "the usual press"}) == "gap";
      process.holder_control = gap ? Process::HolderControl::gap : Process::HolderControl::force;
      if (!gap || p.documentation_mode())
        read_holder_force(p, process);
      else
        mark_unselected(p, "Blank holder force", "Blank holder travels", "Blank holder stop");
      if (gap || p.documentation_mode())
        process.holder_gap = p.quantity("Blank holder gap", "mm", Range::positive().usual(0.1, 20), "Distance between the faces of blank holder and die.");
      else
        p.mark_unselected("Blank holder gap");
    }
  } // namespace

  Process
  Process::read(Parameters &p)
  {
    Process    process;
    const auto absent  = ToolSet::absent_roles(p);
    const auto present = [&](const char *name) { return std::find(absent.begin(), absent.end(), name) == absent.end(); };
    read_punch(p, present("Punch"), process);
    read_holder(p, present("Blank holder"), process);
    if (!p.text("Fluid pressure", "Pressure on the lower face of the blank over time from the start of the drawing on: pairs of time and value, for example `0 s, 0 MPa, 1 s, 5 MPa`, or the name of a CSV file with the columns `time_s` and `pressure_MPa`.",
                Default{"", "no fluid"})
           .empty() &&
        !p.documentation_mode())
      process.fluid_pressure = TimeTable::read(p, "Fluid pressure", {"pressure", "MPa", Range::between(-1e4, 1e4)},
                                               "Pressure on the lower face of the blank, from the start of the drawing on.");
    process.unloading = p.choice("Unloading", {"no", "tools removed"}, "What follows the drawing. tools removed: tools, fluid and pulling forces are taken away, and the part springs back; edges that are held stay so.",
                                 Default{"no", "the part stays in the tools"}) == "tools removed";
    process.stop_at_necking = p.choice("Stop at necking", {"yes", "no"}, "End the run, as a result, when the sheet necks; no: go on as long as there is an equilibrium.",
                                       Default{"yes", "after it the strains depend on the mesh and the part is scrap"}) == "yes";
    return process;
  }

  double
  Process::holder_force(const double travel) const
  {
    if (holder_forces.empty())
      return 0;
    if (holder_travels.size() < 2)
      return holder_forces.front();
    return TimeTable(holder_travels, holder_forces).value(travel);
  }
} // namespace tribodraw
