#include <tribodraw/lubrication/lubricated_face.h>
#include <tribodraw/lubrication/strip_contact.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Kind = FilmTransport::Kind;

    // The film iteration has converged when no pressure changes by more than this part of the greatest one.
    constexpr double film_tolerance   = 1e-3;
    constexpr double least_relaxation = 0.1;
    // Solid pressures, in parts of the nominal one, at which the gap of the touching surfaces is computed. It changes
    // most while the asperities carry little. Dividing the segment of the solution ten times finer changed the drawing
    // force by 0.02 %.
    constexpr std::array<double, FilmTransport::GapCurve::max_points> solid_parts = { 1., 0.6, 0.3, 0.15, 0.05, 0. };

    /// The cut height at which touching surfaces have a gap.
    double
    cut_height_of(const FrictionTable &table, const double gap)
    {
      const auto &h = table.curves.h_avg, &s = table.curves.cut_height;
      if (!(gap > h.front()))
        return s.front();
      if (gap >= h.back())
        return s.back();
      const auto i = std::upper_bound(h.begin(), h.end(), gap) - h.begin();
      return s[i - 1] + (gap - h[i - 1]) / (h[i] - h[i - 1]) * (s[i] - s[i - 1]);
    }
  } // namespace

  FilmTransport::GapCurve
  LubricatedFace::gap_curve(const std::size_t i, const Node &node, const Contact &contact) const
  {
    FilmTransport::GapCurve curve;
    curve.n = static_cast<unsigned>(solid_parts.size());
    for (unsigned k = 0; k < curve.n; ++k)
      {
        curve.pressure[k] = (1. - solid_parts[k]) * node.nominal_pressure;
        curve.gap[k]
            = table(node.table).film(advanced_cut_height(accepted.nodes[i], node, contact, curve.pressure[k])).h_avg;
        if (k > 0)
          curve.gap[k] = std::max(curve.gap[k], curve.gap[k - 1]);
      }
    return curve;
  }

  void
  LubricatedFace::transport_film(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts,
                                 const std::vector<Eigen::Vector3d> &slip_velocity, const std::vector<Node> &guess,
                                 const double dt, const unsigned n_iterations)
  {
    std::vector<Node>                   &nodes   = attempted.nodes;
    Statistics                          &figures = attempted.figures;
    const std::size_t                    n       = nodes.size();
    std::vector<FilmTransport::NodeData> data(n);
    std::vector<double>                  p(n, 0.), opened(n, 0.), last_step(n, 0.);
    FilmTransport::Result                result; // also where the sets start
    result.pressure.assign(n, 0.);
    result.fill.assign(n, 0.);
    for (std::size_t i = 0; i < n; ++i)
      {
        auto &d          = data[i];
        d.kind           = !nodes[i].in_contact() ? Kind::carried : edge[i] ? Kind::border : Kind::film;
        d.sheet_velocity = d.mesh_velocity = slip_velocity[i]; // in the frame of the tool
        d.old_volume                       = accepted.volume[i];
        d.p_limit                          = nodes[i].nominal_pressure;
        if (d.kind == Kind::carried)
          continue;
        d.closed = gap_curve(i, nodes[i], contacts[i]);
        if (d.kind == Kind::film)
          // Trapped lubricant follows the load.
          p[i] = guess[i].in_contact() ? guess[i].lubricant_pressure / guess[i].nominal_pressure * d.p_limit : 0.;
        // The flow sees the lift of the last update: the present one in turn with the pressure would not settle.
        if (accepted.nodes[i].regime == Regime::full)
          opened[i] = nodes[i].supplied_film;
        result.pressure[i] = p[i];
        result.fill[i]     = guess[i].supplied_film / d.closed.gap[0];
      }
    figures.active_set_iterations = figures.film_iterations = 0;
    figures.film_change                                     = 0;
    figures.converged                                       = !(dt > 0);
    double relaxation                                       = settings.film_relaxation;
    for (unsigned iteration = 1; iteration <= n_iterations && dt > 0; ++iteration)
      {
        for (std::size_t i = 0; i < n; ++i)
          if (auto &d = data[i]; d.kind != Kind::carried)
            {
              const FrictionTable &t    = table(nodes[i].table);
              const auto           film = lifted_film(t.film(cut_height_of(t, d.closed.at(p[i]))), opened[i]);
              d.film                    = film.h_avg;
              d.phi_p                   = film.phi_p;
              d.sq_phi_s                = t.sq * film.phi_s;
              d.viscosity = viscosity_law->viscosity(p[i], slip_velocity[i].norm() / film.h_avg).viscosity;
            }
        result                  = transport->solve(positions, data, dt, &result);
        figures.film_iterations = iteration;
        figures.active_set_iterations += result.iterations;

        const double largest = *std::max_element(result.pressure.begin(), result.pressure.end());
        double       change = 0, along = 0, apart = 0;
        for (std::size_t i = 0; i < n; ++i)
          if (data[i].kind == Kind::film)
            {
              const double step = result.pressure[i] - p[i];
              change            = std::max(change, std::abs(step));
              along += last_step[i] * (step - last_step[i]);
              apart += (step - last_step[i]) * (step - last_step[i]);
              last_step[i] = step;
            }
        figures.film_change = largest > 0 ? change / largest : 0.;
        figures.converged   = result.converged && figures.film_change < film_tolerance;
        if (figures.converged)
          break;
        // Aitken's relaxation for vectors (B. M. Irons, R. C. Tuck, Int. J. Numer. Methods Eng. 1 (1969) 275).
        if (iteration > 1 && apart > 0)
          relaxation = std::clamp(-relaxation * along / apart, least_relaxation, settings.film_relaxation);
        for (std::size_t i = 0; i < n; ++i)
          p[i] += relaxation * last_step[i];
      }
    for (std::size_t i = 0; i < n; ++i)
      {
        if (dt > 0)
          {
            attempted.volume[i] = std::max(0., result.volume[i]);
            figures.left_volume += dt * result.outflow[i];
          }
        set_transported_film(i, nodes[i], data[i], contacts[i], dt > 0 ? &result : nullptr);
      }
  }

  void
  LubricatedFace::set_transported_film(const std::size_t i, Node &node, const FilmTransport::NodeData &data,
                                       const Contact &contact, const FilmTransport::Result *result) const
  {
    const FrictionTable &t  = table(node.table);
    node.supplied_film      = attempted.volume[i] / patch.nodal_area()[i];
    node.lubricant_pressure = result && data.kind == Kind::film ? result->pressure[i] : 0.;
    node.solid_pressure     = node.nominal_pressure - node.lubricant_pressure;
    double opened           = 0;
    if (node.in_contact())
      {
        const bool full = result && result->fill[i] >= 1.; // on the edge of the blank without pressure
        node.cut_height = advanced_cut_height(accepted.nodes[i], node, contact, node.lubricant_pressure);
        node.regime     = !result || full ? Regime::mixed : Regime::boundary;
        if (full && node.lubricant_pressure >= data.p_limit)
          {
            node.regime = Regime::full;
            opened      = node.supplied_film;
          }
        else if (full && settings.memory)
          // The surfaces touch around the lubricant there is: free of the error between the points of the curve.
          node.cut_height = std::min(accepted.nodes[i].cut_height, cut_height_of(t, node.supplied_film));
      }
    const auto touching   = t.film(node.cut_height);
    const auto film       = lifted_film(touching, opened);
    node.film_thickness   = film.h_avg;
    node.contact_fraction = film.contact_fraction;
    node.phi_p            = film.phi_p;
    node.phi_s            = film.phi_s;
    node.lift             = film.h_avg - touching.h_avg;
  }
} // namespace tribodraw
