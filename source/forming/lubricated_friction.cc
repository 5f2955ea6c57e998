#include <tribodraw/base/log.h>
#include <tribodraw/forming/lubricated_friction.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    hand_over(contact);
  }

  void
  LubricatedFriction::hand_over(Contact &contact) const
  {
    for (unsigned f = 0; f < n_faces; ++f)
      {
        std::vector<double> mu;
        mu.reserve(faces[f]->nodes().size());
        for (const auto &node : faces[f]->nodes())
          mu.push_back(node.friction_coefficient);
        contact.set_friction(static_cast<Face>(f), std::move(mu));
      }
  }

  void
  LubricatedFriction::update(const Shell &shell, Contact &contact, const Increment &increment)
  {
    const unsigned                       n = shell.n_nodes();
    std::vector<LubricatedFace::Contact> touching(n);
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const Contact::FaceState &state = contact.face(static_cast<Face>(f));
        for (unsigned i = 0; i < n; ++i)
          {
            touching[i]                  = {};
            touching[i].nominal_pressure = state.pressure[i];
            touching[i].eps_p            = shell.node_eps_p()[i];
            if (state.tool[i] < 0)
              continue;
            touching[i].table = table_of_tool[state.tool[i]];
            // relative to the tool, whose velocity is then zero
            touching[i].sheet_velocity = state.slip[i] / increment.dt;
          }
        faces[f]->update(shell.committed().position, touching, {increment.dt, increment.travel, increment.closing});
      }
    hand_over(contact);
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
    if (die.max_node < 0)
      return text;
    const Eigen::Vector3d &x = reference[die.max_node];
    char                   where[60];
    std::snprintf(where, sizeof(where), " at X (%.0f, %.0f)", x[0], x[1]);
    return std::string(text) + where;
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
    unsigned long outside = 0;
    for (const auto &table : tables)
      outside += table->n_outside();
    if (outside > 0)
      log::warning(std::to_string(outside) + " look-ups were outside the range of the friction tables and took the value at its end. "
                   "Extend 'Friction table/Pressures' or 'Friction table/Strains'.");
  }

  void
  LubricatedFriction::save(Archive &archive) const
  {
    for (unsigned f = 0; f < n_faces; ++f)
      faces[f]->save(archive, std::string("lubrication/") + side[f]);
  }

  void
  LubricatedFriction::load(const Archive &archive)
  {
    for (unsigned f = 0; f < n_faces; ++f)
      faces[f]->load(archive, std::string("lubrication/") + side[f]);
  }
} // namespace tribodraw
