#ifndef tribodraw_forming_increment_solver_h
#define tribodraw_forming_increment_solver_h

#include <tribodraw/contact/contact.h>
#include <tribodraw/shell/shell.h>

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

    static SolverSettings read(Parameters &parameters);
  };

  /// One increment of equilibrium: tangent predictor, then Newton's method with an energy-slope line search.
  class IncrementSolver
  {
  public:
    struct Load
    {
      std::vector<double> motion;      ///< vertical displacement of each tool in this increment [mm] (0 for free tools)
      std::vector<double> free_force;  ///< downward force on each free tool, modelled part [N]
      double              dt = 0;      ///< [s]
    };
    struct Outcome
    {
      bool        converged  = false;
      unsigned    iterations = 0;
      double      residual   = 0; ///< relative to the contact forces
      double      correction = 0; ///< last [mm]
      std::string reason;         ///< why it did not converge
    };

    /// @param fixed unknowns that stay zero (symmetry planes), size n_dofs of the shell.
    IncrementSolver(Shell &shell, Contact &contact, std::vector<bool> fixed, unsigned n_free_tools, const SolverSettings &settings);

    /// Find equilibrium at the end of the increment. On success the trial states of shell and contact are the solution
    /// (not committed); on failure both are back at the committed state.
    Outcome solve(const Load &load);

    /// Unbalanced force of each unknown at the last evaluation [N, N mm]: for a diagnosis.
    const Eigen::VectorXd &residual() const { return R; }

  private:
    bool   evaluate(const Load &load, const Shell::AssemblyOptions &options);
    double residual_norm(const Eigen::VectorXd &r) const;
    bool   predict(const Load &load, Eigen::VectorXd &du);
    void   apply(const Eigen::VectorXd &du, double factor);
    void   limit(Eigen::VectorXd &du) const;
    double largest_displacement(const Eigen::VectorXd &du) const;
    bool   line_search(const Load &load, const Shell::AssemblyOptions &options, const Eigen::VectorXd &du, double &norm);
    void   set_tools(const Load &load, bool at_end);

    Shell                &shell;
    Contact              &contact;
    const SolverSettings &settings;
    std::vector<bool>     fixed;
    unsigned              n_free;
    SparseMatrix          K;
    DirectSolver          solver;
    Eigen::VectorXd       R;
    std::vector<double>   free_z;
  };
} // namespace tribodraw

#endif
