#include <tribodraw/base/errors.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/lubrication/lubricated_face.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribodraw
{
  namespace
  {
    std::vector<double>
    lubricant_pressures(const std::vector<LubricatedFace::Node> &nodes)
    {
      std::vector<double> p;
      for (const auto &node : nodes)
        p.push_back(node.lubricant_pressure);
      return p;
    }

    void
    set_film(LubricatedFace::Node &node, const FrictionTable &table)
    {
      const auto film       = table.film(node.cut_height);
      node.film_thickness   = film.h_avg;
      node.contact_fraction = film.contact_fraction;
      node.phi_p            = film.phi_p;
      node.phi_s            = film.phi_s;
    }
  } // namespace

  LubricatedFace::LubricatedFace(const std::vector<Eigen::Vector3d>         &reference,
                                 const std::vector<std::array<unsigned, 3>> &triangles, std::vector<bool> free_edge,
                                 std::vector<std::shared_ptr<const FrictionTable>> friction_tables,
                                 std::shared_ptr<const ViscosityLaw> viscosity, std::vector<double> supplied_film,
                                 const LubricationSettings &lubrication_settings)
      : edge(std::move(free_edge)), tables(std::move(friction_tables)), viscosity_law(std::move(viscosity)),
        settings(lubrication_settings), patch(reference.size(), triangles), supply(std::move(supplied_film))
  {
    accepted.nodes.resize(reference.size());
    accepted.slid.assign(reference.size(), Eigen::Vector3d::Zero());
    accepted.touched.assign(reference.size(), 0.);
    if (tables.empty() || !viscosity_law || edge.size() != reference.size() || supply.size() != reference.size())
      throw InputError(describe_error(
          "A lubricated face needs friction tables, a viscosity law, and an edge mark and a film for each node",
          "set-up of the film"));
    patch.move_to(reference);
    reference_area = patch.nodal_area();
    double top     = -1e300;
    for (const auto &t : tables)
      top = std::max(top, t->initial_cut_height);
    for (std::size_t i = 0; i < reference.size(); ++i)
      {
        Node &node         = accepted.nodes[i];
        node.cut_height    = top;
        node.supplied_film = supply[i];
        set_film(node, table(0));
        node.friction_coefficient = fresh_friction(node);
      }
    accepted.figures.supplied_volume = accepted.figures.volume = patch.integral(supply);
    if (settings.supply == LubricationSettings::Supply::film_transport)
      {
        transport = std::make_unique<FilmTransport>(reference, triangles, settings.phi_p_floor);
        for (std::size_t i = 0; i < supply.size(); ++i)
          accepted.volume.push_back(supply[i] * reference_area[i]);
      }
    else
      reynolds = std::make_unique<AverageReynolds>(reference, triangles, settings.phi_p_floor);
  }

  bool
  LubricatedFace::attempt(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts,
                          const Increment &increment)
  {
    const timing::Scope timer("lubrication/face");
    check(positions, contacts);
    // The last attempt is nearer to the solution than what was there before the increment.
    const std::vector<Node> guess = attempted.nodes.empty() ? accepted.nodes : std::move(attempted.nodes);
    attempted                     = accepted;
    if (!accumulate(contacts, increment))
      return false;
    const double dt = increment.at_rest ? increment.dt : attempted.elapsed;
    patch.move_to(positions);
    const std::size_t            n = accepted.nodes.size();
    std::vector<Eigen::Vector3d> slip(n, Eigen::Vector3d::Zero());
    if (!increment.at_rest)
      slip = mean_slip_velocity();
    prepare_nodes(attempted.nodes, contacts);
    if (transport)
      transport_film(positions, contacts, slip, guess, dt, increment.preliminary ? 1 : settings.film_iterations);
    else
      iterate_film(positions, contacts, slip,
                   increment.at_rest ? std::vector<double>(n, 0.) : lubricant_pressures(accepted.nodes),
                   increment.at_rest ? 0. : dt);
    find_friction(slip);

    attempted.earlier_pressure[1] = std::move(attempted.earlier_pressure[0]);
    attempted.earlier_pressure[0] = lubricant_pressures(accepted.nodes);
    ++attempted.n_updates;
    attempted.figures.n_unsettled += !attempted.figures.converged;
    find_statistics(dt);
    attempted.forget_motion();
    return true;
  }

  void
  LubricatedFace::accept()
  {
    accepted = std::move(attempted);
    forget_attempt();
  }

  bool
  LubricatedFace::update(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts,
                         const Increment &increment)
  {
    const bool is_new = attempt(positions, contacts, increment);
    accept();
    return is_new;
  }

  void
  LubricatedFace::forget_attempt()
  {
    attempted = {};
  }

  void
  LubricatedFace::check(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts) const
  {
    const std::size_t n = accepted.nodes.size();
    if (positions.size() != n || contacts.size() != n)
      throw InputError(describe_error("Wrong number of nodes for the film of a face", "update of the film",
                                      std::to_string(positions.size()) + " positions, "
                                          + std::to_string(contacts.size()) + " contacts",
                                      std::to_string(n)));
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (contacts[i].table >= static_cast<int>(tables.size()) || !std::isfinite(contacts[i].nominal_pressure)
          || !std::isfinite(contacts[i].eps_p))
        throw InputError(describe_error(
            "A node of the film has no meaningful contact state", "node " + std::to_string(i),
            "table " + std::to_string(contacts[i].table) + ", pressure " + std::to_string(contacts[i].nominal_pressure)
                + " MPa, strain " + std::to_string(contacts[i].eps_p)));
  }

  void
  LubricatedFace::prepare_nodes(std::vector<Node> &nodes, const std::vector<Contact> &contacts) const
  {
    std::vector<double> nominal;
    for (const auto &c : contacts)
      nominal.push_back(std::max(0., c.nominal_pressure));
    for (unsigned pass = 0; pass < settings.smoothing; ++pass)
      nominal = patch.smooth(nominal);
    const std::vector<int> table_of = touched_tables(contacts);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        Node &node         = nodes[i];
        node.supplied_film = transport           ? accepted.volume[i] / patch.nodal_area()[i]
                             : settings.thinning ? supply[i] * reference_area[i] / patch.nodal_area()[i]
                                                 : supply[i];
        node.eps_p         = contacts[i].eps_p;
        if (table_of[i] >= 0)
          node.table = table_of[i];
        const bool touches    = table_of[i] >= 0 && nominal[i] >= settings.contact_threshold;
        node.nominal_pressure = touches ? nominal[i] : 0.;
        node.regime           = touches ? Regime::mixed : Regime::no_contact;
      }
  }

  double
  LubricatedFace::advanced_cut_height(const Node &old, const Node &node, const Contact &contact,
                                      const double lubricant) const
  {
    const FrictionTable &t       = table(node.table);
    const double         p_solid = std::max(0., node.nominal_pressure - lubricant);
    return settings.memory ? t.advance(old.cut_height, p_solid, old.eps_p, contact.eps_p)
                           : t.advance(t.initial_cut_height, p_solid, 0., contact.eps_p);
  }
  double
  LubricatedFace::viscosity(const Node &node, const Eigen::Vector3d &slip_velocity, const double pressure) const
  {
    return viscosity_law->viscosity(pressure, slip_velocity.norm() / node.film_thickness).viscosity;
  }

  double
  LubricatedFace::boundary_layer_pressure(const Node &node) const
  {
    const double alpha = node.contact_fraction;
    if (settings.boundary_layer_pressure == LubricationSettings::BoundaryLayerPressure::nominal)
      return alpha > 0 ? node.nominal_pressure / alpha : 0.;
    return (alpha > 0 ? node.solid_pressure / alpha : 0.) + node.lubricant_pressure;
  }

  void
  LubricatedFace::find_friction(const std::vector<Eigen::Vector3d> &slip_velocity)
  {
    std::vector<Node> &nodes     = attempted.nodes;
    unsigned          &n_clamped = attempted.figures.n_clamped_friction;
    const auto         gradient  = patch.gradient(lubricant_pressures(nodes));
    n_clamped                    = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        Node &node = nodes[i];
        if (!node.in_contact())
          {
            node.friction_coefficient = fresh_friction(node);
            continue;
          }
        const double solid
            = table(node.table)
                  .solid_shear(node.cut_height, node.solid_pressure, boundary_layer_pressure(node), node.eps_p);
        const Eigen::Vector3d &n     = patch.normal()[i];
        const Eigen::Vector3d  slip  = slip_velocity[i] - n * n.dot(slip_velocity[i]);
        const double           speed = slip.norm();
        double                 shear = solid;
        if (speed > 0 && node.regime != Regime::boundary)
          {
            // Traction on the sheet: against its sliding (Eqs. 17 and 19; solid_shear() is per nominal area).
            const Eigen::Vector3d viscous = -viscosity(node, slip, node.lubricant_pressure) / node.film_thickness * slip
                                            - 0.5 * node.film_thickness * (gradient[i] - n * n.dot(gradient[i]));
            shear = (-solid / speed * slip + (1. - node.contact_fraction) * viscous).norm();
          }
        const double mu           = shear / node.nominal_pressure;
        node.friction_coefficient = std::clamp(mu, settings.min_friction, settings.max_friction);
        n_clamped += node.friction_coefficient != mu;
      }
  }

  double
  LubricatedFace::fresh_friction(const Node &node) const
  {
    const FrictionTable &t     = table(node.table);
    const double         p     = settings.fresh_contact_pressure;
    const double         s     = t.advance(node.cut_height, p, node.eps_p, node.eps_p);
    const double         alpha = t.film(s).contact_fraction;
    const double         shear = t.solid_shear(s, p, alpha > 0 ? p / alpha : 0., node.eps_p);
    return std::clamp(shear / p, settings.min_friction, settings.max_friction);
  }

  void
  LubricatedFace::find_statistics(const double time)
  {
    Statistics                &figures = attempted.figures;
    const std::vector<Node>   &nodes   = attempted.nodes;
    const std::vector<double> &area    = patch.nodal_area();
    double                     nominal = 0, lubricant = 0, starved = 0, capped = 0, shear = 0, change = 0;
    figures.contact_area = figures.volume = figures.max_lubricant_pressure = figures.nominal_pressure_there = 0;
    figures.max_node                                                                                        = -1;
    if (transport)
      figures.opening_volume = 0;
    figures.min_film = figures.max_film = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const Node &node = nodes[i];
        figures.volume += area[i] * node.supplied_film;
        figures.opening_volume += area[i] * (transport ? node.lift : node.opening_rate * time);
        if (attempted.n_updates > 2)
          change += area[i]
                    * std::abs(node.lubricant_pressure - 2. * attempted.earlier_pressure[0][i]
                               + attempted.earlier_pressure[1][i]);
        if (!node.in_contact())
          continue;
        figures.min_film
            = figures.contact_area > 0 ? std::min(figures.min_film, node.film_thickness) : node.film_thickness;
        figures.max_film = std::max(figures.max_film, node.film_thickness);
        figures.contact_area += area[i];
        nominal += area[i] * node.nominal_pressure;
        lubricant += area[i] * node.lubricant_pressure;
        shear += area[i] * node.nominal_pressure * node.friction_coefficient;
        starved += node.regime == Regime::boundary ? area[i] : 0.;
        capped += node.regime == Regime::full ? area[i] : 0.;
        if (node.lubricant_pressure > figures.max_lubricant_pressure)
          {
            figures.max_lubricant_pressure = node.lubricant_pressure;
            figures.nominal_pressure_there = node.nominal_pressure;
            figures.max_node               = static_cast<int>(i);
          }
      }
    const auto ratio              = [](const double a, const double b) { return b > 0 ? a / b : 0.; };
    figures.load_share            = ratio(lubricant, nominal);
    figures.starved_area_fraction = ratio(starved, figures.contact_area);
    figures.capped_area_fraction  = ratio(capped, figures.contact_area);
    figures.mean_friction         = ratio(shear, nominal);
    figures.oscillation           = ratio(change, lubricant);
    figures.volume_error
        = ratio(figures.volume + figures.left_volume - figures.supplied_volume, figures.supplied_volume);
  }

  std::string
  LubricatedFace::report() const
  {
    const Statistics &figures = accepted.figures;
    char              text[400];
    std::snprintf(
        text, sizeof text,
        "mu %.4f, lubricant carries %.1f %%, starved %.1f %%, at bound %.1f %%, h %.2f-%.2f um, P_lub <= %.2f MPa"
        " (P_nom %.2f), opening %.3g mm^3, oscillation %.2f",
        figures.mean_friction, 100. * figures.load_share, 100. * figures.starved_area_fraction,
        100. * figures.capped_area_fraction, 1e3 * figures.min_film, 1e3 * figures.max_film,
        figures.max_lubricant_pressure, figures.nominal_pressure_there, figures.opening_volume, figures.oscillation);
    return text;
  }
} // namespace tribodraw
