#include "simulation_implementation.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>

#include <sstream>

namespace tribodraw
{
  namespace
  {
    const char *const checkpoint_names[2] = {"checkpoint_1.bin", "checkpoint_2.bin"};

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

    /// What cannot be found again from the states of the parts.
    std::array<double *, 7> figures(IncrementRecord &r)
    {
      return {{&r.time, &r.path, &r.punch_force, &r.die_force, &r.blank_holder_force, &r.external_work, &r.stabilisation_work}};
    }
  } // namespace

  void
  Simulation::Implementation::write_checkpoint()
  {
    if (checkpoint_distance <= 0 || record.path < last_checkpoint + checkpoint_distance)
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
    archive.put("simulation/record", values);
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
    const auto  saved   = figures(record);
    const auto &values  = archive.numbers("simulation/record", saved.size());
    for (std::size_t i = 0; i < saved.size(); ++i)
      *saved[i] = values[i];
    record.punch_travel = tools.punch >= 0 ? record.path : 0.;
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
