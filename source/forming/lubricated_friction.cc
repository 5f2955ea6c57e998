#include <tribodraw/base/log.h>
#include <tribodraw/forming/lubricated_friction.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace tribodraw
{
  namespace
  {
    const char *const side[n_faces] = {"punch", "die"};
  }

  LubricatedFriction::LubricatedFriction(std::vector<std::shared_ptr<const FrictionTable>> tool_tables, const Lubricant &oil, const LubricationSettings &lubrication_settings)
    : tables(std::move(tool_tables))
    , lubricant(oil)
    , settings(lubrication_settings)
  {}

  void
  LubricatedFriction::start(const Shell &shell, Contact &contact)
  {
    const BlankMesh                                                                &mesh = shell.mesh();
    std::array<std::vector<std::shared_ptr<const FrictionTable>>, n_faces> face_tables;
    reference = mesh.nodes;
    table_of_tool.clear();
    for (std::size_t t = 0; t < contact.tools().size(); ++t)
      {
        auto &list = face_tables[static_cast<int>(contact.tools()[t].face)];
        table_of_tool.push_back(static_cast<int>(list.size()));
        list.push_back(tables[t]);
      }
    for (unsigned f = 0; f < n_faces; ++f)
      {
        std::vector<double> film;
        for (const auto &x : mesh.nodes)
          film.push_back(lubricant.supplied_film(f, x[0], x[1]));
        faces[f] = std::make_unique<LubricatedFace>(mesh.nodes, mesh.triangles, mesh.on_outer_edge, face_tables[f], lubricant.viscosity_law, std::move(film), settings);
      }
    hand_over(contact, &LubricatedFace::nodes);
  }

  void
  LubricatedFriction::hand_over(Contact &contact, const Nodes &(LubricatedFace::*nodes)() const) const
  {
    for (unsigned f = 0; f < n_faces; ++f)
      {
        std::vector<double> mu;
        mu.reserve(reference.size());
        for (const auto &node : (*faces[f].*nodes)())
          mu.push_back(node.friction_coefficient);
        contact.set_friction(static_cast<Face>(f), std::move(mu));
      }
  }

  void
  LubricatedFriction::attempt(const std::array<Contact::FaceState, n_faces> &states, const std::vector<Eigen::Vector3d> &positions, const std::vector<double> &eps_p, const Increment &increment, const bool preliminary)
  {
    std::vector<LubricatedFace::Contact> touching(positions.size());
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const Contact::FaceState &state = states[f];
        for (std::size_t i = 0; i < touching.size(); ++i)
          {
            touching[i]                  = {};
            touching[i].nominal_pressure = state.pressure[i];
            touching[i].eps_p            = eps_p[i];
            if (state.tool[i] < 0)
              continue;
            touching[i].table = table_of_tool[state.tool[i]];
            // relative to the tool, whose velocity is then zero
            touching[i].sheet_velocity = state.slip[i] / increment.dt;
          }
        faces[f]->attempt(positions, touching, {increment.dt, increment.travel, increment.closing, preliminary});
      }
  }

  double
  LubricatedFriction::change(const Shell &shell, const Contact &contact) const
  {
    const std::vector<double> area    = shell.node_current_area();
    double                    changed = 0, whole = 0;
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const std::vector<double> &acts = contact.friction(static_cast<Face>(f));
        for (std::size_t i = 0; i < area.size(); ++i)
          {
            const auto  &node  = faces[f]->attempted_nodes()[i];
            const double force = area[i] * node.nominal_pressure;
            changed += force * std::abs(node.friction_coefficient - acts[i]);
            whole += force * node.friction_coefficient;
          }
      }
    return whole > 0 ? changed / whole : 0.;
  }

  bool
  LubricatedFriction::iterate(const Shell &shell, Contact &contact, const Increment &increment, const bool in_equilibrium)
  {
    if (settings.friction_loops == 0 || (!in_equilibrium && n_loops > 0 && expected_change < settings.friction_tolerance))
      return false;
    const double before = last_change;
    attempt(contact.trial_faces(), shell.trial().position, shell.trial_node_eps_p(), increment, !in_equilibrium);
    last_change = change(shell, contact);
    settled     = last_change < settings.friction_tolerance || n_loops == settings.friction_loops;
    // Each change is about as much smaller than the one before as that one was.
    expected_change = n_loops > 0 ? last_change * last_change / before : last_change;
    if (settled)
      return false;
    hand_over(contact, &LubricatedFace::attempted_nodes);
    ++n_loops;
    return true;
  }

  void
  LubricatedFriction::revert(Contact &contact)
  {
    settled = false;
    n_loops = 0;
    for (auto &face : faces)
      face->forget_attempt();
    hand_over(contact, &LubricatedFace::nodes);
  }

  void
  LubricatedFriction::update(const Shell &shell, Contact &contact, const Increment &increment)
  {
    if (!settled)
      attempt({contact.face(Face::punch_side), contact.face(Face::die_side)}, shell.committed().position, shell.node_eps_p(), increment, false);
    for (auto &face : faces)
      face->accept();
    accepted_loops  = settled ? n_loops : 0;
    accepted_change = settled ? last_change : 0;
    if (accepted_change >= settings.friction_tolerance && settled)
      {
        ++n_unsettled;
        worst_change = std::max(worst_change, accepted_change);
      }
    settled = false;
    n_loops = 0;
    hand_over(contact, &LubricatedFace::nodes);
  }

  FrictionCoupling::Summary
  LubricatedFriction::summary() const
  {
    Summary s;
    double  area = 0, starved = 0;
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const auto &figures         = faces[f]->statistics();
        s.max_lubricant_pressure[f] = figures.max_lubricant_pressure;
        s.mean_mu[f]                = figures.mean_friction;
        area += figures.contact_area;
        starved += figures.contact_area * figures.starved_area_fraction;
        s.lubricant_volume_error = std::max(s.lubricant_volume_error, std::abs(figures.volume_error));
      }
    s.starved_area_fraction = area > 0 ? starved / area : 0.;
    return s;
  }

  std::map<std::string, std::vector<double>>
  LubricatedFriction::fields() const
  {
    std::map<std::string, std::vector<double>> result;
    const double                               none = std::numeric_limits<double>::quiet_NaN();
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const std::string end = std::string("_") + side[f];
        for (const auto &node : faces[f]->nodes())
          {
            const bool touches = node.in_contact();
            const auto add     = [&](const char *name, const double value) { result[name + end].push_back(touches ? value : none); };
            result["lubricant_film_thickness" + end].push_back(1e3 * node.supplied_film); // um, also where nothing touches
            add("solid_pressure", node.solid_pressure);
            add("lubricant_pressure", node.lubricant_pressure);
            add("film_thickness", 1e3 * node.film_thickness); // um
            add("contact_fraction", node.contact_fraction);
            add("phi_p", 0.5 * node.phi_p.trace());
            add("phi_s", 0.5 * node.phi_s.trace());
            add("lubrication_regime", static_cast<double>(node.regime));
          }
      }
    return result;
  }

  std::string
  LubricatedFriction::report() const
  {
    const auto &die = faces[static_cast<int>(Face::die_side)]->statistics();
    char        text[200];
    std::snprintf(text, sizeof(text), "film: load share %.2f, starved %.2f, lifted %.2f, P_lub %.1f MPa", die.load_share, die.starved_area_fraction,
                  die.capped_area_fraction, die.max_lubricant_pressure);
    std::string line = text;
    if (die.max_node >= 0)
      {
        const Eigen::Vector3d &x = reference[die.max_node];
        std::snprintf(text, sizeof(text), " at X (%.0f, %.0f)", x[0], x[1]);
        line += text;
      }
    if (settings.friction_loops > 0)
      {
        std::snprintf(text, sizeof(text), ", %u friction loops to %.1f %%", accepted_loops, 100 * accepted_change);
        line += text;
      }
    return line;
  }

  void
  LubricatedFriction::report_end() const
  {
    for (unsigned f = 0; f < n_faces; ++f)
      {
        log::info(std::string("Film at the end, ") + side[f] + " side: " + faces[f]->report());
        if (const unsigned n = faces[f]->statistics().n_unsettled; n > 0)
          log::warning("In " + std::to_string(n) + " increments the film of the " + side[f] + " side did not settle; the last iterate was taken. "
                       "The lubricant is conserved, its pressure is less exact there.");
      }
    if (n_unsettled > 0)
      {
        char text[300];
        std::snprintf(text, sizeof(text),
                      "In %u increments friction did not settle in %u loops; the last change was at most %.1f %% of the friction force. "
                      "Larger 'Coupling/Friction loops' or smaller 'Solver/Largest increment' would help.",
                      n_unsettled, settings.friction_loops, 100 * worst_change);
        log::warning(text);
      }
    // Tools may share a table.
    for (const auto &table : std::set<std::shared_ptr<const FrictionTable>>(tables.begin(), tables.end()))
      table->warn_of_look_ups_beyond();
  }

  void
  LubricatedFriction::save(Archive &archive) const
  {
    for (unsigned f = 0; f < n_faces; ++f)
      faces[f]->save(archive, std::string("lubrication/") + side[f]);
    archive.put("lubrication/friction loop", std::vector<double>{static_cast<double>(n_unsettled), worst_change});
  }

  void
  LubricatedFriction::load(const Archive &archive)
  {
    for (unsigned f = 0; f < n_faces; ++f)
      faces[f]->load(archive, std::string("lubrication/") + side[f]);
    const auto &loop = archive.numbers("lubrication/friction loop", 2);
    n_unsettled      = static_cast<unsigned>(loop[0]);
    worst_change     = loop[1];
  }
} // namespace tribodraw
