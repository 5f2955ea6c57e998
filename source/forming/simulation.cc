#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/simulation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// An increment that took this many Newton iterations or fewer is followed by a larger one, one that took more
    /// than the second number by a smaller one (measured: an increment costs about the same whatever its size).
    constexpr unsigned few_iterations = 14, many_iterations = 22;
    constexpr double   growth = 1.4, shrinkage = 0.6;

    /// Throws InputError naming the first line in which the two texts differ.
    void check_identity(const std::string &checkpoint, const std::string &now)
    {
      std::istringstream old_lines(checkpoint), new_lines(now);
      for (;;)
        {
          std::string old_line, new_line;
          const bool  has_old = static_cast<bool>(std::getline(old_lines, old_line)), has_new = static_cast<bool>(std::getline(new_lines, new_line));
          if (!has_old && !has_new)
            return;
          if (old_line != new_line)
            throw InputError(describe_error("these parameters must be the same when a run is resumed.", "--resume", "'" + new_line + "'",
                                            "'" + old_line + "' (of the checkpoint)",
                                            "Only 'Process/Punch travel' and entries of 'Solver' and 'Output' may change."));
        }
    }

    const char *const checkpoint_names[2] = {"checkpoint_1.bin", "checkpoint_2.bin"};
  } // namespace

  double
  IncrementRecord::energy_error() const
  {
    const double difference = external_work - elastic_energy - plastic_work - friction_work - contact_energy;
    return external_work > 0 ? difference / external_work : 0.;
  }

  struct Simulation::Implementation
  {
    Blank                                  blank;
    Process                                process;
    SolverSettings                         settings;
    std::shared_ptr<const SheetMaterial>   material;
    Shell                                  shell;
    Contact                                contact;
    std::unique_ptr<FrictionCoupling>      friction;
    std::unique_ptr<IncrementSolver>       solver;
    std::vector<std::shared_ptr<Observer>> observers;
    IncrementRecord                        record;

    // what a checkpoint holds besides the states of the parts
    unsigned            closed = 0;   // closing increments done
    double              next_increment = 0;
    std::vector<Vector3d> last_force; // on each tool, for the trapezoidal rule of the work
    long                n_committed = 0;

    std::filesystem::path checkpoint_folder;
    std::string           identity; // parameters that must not change
    double                checkpoint_distance = 0, last_checkpoint = 0;
    unsigned              checkpoint_slot = 0;

    std::array<unsigned, 3> edge_node; // on the x axis, the y axis, the diagonal corner

    Implementation(const Blank &b, std::shared_ptr<const SheetMaterial> m, const ToolSet &tools, const Process &p, const SolverSettings &s, std::unique_ptr<FrictionCoupling> f)
      : blank(b)
      , process(p)
      , settings(s)
      , material(m)
      , shell(b.quarter_mesh(), b.thickness, m, b.n_thickness_points, b.lobatto ? Shell::ThicknessPoints::lobatto : Shell::ThicknessPoints::gauss)
      , contact(shell, tools.place(b.thickness), settings.contact)
      , friction(std::move(f))
      , next_increment(s.first_increment)
      , last_force(3, Vector3d::Zero())
    {
      solver = std::make_unique<IncrementSolver>(shell, contact, symmetry_conditions(), 1, settings);
      find_edge_nodes();
      friction->start(shell, contact);
      record.min_thickness = b.thickness;
    }

    double symmetry() const { return shell.mesh().symmetry_factor; }

    std::vector<bool> symmetry_conditions()
    {
      const BlankMesh  &mesh = shell.mesh();
      std::vector<bool> fixed(shell.n_dofs(), false);
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        {
          if (mesh.on_x_plane[i])
            {
              shell.align_director_frame(i, Vector3d::UnitX());
              fixed[shell.dof(i, 0)] = fixed[shell.dof(i, 3)] = true;
            }
          else if (mesh.on_y_plane[i])
            {
              shell.align_director_frame(i, Vector3d::UnitY());
              fixed[shell.dof(i, 3)] = true;
            }
          if (mesh.on_y_plane[i])
            {
              fixed[shell.dof(i, 1)] = true;
              if (mesh.on_x_plane[i])
                fixed[shell.dof(i, 4)] = true;
            }
        }
      return fixed;
    }

    void find_edge_nodes()
    {
      const BlankMesh &mesh = shell.mesh();
      edge_node             = {0, 0, 0};
      double far_x = -1, far_y = -1, far_d = -1;
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        {
          const Vector3d &x = mesh.nodes[i];
          if (mesh.on_y_plane[i] && x[0] > far_x)
            far_x = x[0], edge_node[0] = i;
          if (mesh.on_x_plane[i] && x[1] > far_y)
            far_y = x[1], edge_node[1] = i;
          if (mesh.on_outer_edge[i] && std::min(x[0], x[1]) > far_d)
            far_d = std::min(x[0], x[1]), edge_node[2] = i;
        }
    }

    double draw_in(const unsigned which) const
    {
      const Vector3d &before = shell.mesh().nodes[edge_node[which]], &now = shell.committed().position[edge_node[which]];
      return before.head<2>().norm() - now.head<2>().norm();
    }

    void advance(const IncrementSolver::Load &load, const IncrementSolver::Outcome &outcome, bool closing);
    void fill_record(const IncrementSolver::Load &load, const IncrementSolver::Outcome &outcome);
    void close();
    void draw();
    void report_step() const;
    [[noreturn]] void fail(const IncrementSolver::Outcome &outcome);
    void write_checkpoint();
    const Simulation *owner = nullptr;
  };

  void
  Simulation::Implementation::fill_record(const IncrementSolver::Load &load, const IncrementSolver::Outcome &outcome)
  {
    const auto &forces = contact.tool_forces();
    record.newton_iterations  = outcome.iterations;
    record.residual           = outcome.residual;
    record.punch_force        = symmetry() * forces[ToolSet::punch_index][2];
    record.blank_holder_force = symmetry() * forces[ToolSet::holder_index][2];
    record.die_force          = -symmetry() * forces[ToolSet::die_index][2];
    const double magnitudes   = std::abs(record.punch_force) + std::abs(record.blank_holder_force) + std::abs(record.die_force);
    record.force_imbalance    = std::abs(record.punch_force + record.blank_holder_force - record.die_force) / std::max(magnitudes, 1e-9);
    for (unsigned t = 0; t < contact.tools().size(); ++t)
      {
        record.external_work -= symmetry() * 0.5 * (last_force[t] + forces[t]).dot(contact.tools()[t].motion());
        last_force[t] = forces[t];
      }
    record.time += load.dt;
    record.increment = -load.motion[ToolSet::punch_index][2];
    record.punch_travel += record.increment;
  }

  void
  Simulation::Implementation::advance(const IncrementSolver::Load &load, const IncrementSolver::Outcome &outcome, const bool closing)
  {
    fill_record(load, outcome);
    shell.commit();
    contact.commit();
    {
      const timing::Scope         scope("forming/friction coupling");
      FrictionCoupling::Increment increment;
      increment.dt      = load.dt;
      increment.travel  = record.increment;
      increment.closing = closing;
      for (const Vector3d &m : load.motion)
        increment.tool_velocity.push_back(m / load.dt);
      friction->update(shell, contact, increment);
    }
    record.friction         = friction->summary();
    record.draw_in_x        = draw_in(0);
    record.draw_in_y        = draw_in(1);
    record.draw_in_diagonal = draw_in(2);
    const auto elements     = shell.element_results();
    record.min_thickness    = *std::min_element(elements.thickness.begin(), elements.thickness.end());
    record.max_eps_p        = *std::max_element(elements.max_eps_p.begin(), elements.max_eps_p.end());
    record.max_penetration  = contact.max_penetration();
    record.elastic_energy   = symmetry() * shell.elastic_energy();
    record.plastic_work     = symmetry() * shell.plastic_work();
    record.friction_work    = symmetry() * contact.friction_work();
    record.contact_energy   = symmetry() * contact.penalty_energy();
    ++n_committed;
    const timing::Scope scope("output/observers");
    for (const auto &o : observers)
      o->committed(*owner, record);
  }

  void
  Simulation::Implementation::report_step() const
  {
    char text[400];
    std::snprintf(text, sizeof(text),
                  "%6.2f mm  %5.1f %%  step %.3f  its %2u  residual %.0e  punch %.2f kN  t_min %.3f mm  mu die %.4f punch %.4f  energy %+.2f %%",
                  record.punch_travel, 100 * record.punch_travel / process.punch_travel, record.increment, record.newton_iterations,
                  record.residual, 1e-3 * record.punch_force, record.min_thickness, record.friction.mean_mu[1], record.friction.mean_mu[0],
                  100 * record.energy_error());
    const std::string extra = friction->report();
    log::info(std::string(text) + (extra.empty() ? "" : "  " + extra));
  }

  void
  Simulation::Implementation::fail(const IncrementSolver::Outcome &outcome)
  {
    std::vector<std::pair<double, unsigned>> worst;
    const Eigen::VectorXd                   &R = solver->residual();
    for (unsigned i = 0; i < shell.n_nodes(); ++i)
      worst.emplace_back(Vector3d(R[shell.dof(i, 0)], R[shell.dof(i, 1)], R[shell.dof(i, 2)]).norm(), i);
    std::sort(worst.rbegin(), worst.rend());
    std::string text = "The increment at punch travel " + units::format(record.punch_travel, "mm") + " does not converge at the smallest size of " +
                       units::format(settings.smallest_increment, "mm") + ": " + outcome.reason +
                       ". The last converged state has been written.\nLargest unbalanced forces:";
    for (unsigned k = 0; k < 5 && k < worst.size(); ++k)
      {
        const unsigned  i    = worst[k].second;
        const Vector3d &x    = shell.committed().position[i];
        std::string     tool = "no tool";
        for (const Face f : {Face::punch_side, Face::die_side})
          if (contact.face(f).tool[i] >= 0)
            tool = contact.tools()[contact.face(f).tool[i]].name;
        char line[200];
        std::snprintf(line, sizeof(line), "\n  node %u at (%.2f, %.2f, %.2f) mm, %.3g N, touching %s", i, x[0], x[1], x[2], worst[k].first, tool.c_str());
        text += line;
      }
    text += "\nTry a smaller 'Solver/Contact stiffness', a finer 'Blank/Element size', or look for necking: smallest thickness " +
            units::format(record.min_thickness, "mm") + " of " + units::format(blank.thickness, "mm") + ".";
    for (const auto &o : observers)
      o->finished(*owner, false);
    throw ConvergenceError(text);
  }

  void
  Simulation::Implementation::close()
  {
    const double force = process.blank_holder_force / symmetry();
    double       done  = static_cast<double>(closed) / settings.closing_increments;
    double       step  = 1. / settings.closing_increments;
    while (done < 1 - 1e-9)
      {
        step = std::min(step, 1 - done);
        IncrementSolver::Load load;
        load.motion.assign(3, Vector3d::Zero());
        load.free_force = {force * (done + step)};
        load.dt         = settings.closing_time * step;
        const auto outcome = solver->solve(load);
        if (!outcome.converged)
          {
            step *= 0.5;
            if (step < 1e-4)
              fail(outcome);
            log::info("Closing: " + outcome.reason + ", the step is halved.");
            continue;
          }
        done += step;
        closed = done > 1 - 1e-9 ? settings.closing_increments : static_cast<unsigned>(done * settings.closing_increments);
        advance(load, outcome, true);
      }
    contact.start_energy_balance();
    record.external_work = record.friction_work = record.contact_energy = 0;
    log::info("Blank holder closed with " + units::format(process.blank_holder_force, "kN") + ".");
  }

  void
  Simulation::Implementation::draw()
  {
    Progress progress("Drawing", process.punch_travel);
    const double target = process.punch_travel;
    while (record.punch_travel < target * (1 - 1e-12))
      {
        const double          remaining = target - record.punch_travel;
        double                step      = std::min(next_increment, remaining);
        if (remaining < 1.5 * step) // no tiny last increment: rates of a tiny one mean nothing
          step = remaining <= settings.largest_increment ? std::min(remaining, 1.5 * step) : 0.5 * remaining;
        IncrementSolver::Load load;
        load.motion.assign(3, Vector3d::Zero());
        load.motion[ToolSet::punch_index] = {0, 0, -step};
        load.free_force                   = {process.blank_holder_force / symmetry()};
        load.dt                           = step / process.punch_speed;
        const auto outcome                = solver->solve(load);
        if (!outcome.converged)
          {
            log::info("   " + units::format(record.punch_travel, "mm") + ": " + outcome.reason + " with an increment of " + units::format(step, "mm") + ", halved.");
            next_increment = 0.5 * step;
            if (next_increment < settings.smallest_increment)
              fail(outcome);
            continue;
          }
        if (outcome.iterations <= few_iterations)
          next_increment = std::min(settings.largest_increment, growth * std::max(step, next_increment));
        else if (outcome.iterations > many_iterations)
          next_increment = std::max(settings.smallest_increment, shrinkage * step);
        advance(load, outcome, false);
        report_step();
        progress.update(record.punch_travel);
        write_checkpoint();
      }
    progress.finish();
    friction->report_end();
  }

  void
  Simulation::Implementation::write_checkpoint()
  {
    if (checkpoint_distance <= 0 || record.punch_travel < last_checkpoint + checkpoint_distance)
      return;
    const timing::Scope scope("forming/checkpoint");
    last_checkpoint = record.punch_travel;
    Archive archive;
    shell.save(archive);
    contact.save(archive);
    friction->save(archive);
    for (const auto &o : observers)
      o->save(archive);
    const IncrementRecord &r = record;
    archive.put("simulation/state", std::vector<double>{static_cast<double>(n_committed), static_cast<double>(closed), next_increment, last_checkpoint});
    std::vector<double> forces;
    for (const Vector3d &f : last_force)
      forces.insert(forces.end(), f.data(), f.data() + 3);
    archive.put("simulation/last force", forces);
    archive.put("simulation/record", std::vector<double>{r.time, r.punch_travel, r.punch_force, r.die_force, r.blank_holder_force, r.external_work});
    archive.put("simulation/parameters", identity);
    if (parallel::rank() == 0)
      archive.save(checkpoint_folder / checkpoint_names[checkpoint_slot]);
    checkpoint_slot = 1 - checkpoint_slot;
  }

  Simulation::Simulation(const Blank &blank, std::shared_ptr<const SheetMaterial> material, const ToolSet &tools, const Process &process, const SolverSettings &settings, std::unique_ptr<FrictionCoupling> friction)
    : data(std::make_unique<Implementation>(blank, std::move(material), tools, process, settings, std::move(friction)))
  {
    data->owner = this;
  }

  Simulation::~Simulation() = default;

  void
  Simulation::add_observer(std::shared_ptr<Observer> observer)
  {
    data->observers.push_back(std::move(observer));
  }

  void
  Simulation::checkpoint_to(const std::filesystem::path &folder, const double travel_between, const std::string &identity)
  {
    data->identity            = identity;
    data->checkpoint_folder   = folder;
    data->checkpoint_distance = travel_between;
  }

  bool
  Simulation::resume(const std::filesystem::path &folder)
  {
    Archive  newest;
    double   newest_count = -1;
    unsigned slot         = 0;
    for (unsigned k = 0; k < 2; ++k)
      {
        const auto file = folder / checkpoint_names[k];
        if (!std::filesystem::exists(file))
          continue;
        try
          {
            Archive      archive = Archive::load(file);
            const double count   = archive.numbers("simulation/state", 4)[0];
            if (count > newest_count)
              {
                newest       = std::move(archive);
                newest_count = count;
                slot         = k;
              }
          }
        catch (const InputError &e)
          {
            log::warning(std::string(e.what()) + " The other checkpoint is used.");
          }
      }
    if (newest_count < 0)
      return false;
    auto &d = *data;
    check_identity(newest.text("simulation/parameters"), d.identity);
    d.shell.load(newest);
    d.contact.load(newest);
    d.friction->load(newest);
    for (const auto &o : d.observers)
      o->load(newest);
    const auto &state = newest.numbers("simulation/state", 4);
    d.n_committed     = static_cast<long>(state[0]);
    d.closed          = d.settings.closing_increments;
    d.next_increment  = state[2];
    d.last_checkpoint = state[3];
    const auto &forces = newest.numbers("simulation/last force", 3 * d.last_force.size());
    for (std::size_t t = 0; t < d.last_force.size(); ++t)
      d.last_force[t] = Vector3d(forces[3 * t], forces[3 * t + 1], forces[3 * t + 2]);
    const auto &r     = newest.numbers("simulation/record", 6);
    d.record.time = r[0], d.record.punch_travel = r[1], d.record.punch_force = r[2], d.record.die_force = r[3], d.record.blank_holder_force = r[4], d.record.external_work = r[5];
    d.checkpoint_slot = 1 - slot;
    log::info("Resumed from " + (folder / checkpoint_names[slot]).string() + " at punch travel " + units::format(d.record.punch_travel, "mm") + ".");
    return true;
  }

  void
  Simulation::run()
  {
    if (data->closed < data->settings.closing_increments)
      data->close();
    data->draw();
    for (const auto &o : data->observers)
      o->finished(*this, true);
  }

  const Shell            &Simulation::shell() const { return data->shell; }
  const Contact          &Simulation::contact() const { return data->contact; }
  const FrictionCoupling &Simulation::friction() const { return *data->friction; }
  const Process          &Simulation::process() const { return data->process; }
  const IncrementRecord  &Simulation::record() const { return data->record; }
} // namespace tribodraw
