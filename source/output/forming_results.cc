#include <tribodraw/base/parallel.h>
#include <tribodraw/output/forming_output.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// Place of an extreme value: the first that differs from it by round-off only. Where many are equal (sheet that is
    /// hardly stretched yet), the very extreme lies elsewhere with another number of ranks.
    std::size_t
    first_like(const std::vector<double> &values, const double extreme)
    {
      constexpr double round_off = 1e-9; // parts; sums over ranks differ by 1e-12
      const auto       like      = [&](const double value) { return std::abs(value - extreme) <= round_off * std::abs(extreme); };
      return static_cast<std::size_t>(std::find_if(values.begin(), values.end(), like) - values.begin());
    }
  } // namespace

  ResultsWriter::ResultsWriter(std::filesystem::path output_folder) : folder(std::move(output_folder)) {}

  void
  ResultsWriter::committed(const Simulation &, const IncrementRecord &r)
  {
    if (r.punch_force > max_force)
      {
        max_force           = r.punch_force;
        travel_at_max_force = r.punch_travel;
      }
    max_penetration = std::max(max_penetration, r.max_penetration);
    newton_iterations += r.newton_iterations;
  }

  void
  ResultsWriter::unloading(const Simulation &simulation)
  {
    in_the_tools                = simulation.shell().committed().position;
    elastic_energy_in_the_tools = simulation.record().elastic_energy;
  }

  void
  ResultsWriter::finished(const Simulation &simulation, const bool converged)
  {
    if (parallel::rank() != 0)
      return;
    write_results(simulation, converged);
    write_edge_profile(simulation);
  }

  void
  ResultsWriter::write_results(const Simulation &simulation, const bool converged) const
  {
    const IncrementRecord &r = simulation.record();
    CsvTable               table({ "quantity", "value", "unit" });
    const auto add = [&](const char *quantity, const double value, const char *unit) { table.add_row({ std::string(quantity), value, std::string(unit) }); };
    add("converged", converged, "");
    if (simulation.process().punch_travel > 0)
      {
        add("punch_travel", r.punch_travel, "mm");
        add("largest_punch_force", max_force, "N");
        add("punch_travel_at_the_largest_punch_force", travel_at_max_force, "mm");
        add("punch_force_at_the_end", r.punch_force, "N");
      }
    else
      add("time", r.time, "s");
    add("draw_in_x", r.draw_in_x, "mm");
    add("draw_in_y", r.draw_in_y, "mm");
    add("draw_in_diagonal", r.draw_in_diagonal, "mm");
    const auto &thickness = simulation.shell().node_thickness();
    const auto [least, greatest] = std::minmax_element(thickness.begin(), thickness.end());
    const std::size_t thinnest = first_like(thickness, *least), thickest = first_like(thickness, *greatest);
    const auto &start = simulation.shell().mesh().nodes;
    add("least_thickness_of_an_element", r.min_thickness, "mm");
    add("least_thickness_of_a_node", *least, "mm");
    add("least_thickness_at_undeformed_x", start[thinnest][0], "mm");
    add("least_thickness_at_undeformed_y", start[thinnest][1], "mm");
    add("greatest_thickness_of_a_node", *greatest, "mm");
    add("greatest_thickness_at_undeformed_x", start[thickest][0], "mm");
    add("greatest_thickness_at_undeformed_y", start[thickest][1], "mm");
    add("largest_plastic_strain", r.max_eps_p, "");
    if (r.forming_limit.ratio > 0)
      {
        add("largest_major_strain_over_its_forming_limit", r.forming_limit.ratio, "");
        add("nearest_to_the_forming_limit_at_undeformed_x", r.forming_limit.place_undeformed[0], "mm");
        add("nearest_to_the_forming_limit_at_undeformed_y", r.forming_limit.place_undeformed[1], "mm");
      }
    add("necked", simulation.necking() != nullptr, "");
    if (const NeckingMonitor *neck = simulation.necking())
      {
        add("necked_at_travel", neck->travel(), "mm");
        add("necked_at_x", neck->place()[0], "mm");
        add("necked_at_y", neck->place()[1], "mm");
        add("necked_at_z", neck->place()[2], "mm");
      }
    if (!in_the_tools.empty())
      {
        const auto &now     = simulation.shell().committed().position;
        double      largest = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
          largest = std::max(largest, (now[i] - in_the_tools[i]).norm());
        add("largest_springback", largest, "mm");
        add("elastic_energy_in_the_tools", 1e-3 * elastic_energy_in_the_tools, "J");
        add("elastic_energy_after_springback", 1e-3 * r.elastic_energy, "J");
      }
    add("external_work", 1e-3 * r.external_work, "J");
    add("plastic_work", 1e-3 * r.plastic_work, "J");
    add("friction_work", 1e-3 * r.friction_work, "J");
    add("elastic_energy", 1e-3 * r.elastic_energy, "J");
    add("stabilisation_work", 1e-3 * r.stabilisation_work, "J");
    add("energy_error", r.energy_error(), "");
    add("largest_penetration", max_penetration, "mm");
    add("newton_iterations", newton_iterations, "");
    table.save(folder / "results.csv");
  }

  void
  ResultsWriter::write_edge_profile(const Simulation &simulation) const
  {
    const Shell &shell = simulation.shell();
    const auto  &start = shell.mesh().nodes, &now = shell.committed().position;
    double       bottom = std::numeric_limits<double>::infinity();
    for (const Vector3d &x : now)
      bottom = std::min(bottom, x[2]);
    std::vector<std::pair<double, unsigned>> nodes; // by angle
    for (unsigned i = 0; i < shell.n_nodes(); ++i)
      if (shell.mesh().on_outer_edge[i])
        nodes.emplace_back(std::atan2(start[i][1], start[i][0]) * 180 / M_PI, i);
    std::sort(nodes.begin(), nodes.end());
    CsvTable table({ "angle_deg", "x0_mm", "y0_mm", "x_mm", "y_mm", "z_mm", "radius_mm", "height_mm", "thickness_mm" });
    for (const auto &[angle, i] : nodes)
      {
        const Vector3d &x = now[i];
        // outside the bottom to the rim; the middle surface ends half a thickness above the outside
        table.add_row({ angle, start[i][0], start[i][1], x[0], x[1], x[2], std::hypot(x[0], x[1]), x[2] - bottom + 0.5 * simulation.blank().thickness, shell.node_thickness()[i] });
      }
    table.save(folder / "edge_profile.csv");
  }

  void
  ResultsWriter::save(Archive &archive) const
  {
    archive.put("output/results", std::vector<double>{ max_force, travel_at_max_force, max_penetration, newton_iterations });
  }

  void
  ResultsWriter::load(const Archive &archive)
  {
    const auto &values  = archive.numbers("output/results", 4);
    max_force           = values[0];
    travel_at_max_force = values[1];
    max_penetration     = values[2];
    newton_iterations   = values[3];
  }
} // namespace tribodraw
