#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/shell/static_analysis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    /// Time increment that stands for `rate-independent` in the predictor [s].
    constexpr double without_rate = 1e12;
    /// An increment is given up after this many iterations without progress by a tenth.
    constexpr unsigned patience             = 12;
    constexpr unsigned n_line_search_trials = 5;
  } // namespace

  DisplacementMeasure
  DisplacementMeasure::at(const unsigned node, const unsigned component, const double weight)
  {
    return { { { node, component, weight } } };
  }

  DisplacementMeasure
  DisplacementMeasure::mean(const NodeSet &nodes, const unsigned component, const double weight)
  {
    DisplacementMeasure measure;
    for (const unsigned node : nodes)
      measure.terms.push_back({ node, component, weight / static_cast<double>(nodes.size()) });
    return measure;
  }

  double
  DisplacementMeasure::value(const Shell &shell, const Shell::Configuration &configuration) const
  {
    double sum = 0;
    for (const Term &t : terms)
      sum += t.weight * (configuration.position[t.node][t.component] - shell.mesh().nodes[t.node][t.component]);
    return sum;
  }

  StaticAnalysis::Settings
  StaticAnalysis::Settings::read(Parameters &p)
  {
    Settings s;
    s.residual_tolerance = p.quantity("Residual tolerance", "", Range::between(1e-12, 1e-2),
                                      "Norm of the unbalanced forces divided by that of the loads or reactions.",
                                      Default{ "1e-6", "the last iterations converge quadratically" });
    s.correction_tolerance
        = p.quantity("Correction tolerance", "", Range::between(1e-14, 1e-4),
                     "A step has also converged if the last correction of every node is smaller than this fraction of "
                     "the size of the model, and of every director smaller than this angle in rad.",
                     Default{ "1e-9", "in thin sheets the unbalanced forces end at the round-off of membrane forces" });
    s.largest_rotation
        = p.quantity("Largest rotation", "rad", Range::between(1e-3, 1.5), "Of a director in one Newton correction.",
                     Default{ "0.5 rad", "beyond, the linearisation says nothing about the solution" });
    s.max_iterations = static_cast<unsigned>(
        p.integer("Maximal iterations", Range::between(3, 1000), "Newton iterations before the step is halved.",
                  Default{ "30", "a step that needs more is cheaper when halved" }));
    s.desired_iterations = static_cast<unsigned>(p.integer(
        "Desired iterations", Range::between(2, 1000), "The step grows while fewer are needed, and shrinks with more.",
        Default{ "8", "a little above the least number of a smooth response" }));
    s.max_steps = static_cast<unsigned>(p.integer("Maximal steps", Range::between(1, 1e6), "The run stops after these.",
                                                  Default{ "2000", "load cases of this kind need 10 to 200" }));
    s.line_search = p.flag("Line search", "Shorten corrections that overshoot, under a prescribed load.",
                           Default{ "true", "costs nothing where Newton's method converges by itself" });
    return s;
  }

  StaticAnalysis::StaticAnalysis(Shell &shell, const Supports &supports, const Loads &growing, const Loads &constant,
                                 const Settings &solver_settings, const double initial_factor)
      : the_shell(shell), fixed(supports.fixed()), motion(supports.motion()), moving(motion.squaredNorm() > 0),
        loads(growing), constant_loads(constant), settings(solver_settings),
        symmetric(growing.conservative() && constant.conservative()), K(shell.make_matrix()),
        solver(symmetric ? DirectSolver::Symmetry::symmetric : DirectSolver::Symmetry::unsymmetric),
        committed_reactions(Eigen::VectorXd::Zero(shell.n_dofs())),
        last_path_increment(Eigen::VectorXd::Zero(shell.n_dofs())), committed_factor(initial_factor),
        trial_factor(initial_factor)
  {
    the_shell.revert();
    Eigen::VectorXd external = std::abs(initial_factor) * loads.forces(shell) + constant_loads.forces(shell);
    clear_fixed(external);
    force_scale         = external.norm();
    Eigen::Vector3d low = shell.mesh().nodes.front(), high = low;
    for (const Eigen::Vector3d &x : shell.mesh().nodes)
      {
        low  = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    model_size = (high - low).norm();
  }

  void
  StaticAnalysis::set_speed(const double prescribed_per_second)
  {
    speed = prescribed_per_second;
  }

  void
  StaticAnalysis::observe(Observer observer)
  {
    observers.push_back(std::move(observer));
  }

  double
  StaticAnalysis::displacement(const DisplacementMeasure &quantity) const
  {
    return quantity.value(the_shell, the_shell.committed());
  }

  double
  StaticAnalysis::motion_force() const
  {
    return motion.dot(committed_reactions);
  }

  void
  StaticAnalysis::clear_fixed(Eigen::VectorXd &v) const
  {
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i])
        v[static_cast<Eigen::Index>(i)] = 0;
  }

  double
  StaticAnalysis::path_product(const Eigen::VectorXd &a, const Eigen::VectorXd &b) const
  {
    double sum = 0;
    for (unsigned node = 0; node < the_shell.n_nodes(); ++node)
      for (unsigned k = 0; k < 3; ++k)
        sum += a[the_shell.dof(node, k)] * b[the_shell.dof(node, k)];
    return sum;
  }

  Eigen::VectorXd
  StaticAnalysis::displacement_increment() const
  {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(the_shell.n_dofs());
    for (unsigned node = 0; node < the_shell.n_nodes(); ++node)
      for (unsigned k = 0; k < 3; ++k)
        u[the_shell.dof(node, k)] = the_shell.trial().position[node][k] - the_shell.committed().position[node][k];
    return u;
  }

  /// Residual and tangent of the trial state.
  bool
  StaticAnalysis::evaluate(const Shell::AssemblyOptions &options, const double time_increment)
  {
    K.set_zero();
    if (!the_shell.assemble(time_increment, options, R, &K))
      return false;
    loads.subtract(the_shell, trial_factor, R, &K);
    constant_loads.subtract(the_shell, 1., R, &K);
    load_vector     = loads.forces(the_shell);
    trial_reactions = R;
    clear_fixed(R);
    return R.allFinite();
  }

  double
  StaticAnalysis::relative_residual()
  {
    Eigen::VectorXd external = std::abs(trial_factor) * load_vector + constant_loads.forces(the_shell);
    clear_fixed(external);
    force_scale = std::max(force_scale, external.norm());
    if (moving)
      force_scale = std::max(force_scale, (trial_reactions - R).norm());
    return R.norm() / std::max(force_scale, std::numeric_limits<double>::min());
  }

  /// True if a correction moved nothing by more than the correction tolerance.
  bool
  StaticAnalysis::at_rest(const Eigen::VectorXd &du) const
  {
    for (unsigned node = 0; node < the_shell.n_nodes(); ++node)
      for (unsigned c = 0; c < Shell::dofs_per_node; ++c)
        if (std::abs(du[the_shell.dof(node, c)]) > settings.correction_tolerance * (c < 3 ? model_size : 1.))
          return false;
    return true;
  }

  /// Solutions of K u = -R and of K u = d(loads)/d(factor) with the motion of the supports.
  bool
  StaticAnalysis::solve_linear(Eigen::VectorXd &from_residual, Eigen::VectorXd &from_factor)
  {
    from_residual = -R;
    from_factor   = load_vector;
    if (moving)
      {
        const Eigen::VectorXd part = K.multiply(motion);
        std::vector<double>   sum(part.data(), part.data() + part.size());
        parallel::sum(sum);
        from_factor -= Eigen::Map<const Eigen::VectorXd>(sum.data(), part.size());
      }
    clear_fixed(from_factor);
    K.eliminate(fixed, parallel::rank() == 0 ? 1. : 0.);
    const timing::Scope scope("shell/linear solver");
    if (!solver.factor(K))
      return false;
    solver.solve(from_residual);
    solver.solve(from_factor);
    if (moving)
      from_factor += motion;
    return from_residual.allFinite() && from_factor.allFinite();
  }

  /// The Newton correction of displacements and factor under the constraint.
  bool
  StaticAnalysis::correction(const Control control, const double target, const double size, const bool first,
                             Correction &result)
  {
    Eigen::VectorXd by_residual, by_factor;
    if (!solve_linear(by_residual, by_factor))
      return false;
    switch (control)
      {
      case Control::factor:
        result.dfactor = target - trial_factor;
        break;
      case Control::displacement:
        {
          const double gap   = measure->value(the_shell, the_shell.trial()) - target;
          const double slope = measure_gradient.dot(by_factor);
          result.dfactor     = -(gap + measure_gradient.dot(by_residual)) / slope;
          break;
        }
      case Control::path:
        if (first)
          {
            const double forward = path_product(last_path_increment, by_factor) < 0 ? -1 : 1;
            result.dfactor       = forward * size / std::sqrt(path_product(by_factor, by_factor));
          }
        else
          {
            const Eigen::VectorXd u = displacement_increment();
            result.dfactor          = -(0.5 * (path_product(u, u) - size * size) + path_product(u, by_residual))
                             / path_product(u, by_factor);
          }
        break;
      }
    if (!std::isfinite(result.dfactor))
      return false;
    result.du       = by_residual + result.dfactor * by_factor;
    double rotation = 0;
    for (unsigned node = 0; node < the_shell.n_nodes(); ++node)
      rotation = std::max(rotation, std::hypot(result.du[the_shell.dof(node, 3)], result.du[the_shell.dof(node, 4)]));
    if (rotation > settings.largest_rotation)
      {
        result.du *= settings.largest_rotation / rotation;
        result.dfactor *= settings.largest_rotation / rotation;
      }
    return true;
  }

  /// Apply the correction, shortened where the elements or the line search ask for it.
  bool
  StaticAnalysis::apply(const Control control, const bool first, const Correction &correction,
                        const double time_increment)
  {
    const Shell::Configuration start        = the_shell.trial();
    const double               start_factor = trial_factor, norm0 = R.norm(), slope0 = correction.du.dot(R);
    const bool                 search = settings.line_search && control == Control::factor && !first && slope0 < 0;
    double                     s      = 1;
    for (unsigned attempt = 0; attempt < n_line_search_trials; ++attempt)
      {
        if (attempt > 0)
          the_shell.set_trial(start);
        the_shell.move(s * correction.du);
        trial_factor       = start_factor + s * correction.dfactor;
        const bool   valid = evaluate({}, time_increment);
        const double slope = valid ? correction.du.dot(R) : 0;
        if (valid
            && (!search || R.norm() < norm0 || std::abs(slope) <= 0.9 * std::abs(slope0)
                || attempt + 1 == n_line_search_trials))
          return true;
        const double secant = valid && slope != slope0 ? slope0 / (slope0 - slope) : 0.4;
        s *= secant > 0 && secant < 1 ? std::clamp(secant, 0.1, 0.9) : 0.4;
      }
    return false;
  }

  StaticAnalysis::Outcome
  StaticAnalysis::increment(const Control control, const double target, const double size, const bool continued)
  {
    Outcome outcome;
    the_shell.revert();
    trial_factor                          = committed_factor;
    const double           dt             = size / speed;
    double                 best           = std::numeric_limits<double>::max();
    unsigned               since_progress = 0;
    Shell::AssemblyOptions options;
    options.loading_tangent = continued; // committed points are elastic or plastic by round-off
    if (!evaluate(options, continued ? without_rate : dt))
      {
        outcome.reason = "the committed state cannot be evaluated";
        return outcome;
      }
    for (unsigned iteration = 1; iteration <= settings.max_iterations; ++iteration)
      {
        Correction du;
        if (!correction(control, target, size, iteration == 1, du))
          {
            outcome.reason = "the tangent is singular";
            return outcome;
          }
        if (symmetric)
          outcome.step.negative_pivots = solver.n_negative_pivots();
        if (!apply(control, iteration == 1, du, dt))
          {
            outcome.reason = "an element is turned inside out or a material point does not converge";
            return outcome;
          }
        const double residual   = relative_residual();
        outcome.step.iterations = iteration;
        outcome.step.residuals.push_back(residual);
        const bool arrived = control != Control::factor || std::abs(trial_factor - target) <= 1e-12 * size;
        // In thin sheets the unbalanced forces may not fall below the round-off of much greater membrane forces.
        if (arrived && (residual <= settings.residual_tolerance || at_rest(du.du)))
          {
            outcome.converged   = true;
            outcome.step.factor = control == Control::factor ? target : trial_factor;
            return outcome;
          }
        since_progress = residual < 0.9 * best ? 0 : since_progress + 1;
        best           = std::min(best, residual);
        if (since_progress >= patience)
          {
            outcome.reason = "no progress in " + std::to_string(patience) + " iterations";
            return outcome;
          }
      }
    outcome.reason = "more than " + std::to_string(settings.max_iterations) + " iterations";
    return outcome;
  }

  void
  StaticAnalysis::accept(const Control control, const Outcome &outcome)
  {
    if (control == Control::path)
      last_path_increment = displacement_increment();
    committed_factor    = outcome.step.factor;
    committed_reactions = trial_reactions;
    the_shell.commit();
    history.push_back(outcome.step);
    if (!symmetric)
      history.back().negative_pivots = -1;
    for (const Observer &observer : observers)
      observer(*this);
  }

  std::string
  StaticAnalysis::diagnosis(const Control control, const Outcome &outcome) const
  {
    std::ostringstream where, value;
    where << "static analysis of the shell at load factor " << units::number(committed_factor);
    unsigned worst = 0, component = 0;
    for (unsigned node = 0; R.size() > 0 && node < the_shell.n_nodes(); ++node)
      for (unsigned c = 0; c < Shell::dofs_per_node; ++c)
        if (std::abs(R[the_shell.dof(node, c)]) > std::abs(R[the_shell.dof(worst, component)]))
          {
            worst     = node;
            component = c;
          }
    const Eigen::Vector3d &x = the_shell.mesh().nodes[worst];
    value << outcome.reason;
    if (!outcome.step.residuals.empty())
      value << "; relative residual " << units::number(outcome.step.residuals.back());
    value << "; largest at node " << worst << " (" << units::number(x[0]) << ", " << units::number(x[1]) << ", "
          << units::number(x[2]) << ") mm in " << (component < 3 ? "a force" : "a moment");
    const bool  unstable = !history.empty() && history.back().negative_pivots > 0;
    std::string hint     = "Try a smaller first step, a finer mesh or another control.";
    if (control == Control::factor)
      hint = unstable ? "The last state is unstable: prescribe a displacement or follow the path."
                      : "If the load has a limit, prescribe a displacement or follow the path.";
    else if (control == Control::displacement)
      hint = "If the displacement snaps back, follow the path.";
    return describe_error("The step became too small.", where.str(), value.str(), "", hint);
  }

  void
  StaticAnalysis::go(const Control control, const double target, double &step, const double largest,
                     const std::function<bool(const StaticAnalysis &)> &finished)
  {
    if (!(largest > 0) || !(step > 0))
      throw InputError(describe_error("Steps must be positive.", "static analysis of the shell"));
    const auto position = [&] {
      return control == Control::factor ? committed_factor : measure ? displacement(*measure) : 0.;
    };
    if (control != Control::displacement)
      measure = nullptr;
    const double smallest  = settings.smallest_step * std::min(step, largest);
    bool         continued = false;
    for (unsigned n = 0; n < settings.max_steps; ++n)
      {
        if (control == Control::path ? finished(*this) : std::abs(target - position()) <= 1e-9 * largest)
          return;
        const double here = position();
        double       size = std::min(step, largest), there = target;
        bool         cut = false; // the step only reaches the end, which says nothing about its best size
        if (control != Control::path)
          {
            cut = std::abs(target - here) <= size * (1 + 1e-9);
            if (cut)
              size = std::abs(target - here);
            else
              there = here + (target > here ? size : -size);
          }
        const Outcome outcome = increment(control, there, size, continued);
        if (outcome.converged)
          {
            accept(control, outcome);
            const double growth = std::sqrt(static_cast<double>(settings.desired_iterations) / outcome.step.iterations);
            if (!cut || growth < 1)
              step = std::min(largest, size * std::clamp(growth, 0.5, settings.largest_growth));
            continued = true;
          }
        else
          {
            const std::string text = diagnosis(control, outcome);
            the_shell.revert();
            step = 0.5 * size;
            if (step < smallest)
              throw ConvergenceError(text);
          }
      }
    throw ConvergenceError(describe_error(
        "The static analysis of the shell did not arrive.", "load factor " + units::number(committed_factor),
        std::to_string(settings.max_steps) + " steps", "", "Allow more or larger steps."));
  }

  Eigen::VectorXd
  StaticAnalysis::linear_response()
  {
    the_shell.revert();
    trial_factor = committed_factor;
    Eigen::VectorXd by_residual, by_factor;
    if (!evaluate({}, 1.) || !solve_linear(by_residual, by_factor))
      throw ConvergenceError(describe_error("The tangent of the shell is singular.", "static analysis of the shell", "",
                                            "", "Are there enough supports?"));
    return by_factor;
  }

  double
  StaticAnalysis::linear_energy(const Eigen::VectorXd &u)
  {
    the_shell.revert();
    trial_factor = committed_factor;
    if (!evaluate({}, 1.))
      throw ConvergenceError(describe_error("The shell cannot be evaluated.", "static analysis of the shell"));
    const Eigen::VectorXd part = K.multiply(u);
    std::vector<double>   sum(part.data(), part.data() + part.size());
    parallel::sum(sum);
    return 0.5 * u.dot(Eigen::Map<const Eigen::VectorXd>(sum.data(), part.size()));
  }

  void
  StaticAnalysis::to_factor(const double factor, const double step, const double largest)
  {
    if (factor_step == 0)
      factor_step = step;
    go(Control::factor, factor, factor_step, largest, {});
  }

  void
  StaticAnalysis::to_displacement(const DisplacementMeasure &quantity, const double displacement, const double step,
                                  const double largest)
  {
    if (displacement_step == 0)
      displacement_step = step;
    measure          = &quantity;
    measure_gradient = Eigen::VectorXd::Zero(the_shell.n_dofs());
    for (const DisplacementMeasure::Term &t : quantity.terms)
      measure_gradient[the_shell.dof(t.node, t.component)] += t.weight;
    go(Control::displacement, displacement, displacement_step, largest, {});
  }

  void
  StaticAnalysis::along_path(const double step, const double largest,
                             const std::function<bool(const StaticAnalysis &)> &finished)
  {
    if (path_step == 0)
      path_step = step;
    go(Control::path, 0, path_step, largest, finished);
  }
} // namespace tribodraw
