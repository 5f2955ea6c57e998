#ifndef tribodraw_forming_simulation_h
#define tribodraw_forming_simulation_h

#include <tribodraw/forming/friction_coupling.h>
#include <tribodraw/forming/increment_solver.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// What the press does.
  struct Process
  {
    double punch_travel       = 0; ///< [mm]
    double punch_speed        = 0; ///< [mm/s]
    double blank_holder_force = 0; ///< of the full part [N]

    static Process read(Parameters &parameters);
  };

  /// The blank as described in section `Blank`.
  struct Blank
  {
    double   length = 0, width = 0; ///< of the full blank along x (rolling direction) and y [mm]
    double   thickness    = 0;
    double   element_size = 0;
    unsigned n_thickness_points = 5;
    bool     lobatto            = false; ///< rule through the thickness; else Gauss

    std::string                      shape = "rectangle";
    std::vector<Eigen::Vector2d>     outline;    ///< of the quarter, for a polygon
    std::vector<SizeField::Zone>     zones;      ///< of smaller elements
    std::shared_ptr<const BlankMesh> given_mesh; ///< from a file

    static Blank read(Parameters &parameters);
    BlankMesh    quarter_mesh() const;
  };

  /// The three tools of a drawing process as described in section `Tools`.
  struct ToolSet
  {
    std::shared_ptr<const ToolGeometry> die, punch, blank_holder;

    static ToolSet read(Parameters &parameters);
    enum Index { die_index = 0, punch_index = 1, holder_index = 2 };
    /// Places the tools so that they touch the flat blank, which lies at z = 0.
    std::vector<ContactTool> place(double thickness) const;
  };

  /// Mistakes that show only when blank, tools and process are seen together: a punch that does not fit the die, a mesh too
  /// coarse for a radius, a blank smaller than the opening. Recorded in @p parameters; call at the top level.
  void check_process(Parameters &parameters, const Blank &blank, const ToolSet &tools);

  /// Figures of a committed increment, of the full part. One row of history.csv.
  struct IncrementRecord
  {
    double   time = 0, punch_travel = 0;
    double   punch_force = 0, die_force = 0, blank_holder_force = 0; ///< downward positive on the sheet by punch and holder, upward by the die [N]
    double   force_imbalance = 0; ///< |sum of tool forces| / sum of magnitudes
    double   draw_in_x = 0, draw_in_y = 0, draw_in_diagonal = 0;
    double   min_thickness = 0, max_eps_p = 0;
    FrictionCoupling::Summary friction;
    unsigned newton_iterations = 0;
    double   increment = 0; ///< of punch travel [mm]
    double   residual  = 0;
    double   max_penetration = 0;
    // energies of the full part [N mm]
    double external_work = 0, elastic_energy = 0, plastic_work = 0, friction_work = 0, contact_energy = 0;
    /// (external - elastic - plastic - friction - contact) / external
    double energy_error() const;
  };

  class Simulation;

  /// Sees every committed state; const access only.
  class Observer
  {
  public:
    virtual ~Observer()                                                              = default;
    virtual void committed(const Simulation &simulation, const IncrementRecord &record) = 0;
    /// Called once at the end, also when the run did not converge.
    virtual void finished(const Simulation &, bool /*converged*/) {}
    virtual void save(Archive &) const {}
    virtual void load(const Archive &) {}
  };

  /// Deep drawing: closing of the blank holder, then punch travel in implicit increments of automatic size; after each
  /// increment the friction coupling gives the coefficients for the next. The only loop that commits history.
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
    /// Checkpoints go to this folder every @p travel_between mm; 0: none.
    /// @param identity text of all parameters, line by line, that must be the same when the run is resumed
    void checkpoint_to(const std::filesystem::path &folder, double travel_between, const std::string &identity = "");
    /// Go on from the newest intact checkpoint in the folder. Returns false if there is none. Throws InputError naming the
    /// first parameter that differs from the checkpoint's.
    bool resume(const std::filesystem::path &folder);

    /// Throws ConvergenceError with a diagnosis after the observers have seen the last state.
    void run();

    const Shell            &shell() const;
    const Contact          &contact() const;
    const FrictionCoupling &friction() const;
    const Process          &process() const;
    const IncrementRecord  &record() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };
} // namespace tribodraw

#endif
