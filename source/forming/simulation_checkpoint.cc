#include "simulation_implementation.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>

#include <map>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    const char *const checkpoint_names[2] = {"checkpoint_1.bin", "checkpoint_2.bin"};

    /// `path = value` lines as a map.
    std::map<std::string, std::string> entries(const std::string &lines)
    {
      std::map<std::string, std::string> result;
      std::istringstream                 in(lines);
      for (std::string line; std::getline(in, line);)
        {
          const auto equals                  = line.find(" = ");
          result[line.substr(0, equals)] = equals == std::string::npos ? "" : line.substr(equals + 3);
        }
      return result;
    }

    /// Throws InputError naming every entry in which the two texts differ.
    void check_identity(const std::string &checkpoint, const std::string &now)
    {
      auto                                     before = entries(checkpoint), after = entries(now);
      std::map<std::string, std::string>       all    = before;
      std::string                              differences;
      const auto                               shown = [](const std::map<std::string, std::string> &values, const std::string &path) {
        const auto found = values.find(path);
        return found == values.end() ? std::string("absent") : "'" + found->second + "'";
      };
      all.insert(after.begin(), after.end());
      for (const auto &[path, value] : all)
        if (shown(before, path) != shown(after, path))
          differences += "\n  " + path + ": " + shown(after, path) + " now, " + shown(before, path) + " in the checkpoint";
      if (!differences.empty())
        throw InputError("--resume: a run goes on with the parameters with which it began. These differ:" + differences +
                         "\nWhat may change: 'Process/Punch travel' and the entries of 'Solver' and 'Output'. Start without --resume, or in another folder with --output.");
    }

    /// Of all quantities of the record, which an observer at the end of a resumed run may ask for.
    std::vector<double *> figures(IncrementRecord &r)
    {
      std::vector<double *> result{&r.time, &r.path, &r.punch_travel, &r.punch_force, &r.die_force, &r.blank_holder_force, &r.force_imbalance,
                                   &r.draw_in_x, &r.draw_in_y, &r.draw_in_diagonal, &r.min_thickness, &r.max_eps_p, &r.unloaded,
                                   &r.friction.starved_area_fraction, &r.friction.lubricant_volume_error, &r.increment, &r.residual, &r.max_penetration,
                                   &r.external_work, &r.elastic_energy, &r.plastic_work, &r.friction_work, &r.contact_energy, &r.stabilisation_work,
                                   &r.forming_limit.ratio};
      for (unsigned f = 0; f < n_faces; ++f)
        result.insert(result.end(), {&r.friction.max_lubricant_pressure[f], &r.friction.mean_mu[f]});
      for (unsigned c = 0; c < 3; ++c)
        result.insert(result.end(), {&r.forming_limit.place[c], &r.forming_limit.place_undeformed[c]});
      return result;
    }
  } // namespace

  void
  Simulation::Implementation::write_checkpoint()
  {
    if (checkpoint_distance <= 0 || record.path < last_checkpoint + checkpoint_distance)
      return;
    // A resumed run solves at least one increment, so that whatever follows the drawing finds the state of a solver.
    if (is_drawn() || ends_with_neck())
      return;
    const timing::Scope scope("forming/checkpoint");
    last_checkpoint = record.path;
    Archive archive;
    shell.save(archive);
    contact.save(archive);
    friction->save(archive);
    if (monitor)
      monitor->save(archive);
    for (const auto &o : observers)
      o->save(archive);
    archive.put("simulation/state", std::vector<double>{static_cast<double>(n_committed), next_increment, last_checkpoint, tools.holder >= 0 && schedule.is_free(tools.holder) ? 1. : 0.});
    std::vector<double> forces, values;
    for (const Eigen::Vector3d &f : last_force)
      forces.insert(forces.end(), f.data(), f.data() + 3);
    for (const double *value : figures(record))
      values.push_back(*value);
    archive.put("simulation/last force", forces);
    values.insert(values.end(), {static_cast<double>(record.newton_iterations), static_cast<double>(record.forming_limit.element)});
    archive.put("simulation/record", values);
    const Eigen::VectorXd &held = solver->reactions();
    archive.put("simulation/reactions", std::vector<double>(held.data(), held.data() + held.size()));
    archive.put("simulation/parameters", identity);
    if (parallel::rank() == 0)
      archive.save(checkpoint_folder / checkpoint_names[checkpoint_slot]);
    checkpoint_slot = 1 - checkpoint_slot;
  }

  void
  Simulation::Implementation::restore(const Archive &archive)
  {
    check_identity(archive.text("simulation/parameters"), identity);
    shell.load(archive);
    contact.load(archive);
    friction->load(archive);
    if (monitor)
      monitor->load(archive);
    for (const auto &o : observers)
      o->load(archive);
    const auto &state  = archive.numbers("simulation/state", 4);
    n_committed        = static_cast<long>(state[0]);
    closed             = 1;
    next_increment     = state[1];
    last_checkpoint    = state[2];
    if (tools.holder >= 0 && schedule.is_free(tools.holder) && state[3] == 0)
      stop_holder();
    const auto &forces = archive.numbers("simulation/last force", 3 * last_force.size());
    for (std::size_t t = 0; t < last_force.size(); ++t)
      last_force[t] = Eigen::Vector3d(forces[3 * t], forces[3 * t + 1], forces[3 * t + 2]);
    const auto  saved  = figures(record);
    const auto &values = archive.numbers("simulation/record", saved.size() + 2);
    for (std::size_t i = 0; i < saved.size(); ++i)
      *saved[i] = values[i];
    record.newton_iterations     = static_cast<unsigned>(values[saved.size()]);
    record.forming_limit.element = static_cast<unsigned>(values[saved.size() + 1]);
    const auto &reactions        = archive.numbers("simulation/reactions", solver->reactions().size());
    solver->set_reactions(Eigen::Map<const Eigen::VectorXd>(reactions.data(), static_cast<Eigen::Index>(reactions.size())));
    if (is_drawn())
      throw InputError(describe_error("the checkpoint is beyond the end of this run.", "--resume, Process/Punch travel", units::format(schedule.length(), "mm"),
                                      "more than " + units::format(record.path, "mm"), "Start without --resume for a shorter run."));
  }

  void
  Simulation::Implementation::remove_checkpoints() const
  {
    if (checkpoint_folder.empty() || parallel::rank() != 0)
      return;
    std::error_code ignored;
    for (const char *name : checkpoint_names)
      std::filesystem::remove(checkpoint_folder / name, ignored);
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
    data->restore(newest);
    data->checkpoint_slot = 1 - slot;
    log::info("Resumed from " + (folder / checkpoint_names[slot]).string() + " at punch travel " + units::format(data->record.path, "mm") + ".");
    return true;
  }
} // namespace tribodraw
