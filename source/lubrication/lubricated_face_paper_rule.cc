#include <tribodraw/lubrication/lubricated_face.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    // A film iteration has converged when the pressure changes by less than this part of its maximum.
    constexpr double film_tolerance = 1e-3;
    // Part of the nominal pressure over which the gap's slope is taken.
    constexpr double pressure_step = 0.01;
  } // namespace

  void
  LubricatedFace::iterate_film(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts,
                               const std::vector<Eigen::Vector3d> &slip_velocity, std::vector<double> lubricant,
                               const double dt)
  {
    std::vector<Node> &nodes      = attempted.nodes;
    Statistics        &figures    = attempted.figures;
    figures.active_set_iterations = figures.film_iterations = 0;
    figures.film_change                                     = 0;
    figures.converged                                       = true;
    for (unsigned iteration = 1; iteration <= settings.film_iterations; ++iteration)
      {
        flatten(nodes, contacts, lubricant);
        if (!(dt > 0))
          return;
        const auto result       = solve_film(positions, nodes, contacts, slip_velocity, lubricant, dt);
        figures.film_iterations = iteration;
        figures.active_set_iterations += result.iterations;
        figures.converged = figures.converged && result.converged;
        double change = 0, largest = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i)
          {
            Node &node = nodes[i];
            // A node without pressure (open, starved) is not relaxed: it has none.
            const bool   carries    = node.regime == Regime::mixed && !edge[i];
            const double p          = carries
                                          ? std::min(node.nominal_pressure, (1. - settings.film_relaxation) * lubricant[i]
                                                                                + settings.film_relaxation * result.pressure[i])
                                          : 0.;
            change                  = std::max(change, std::abs(p - lubricant[i]));
            largest                 = std::max(largest, p);
            lubricant[i]            = p;
            node.lubricant_pressure = p;
            node.solid_pressure     = node.nominal_pressure - p;
            node.opening_rate       = result.opening_rate[i];
          }
        figures.film_change = largest > 0 ? change / largest : 0.;
        if (figures.film_change < film_tolerance)
          break;
      }
    for (auto &node : nodes)
      if (node.regime == Regime::mixed && node.lubricant_pressure >= (1. - 1e-12) * node.nominal_pressure)
        node.regime = Regime::full;
  }

  void
  LubricatedFace::flatten(std::vector<Node> &nodes, const std::vector<Contact> &contacts,
                          const std::vector<double> &lubricant) const
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        Node       &node = nodes[i];
        const Node &old  = accepted.nodes[i];
        node.cut_height  = old.cut_height;
        // A node that has just come into contact is first pressed by its full load, else it would be judged on its
        // undeformed valleys and starve.
        if (node.in_contact())
          node.cut_height = advanced_cut_height(old, node, contacts[i], old.in_contact() ? lubricant[i] : 0.);
        const auto film         = table(node.table).film(node.cut_height);
        node.film_thickness     = film.h_avg;
        node.contact_fraction   = film.contact_fraction;
        node.phi_p              = film.phi_p;
        node.phi_s              = film.phi_s;
        node.lubricant_pressure = node.opening_rate = 0;
        node.solid_pressure                         = node.nominal_pressure;
        if (node.in_contact())
          node.regime = node.supplied_film < node.film_thickness ? Regime::boundary : Regime::mixed;
      }
  }

  AverageReynolds::Result
  LubricatedFace::solve_film(const std::vector<Eigen::Vector3d> &positions, const std::vector<Node> &nodes,
                             const std::vector<Contact> &contacts, const std::vector<Eigen::Vector3d> &slip_velocity,
                             const std::vector<double> &lubricant, const double dt) const
  {
    std::vector<AverageReynolds::NodeData> data(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const Node &node = nodes[i];
        auto       &d    = data[i];
        d.fixed          = node.regime != Regime::mixed || edge[i];
        d.film           = node.film_thickness;
        d.viscosity      = viscosity(node, slip_velocity[i], lubricant[i]);
        d.phi_p          = node.phi_p;
        d.sq_phi_s       = table(node.table).sq * node.phi_s;
        d.sheet_velocity = slip_velocity[i]; // in the frame of the tool
        d.p_limit        = node.nominal_pressure;
      }
    if (settings.squeeze)
      add_squeeze(positions, nodes, contacts, lubricant, dt, data);
    return reynolds->solve(positions, data, lubricant);
  }

  /// d h/d t at a fixed point of the tool = (rate at the material point) - U1 . grad h, at the end of the increment and
  /// with the change of h by the pressure that is sought. A node that has just come into contact has no rate: its gap
  /// before was no film.
  void
  LubricatedFace::add_squeeze(const std::vector<Eigen::Vector3d> &positions, const std::vector<Node> &nodes,
                              const std::vector<Contact> &contacts, const std::vector<double> &lubricant,
                              const double dt, std::vector<AverageReynolds::NodeData> &data) const
  {
    std::vector<double> film;
    for (const Node &node : nodes)
      film.push_back(node.film_thickness);
    const auto both = [&](const std::size_t i) { return nodes[i].in_contact() && accepted.nodes[i].in_contact(); };
    std::vector<Eigen::Vector3d> gradient(nodes.size(), Eigen::Vector3d::Zero());
    std::vector<double>          weight(nodes.size(), 0.);
    for (const auto &t : patch.triangles())
      {
        if (!both(t[0]) || !both(t[1]) || !both(t[2]))
          continue;
        const Eigen::Vector3d a = positions[t[1]] - positions[t[0]], b = positions[t[2]] - positions[t[0]];
        const Eigen::Vector3d n = a.cross(b);
        // Twice the area times the gradient of the linear function.
        const Eigen::Vector3d g
            = ((film[t[1]] - film[t[0]]) * b.cross(n) + (film[t[2]] - film[t[0]]) * n.cross(a)) / n.norm();
        for (const unsigned i : t)
          {
            gradient[i] += g;
            weight[i] += n.norm();
          }
      }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (both(i) && weight[i] > 0)
        {
          const double step = pressure_step * nodes[i].nominal_pressure;
          const double side = lubricant[i] > step ? -step : step; // towards where the asperities are pressed
          const double h    = table(nodes[i].table)
                               .film(advanced_cut_height(accepted.nodes[i], nodes[i], contacts[i], lubricant[i] + side))
                               .h_avg;
          const double slope    = std::max(0., (h - film[i]) / side);
          data[i].squeeze_slope = slope / dt;
          data[i].squeeze       = (film[i] - slope * lubricant[i] - accepted.nodes[i].film_thickness) / dt
                            - data[i].sheet_velocity.dot(gradient[i]) / weight[i];
        }
  }
} // namespace tribodraw
