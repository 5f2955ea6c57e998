#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/forming/increment_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribodraw
{
  namespace
  {
    /// Largest displacement (between tools: a free sheet may swing) and director rotation of one Newton correction: a fully
    /// plastic section is so soft that the first tangents ask for much more.
    constexpr double largest_step = 2.0 /* mm */, largest_rotation = 0.5 /* rad */;
    /// Far from the solution (unbalanced / contact forces above this) the tangent is stabilised.
    constexpr double far_from_solution = 0.1;
    constexpr double elastic_share     = 0.05;
    /// Below this pressures and sliding are known well enough for friction.
    constexpr double near_solution = 0.02;
    /// Below this part of the residual's tolerance a displacement may still move: it costs no force (a corner of the blank
    /// between the flat tools).
    constexpr double surely_converged = 0.1;

    /// Measure of unbalanced forces where nothing touches or loads the sheet [N]: a ten thousandth of it is still above round-off.
    constexpr double least_force = 1e-3;

    void
    stabilise(Shell::AssemblyOptions &options, const bool far)
    {
      options.tension_only  = far;
      options.elastic_blend = far ? elastic_share : 0.;
    }

    /// Relative residual of a correction computed with old factors: a Newton step gains about as much.
    constexpr double linear_tolerance = 5e-2;
    /// A step that gained this much leaves a tangent close to the one before.
    constexpr double similar_below = 0.3;
    /// Time increment that stands for `rate-independent` in the predictor [s]: at the committed strain the backward
    /// difference would see a strain rate of zero and a viscous tangent far too stiff for what comes.
    constexpr double without_rate = 1e12;
  } // namespace

  SolverSettings
  SolverSettings::read(Parameters &p)
  {
    SolverSettings s;
    s.contact.stiffness = p.quantity("Contact stiffness", "MPa/mm", Range::between(0, 1e7),
                                     "Pressure per penetration of a tool; 0: automatic, so that no penetration exceeds 3 % of the thickness.",
                                     Default{"0 MPa/mm", "from the modulus and the thickness of the sheet, raised where the pressure needs it"});
    s.contact.transition = p.quantity("Contact transition", "mm", Range::between(0, 1),
                                      "Half width of the gap range over which contact pressure sets in quadratically; 0: automatic, 2.5 % of the thickness.",
                                      Default{"0 mm", "the softer the onset, the fewer iterations"});
    s.contact.stick_slip = p.quantity("Elastic slip", "mm", Range::positive().usual(1e-4, 0.2),
                                      "Relative displacement over which friction builds up to its full value.",
                                      Default{"0.01 mm", "small against the sliding in one increment; the result does not depend on it"});
    s.contact.initial_thickness = p.choice("Contact thickness", {"current", "initial"},
                                           "Thickness that puts the faces of the sheet off its middle surface in contact; initial: as many explicit codes do, for comparison with them.",
                                           Default{"current", "where the flange thickens decides who carries the blank holder"}) == "initial";
    s.residual_tolerance = p.quantity("Residual tolerance", "", Range::between(1e-12, 1e-1),
                                      "Norm of the unbalanced forces divided by the sum of the contact forces.",
                                      Default{"1e-4", "the last iterations converge quadratically, so that a smaller value costs little"});
    s.displacement_tolerance = p.quantity("Displacement tolerance", "mm", Range::positive(), "Largest correction of a node that is still to come, estimated from the last one and by how much that reduced the residual.",
                                          Default{"0.001 mm", "small against the contact transition"});
    s.max_iterations     = static_cast<unsigned>(p.integer("Maximal iterations", Range::between(5, 1000), "Newton iterations before the increment is halved.",
                                                           Default{"50", "an increment that needs more is cheaper when halved"}));
    s.first_increment    = p.quantity("First increment", "mm", Range::positive(), "First increment of punch travel.",
                                      Default{"0.05 mm", "the punch touches one node row after the other"});
    s.largest_increment  = p.quantity("Largest increment", "mm", Range::positive(), "Largest increment of punch travel.",
                                      Default{"1 mm", "costs little more than 2 mm, and the punch force is then right to half a per cent"});
    s.smallest_increment = p.quantity("Smallest increment", "mm", Range::positive(), "The run stops when increments must be smaller.",
                                      Default{"0.001 mm", "smaller ones have never helped"});
    s.closing_increments = static_cast<unsigned>(p.integer("Closing increments", Range::between(1, 1000), "Increments in which the blank holder force is applied.",
                                                           Default{"4", "3 to 8 iterations each"}));
    s.closing_time       = p.quantity("Closing time", "s", Range::positive(), "Time in which the blank holder closes.",
                                      Default{"0.1 s", "only sets the small strain rates while the sheet is clamped"});
    s.viscosity = p.quantity("Stabilisation viscosity", "MPa s/mm", Range::between(0, 1e3),
                             "Traction per velocity of the blank that resists its motion, on its undeformed area; the work against it is reported.",
                             Default{"0 MPa s/mm", "none is needed for convergence"});
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
    , K(sheet, n_free_tools)
    , R(Eigen::VectorXd::Zero(sheet.n_dofs() + n_free_tools))
    , reaction(Eigen::VectorXd::Zero(sheet.n_dofs()))
    , free_travel(n_free_tools, 0.)
  {
    fixed.resize(shell.n_dofs() + n_free, false);
    held = fixed;
  }

  void
  IncrementSolver::set_tools(const Load &load, const double part)
  {
    auto &tools = contact.tools();
    for (unsigned t = 0; t < tools.size(); ++t)
      if (tools[t].free_index < 0)
        tools[t].place = tools[t].committed_place + part * load.motion[t];
      else
        tools[t].place = tools[t].committed_place + free_travel[tools[t].free_index] * tools[t].axis;
  }

  void
  IncrementSolver::add_travels()
  {
    R.conservativeResize(n_unknowns());
    R.tail(n_free).setZero();
  }

  bool
  IncrementSolver::evaluate(const Load &load, const Shell::AssemblyOptions &options)
  {
    K.set_zero();
    if (!shell.assemble(load.dt, options, R, &K.sheet))
      return false;
    add_travels();
    load_scale = 0;
    for (const Load::External &e : load.external)
      {
        e.loads->subtract(shell, e.after, R, &K.sheet);
        load_scale += std::max(std::abs(e.before), std::abs(e.after)) * e.loads->forces(shell).lpNorm<1>();
      }
    if (settings.viscosity > 0)
      resist_motion(load.dt);
    set_tools(load, 1.);
    if (load.contact)
      {
        const timing::Scope scope("contact/assemble");
        contact.assemble(R, &K, {});
        for (unsigned i = 0; i < n_free; ++i)
          R[shell.n_dofs() + i] -= load.free_force[i];
      }
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i])
        {
          if (i < shell.n_dofs())
            reaction[i] = R[i];
          R[i] = 0;
        }
    support_scale = load.prescribed.size() ? (load.prescribed.array() != 0).select(reaction, 0.).lpNorm<1>() : 0.;
    return true;
  }

  void
  IncrementSolver::resist_motion(const double dt)
  {
    const auto &now = shell.trial().position, &before = shell.committed().position;
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      {
        const double resistance = settings.viscosity * shell.node_reference_area()[node] / dt;
        for (unsigned c = 0; c < 3; ++c)
          {
            const auto i = static_cast<int>(shell.dof(node, c));
            R[i] += resistance * (now[node][c] - before[node][c]);
            if (parallel::rank() == 0)
              K.sheet.add(i, i, resistance);
          }
      }
  }

  double
  IncrementSolver::force_scale() const
  {
    return std::max(contact.force_scale() + load_scale + support_scale, least_force);
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
  IncrementSolver::limit(const Load &load, Eigen::VectorXd &du) const
  {
    double rotation = 0;
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      rotation = std::max(rotation, std::hypot(du[shell.dof(node, 3)], du[shell.dof(node, 4)]));
    const double excess = std::max(rotation / largest_rotation, load.contact ? largest_displacement(du) / largest_step : 0.);
    if (excess > 1)
      du /= excess;
  }

  void
  IncrementSolver::apply(const Eigen::VectorXd &du, const double factor)
  {
    const Eigen::VectorXd step = factor * du;
    shell.move(step);
    for (unsigned i = 0; i < n_free; ++i)
      free_travel[i] += step[shell.n_dofs() + i];
  }

  void
  IncrementSolver::restart()
  {
    shell.revert();
    std::fill(free_travel.begin(), free_travel.end(), 0.);
    for (auto &t : contact.tools())
      t.place = t.committed_place;
  }

  bool
  IncrementSolver::predict(const Load &load, Eigen::VectorXd &du)
  {
    if (!predict_from(load, 0., du))
      return false;
    // Midpoint rule: a sheet that moves along its tangent would leave the radius that it slides over.
    const Eigen::VectorXd first = du;
    apply(du, 0.5);
    const bool followed = predict_from(load, 0.5, du);
    restart();
    if (!followed)
      du = first;
    return true;
  }

  bool
  IncrementSolver::predict_from(const Load &load, const double part, Eigen::VectorXd &du)
  {
    Shell::AssemblyOptions options;
    options.loading_tangent = true;
    options.tension_only    = true; // between the flat tools the flange is close to buckling: full waves would be predicted
    K.set_zero();
    if (!shell.assemble(without_rate, options, R, &K.sheet))
      return false;
    add_travels();
    set_tools(load, part);
    // The committed state is in equilibrium: only what moves or loads it is unbalanced.
    Eigen::VectorXd unbalanced = Eigen::VectorXd::Zero(n_unknowns());
    if (load.contact)
      {
        Contact::Options frozen;
        frozen.frozen = true;
        contact.assemble(R, &K, frozen, &load.motion, &unbalanced);
        // a changed force on a free tool; small differences come from areas and thicknesses that lag
        for (unsigned i = 0; i < n_free; ++i)
          {
            const double change = load.free_force[i] - R[shell.n_dofs() + i];
            if (std::abs(change) > 1e-2 * std::abs(load.free_force[i]))
              unbalanced[shell.n_dofs() + i] -= change;
          }
      }
    for (const Load::External &e : load.external)
      {
        e.loads->subtract(shell, e.after - e.before, unbalanced, nullptr);
        e.loads->subtract(shell, e.before, R, &K.sheet);
      }
    Eigen::VectorXd given = Eigen::VectorXd::Zero(n_unknowns());
    if (load.prescribed.size())
      {
        given.head(shell.n_dofs()) = load.prescribed;
        const Eigen::VectorXd own = K.sheet.multiply(load.prescribed);
        std::vector<double>   forces(own.data(), own.data() + own.size());
        parallel::sum(forces);
        unbalanced.head(shell.n_dofs()) += Eigen::Map<const Eigen::VectorXd>(forces.data(), shell.n_dofs());
        unbalanced.tail(n_free) += K.row.transpose() * load.prescribed;
      }
    du = -unbalanced;
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i])
        du[i] = 0;
    if (!solver.solve(K, held, linear_tolerance, false, du))
      return false;
    double travel = largest_displacement(given);
    for (const Eigen::Vector3d &m : load.motion)
      travel = std::max(travel, m.norm());
    const double largest = largest_displacement(du);
    if (travel > 0 && largest > 5 * travel)
      du *= 5 * travel / largest;
    else if (travel == 0)
      limit(load, du);
    du += given;
    return true;
  }

  bool
  IncrementSolver::line_search(const Load &load, const Shell::AssemblyOptions &options, const Eigen::VectorXd &du, double &norm)
  {
    const auto                start        = shell.trial();
    const std::vector<double> start_travel = free_travel;
    const double              norm0 = norm, slope0 = du.dot(R);
    double                    s     = 1;
    for (unsigned attempt = 0; attempt < 5; ++attempt)
      {
        if (attempt > 0)
          {
            shell.set_trial(start);
            free_travel = start_travel;
          }
        apply(du, s);
        const bool   valid = evaluate(load, options);
        const double slope = du.dot(R);
        norm               = R.norm(); // moments [N mm] count like forces at 1 mm
        if (valid && std::isfinite(norm) && (std::abs(slope) <= 0.9 * std::abs(slope0) || norm < norm0 || attempt == 4))
          return true;
        const double secant = valid && std::isfinite(slope) && slope0 != slope ? slope0 / (slope0 - slope) : 0.4;
        s *= secant > 0 && secant < 1 ? std::clamp(secant, 0.1, 0.9) : 0.4;
      }
    return false;
  }

  Eigen::VectorXd
  IncrementSolver::increment() const
  {
    Eigen::VectorXd                   u   = Eigen::VectorXd::Zero(shell.n_dofs());
    const Shell::Configuration &now = shell.trial(), &before = shell.committed();
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      {
        for (unsigned c = 0; c < 3; ++c)
          u[shell.dof(node, c)] = now.position[node][c] - before.position[node][c];
        // the rotation vector that turns the director along a great circle
        const double          cosine  = std::clamp(now.director[node].dot(before.director[node]), -1., 1.);
        const Eigen::Vector3d towards = now.director[node] - cosine * before.director[node];
        const double          sine    = towards.norm();
        if (sine > 0)
          for (unsigned t = 0; t < 2; ++t)
            u[shell.dof(node, 3 + t)] = std::atan2(sine, cosine) / sine * towards.dot(before.frame[node][t]);
      }
    return u;
  }

  void
  IncrementSolver::account(const Load &load, const Eigen::VectorXd &loads_before, const Eigen::VectorXd &reaction_before, Outcome &outcome) const
  {
    const Eigen::VectorXd u     = increment();
    Eigen::VectorXd       loads = loads_before;
    for (const Load::External &e : load.external)
      loads += e.after * e.loads->forces(shell);
    for (unsigned node = 0; node < shell.n_nodes() && settings.viscosity > 0; ++node)
      outcome.stabilisation_work += settings.viscosity / load.dt * shell.node_reference_area()[node] *
                                    (shell.trial().position[node] - shell.committed().position[node]).squaredNorm();
    outcome.load_work    = 0.5 * loads.dot(u);
    outcome.support_work = load.prescribed.size() ? 0.5 * (reaction_before + reaction).dot(load.prescribed) : 0.;
  }

  IncrementSolver::Outcome
  IncrementSolver::solve(const Load &load, const std::function<bool(bool)> &update_friction)
  {
    Outcome outcome;
    restart();
    held = fixed;
    if (!load.contact)
      std::fill(held.begin() + shell.n_dofs(), held.end(), true);
    const Eigen::VectorXd reaction_before = reaction;
    Eigen::VectorXd       loads_before    = Eigen::VectorXd::Zero(shell.n_dofs());
    bool                  changes         = load.prescribed.size() && load.prescribed.squaredNorm() > 0;
    for (const Load::External &e : load.external)
      {
        loads_before += e.before * e.loads->forces(shell);
        changes = changes || e.after != e.before;
      }
    for (const Eigen::Vector3d &m : load.motion)
      changes = changes || m.squaredNorm() > 0;
    changes = changes || (load.contact && n_free > 0);
    const auto give_up = [&](const std::string &reason) {
      restart();
      reaction       = reaction_before;
      outcome.reason = reason;
      return outcome;
    };

    Eigen::VectorXd given = Eigen::VectorXd::Zero(n_unknowns());
    if (load.prescribed.size())
      given.head(shell.n_dofs()) = load.prescribed;
    Eigen::VectorXd du;
    apply(changes && predict(load, du) ? du : given, 1.);
    Shell::AssemblyOptions options;
    stabilise(options, changes); // the prediction is far off as a rule
    if (!evaluate(load, options))
      {
        // the predictor went too far: start from the committed state
        restart();
        apply(given, 1.);
        if (!evaluate(load, options))
          return give_up("a material point or an element cannot follow the increment");
      }
    double   norm = R.norm(), best = norm, last_norm = 0;
    unsigned since_progress = 0;
    for (unsigned tried = 1; tried <= settings.max_iterations; ++tried)
      {
        ++outcome.iterations;
        du = -R;
        if (!solver.solve(K, held, linear_tolerance, norm < similar_below * last_norm && !options.tension_only, du))
          return give_up("the tangent is singular");
        last_norm = norm;
        limit(load, du);
        const bool far        = norm > far_from_solution * force_scale();
        stabilise(options, far);
        if (!line_search(load, options, du, norm))
          return give_up("a material point or an element cannot follow the increment");
        outcome.correction = largest_displacement(du);
        outcome.residual   = norm / force_scale();
        if (outcome.residual < settings.residual_tolerance &&
            (outcome.correction * std::min(1., norm / last_norm) < settings.displacement_tolerance || outcome.residual < surely_converged * settings.residual_tolerance))
          {
            const bool stiffer = load.contact && contact.stiffen();
            if (!stiffer && outcome.first_iterations == 0)
              outcome.first_iterations = outcome.iterations;
            if (stiffer || (update_friction && update_friction(true)))
              {
                if (!evaluate(load, options))
                  return give_up("a material point or an element cannot follow the increment");
                norm = best = R.norm();
                since_progress = tried = 0;
                if (!stiffer)
                  last_norm = std::numeric_limits<double>::infinity(); // the tangent is nearly that of the last step
                continue;
              }
            outcome.converged = true;
            account(load, loads_before, reaction_before, outcome);
            return outcome;
          }
        // The next correction is still found with the old friction, so that this costs no evaluation of the sheet.
        if (update_friction && outcome.residual < near_solution)
          update_friction(false);
        since_progress = norm < 0.9 * best ? 0 : since_progress + 1;
        best           = std::min(best, norm);
        if (since_progress >= 10)
          return give_up("no progress in 10 iterations");
      }
    return give_up("more than " + std::to_string(settings.max_iterations) + " iterations");
  }
} // namespace tribodraw
