#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/forming/increment_solver.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Largest displacement and director rotation of one Newton correction: a fully plastic section is so soft that the
    /// first tangents ask for much more.
    constexpr double largest_step = 2.0 /* mm */, largest_rotation = 0.5 /* rad */;
    /// Far from the solution (unbalanced / contact forces above this) the tangent is stabilised.
    constexpr double far_from_solution = 0.1;
    constexpr double elastic_share     = 0.05;
    /// Time increment that stands for `rate-independent` in the predictor [s]: at the committed strain the backward
    /// difference would see a strain rate of zero and a viscous tangent far too stiff for what comes.
    constexpr double without_rate = 1e12;
  } // namespace

  SolverSettings
  SolverSettings::read(Parameters &p)
  {
    SolverSettings s;
    s.contact.stiffness = p.quantity("Contact stiffness", "MPa/mm", Range::positive().usual(10, 1e5),
                                     "Pressure per penetration of a tool.",
                                     Default{"1000 MPa/mm", "penetration stays near 0.01 mm in the flange and 0.1 mm at the die radius, and Newton's method converges well"});
    s.contact.transition = p.quantity("Contact transition", "mm", Range::positive().usual(1e-4, 0.2),
                                      "Half width of the gap range over which contact pressure sets in quadratically.",
                                      Default{"0.02 mm", "a quarter of the iterations less than with 0.005 mm at the same result"});
    s.contact.stick_slip = p.quantity("Elastic slip", "mm", Range::positive().usual(1e-4, 0.2),
                                      "Relative displacement over which friction builds up to its full value.",
                                      Default{"0.01 mm", "small against the sliding in one increment; the result does not depend on it"});
    s.residual_tolerance = p.quantity("Residual tolerance", "", Range::between(1e-12, 1e-1),
                                      "Norm of the unbalanced forces divided by the sum of the contact forces.",
                                      Default{"1e-4", "the last iterations converge quadratically, so that a smaller value costs little"});
    s.displacement_tolerance = p.quantity("Displacement tolerance", "mm", Range::positive(), "Largest last correction of a node.",
                                          Default{"0.001 mm", "small against the contact transition"});
    s.max_iterations     = static_cast<unsigned>(p.integer("Maximal iterations", Range::between(5, 1000), "Newton iterations before the increment is halved.",
                                                           Default{"50", "an increment that needs more is cheaper when halved"}));
    s.first_increment    = p.quantity("First increment", "mm", Range::positive(), "First increment of punch travel.",
                                      Default{"0.05 mm", "the punch touches one node row after the other"});
    s.largest_increment  = p.quantity("Largest increment", "mm", Range::positive(), "Largest increment of punch travel.",
                                      Default{"2 mm", "an increment costs 10 to 15 iterations almost regardless of its size"});
    s.smallest_increment = p.quantity("Smallest increment", "mm", Range::positive(), "The run stops when increments must be smaller.",
                                      Default{"0.001 mm", "smaller ones have never helped"});
    s.closing_increments = static_cast<unsigned>(p.integer("Closing increments", Range::between(1, 1000), "Increments in which the blank holder force is applied.",
                                                           Default{"4", "3 to 8 iterations each"}));
    s.closing_time       = p.quantity("Closing time", "s", Range::positive(), "Time in which the blank holder closes.",
                                      Default{"0.1 s", "only sets the small strain rates while the sheet is clamped"});
    if (s.smallest_increment > s.first_increment || s.first_increment > s.largest_increment)
      p.problem("First increment", "the increments are not in order.", "Smallest increment <= First increment <= Largest increment");
    return s;
  }

  IncrementSolver::IncrementSolver(Shell &sheet, Contact &tools, std::vector<bool> fixed_unknowns, const unsigned n_free_tools, const SolverSettings &solver_settings)
    : shell(sheet)
    , contact(tools)
    , settings(solver_settings)
    , fixed(std::move(fixed_unknowns))
    , n_free(n_free_tools)
    , K(sheet.make_matrix(n_free_tools))
    , solver(DirectSolver::Symmetry::unsymmetric)
    , R(Eigen::VectorXd::Zero(sheet.n_dofs() + n_free_tools))
  {
    fixed.resize(shell.n_dofs() + n_free, false);
  }

  void
  IncrementSolver::set_tools(const Load &load, const bool at_end)
  {
    auto &tools = contact.tools();
    for (unsigned t = 0; t < tools.size(); ++t)
      if (tools[t].free_index < 0)
        tools[t].z = tools[t].committed_z + (at_end ? load.motion[t] : 0.);
      else
        tools[t].z = free_z[tools[t].free_index];
  }

  bool
  IncrementSolver::evaluate(const Load &load, const Shell::AssemblyOptions &options)
  {
    K.set_zero();
    const bool valid = shell.assemble(load.dt, options, R, &K);
    const timing::Scope scope("contact/assemble");
    set_tools(load, true);
    contact.assemble(R, &K, {});
    for (unsigned i = 0; i < n_free; ++i)
      R[shell.n_dofs() + i] += load.free_force[i];
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i])
        R[i] = 0;
    return valid;
  }

  double
  IncrementSolver::residual_norm(const Eigen::VectorXd &r) const
  {
    // moments [N mm] count like forces at 1 mm
    return r.norm();
  }

  double
  IncrementSolver::largest_displacement(const Eigen::VectorXd &du) const
  {
    double largest = 0;
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      largest = std::max(largest, Eigen::Vector3d(du[shell.dof(node, 0)], du[shell.dof(node, 1)], du[shell.dof(node, 2)]).norm());
    return largest;
  }

  void
  IncrementSolver::limit(Eigen::VectorXd &du) const
  {
    double rotation = 0;
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      rotation = std::max(rotation, std::hypot(du[shell.dof(node, 3)], du[shell.dof(node, 4)]));
    const double excess = std::max(largest_displacement(du) / largest_step, rotation / largest_rotation);
    if (excess > 1)
      du /= excess;
  }

  void
  IncrementSolver::apply(const Eigen::VectorXd &du, const double factor)
  {
    const Eigen::VectorXd step = factor * du;
    shell.move(step);
    for (unsigned i = 0; i < n_free; ++i)
      free_z[i] += step[shell.n_dofs() + i];
  }

  bool
  IncrementSolver::predict(const Load &load, Eigen::VectorXd &du)
  {
    Shell::AssemblyOptions options;
    options.loading_tangent = true;
    K.set_zero();
    if (!shell.assemble(without_rate, options, R, &K))
      return false;
    set_tools(load, false);
    Contact::Options frozen;
    frozen.frozen = true;
    Eigen::VectorXd sensitivity;
    contact.assemble(R, &K, frozen, &load.motion, &sensitivity);
    // The committed state is in equilibrium: only what moves the tools is unbalanced.
    du = -sensitivity;
    K.eliminate(fixed, parallel::rank() == 0 ? 1. : 0.);
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i])
        du[i] = 0;
    const timing::Scope scope("forming/linear solver");
    if (!solver.factor(K))
      return false;
    solver.solve(du);
    double travel = 0;
    for (const double m : load.motion)
      travel = std::max(travel, std::abs(m));
    const double largest = largest_displacement(du);
    if (!std::isfinite(largest))
      return false;
    if (largest > 5 * travel)
      du *= 5 * travel / largest;
    return true;
  }

  bool
  IncrementSolver::line_search(const Load &load, const Shell::AssemblyOptions &options, const Eigen::VectorXd &du, double &norm)
  {
    const auto                start   = shell.trial();
    const std::vector<double> start_z = free_z;
    const double              norm0 = norm, slope0 = du.dot(R);
    double                    s     = 1;
    for (unsigned attempt = 0; attempt < 5; ++attempt)
      {
        if (attempt > 0)
          {
            shell.set_trial(start);
            free_z = start_z;
          }
        apply(du, s);
        const bool   valid = evaluate(load, options);
        const double slope = du.dot(R);
        norm               = residual_norm(R);
        if (valid && std::isfinite(norm) && (std::abs(slope) <= 0.9 * std::abs(slope0) || norm < norm0 || attempt == 4))
          return true;
        const double secant = valid && std::isfinite(slope) && slope0 != slope ? slope0 / (slope0 - slope) : 0.4;
        s *= secant > 0 && secant < 1 ? std::clamp(secant, 0.1, 0.9) : 0.4;
      }
    return false;
  }

  IncrementSolver::Outcome
  IncrementSolver::solve(const Load &load)
  {
    Outcome outcome;
    shell.revert();
    free_z.resize(n_free);
    bool moving = false;
    for (unsigned t = 0; t < contact.tools().size(); ++t)
      {
        if (contact.tools()[t].free_index >= 0)
          free_z[contact.tools()[t].free_index] = contact.tools()[t].committed_z;
        moving = moving || load.motion[t] != 0;
      }
    const auto give_up = [&](const std::string &reason) {
      shell.revert();
      for (auto &t : contact.tools())
        t.z = t.committed_z;
      outcome.reason = reason;
      return outcome;
    };

    Eigen::VectorXd du;
    if (moving && predict(load, du))
      apply(du, 1.);
    Shell::AssemblyOptions options;
    if (!evaluate(load, options))
      {
        // the predictor went too far: start from the committed state
        shell.revert();
        for (unsigned t = 0; t < contact.tools().size(); ++t)
          if (contact.tools()[t].free_index >= 0)
            free_z[contact.tools()[t].free_index] = contact.tools()[t].committed_z;
        if (!evaluate(load, options))
          return give_up("a material point or an element cannot follow the increment");
      }
    double   norm = residual_norm(R), best = norm;
    unsigned since_progress = 0;
    for (outcome.iterations = 1; outcome.iterations <= settings.max_iterations; ++outcome.iterations)
      {
        K.eliminate(fixed, parallel::rank() == 0 ? 1. : 0.);
        {
          const timing::Scope scope("forming/linear solver");
          if (!solver.factor(K))
            return give_up("the tangent is singular");
          du = -R;
          solver.solve(du);
        }
        if (!du.allFinite())
          return give_up("the linear solver gave no finite correction");
        limit(du);
        const bool far         = norm > far_from_solution * contact.force_scale();
        options.tension_only   = far;
        options.elastic_blend  = far ? elastic_share : 0.;
        if (!line_search(load, options, du, norm))
          return give_up("a material point or an element cannot follow the increment");
        outcome.correction = largest_displacement(du);
        outcome.residual   = norm / std::max(contact.force_scale(), 1e-6);
        if (outcome.residual < settings.residual_tolerance && outcome.correction < settings.displacement_tolerance)
          {
            outcome.converged = true;
            return outcome;
          }
        since_progress = norm < 0.9 * best ? 0 : since_progress + 1;
        best           = std::min(best, norm);
        if (since_progress >= 10)
          return give_up("no progress in 10 iterations");
      }
    return give_up("more than " + std::to_string(settings.max_iterations) + " iterations");
  }
} // namespace tribodraw
