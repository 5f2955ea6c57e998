#ifndef tribodraw_forming_simulation_h
#define tribodraw_forming_simulation_h

#include <tribodraw/forming/blank.h>
#include <tribodraw/forming/friction_coupling.h>
#include <tribodraw/forming/increment_solver.h>
#include <tribodraw/forming/process.h>
#include <tribodraw/forming/record.h>
#include <tribodraw/forming/tool_set.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Simulation;

  /// Sees every committed state; const access only.
  class Observer
  {
  public:
    virtual ~Observer()                                                              = default;
    virtual void committed(const Simulation &simulation, const IncrementRecord &record) = 0;
    /// Called when the drawing is complete and before the tools are taken away.
    virtual void unloading(const Simulation &) {}
    /// Called before finished() when an increment has no solution. @param unbalanced force of each node at the last attempt,
    /// on the last committed state [N]
    virtual void failed(const Simulation &, const std::vector<Eigen::Vector3d> & /*unbalanced*/) {}
    /// Called once at the end, also when the run did not converge.
    virtual void finished(const Simulation &, bool /*converged*/) {}
    virtual void save(Archive &) const {}
    virtual void load(const Archive &) {}
  };

  /// Deep drawing: closing of the blank holder, then punch travel in implicit increments of automatic size, at the end the
  /// tools may be taken away; after each increment the friction coupling gives the coefficients for the next. The only loop
  /// that commits history.
  class Simulation
  {
  public:
    Simulation(const Blank                         &blank,
               std::shared_ptr<const SheetMaterial> material,
               const ToolSet                       &tools,
               const Process                       &process,
               const SolverSettings                &settings,
               std::unique_ptr<FrictionCoupling>    friction);
    ~Simulation();

    void add_observer(std::shared_ptr<Observer> observer);
    /// Watch for necking with this forming limit. A neck ends the run as a result, if the process says so.
    void watch_forming_limit(std::shared_ptr<const FormingLimitCurve> limit);
    /// Checkpoints go to this folder every @p travel_between mm; 0: none.
    /// @param identity text of all parameters, line by line, that must be the same when the run is resumed
    void checkpoint_to(const std::filesystem::path &folder, double travel_between, const std::string &identity = "");
    /// Go on from the newest intact checkpoint in the folder. Returns false if there is none. Throws InputError naming
    /// every parameter that differs from the checkpoint's.
    bool resume(const std::filesystem::path &folder);

    /// Ends at the full travel or with a neck. Throws ConvergenceError with a diagnosis after the observers have seen the
    /// last state.
    void run();

    const Shell            &shell() const;
    const Contact          &contact() const;
    const FrictionCoupling &friction() const;
    const Blank            &blank() const;
    const ToolSet          &tools() const;
    const Process          &process() const;
    const IncrementRecord  &record() const;
    /// The neck that ended the run or was passed over; nullptr: none was seen.
    const NeckingMonitor *necking() const;
    /// True once the tools have been taken away.
    bool tools_away() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };
} // namespace tribodraw

#endif
