#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/output/forming_output.h>
#include <tribodraw/output/paraview.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// Rows of a numeric table as one array, for the checkpoint.
    std::vector<double>
    flatten(const CsvTable &table)
    {
      std::vector<double> values;
      for (const auto &row : table.rows())
        for (const auto &cell : row)
          values.push_back(std::holds_alternative<long>(cell) ? static_cast<double>(std::get<long>(cell))
                                                              : std::get<double>(cell));
      return values;
    }

    void
    restore(CsvTable &table, const std::vector<double> &values, const std::vector<bool> &is_integer)
    {
      table.truncate(0);
      const std::size_t n = is_integer.size();
      for (std::size_t r = 0; r + n <= values.size(); r += n)
        {
          std::vector<CsvTable::Cell> row;
          for (std::size_t c = 0; c < n; ++c)
            if (is_integer[c])
              row.emplace_back(static_cast<long>(values[r + c]));
            else
              row.emplace_back(values[r + c]);
          table.add_row(row);
        }
    }

    std::vector<bool>
    integer_is(const std::size_t n, const std::size_t column)
    {
      std::vector<bool> integer(n, false);
      integer[column] = true;
      return integer;
    }

    std::string
    step_name(const std::string &what, const unsigned step)
    {
      char number[20];
      std::snprintf(number, sizeof(number), "_%04u.vtu", step);
      return what + number;
    }

    /// How ParaView shows the sheet: what is new in it, and both faces.
    std::vector<ParaviewView>
    views(const SurfaceFields &fields)
    {
      using From             = ParaviewView::From;
      const bool  lubricated = fields.node_scalars.count("lubricant_pressure_die") > 0;
      const bool  limited    = fields.cell_scalars.count("flc_margin") > 0;
      const char *pressure   = lubricated ? "lubricant_pressure_" : "contact_pressure_";
      const char *name       = lubricated ? "Lubricant pressure" : "Contact pressure";
      return { { "Thinning, part of the first thickness", "thinning", From::inside_above },
               { "Friction coefficient, punch side", "friction_coefficient_punch", From::inside_above },
               { std::string(name) + ", punch side / MPa", std::string(pressure) + "punch", From::inside_above },
               limited ? ParaviewView{ "Major strain over its forming limit", "flc_margin", From::outside_below }
                       : ParaviewView{ "Equivalent plastic strain", "eps_p", From::outside_below },
               { "Friction coefficient, die side", "friction_coefficient_die", From::outside_below },
               { std::string(name) + ", die side / MPa", std::string(pressure) + "die", From::outside_below } };
    }

    const char *
    side(const unsigned face)
    {
      return face == static_cast<unsigned>(Face::die_side) ? "die" : "punch";
    }
  } // namespace

  HistoryWriter::HistoryWriter(std::filesystem::path output_folder)
      : folder(std::move(output_folder)),
        history({ "time_s", "punch_travel_mm", "punch_force_n", "die_force_n", "blank_holder_force_n", "draw_in_x_mm",
                  "draw_in_y_mm", "draw_in_diagonal_mm", "min_thickness_mm", "max_eps_p",
                  "max_lubricant_pressure_die_mpa", "max_lubricant_pressure_punch_mpa", "mean_mu_die", "mean_mu_punch",
                  "starved_area_fraction", "lubricant_volume_error", "newton_iterations" }),
        energy({ "time_s", "punch_travel_mm", "increment_mm", "external_work_j", "elastic_energy_j", "plastic_work_j",
                 "friction_work_j", "contact_energy_j", "energy_error", "force_imbalance", "residual",
                 "max_penetration_mm", "newton_iterations", "stabilisation_work_j", "flc_margin", "unloaded_share" }),
        tools({ "time_s", "punch_travel_mm", "tool", "force_x_n", "force_y_n", "force_z_n", "place_x_mm", "place_y_mm",
                "place_z_mm" })
  {
  }

  void
  HistoryWriter::committed(const Simulation &simulation, const IncrementRecord &r)
  {
    const unsigned punch = static_cast<unsigned>(Face::punch_side), die = static_cast<unsigned>(Face::die_side);
    const auto     its = static_cast<long>(r.newton_iterations);
    history.add_row({ r.time, r.punch_travel, r.punch_force, r.die_force, r.blank_holder_force, r.draw_in_x,
                      r.draw_in_y, r.draw_in_diagonal, r.min_thickness, r.max_eps_p,
                      r.friction.max_lubricant_pressure[die], r.friction.max_lubricant_pressure[punch],
                      r.friction.mean_mu[die], r.friction.mean_mu[punch], r.friction.starved_area_fraction,
                      r.friction.lubricant_volume_error, its });
    const double joule = 1e-3; // 1 N mm
    energy.add_row({ r.time, r.punch_travel, r.increment, joule * r.external_work, joule * r.elastic_energy,
                     joule * r.plastic_work, joule * r.friction_work, joule * r.contact_energy, r.energy_error(),
                     r.force_imbalance, r.residual, r.max_penetration, its, joule * r.stabilisation_work,
                     r.forming_limit.ratio, r.unloaded });
    const auto &rigid = simulation.contact().tools();
    for (std::size_t t = 0; t < rigid.size(); ++t)
      {
        const Vector3d force
            = simulation.tools_away() ? Vector3d(0, 0, 0) : Vector3d(simulation.contact().tool_forces()[t]);
        const Vector3d &place = rigid[t].place;
        tools.add_row({ r.time, r.punch_travel, static_cast<long>(t), force[0], force[1],
                        force[2] * simulation.shell().mesh().symmetry_factor, place[0], place[1], place[2] });
      }
    write(simulation);
  }

  void
  HistoryWriter::finished(const Simulation &simulation, bool)
  {
    write(simulation);
  }

  void
  HistoryWriter::write(const Simulation &simulation) const
  {
    if (parallel::rank() != 0)
      return;
    history.save(folder / "history.csv");
    energy.save(folder / "energy.csv");
    // The three roles stand in history.csv.
    const ToolSet &set     = simulation.tools();
    const int      n_roles = (set.die >= 0) + (set.punch >= 0) + (set.holder >= 0);
    if (static_cast<int>(set.tools.size()) == n_roles)
      return;
    CsvTable named(tools.columns());
    for (auto row : tools.rows())
      {
        row[2] = set.tools[std::get<long>(row[2])].name;
        named.add_row(row);
      }
    named.save(folder / "tools.csv");
  }

  void
  HistoryWriter::save(Archive &archive) const
  {
    archive.put("output/history", flatten(history));
    archive.put("output/energy", flatten(energy));
    archive.put("output/tools", flatten(tools));
  }

  void
  HistoryWriter::load(const Archive &archive)
  {
    restore(history, archive.numbers("output/history"), integer_is(history.columns().size(), 16));
    restore(energy, archive.numbers("output/energy"), integer_is(energy.columns().size(), 12));
    restore(tools, archive.numbers("output/tools"), integer_is(tools.columns().size(), 2));
    log::info("history.csv is cut back to its " + std::to_string(history.rows().size()) + " rows at the checkpoint.");
  }

  FieldWriter::FieldWriter(std::filesystem::path output_folder, const double distance,
                           std::shared_ptr<const FormingLimitCurve> forming_limit)
      : folder(std::move(output_folder)), travel_between(distance), limit(std::move(forming_limit))
  {
  }

  SurfaceFields
  FieldWriter::collect(const Simulation &simulation) const
  {
    const Shell  &shell = simulation.shell();
    SurfaceFields fields;
    fields.points                    = shell.committed().position;
    fields.triangles                 = shell.mesh().triangles;
    fields.node_scalars["thickness"] = shell.node_thickness();
    fields.units["thickness"]        = "mm";
    auto &thinning                   = fields.node_scalars["thinning"];
    for (const double thickness : shell.node_thickness())
      thinning.push_back(1 - thickness / simulation.blank().thickness);
    auto &displacement               = fields.node_vectors["displacement"];
    for (unsigned i = 0; i < shell.n_nodes(); ++i)
      displacement.push_back(fields.points[i] - shell.mesh().nodes[i]);
    fields.node_vectors["velocity"]
        = velocity.empty() ? std::vector<Vector3d>(shell.n_nodes(), Vector3d::Zero()) : velocity;
    fields.units["displacement"] = "mm";
    fields.units["velocity"]     = "mm/s";
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const auto &face     = simulation.contact().face(static_cast<Face>(f));
        auto       &pressure = fields.node_scalars[std::string("contact_pressure_") + side(f)];
        auto       &mu       = fields.node_scalars[std::string("friction_coefficient_") + side(f)];
        for (unsigned i = 0; i < shell.n_nodes(); ++i)
          {
            const bool touches = face.tool[i] >= 0 && !simulation.tools_away();
            pressure.push_back(touches ? face.pressure[i] : 0.);
            mu.push_back(touches ? simulation.contact().friction(static_cast<Face>(f))[i]
                                           : std::numeric_limits<double>::quiet_NaN());
          }
        fields.units[std::string("contact_pressure_") + side(f)] = "MPa";
      }
    if (!in_the_tools.empty())
      {
        auto &springback = fields.node_vectors["springback"];
        for (unsigned i = 0; i < shell.n_nodes(); ++i)
          springback.push_back(fields.points[i] - in_the_tools[i]);
        fields.units["springback"] = "mm";
      }
    for (auto &[name, values] : simulation.friction().fields())
      {
        fields.node_scalars[name] = values;
        if (name.find("pressure") != std::string::npos)
          fields.units[name] = "MPa";
        else if (name.find("film_thickness") != std::string::npos)
          fields.units[name] = "um";
      }
    const auto elements                 = shell.element_results();
    fields.cell_scalars["major_strain"] = elements.major_strain;
    fields.cell_scalars["minor_strain"] = elements.minor_strain;
    fields.cell_scalars["eps_p"]        = elements.eps_p;
    if (limit)
      {
        auto &margin = fields.cell_scalars["flc_margin"];
        for (std::size_t e = 0; e < elements.major_strain.size(); ++e)
          margin.push_back(forming_limit_margin(*limit, elements.major_strain[e], elements.minor_strain[e]));
      }
    return fields;
  }

  void
  FieldWriter::write_step(const Simulation &simulation, const IncrementRecord &r)
  {
    SurfaceFields fields = collect(simulation);
    fields.time          = r.time;
    fields.cycle         = step;
    if (parallel::rank() == 0)
      {
        if (step == 0)
          {
            remove_steps_from(0); // of an earlier run in the same folder
            write_paraview_state(folder, views(fields));
          }
        SurfaceFields rigid = tools.at_present(simulation);
        rigid.time          = fields.time;
        rigid.cycle         = fields.cycle;
        write_vtu(folder / step_name("solution", step), fields);
        write_vtu(folder / step_name("tools", step), rigid);
      }
    ++step;
    times.push_back(r.time);
    write_collections();
    last_written = r.time;
  }

  void
  FieldWriter::write_collections() const
  {
    if (parallel::rank() != 0)
      return;
    for (const std::string what : { "solution", "tools" })
      {
        PvdCollection collection;
        for (unsigned k = 0; k < step; ++k)
          collection.add(times[k], step_name(what, k));
        collection.save(folder / (what + ".pvd"));
      }
  }

  void
  FieldWriter::remove_steps_from(const unsigned first) const
  {
    std::error_code ignored;
    for (const std::string what : { "solution", "tools" })
      for (unsigned k = first; std::filesystem::remove(folder / step_name(what, k), ignored); ++k)
        {
        }
  }

  void
  FieldWriter::committed(const Simulation &simulation, const IncrementRecord &r)
  {
    const auto &position = simulation.shell().committed().position;
    const auto &before   = previous_position.empty() ? simulation.shell().mesh().nodes : previous_position;
    velocity.resize(position.size());
    for (std::size_t i = 0; i < position.size(); ++i)
      velocity[i] = (position[i] - before[i]) / (r.time - previous_time);
    previous_position = position;
    previous_time     = r.time;
    if (r.path > 0 && r.path >= next_travel && !simulation.tools_away())
      {
        next_travel = r.path + travel_between;
        write_step(simulation, r);
      }
  }

  void
  FieldWriter::unloading(const Simulation &simulation)
  {
    if (simulation.record().time != last_written)
      write_step(simulation, simulation.record());
    in_the_tools = simulation.shell().committed().position;
  }

  void
  FieldWriter::failed(const Simulation &simulation, const std::vector<Vector3d> &unbalanced)
  {
    SurfaceFields fields                    = collect(simulation);
    fields.time                             = simulation.record().time;
    fields.cycle                            = step;
    fields.node_vectors["unbalanced_force"] = unbalanced;
    fields.units["unbalanced_force"]        = "N";
    if (parallel::rank() == 0)
      write_vtu(folder / "not_converged.vtu", fields);
  }

  void
  FieldWriter::finished(const Simulation &simulation, bool)
  {
    const IncrementRecord &r = simulation.record();
    if (r.time != last_written)
      write_step(simulation, r);
    write_final(simulation);
  }

  void
  FieldWriter::write_final(const Simulation &simulation) const
  {
    // Both need all ranks; the files are written by the first.
    const SurfaceFields fields  = collect(simulation);
    const auto          results = simulation.shell().element_results();
    if (parallel::rank() != 0)
      return;
    const auto                              &start    = simulation.shell().mesh().nodes;
    std::vector<std::string>                 columns  = { "node", "x_mm", "y_mm", "z_mm", "x0_mm", "y0_mm" };
    const std::map<std::string, std::string> suffixes = { { "mm", "_mm" }, { "um", "_um" }, { "MPa", "_mpa" } };
    for (const auto &[name, values] : fields.node_scalars)
      {
        const auto unit = fields.units.find(name);
        columns.push_back(unit == fields.units.end() ? name : name + suffixes.at(unit->second));
      }
    CsvTable nodes(columns);
    for (std::size_t i = 0; i < fields.points.size(); ++i)
      {
        const Vector3d             &x   = fields.points[i];
        std::vector<CsvTable::Cell> row = { static_cast<long>(i), x[0], x[1], x[2], start[i][0], start[i][1] };
        for (const auto &[name, values] : fields.node_scalars)
          row.emplace_back(values[i]);
        nodes.add_row(row);
      }
    nodes.save(folder / "nodes_final.csv");

    columns = { "element", "n1", "n2", "n3", "major_strain", "minor_strain", "thickness_mm", "eps_p" };
    if (limit)
      columns.push_back("flc_margin");
    CsvTable elements(columns);
    for (std::size_t e = 0; e < fields.triangles.size(); ++e)
      {
        const auto                 &t = fields.triangles[e];
        std::vector<CsvTable::Cell> row
            = { static_cast<long>(e),    static_cast<long>(t[0]), static_cast<long>(t[1]), static_cast<long>(t[2]),
                results.major_strain[e], results.minor_strain[e], results.thickness[e],    results.eps_p[e] };
        if (limit)
          row.emplace_back(fields.cell_scalars.at("flc_margin")[e]);
        elements.add_row(row);
      }
    elements.save(folder / "elements_final.csv");
    if (!limit)
      return;
    CsvTable curve({ "minor_strain", "major_strain" });
    for (int i = -50; i <= 50; ++i)
      curve.add_row({ 0.01 * i, limit->limit(0.01 * i) });
    curve.save(folder / "flc.csv");
  }

  void
  FieldWriter::save(Archive &archive) const
  {
    std::vector<double> values = { next_travel, static_cast<double>(step), previous_time, last_written };
    for (const auto &x : previous_position)
      values.insert(values.end(), { x[0], x[1], x[2] });
    for (const auto &v : velocity)
      values.insert(values.end(), { v[0], v[1], v[2] });
    archive.put("output/fields", values);
    archive.put("output/times", times);
  }

  void
  FieldWriter::load(const Archive &archive)
  {
    const auto &values = archive.numbers("output/fields");
    next_travel        = values.at(0);
    step               = static_cast<unsigned>(values.at(1));
    previous_time      = values.at(2);
    last_written       = values.at(3);
    previous_position.clear();
    velocity.clear();
    const std::size_t n_nodes = (values.size() - 4) / 6;
    for (std::size_t i = 0; i < 2 * n_nodes; ++i)
      (i < n_nodes ? previous_position : velocity)
          .emplace_back(values[4 + 3 * i], values[5 + 3 * i], values[6 + 3 * i]);
    // Steps after the checkpoint are written again, or belong to a run that ended elsewhere.
    times = archive.numbers("output/times", step);
    if (parallel::rank() == 0)
      remove_steps_from(step);
    write_collections();
  }
} // namespace tribodraw
