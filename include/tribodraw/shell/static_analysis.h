#ifndef tribodraw_shell_static_analysis_h
#define tribodraw_shell_static_analysis_h

#include <tribodraw/base/sparse_system.h>
#include <tribodraw/shell/loads.h>
#include <tribodraw/shell/shell.h>

#include <functional>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// A weighted sum of displacement components of nodes [mm].
  struct DisplacementMeasure
  {
    struct Term
    {
      unsigned node, component; ///< component 0..2
      double   weight;
    };
    std::vector<Term> terms;

    static DisplacementMeasure at(unsigned node, unsigned component, double weight = 1);
    /// Mean over nodes.
    static DisplacementMeasure mean(const NodeSet &nodes, unsigned component, double weight = 1);
    double                     value(const Shell &shell, const Shell::Configuration &configuration) const;
  };

  /// Static equilibrium of a shell under loads and motions of its supports that grow with one factor, followed by
  /// Newton's method with adaptive steps. What is prescribed is the factor, a displacement (E. Ramm, 1981) or
  /// the length of the path (M. A. Crisfield, Comput. Struct. 13 (1981) 55; the constraint is linearised in
  /// each iteration, so that there is no root to choose), past limit points and back.
  class StaticAnalysis
  {
  public:
    struct Settings
    {
      double          residual_tolerance   = 1e-6; ///< norm of the unbalanced forces over that of loads or reactions
      double          correction_tolerance = 1e-9; ///< of the size of the model, or rad
      double          largest_rotation     = 0.5;  ///< of a director in one correction [rad]
      double          largest_growth       = 1.5;  ///< of the step
      double          smallest_step        = 1e-6; ///< as a fraction of the first step
      unsigned        max_iterations       = 30;
      unsigned        desired_iterations   = 8;
      unsigned        max_steps            = 2000; ///< of one call
      bool            line_search          = true; ///< under a prescribed factor
      static Settings read(Parameters &parameters);
    };

    /// One converged increment.
    struct Step
    {
      double              factor;
      unsigned            iterations;      ///< linear solutions, the predictor included
      std::vector<double> residuals;       ///< relative, after each of them
      int                 negative_pivots; ///< of the last tangent; -1: not known (loads that are not conservative)
    };
    using Observer = std::function<void(const StaticAnalysis &)>;

    /// Continue from the committed state of @p shell, which is in equilibrium with @p initial_factor.
    /// @param loads,supports grow with the factor; @p constant_loads do not. Copied.
    StaticAnalysis(Shell &shell, const Supports &supports, const Loads &loads, const Loads &constant_loads,
                   const Settings &settings, double initial_factor = 0);

    /// Speed at which the prescribed quantity (factor, displacement, path) grows, for materials that depend on the
    /// strain rate [1/s, mm/s, mm/s]; default 1.
    void set_speed(double prescribed_per_second);
    /// Called after each converged step.
    void observe(Observer observer);

    /// Go to @p factor, reaching it exactly. All throw ConvergenceError with a diagnosis if the step becomes too small.
    /// @param step first and @p largest step, positive; a step is carried over from the last call of the same kind, and
    /// from then on only bounded by @p largest
    void to_factor(double factor, double step, double largest);
    /// Go to the value @p displacement of a measure, with the factor unknown.
    void to_displacement(const DisplacementMeasure &measure, double displacement, double step, double largest);
    /// Follow the path with steps of length @p step to @p largest (Euclidean norm of all nodes' displacements) until @p
    /// finished says so.
    void along_path(double step, double largest, const std::function<bool(const StaticAnalysis &)> &finished);

    /// Derivative of the unknowns by the factor in the committed state: the linear solution, if nothing has moved yet.
    Eigen::VectorXd linear_response();
    /// Strain energy of displacements @p u (and director increments) by the tangent of the committed state [N mm].
    double linear_energy(const Eigen::VectorXd &u);

    double
    factor() const
    {
      return committed_factor;
    }
    const std::vector<Step> &
    steps() const
    {
      return history;
    }
    const Shell &
    shell() const
    {
      return the_shell;
    }
    double displacement(const DisplacementMeasure &measure) const; ///< committed
    /// Internal minus external forces of the committed state, n_dofs() entries: the reactions at held unknowns.
    const Eigen::VectorXd &
    reactions() const
    {
      return committed_reactions;
    }
    /// Force that does the work of the prescribed motion of the supports [N mm per factor].
    double motion_force() const;

  private:
    enum class Control
    {
      factor,
      displacement,
      path
    };
    struct Outcome
    {
      bool        converged = false;
      Step        step;
      std::string reason;
    };
    struct Correction
    {
      Eigen::VectorXd du;
      double          dfactor = 0;
    };

    bool            evaluate(const Shell::AssemblyOptions &options, double time_increment);
    bool            solve_linear(Eigen::VectorXd &from_residual, Eigen::VectorXd &from_factor);
    Outcome         increment(Control control, double target, double size, bool continued);
    bool            correction(Control control, double target, double size, bool first, Correction &result);
    bool            apply(Control control, bool first, const Correction &correction, double time_increment);
    double          path_product(const Eigen::VectorXd &a, const Eigen::VectorXd &b) const;
    Eigen::VectorXd displacement_increment() const;
    void            clear_fixed(Eigen::VectorXd &v) const;
    double          relative_residual();
    bool            at_rest(const Eigen::VectorXd &du) const;
    void            accept(Control control, const Outcome &outcome);
    std::string     diagnosis(Control control, const Outcome &outcome) const;
    void            go(Control control, double target, double &step, double largest,
                       const std::function<bool(const StaticAnalysis &)> &finished);

    Shell                     &the_shell;
    const std::vector<bool>    fixed;
    const Eigen::VectorXd      motion;
    const bool                 moving;
    const Loads                loads, constant_loads;
    const Settings             settings;
    const bool                 symmetric;
    SparseMatrix               K;
    DirectSolver               solver;
    Eigen::VectorXd            R, load_vector, trial_reactions, committed_reactions, last_path_increment;
    double                     committed_factor, trial_factor, force_scale = 0, model_size = 0, speed = 1;
    double                     factor_step = 0, displacement_step = 0, path_step = 0;
    const DisplacementMeasure *measure = nullptr;
    Eigen::VectorXd            measure_gradient;
    std::vector<Step>          history;
    std::vector<Observer>      observers;
  };
} // namespace tribodraw

#endif
