#ifndef tribodraw_forming_increment_solver_h
#define tribodraw_forming_increment_solver_h

#include <tribodraw/forming/tangent_solver.h>
#include <tribodraw/shell/loads.h>
#include <tribodraw/shell/shell.h>

#include <functional>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// Numerical controls of the quasi-static implicit solution; every one has a default with its reason.
  struct SolverSettings
  {
    Contact::Settings contact;
    double            residual_tolerance = 0; ///< unbalanced forces / sum of contact forces
    double            displacement_tolerance = 0; ///< last correction [mm]
    unsigned          max_iterations = 0;
    double            first_increment = 0, largest_increment = 0, smallest_increment = 0; ///< of punch travel [mm]
    unsigned          closing_increments = 0;
    double            closing_time = 0; ///< [s]
    double            viscosity = 0; ///< traction of the viscous stabilisation per velocity [MPa s/mm]

    static SolverSettings read(Parameters &parameters);
  };

  /// One increment of equilibrium: tangent predictor, then Newton's method with an energy-slope line search.
  class IncrementSolver
  {
  public:
    struct Load
    {
      std::vector<Eigen::Vector3d> motion;     ///< of each tool in this increment [mm] (zero for free tools)
      std::vector<double>          free_force; ///< of the machine on each free tool along its axis, modelled part [N]
      Eigen::VectorXd              prescribed; ///< increments of the fixed unknowns, n_dofs() entries; empty: zero

      /// Loads on the blank with their factors at both ends of the increment.
      struct External
      {
        const Loads *loads  = nullptr;
        double       before = 0, after = 0;
      };
      std::vector<External> external;

      /// False: the tools are away (springback). To take them away slowly, add Contact::frozen_forces() of the last state
      /// with tools to the external loads and bring their factor from 1 to 0.
      bool   contact = true;
      double dt      = 0; ///< [s]
    };
    struct Outcome
    {
      bool        converged  = false;
      unsigned    iterations = 0;
      unsigned    first_iterations = 0; ///< up to the first equilibrium: how hard the increment is
      double      residual   = 0; ///< relative to the forces that act on the blank
      double      correction = 0; ///< last [mm]
      std::string reason;         ///< why it did not converge
      // Work done on the blank in the increment, modelled part (mean of the forces at both ends) [N mm].
      double load_work = 0;          ///< of the external loads
      double support_work = 0;       ///< of the prescribed increments
      double stabilisation_work = 0; ///< taken out by the viscous stabilisation
    };

    /// @param fixed unknowns that are held (symmetry planes) or prescribed, size n_dofs of the shell.
    IncrementSolver(Shell &shell, Contact &contact, std::vector<bool> fixed, unsigned n_free_tools, const SolverSettings &settings);

    /// Find equilibrium at the end of the increment. On success the trial states of shell and contact are the solution
    /// (not committed); on failure both are back at the committed state.
    /// @param update_friction called when the trial states are close to equilibrium and, with `true`, when they have
    /// reached it: whether it has changed the friction coefficients of the contact. Then the iteration goes on from there.
    Outcome solve(const Load &load, const std::function<bool(bool in_equilibrium)> &update_friction = {});

    /// Force (moment) of the supports on the blank at each fixed unknown in the last solution, zero elsewhere [N, N mm].
    const Eigen::VectorXd &reactions() const { return reaction; }
    /// Those of the committed state, from a checkpoint.
    void set_reactions(const Eigen::VectorXd &of_committed_state) { reaction = of_committed_state; }

    /// Unbalanced force of each unknown at the last evaluation [N, N mm]: for a diagnosis.
    const Eigen::VectorXd &residual() const { return R; }

  private:
    bool   evaluate(const Load &load, const Shell::AssemblyOptions &options);
    Eigen::Index n_unknowns() const { return static_cast<Eigen::Index>(shell.n_dofs() + n_free); }
    void   resist_motion(double dt);
    double force_scale() const;
    bool   predict(const Load &load, Eigen::VectorXd &du);
    /// Linear step of the whole increment with the tangent of the trial state, where the tools have done @p part of their way.
    bool   predict_from(const Load &load, double part, Eigen::VectorXd &du);
    void   restart();
    void   account(const Load &load, const Eigen::VectorXd &loads_before, const Eigen::VectorXd &reaction_before, Outcome &outcome) const;
    Eigen::VectorXd increment() const;
    void   apply(const Eigen::VectorXd &du, double factor);
    void   limit(const Load &load, Eigen::VectorXd &du) const;
    double largest_displacement(const Eigen::VectorXd &du) const;
    void   add_travels();
    bool   line_search(const Load &load, const Shell::AssemblyOptions &options, const Eigen::VectorXd &du, double &norm);
    void   set_tools(const Load &load, double part);

    Shell                &shell;
    Contact              &contact;
    const SolverSettings &settings;
    std::vector<bool>     fixed, held; // held: fixed, and the free tools while they are away
    unsigned              n_free;
    Contact::Tangent      K;
    TangentSolver         solver;
    Eigen::VectorXd       R, reaction;
    std::vector<double>   free_travel; // of each free tool along its axis in this increment [mm]
    double                load_scale = 0, support_scale = 0;
  };
} // namespace tribodraw

#endif
