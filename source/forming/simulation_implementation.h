#ifndef tribodraw_forming_simulation_implementation_h
#define tribodraw_forming_simulation_implementation_h

#include <tribodraw/base/log.h>
#include <tribodraw/forming/schedule.h>
#include <tribodraw/forming/simulation.h>

#include <array>

namespace tribodraw
{
  /// The state of a run, shared by the files simulation*.cc.
  struct Simulation::Implementation
  {
    const Simulation                      &owner;
    Blank                                  blank;
    ToolSet                                tools;
    Process                                process;
    SolverSettings                         settings;
    const double                           viscosity_given; // more of it while the sheet snaps
    std::shared_ptr<const SheetMaterial>   material;
    Shell                                  shell;
    Schedule                               schedule;
    Contact                                contact;
    std::unique_ptr<FrictionCoupling>      friction;
    std::unique_ptr<IncrementSolver>       solver;
    std::unique_ptr<NeckingMonitor>        monitor;
    std::vector<std::shared_ptr<Observer>> observers;
    IncrementRecord                        record;
    bool                                   tools_away = false;

    // what a checkpoint holds besides the states of the parts
    double                       closed         = 0; // share of the forces at the start that is applied
    double                       next_increment = 0;
    double                       holder_start   = 0; // height of the holder's frame at the start [mm]
    std::vector<Eigen::Vector3d> last_force; // on each tool, for the trapezoidal rule of the work
    long                         n_committed = 0;

    std::filesystem::path checkpoint_folder;
    std::string           identity; // parameters that must not change
    double                checkpoint_distance = 0, last_checkpoint = 0;
    unsigned              checkpoint_slot     = 0;

    std::array<unsigned, 3> edge_node; // on the x axis, the y axis, the diagonal corner

    Implementation(const Simulation &the_owner, const Blank &b, std::shared_ptr<const SheetMaterial> m, const ToolSet &t, const Process &p, const SolverSettings &s, std::unique_ptr<FrictionCoupling> f);

    double symmetry() const { return shell.mesh().symmetry_factor; }

    /// Equilibrium after an increment of the drawing, with the friction that belongs to it.
    IncrementSolver::Outcome solve(const IncrementSolver::Load &load, double increment);

    // stages
    void close();
    void draw();
    bool slow_down(); // false: it has been slowed down enough
    bool is_slowed() const { return settings.viscosity > viscosity_given; }
    void unload();
    void   stop_holder();
    double holder_height() const; // of its face above that of the die [mm]
    bool ends_with_neck() const;
    bool is_drawn() const { return record.path >= schedule.length() * (1 - 1e-12); }

    // a converged increment: figures, history, friction, observers
    enum class Stage
    {
      closing,
      drawing,
      unloading
    };
    void   advance(const IncrementSolver::Load &load, const IncrementSolver::Outcome &outcome, Stage stage, double increment);
    void   record_forces(const IncrementSolver::Load &load, const IncrementSolver::Outcome &outcome);
    void   record_state();
    void   update_friction(const IncrementSolver::Load &load, bool closing);
    double tool_force(int role) const; // downwards on the sheet, full part [N]
    double press_force() const;        // that drives the process, full part [N or MPa]
    void   find_edge_nodes();
    double draw_in(unsigned which) const;
    void   report_step(const Progress &progress) const;

    /// Tell the observers and throw a ConvergenceError that says where and why.
    [[noreturn]] void fail(const IncrementSolver &solver, const IncrementSolver::Outcome &outcome, Stage stage);

    std::string       tool_at(unsigned node) const; // name, or "no tool"
    std::string       diagnosis(const std::vector<unsigned> &worst, const IncrementSolver::Outcome &outcome, Stage stage) const;

    void write_checkpoint();
    void remove_checkpoints() const; // of an earlier run in the same folder
    void restore(const Archive &archive);
  };
} // namespace tribodraw

#endif
