#include "simulation_implementation.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribodraw
{
  using Eigen::Vector3d;

  double
  IncrementRecord::energy_error() const
  {
    const double difference = external_work - elastic_energy - plastic_work - friction_work - contact_energy - stabilisation_work;
    return external_work > 0 ? difference / external_work : 0.;
  }

  void
  Simulation::Implementation::find_edge_nodes()
  {
    const BlankMesh &mesh  = shell.mesh();
    edge_node              = {0, 0, 0};
    // The end of the blank on each axis, as near to the axis as the mesh has a node, and its outermost corner.
    double best_x = -1e300, best_y = -1e300, far_d = -1e300;
    for (unsigned i = 0; i < shell.n_nodes(); ++i)
      {
        const Vector3d &x = mesh.nodes[i];
        if (!mesh.on_outer_edge[i])
          continue;
        if (x[0] - 10 * std::abs(x[1]) > best_x)
          best_x = x[0] - 10 * std::abs(x[1]), edge_node[0] = i;
        if (x[1] - 10 * std::abs(x[0]) > best_y)
          best_y = x[1] - 10 * std::abs(x[0]), edge_node[1] = i;
        if (std::min(x[0], x[1]) > far_d)
          far_d = std::min(x[0], x[1]), edge_node[2] = i;
      }
  }

  double
  Simulation::Implementation::draw_in(const unsigned which) const
  {
    const Vector3d &before = shell.mesh().nodes[edge_node[which]], &now = shell.committed().position[edge_node[which]];
    return before.head<2>().norm() - now.head<2>().norm();
  }

  double
  Simulation::Implementation::tool_force(const int role) const
  {
    return role < 0 || tools_away ? 0. : symmetry() * contact.tool_forces()[role][2];
  }

  double
  Simulation::Implementation::press_force() const
  {
    if (tools.punch >= 0)
      return record.punch_force;
    double largest = 0;
    for (std::size_t t = 0; t < tools.tools.size(); ++t)
      if (tools.tools[t].control == ProcessTool::Control::motion)
        largest = std::max(largest, symmetry() * contact.tool_forces()[t].norm());
    return largest;
  }

  void
  Simulation::Implementation::record_forces(const IncrementSolver::Load &load, const IncrementSolver::Outcome &outcome)
  {
    record.newton_iterations  = outcome.iterations;
    record.residual           = outcome.residual;
    record.punch_force        = tool_force(tools.punch);
    record.blank_holder_force = tool_force(tools.holder);
    record.die_force          = -tool_force(tools.die);
    record.external_work += symmetry() * (outcome.load_work + outcome.support_work);
    record.stabilisation_work += symmetry() * outcome.stabilisation_work;
    double sum = 0, magnitudes = 0;
    const auto add = [&](const double vertical) {
      sum += vertical;
      magnitudes += std::abs(vertical);
    };
    for (const auto &external : load.external)
      {
        const Eigen::VectorXd forces = external.after * external.loads->forces(shell);
        for (unsigned i = 0; i < shell.n_nodes(); ++i)
          add(forces[shell.dof(i, 2)]);
      }
    const auto &held = solver->reactions();
    for (unsigned i = 0; i < shell.n_nodes() && !tools_away; ++i)
      add(held[shell.dof(i, 2)]);
    for (std::size_t t = 0; t < contact.tools().size() && !tools_away; ++t)
      {
        // force of the sheet on the tool
        const Vector3d &force = contact.tool_forces()[t];
        add(-force[2]);
        record.external_work -= symmetry() * 0.5 * (last_force[t] + force).dot(contact.tools()[t].motion());
        last_force[t] = force;
      }
    record.force_imbalance = tools_away ? 0. : std::abs(sum) / std::max(magnitudes, 1e-9);
  }

  void
  Simulation::Implementation::update_friction(const IncrementSolver::Load &load, const bool closing)
  {
    const timing::Scope scope("forming/friction coupling");
    friction->update(shell, contact, {load.dt, record.increment, closing});
    record.friction = friction->summary();
  }

  void
  Simulation::Implementation::record_state()
  {
    record.draw_in_x        = draw_in(0);
    record.draw_in_y        = draw_in(1);
    record.draw_in_diagonal = draw_in(2);
    const auto elements     = shell.element_results();
    record.min_thickness    = *std::min_element(elements.thickness.begin(), elements.thickness.end());
    record.max_eps_p        = *std::max_element(elements.max_eps_p.begin(), elements.max_eps_p.end());
    record.max_penetration  = tools_away ? 0. : contact.max_penetration();
    record.elastic_energy   = symmetry() * shell.elastic_energy();
    record.plastic_work     = symmetry() * shell.plastic_work();
    record.friction_work    = symmetry() * contact.friction_work();
    record.contact_energy   = symmetry() * contact.penalty_energy();
    if (!monitor || tools_away)
      return;
    monitor->observe(elements, record.path, press_force());
    record.forming_limit = monitor->state();
  }

  void
  Simulation::Implementation::advance(const IncrementSolver::Load &load, const IncrementSolver::Outcome &outcome, const Stage stage, const double increment)
  {
    record_forces(load, outcome);
    record.time += load.dt;
    record.increment = increment;
    record.path += increment;
    record.punch_travel = tools.punch >= 0 ? record.path : 0.;
    shell.commit();
    if (stage != Stage::unloading)
      {
        contact.commit();
        update_friction(load, stage == Stage::closing);
      }
    record_state();
    ++n_committed;
    const timing::Scope scope("output/observers");
    for (const auto &o : observers)
      o->committed(owner, record);
  }

  void
  Simulation::Implementation::report_step(const Progress &progress) const
  {
    std::size_t touching[n_faces] = {};
    for (const Face f : {Face::punch_side, Face::die_side})
      for (const int tool : contact.face(f).tool)
        touching[static_cast<unsigned>(f)] += tool >= 0;
    const unsigned punch = static_cast<unsigned>(Face::punch_side), die = static_cast<unsigned>(Face::die_side);
    char           text[500];
    std::snprintf(text, sizeof(text),
                  "%6.2f mm  %5.1f %%  step %.3f  its %2u  residual %.0e  force %.2f kN  t_min %.3f mm  contact die %zu punch %zu nodes  mu die %.4f punch %.4f  energy %+.2f %%  %s",
                  record.path, 100 * record.path / schedule.length(), record.increment, record.newton_iterations,
                  record.residual, 1e-3 * press_force(), record.min_thickness, touching[die], touching[punch], record.friction.mean_mu[die],
                  record.friction.mean_mu[punch], 100 * record.energy_error(), progress.times(record.path).c_str());
    const std::string extra = friction->report();
    log::step(std::string(text) + (extra.empty() ? "" : "  " + extra));
  }
} // namespace tribodraw
