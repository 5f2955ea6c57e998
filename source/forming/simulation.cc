#include "simulation_implementation.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// An increment that took this many Newton iterations or fewer is followed by a larger one, one that took more
    /// than the second number by a smaller one (measured: an increment costs about the same whatever its size).
    constexpr unsigned few_iterations = 14, many_iterations = 22;
    constexpr double   growth = 1.4, shrinkage = 0.6;
    /// Share of the tool forces that is taken away first, and the smallest step: springback is mostly elastic.
    constexpr double first_release = 0.25, smallest_release = 2e-3;
    /// Of a viscosity in a step of the first size, if the part buckles [MPa/mm]; and how much longer steps become before it
    /// is left away.
    constexpr double slowing_stiffness = 0.5, longest_relaxation = 1e4;
    constexpr double fine             = 0.01; // of the residual tolerance
    /// A sheet that snaps while it is drawn has no equilibrium nearby. A viscosity makes the path through the snap: of this
    /// stiffness in a first increment [MPa/mm], five times that if it is not enough, and left away when the increments
    /// have grown by the second number. Its work stays below this share of all, or the run ends.
    constexpr double snap_stiffness = 0.1, stiffest_snap = 2.5, regrowth = 8, slowing_work = 0.01;
    constexpr double smallest_closing = 1e-4;
    constexpr double complete         = 1 - 1e-9;
  } // namespace

  Simulation::Implementation::Implementation(const Simulation &the_owner, const Blank &b, std::shared_ptr<const SheetMaterial> m, const ToolSet &t, const Process &p, const SolverSettings &s, std::unique_ptr<FrictionCoupling> f)
    : owner(the_owner)
    , blank(b)
    , tools(t)
    , process(p)
    , settings(s)
    , viscosity_given(s.viscosity)
    , material(m)
    , shell(b.mesh(), b.thickness, m, b.n_thickness_points, b.thickness_rule)
    , schedule(shell, blank, tools, process)
    , contact(shell, schedule.place(shell.mesh(), b.thickness), settings.contact)
    , friction(std::move(f))
    , next_increment(s.first_increment)
    , last_force(tools.tools.size(), Vector3d::Zero())
  {
    solver = std::make_unique<IncrementSolver>(shell, contact, schedule.fixed(), schedule.n_free_tools(), settings);
    holder_start = tools.holder >= 0 ? contact.tools()[tools.holder].place[2] : 0.;
    find_edge_nodes();
    friction->start(shell, contact);
    record.min_thickness = b.thickness;
  }

  bool
  Simulation::Implementation::ends_with_neck() const
  {
    return monitor && monitor->necked() && process.stop_at_necking;
  }

  void
  Simulation::Implementation::close()
  {
    double step = 1. / settings.closing_increments;
    while (schedule.has_closing() && closed < complete)
      {
        step      = std::min(step, 1 - closed);
        auto load = schedule.closing(closed, closed + step);
        load.dt   = settings.closing_time * step;
        const auto outcome = solver->solve(load);
        if (!outcome.converged)
          {
            step *= 0.5;
            if (step < smallest_closing)
              fail(*solver, outcome, Stage::closing);
            log::step("Closing: " + outcome.reason + ", the step is halved.");
            continue;
          }
        closed += step;
        advance(load, outcome, Stage::closing, 0.);
      }
    closed = 1;
    contact.start_energy_balance();
    record.external_work = record.friction_work = record.contact_energy = 0;
    if (tools.holder >= 0)
      log::info(process.holder_control == Process::HolderControl::gap ? "Blank holder at " + units::format(process.holder_gap, "mm") + " from the die."
                                                                       : "Blank holder closed with " + units::format(process.holder_force(0), "kN") + ".");
  }

  IncrementSolver::Outcome
  Simulation::Implementation::solve(const IncrementSolver::Load &load, const double increment)
  {
    const auto outcome = solver->solve(load, [&](const bool in_equilibrium) {
      const timing::Scope scope("forming/friction coupling");
      return friction->iterate(shell, contact, {load.dt, increment, false}, in_equilibrium);
    });
    if (!outcome.converged)
      friction->revert(contact);
    return outcome;
  }

  bool
  Simulation::Implementation::slow_down()
  {
    const double dt    = schedule.drawing(record.path, record.path + settings.first_increment).dt;
    settings.viscosity = is_slowed() ? 5 * settings.viscosity : viscosity_given + snap_stiffness * dt;
    next_increment     = settings.first_increment;
    return settings.viscosity <= viscosity_given + stiffest_snap * dt;
  }

  void
  Simulation::Implementation::draw()
  {
    const double target = schedule.length();
    Progress     progress("Drawing", target, record.path);
    while (!is_drawn() && !ends_with_neck())
      {
        const double remaining = target - record.path;
        double       step      = std::min(next_increment, remaining);
        if (remaining < 1.5 * step) // no tiny last increment: rates of a tiny one mean nothing
          step = remaining <= settings.largest_increment ? std::min(remaining, 1.5 * step) : 0.5 * remaining;
        const auto load    = schedule.drawing(record.path, record.path + step);
        const auto outcome = solve(load, step);
        if (!outcome.converged)
          {
            log::step("   " + units::format(record.path, "mm") + ": " + outcome.reason + " with an increment of " + units::format(step, "mm") + ", halved.");
            next_increment = 0.5 * step;
            if (next_increment >= settings.smallest_increment)
              continue;
            if (monitor && monitor->limit_exceeded())
              {
                monitor->without_equilibrium(outcome.reason);
                break;
              }
            if (!slow_down())
              fail(*solver, outcome, Stage::drawing);
            log::info("   " + units::format(record.path, "mm") + ": the sheet snaps; it is slowed down by a viscosity.");
            continue;
          }
        if (outcome.first_iterations <= few_iterations)
          next_increment = std::min(settings.largest_increment, growth * std::max(step, next_increment));
        else if (outcome.first_iterations > many_iterations)
          next_increment = std::max(settings.smallest_increment, shrinkage * step);
        advance(load, outcome, Stage::drawing, step);
        if (tools.holder >= 0 && schedule.is_free(tools.holder) && tools.die >= 0 && holder_height() < process.holder_stop * blank.thickness)
          {
            log::info("The blank holder rests on its spacers.");
            stop_holder();
          }
        report_step(progress);
        progress.update(record.path);
        if (is_slowed() && viscosity_given == 0 && record.stabilisation_work > slowing_work * record.external_work)
          {
            auto too_slow   = outcome;
            too_slow.reason = "the viscosity that slows a snap down has taken more than 1 % of the work";
            fail(*solver, too_slow, Stage::drawing);
          }
        if (!is_slowed())
          write_checkpoint();
        else if (next_increment >= std::min(regrowth * settings.first_increment, settings.largest_increment))
          settings.viscosity = viscosity_given;
      }
    progress.finish();
    friction->report_end();
    if (monitor && monitor->necked())
      log::warning("The sheet necks. " + monitor->reason());
  }

  double
  Simulation::Implementation::holder_height() const
  {
    // both touched the flat sheet at the start
    return blank.thickness + contact.tools()[tools.holder].place[2] - holder_start;
  }

  void
  Simulation::Implementation::stop_holder()
  {
    schedule.stop(tools.holder, contact.tools());
    solver = std::make_unique<IncrementSolver>(shell, contact, schedule.fixed(), schedule.n_free_tools(), settings);
  }

  void
  Simulation::Implementation::unload()
  {
    for (const auto &o : observers)
      o->unloading(owner);
    log::info("The tools are taken away.");
    tools_away = true;
    const Loads           tool_forces = contact.frozen_forces();
    SolverSettings        controls    = settings;
    IncrementSolver       springback(shell, contact, schedule.held_without_tools(shell), schedule.n_free_tools(), controls);
    IncrementSolver::Load load = schedule.drawing(record.path, record.path);
    load.contact               = false;
    load.external.push_back({&tool_forces, 1., 1.});
    const auto external = load.external;
    // The forces that were there remain the measure of what is unbalanced, a finer one: a free part is soft.
    controls.residual_tolerance *= fine;
    load.external.push_back({&tool_forces, 1., 1.});
    load.external.push_back({&tool_forces, -1., -1.});
    double     done = 0, step = first_release, relaxation = 0;
    while (done < complete || controls.viscosity > settings.viscosity)
      {
        step    = std::min(step, 1 - done);
        load.dt = settings.closing_time * std::max(step, relaxation);
        for (std::size_t i = 0; i < external.size(); ++i)
          {
            load.external[i].before = (1 - done) * external[i].after;
            load.external[i].after  = done + step < complete ? (1 - done - step) * external[i].after : 0.;
          }
        const auto outcome = springback.solve(load);
        if (!outcome.converged)
          {
            if (relaxation > smallest_release)
              {
                relaxation *= 0.2; // less than the growth of a good step
                continue;
              }
            step *= 0.5;
            if (step >= smallest_release)
              continue;
            if (controls.viscosity > settings.viscosity)
              fail(springback, outcome, Stage::unloading);
            // A flange that only the holder kept flat buckles: it needs something that slows it down.
            log::info("Unloading: " + outcome.reason + "; it is slowed down by a viscosity.");
            controls.viscosity = slowing_stiffness * settings.closing_time * first_release;
            step               = first_release;
            continue;
          }
        done += step;
        record.unloaded = done < complete ? done : 1.;
        if (outcome.iterations <= few_iterations)
          step *= 1.5;
        if (done >= complete && controls.viscosity > settings.viscosity)
          {
            // without load: less and less viscous, in the end not at all
            relaxation = std::max((outcome.iterations <= few_iterations ? 4 : 1.5) * relaxation, first_release);
            if (relaxation > longest_relaxation)
              controls.viscosity = settings.viscosity;
            step = 1;
          }
        advance(load, outcome, Stage::unloading, 0.);
      }
    log::info("Springback: elastic energy " + units::number(1e-3 * record.elastic_energy) + " J is left in the part.");
  }

  Simulation::Simulation(const Blank &blank, std::shared_ptr<const SheetMaterial> material, const ToolSet &tools, const Process &process, const SolverSettings &settings, std::unique_ptr<FrictionCoupling> friction)
    : data(std::make_unique<Implementation>(*this, blank, std::move(material), tools, process, settings, std::move(friction)))
  {}

  Simulation::~Simulation() = default;

  void
  Simulation::add_observer(std::shared_ptr<Observer> observer)
  {
    data->observers.push_back(std::move(observer));
  }

  void
  Simulation::watch_forming_limit(std::shared_ptr<const FormingLimitCurve> limit)
  {
    data->monitor = std::make_unique<NeckingMonitor>(data->shell, std::move(limit));
  }

  void
  Simulation::run()
  {
    if (data->n_committed == 0)
      data->remove_checkpoints();
    if (data->closed < 1)
      data->close();
    data->draw();
    if (data->process.unloading && !data->ends_with_neck() && data->is_drawn())
      data->unload();
    for (const auto &o : data->observers)
      o->finished(*this, true);
  }

  const Shell            &Simulation::shell() const { return data->shell; }
  const Contact          &Simulation::contact() const { return data->contact; }
  const FrictionCoupling &Simulation::friction() const { return *data->friction; }
  const Blank            &Simulation::blank() const { return data->blank; }
  const ToolSet          &Simulation::tools() const { return data->tools; }
  const Process          &Simulation::process() const { return data->process; }
  const IncrementRecord  &Simulation::record() const { return data->record; }
  bool                    Simulation::tools_away() const { return data->tools_away; }

  const NeckingMonitor *
  Simulation::necking() const
  {
    return data->monitor && data->monitor->necked() ? data->monitor.get() : nullptr;
  }
} // namespace tribodraw
