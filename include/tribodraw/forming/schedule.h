#ifndef tribodraw_forming_schedule_h
#define tribodraw_forming_schedule_h

#include <tribodraw/forming/blank.h>
#include <tribodraw/forming/increment_solver.h>
#include <tribodraw/forming/process.h>
#include <tribodraw/forming/tool_set.h>

namespace tribodraw
{
  /// What is prescribed where on the path of the process. The path is the punch travel; without a punch it is the way of the
  /// fastest tool or edge; if nothing has a prescribed way, 100 mm stand for the duration.
  class Schedule
  {
  public:
    /// Fixes the unknowns of @p shell on planes of symmetry and edges.
    Schedule(Shell &shell, const Blank &blank, const ToolSet &tools, const Process &process);

    double length() const { return path_length; }
    double time(double path) const { return path / speed; }
    /// Tools in their places before the closing.
    std::vector<ContactTool> place(const BlankMesh &mesh, double thickness) const;
    /// The tool is stopped where it is: no longer moved by its force.
    void                     stop(std::size_t tool, std::vector<ContactTool> &placed);
    bool                     is_free(std::size_t tool) const;
    unsigned                 n_free_tools() const { return static_cast<unsigned>(free_tools.size()); }
    /// True if something presses from the start on and has to be applied step by step before the drawing.
    bool has_closing() const;

    const std::vector<bool> &fixed() const { return supports.fixed(); }
    /// Marks of the unknowns that hold the part without tools: the fixed ones and those that stop its rigid motions.
    std::vector<bool> held_without_tools(const Shell &shell) const;

    /// Shares @p from and @p to of the forces at the start of the path.
    IncrementSolver::Load closing(double from, double to) const;
    IncrementSolver::Load drawing(double from, double to) const;

  private:
    double force(std::size_t tool, double path) const;
    double pressure(double path) const;
    void   number_free_tools(std::vector<ContactTool> &placed) const;
    void   add_edges(Shell &shell);
    void   measure_path();

    const Blank             &blank;
    const ToolSet           &tools;
    const Process           &process;
    double                   symmetry;
    Supports                 supports;
    std::vector<std::size_t> free_tools; // positions in the list of tools
    Loads                    fluid;
    struct Pull
    {
      const TimeTable *force;
      Loads            loads; // of 1 N on the full part
    };
    std::vector<Pull> pulls;
    struct Grip
    {
      const TimeTable      *motion;
      std::vector<unsigned> unknowns;
      double                sign;
    };
    std::vector<Grip> grips;
    double            path_length = 0, speed = 1;
  };
} // namespace tribodraw

#endif
