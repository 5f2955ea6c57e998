#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/lubrication/film_transport.h>
#include <tribodraw/lubrication/strip_contact.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    // The tool height is found to this part of itself; the load then fits to about the same.
    constexpr double         height_tolerance    = 1e-12;
    constexpr std::uintmax_t max_load_iterations = 200;
    constexpr unsigned       max_widenings       = 80;
    // Film and viscosity in turn: a contraction for all but pathological laws.
    constexpr unsigned max_viscosity_iterations = 60;
    constexpr double   viscosity_tolerance      = 1e-9; // of the greatest pressure
    // The gap at the ends of the mesh, in parts of the greatest gap of touching surfaces: pressure there is
    // negligible, as the conductance is its cube.
    constexpr double inlet_gap = 6, outlet_gap = 3;
    // Shares of the load below which it counts as nothing.
    constexpr double negligible_share = 0.01;

    /// Value at x on a curve through ascending points, constant outside.
    double
    interpolate(const std::vector<double> &xs, const std::vector<double> &ys, const double x)
    {
      if (!(x > xs.front()))
        return ys.front();
      if (x >= xs.back())
        return ys.back();
      const auto i = std::upper_bound(xs.begin(), xs.end(), x) - xs.begin();
      return ys[i - 1] + (x - xs[i - 1]) / (xs[i] - xs[i - 1]) * (ys[i] - ys[i - 1]);
    }

    /// Cut height over solid pressure at one strain, and back.
    struct FlatteningCurve
    {
      std::vector<double> s, p; // s ascending, p descending to zero at the top

      FlatteningCurve(const FrictionTable &table, const double strain)
      {
        constexpr int points_per_interval = 8;
        const auto   &pressures           = table.cut_height_monotone.axes()[0].points;
        const auto    add                 = [&](const double pressure, const double cut_height) {
          if (s.empty() || cut_height > s.back())
            {
              s.push_back(cut_height);
              p.push_back(pressure);
            }
        };
        add(pressures.back(), table.cut_height_monotone.value({ pressures.back(), strain }));
        for (std::size_t i = pressures.size() - 1; i-- > 0;)
          for (int k = 1; k <= points_per_interval; ++k)
            {
              const double pressure
                  = pressures[i + 1] * std::pow(pressures[i] / pressures[i + 1], double(k) / points_per_interval);
              add(pressure, table.cut_height_monotone.value({ pressure, strain }));
            }
        add(0., table.initial_cut_height);
      }
      double
      pressure(const double cut_height) const
      {
        return interpolate(s, p, cut_height);
      }
    };
  } // namespace

  FrictionTable::Film
  lifted_film(const FrictionTable::Film &film, const double h_avg)
  {
    if (!(h_avg > film.h_avg))
      return film;
    FrictionTable::Film   lifted = film;
    const double          ratio  = film.h_avg / h_avg;
    const Eigen::Matrix2d one    = Eigen::Matrix2d::Identity();
    lifted.contact_fraction      = 0;
    lifted.h_avg                 = h_avg;
    lifted.phi_p                 = one + ratio * ratio * (film.phi_p - one);
    lifted.phi_s                 = ratio * film.phi_s;
    return lifted;
  }

  std::string
  regime_name(const StripContact::Result::Regime regime)
  {
    using Regime = StripContact::Result::Regime;
    return regime == Regime::boundary ? "boundary" : regime == Regime::mixed ? "mixed" : "full film";
  }

  StripContact::Geometry
  StripContact::Geometry::read(Parameters &parameters)
  {
    Geometry g;
    g.length      = parameters.quantity("Length", "mm", Range::positive().usual(0.01, 1000),
                                        "Length of the flat land of the tool along the drawing direction.");
    g.width       = parameters.quantity("Width", "mm", Range::positive().usual(0.01, 5000), "Width of the contact.");
    g.edge_radius = parameters.quantity("Edge radius", "mm", Range::positive().usual(1e-3, 1e4),
                                        "Radius of the rounded edges of the tool at inlet and outlet.");
    g.inclination = parameters.quantity("Inclination", "um", Range::non_negative().usual(0, 1000),
                                        "How much wider the gap is at the start of the land than at its end.",
                                        Default{ "0 um", "a tool that lies flat" });
    g.open_sides
        = parameters.choice("Sides", { "no flow", "pressure zero" },
                            "What happens at the sides of the strip. `no flow`: the contact is wide, and one row of "
                            "elements is enough.",
                            Default{ "no flow", "contacts of strip drawing are wide against the length in which the "
                                                "film changes" })
          == "pressure zero";
    g.n_along = static_cast<unsigned>(
        parameters.integer("Elements along", Range::between(10, 5000), "Elements along the drawing direction.",
                           Default{ "120", "error of the friction coefficient below 0.1 %" }));
    g.n_across = static_cast<unsigned>(parameters.integer(
        "Elements across", Range::between(1, 1000), "Elements across the strip; one if no flow leaves at the sides.",
        Default{ g.open_sides ? "12" : "1", "the pressure falls to zero at "
                                            "open sides" }));
    if (!parameters.documentation_mode() && g.open_sides && g.n_across < 2)
      parameters.problem("Elements across", "One element across leaves no point between the open sides.", "2 or more");
    return g;
  }

  struct StripContact::Implementation
  {
    Geometry                                   geometry;
    std::shared_ptr<const FrictionTable>       table;
    std::shared_ptr<const ViscosityLaw>        law;
    LubricationSettings::BoundaryLayerPressure layer_pressure;
    double                                     phi_p_floor;
    double                                     greatest_gap; // of touching surfaces

    // the mesh: stations along x, node = station + n_stations * row
    std::vector<double>                  stations, profile;
    std::vector<Eigen::Vector3d>         nodes;
    std::vector<std::array<unsigned, 3>> triangles;
    std::vector<double>                  area; // of the nodes
    std::unique_ptr<FilmTransport>       film;
    std::size_t                          land_first = 0, land_last = 0; // stations

    /// State of the contact at a station for a given height of the tool.
    struct Station
    {
      FrictionTable::Film film;
      double              cut_height = 0, solid_pressure = 0;

      Station()
      {
        film.phi_p.setIdentity();
        film.phi_s.setZero();
      }
    };
    struct State
    {
      std::vector<Station>  station;
      FilmTransport::Result lubricant;
      std::vector<double>   viscosity; // of the nodes
      double                solid_load = 0, lubricant_load = 0;
      unsigned              film_iterations = 0;
    };

    double
    edge(const double distance) const
    {
      return geometry.edge_radius
             - std::sqrt(std::max(0., geometry.edge_radius * geometry.edge_radius - distance * distance));
    }

    double
    edge_length(const double rise) const
    {
      const double r = geometry.edge_radius;
      return rise < r ? std::sqrt(rise * (2. * r - rise)) : r;
    }

    /// Stations: denser towards the ends of the land, where pressure builds up and falls.
    void
    make_stations()
    {
      const unsigned n_inlet = geometry.n_along * 2 / 5, n_outlet = geometry.n_along / 5,
                     n_land = geometry.n_along - n_inlet - n_outlet;
      // A rounding that is lower than the gap asked for ends at its quarter circle.
      const double inlet  = 0.999 * edge_length(std::min(inlet_gap * greatest_gap, geometry.edge_radius)),
                   outlet = 0.999 * edge_length(std::min(outlet_gap * greatest_gap, geometry.edge_radius));
      for (unsigned i = 0; i < n_inlet; ++i)
        stations.push_back(-inlet * (1. - double(i) / n_inlet));
      land_first = stations.size();
      for (unsigned i = 0; i <= n_land; ++i)
        stations.push_back(0.5 * geometry.length * (1. - std::cos(M_PI * i / n_land)));
      stations[land_first] = 0;
      land_last            = stations.size() - 1;
      stations[land_last]  = geometry.length;
      for (unsigned i = 1; i <= n_outlet; ++i)
        stations.push_back(geometry.length + outlet * i / n_outlet);
      for (const double x : stations)
        {
          const double slope = geometry.inclination / geometry.length;
          const double tilt  = slope * (geometry.length - std::clamp(x, 0., geometry.length));
          profile.push_back(tilt + (x < 0 ? edge(x) : x > geometry.length ? edge(x - geometry.length) : 0.));
        }
    }

    void
    make_mesh()
    {
      const auto row = static_cast<unsigned>(stations.size());
      for (unsigned j = 0; j <= geometry.n_across; ++j)
        for (const double x : stations)
          nodes.emplace_back(x, geometry.width * j / geometry.n_across, 0.);
      for (unsigned j = 0; j < geometry.n_across; ++j)
        for (unsigned i = 0; i + 1 < row; ++i)
          {
            const unsigned p = j * row + i, q = p + 1, r = p + row, s = r + 1;
            if ((i + j) % 2 == 0)
              triangles.insert(triangles.end(), { { p, q, s }, { p, s, r } });
            else
              triangles.insert(triangles.end(), { { p, q, r }, { q, s, r } });
          }
      film = std::make_unique<FilmTransport>(nodes, triangles, phi_p_floor);
      // Trapezoidal rule in both directions: the area of the land is then exactly length times width.
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          const std::size_t i = k % row, j = k / row;
          const double      across = geometry.width / geometry.n_across * (j == 0 || j == geometry.n_across ? 0.5 : 1.);
          const double      before = i > 0 ? stations[i] - stations[i - 1] : 0.,
                       after       = i + 1 < row ? stations[i + 1] - stations[i] : 0.;
          area.push_back(0.5 * (before + after) * across);
        }
    }

    bool
    on_land(const std::size_t node) const
    {
      const std::size_t i = node % stations.size();
      return i >= land_first && i <= land_last;
    }

    /// Flattening along the way of the strip under a tool whose land ends at @p height above the mean plane.
    void
    flatten(const double height, const FlatteningCurve &curve, State &state) const
    {
      state.station.resize(stations.size());
      double lowest = 1e300, s = table->initial_cut_height;
      for (std::size_t i = 0; i < stations.size(); ++i)
        {
          Station     &station   = state.station[i];
          const double d         = height + profile[i];
          const bool   closing   = d <= lowest;
          station.solid_pressure = 0;
          if (closing && d < greatest_gap)
            {
              s                      = interpolate(table->curves.h_avg, table->curves.cut_height, d);
              station.solid_pressure = curve.pressure(s);
            }
          lowest             = std::min(lowest, d);
          station.cut_height = s;
          station.film       = table->film(s);
          if (station.solid_pressure > 0)
            station.film.h_avg = d; // the table's curve within round-off
          else
            station.film = lifted_film(station.film, d);
        }
    }

    double
    viscosity(const Station &station, const double speed, const double pressure) const
    {
      return law->viscosity(pressure, speed / station.film.h_avg).viscosity;
    }

    /// The film in the gap of the present stations.
    void
    fill(const Conditions &c, State &state) const
    {
      const std::size_t                    row = stations.size();
      std::vector<FilmTransport::NodeData> data(nodes.size());
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          const Station &station = state.station[k % row];
          auto          &d       = data[k];
          const bool     inlet = k % row == 0, outlet = k % row == row - 1;
          const bool     side = geometry.open_sides && (k < row || k >= nodes.size() - row);
          d.kind              = inlet || outlet || side ? FilmTransport::Kind::border : FilmTransport::Kind::film;
          d.film              = station.film.h_avg;
          d.phi_p             = station.film.phi_p;
          d.sq_phi_s          = table->sq * station.film.phi_s;
          d.sheet_velocity    = { c.speed, 0, 0 };
          if (inlet)
            {
              const std::size_t j = k / row;
              d.inflow            = c.supplied_film * c.speed * geometry.width / geometry.n_across
                         * (j == 0 || j == geometry.n_across ? 0.5 : 1.);
            }
        }
      state.viscosity.resize(nodes.size());
      const bool warm = state.lubricant.pressure.size() == nodes.size();
      for (unsigned iteration = 0; iteration < max_viscosity_iterations; ++iteration)
        {
          const std::vector<double> before = state.lubricant.pressure;
          for (std::size_t k = 0; k < nodes.size(); ++k)
            {
              state.viscosity[k] = viscosity(state.station[k % row], c.speed, before.empty() ? 0. : before[k]);
              data[k].viscosity  = state.viscosity[k];
            }
          state.lubricant
              = film->solve(nodes, data, FilmTransport::steady, warm || iteration > 0 ? &state.lubricant : nullptr);
          state.film_iterations += state.lubricant.iterations;
          if (!state.lubricant.converged)
            throw ConvergenceError(describe_error("The sets of full and starved points of the film did not settle",
                                                  "film of the strip contact", describe(c), "",
                                                  "Change 'Strip draw/Elements along' a little."));
          double change = 0, greatest = 0;
          for (std::size_t k = 0; k < nodes.size(); ++k)
            {
              change   = std::max(change, std::abs(state.lubricant.pressure[k] - (before.empty() ? 0. : before[k])));
              greatest = std::max(greatest, state.lubricant.pressure[k]);
            }
          if (change <= viscosity_tolerance * greatest || !depends_on_pressure(state, c))
            return;
        }
      throw ConvergenceError(describe_error("Pressure and viscosity of the film did not settle",
                                            "film of the strip contact", describe(c),
                                            std::to_string(max_viscosity_iterations) + " iterations at most",
                                            "Look at the pressure coefficient of 'Lubricant/Viscosity law'."));
    }

    bool
    depends_on_pressure(const State &state, const Conditions &c) const
    {
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (viscosity(state.station[k % stations.size()], c.speed, state.lubricant.pressure[k]) != state.viscosity[k])
          return true;
      return false;
    }

    static std::string
    describe(const Conditions &c)
    {
      return units::format(c.pressure, "MPa") + ", " + units::format(c.speed, "mm/s") + ", strain "
             + units::number(c.strain) + ", film " + units::format(c.supplied_film, "um");
    }

    /// Load per nominal area at a height of the tool.
    double
    carried(const double height, const FlatteningCurve &curve, const Conditions &c, State &state) const
    {
      flatten(height, curve, state);
      state.solid_load = state.lubricant_load = 0;
      if (c.speed > 0 && c.supplied_film > 0)
        fill(c, state);
      else
        {
          state.lubricant = {};
          state.lubricant.pressure.assign(nodes.size(), 0.);
          state.lubricant.fill.assign(nodes.size(), 0.);
          state.lubricant.outflow.assign(nodes.size(), 0.);
          state.viscosity.assign(nodes.size(), law->viscosity(0., 0.).viscosity);
        }
      const double nominal = geometry.length * geometry.width;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          state.solid_load += area[k] * state.station[k % stations.size()].solid_pressure / nominal;
          state.lubricant_load += area[k] * state.lubricant.pressure[k] / nominal;
        }
      return state.solid_load + state.lubricant_load;
    }

    /// The height at which the tool floats on asperities and film.
    double
    find_height(const FlatteningCurve &curve, const Conditions &c, State &state, unsigned &iterations) const
    {
      const auto excess = [&](const double height) {
        ++iterations;
        return carried(height, curve, c, state) - c.pressure;
      };
      double low = table->film(curve.s.front()).h_avg, high = greatest_gap;
      double f_low = excess(low);
      if (f_low < 0)
        throw InputError(describe_error(
            "The contact asks for a higher solid pressure than the friction table holds", "strip contact", describe(c),
            "solid pressures up to " + units::format(table->max_pressure(), "MPa"),
            "Extend 'Friction table/Pressures'; an inclined or rounded tool concentrates the load."));
      double f_high = excess(high);
      for (unsigned i = 0; f_high > 0; ++i)
        {
          if (i == max_widenings)
            throw ConvergenceError(
                describe_error("The film carries the tool at any height", "strip contact", describe(c)));
          low    = high;
          f_low  = f_high;
          f_high = excess(high *= 1.3);
        }
      std::uintmax_t steps  = max_load_iterations;
      const auto     result = boost::math::tools::toms748_solve(
              excess, low, high, f_low, f_high,
              [](const double a, const double b) { return std::abs(b - a) <= height_tolerance * std::abs(b); }, steps);
      return 0.5 * (result.first + result.second);
    }

    Result
    measure(const double height, const Conditions &c, const State &state) const
    {
      const std::size_t row = stations.size();
      Result            r;
      r.tool_height     = height;
      r.film_iterations = state.film_iterations;
      r.load_error      = std::abs(state.solid_load + state.lubricant_load - c.pressure) / c.pressure;
      r.solid_share     = state.solid_load / (state.solid_load + state.lubricant_load);
      r.lubricant_share = state.lubricant_load / (state.solid_load + state.lubricant_load);
      r.regime          = r.lubricant_share < negligible_share ? Result::Regime::boundary
                          : r.solid_share < negligible_share   ? Result::Regime::full_film
                                                               : Result::Regime::mixed;
      double solid = 0, viscous = 0, land = 0;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          const Station &station = state.station[k % row];
          const double   h       = station.film.h_avg;
          const double   p       = state.lubricant.pressure[k];
          solid += area[k] * solid_shear(station, p, c.strain);
          if (c.speed > 0 && c.supplied_film > 0)
            viscous += area[k] * (1. - station.film.contact_fraction) * bridged(station, state.lubricant.fill[k])
                       * (state.viscosity[k] * c.speed / h + 0.5 * h * slope(state.lubricant.pressure, k));
          r.max_lubricant_pressure = std::max(r.max_lubricant_pressure, p);
          if (!on_land(k))
            continue;
          const double part = land_area(k);
          land += part;
          r.mean_film += part * h;
          r.contact_fraction += part * station.film.contact_fraction * (station.solid_pressure > 0);
          r.starved_fraction += part * (state.lubricant.fill[k] < 1.);
        }
      const double load      = c.pressure * geometry.length * geometry.width;
      r.solid_friction       = solid / load;
      r.viscous_friction     = viscous / load;
      r.friction_coefficient = r.solid_friction + r.viscous_friction;
      r.mean_film /= land;
      r.contact_fraction /= land;
      r.starved_fraction /= land;
      r.film_ratio = r.mean_film / table->sq;
      add_flow(c, state, r);
      add_profile(state, r);
      return r;
    }

    /// Part of the gap in which lubricant reaches from the strip to the tool. Between touching asperities a film that
    /// does not fill the valleys lies at their bottom (the paper's boundary lubrication); in a gap wider than the
    /// asperities it is torn into streaks (cavitation).
    static double
    bridged(const Station &station, const double fill)
    {
      return fill >= 1. ? 1. : station.solid_pressure > 0 ? 0. : fill;
    }

    double
    solid_shear(const Station &station, const double lubricant_pressure, const double strain) const
    {
      if (!(station.solid_pressure > 0))
        return 0.;
      const double alpha = station.film.contact_fraction;
      const double total = station.solid_pressure + lubricant_pressure;
      const double p0    = alpha <= 0 ? 0.
                           : layer_pressure == LubricationSettings::BoundaryLayerPressure::nominal
                               ? total / alpha
                               : station.solid_pressure / alpha + lubricant_pressure;
      return table->solid_shear(station.cut_height, station.solid_pressure, p0, strain);
    }

    /// d p/d x at a node.
    double
    slope(const std::vector<double> &p, const std::size_t k) const
    {
      const std::size_t row = stations.size(), i = k % row;
      const std::size_t a = i > 0 ? k - 1 : k, b = i + 1 < row ? k + 1 : k;
      return (p[b] - p[a]) / (nodes[b][0] - nodes[a][0]);
    }

    /// The part of a node's area that belongs to the land.
    double
    land_area(const std::size_t k) const
    {
      const std::size_t i      = k % stations.size();
      const double      before = i > land_first ? stations[i] - stations[i - 1] : 0.,
                   after       = i < land_last ? stations[i + 1] - stations[i] : 0.;
      const double along       = stations[i + 1] - stations[i - 1];
      return area[k] * (before + after) / along;
    }

    void
    add_flow(const Conditions &c, const State &state, Result &r) const
    {
      if (!(c.speed > 0 && c.supplied_film > 0))
        return;
      const std::size_t row = stations.size();
      r.flow_in             = c.supplied_film * c.speed * geometry.width;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          const double out = state.lubricant.outflow[k];
          if (k % row == 0)
            r.rejected += out;
          else if (k % row == row - 1)
            r.flow_out += out;
          else
            r.flow_sides += out;
        }
      r.flow_error = std::abs(r.flow_in - r.rejected - r.flow_out - r.flow_sides) / r.flow_in;
    }

    void
    add_profile(const State &state, Result &r) const
    {
      const std::size_t row = stations.size(), first = row * (geometry.n_across / 2);
      r.profile.x = stations;
      for (std::size_t i = 0; i < row; ++i)
        {
          const Station &station = state.station[i];
          r.profile.gap.push_back(station.film.h_avg);
          r.profile.solid_pressure.push_back(station.solid_pressure);
          r.profile.lubricant_pressure.push_back(state.lubricant.pressure[first + i]);
          r.profile.fill.push_back(state.lubricant.fill[first + i]);
          r.profile.contact_fraction.push_back(station.solid_pressure > 0 ? station.film.contact_fraction : 0.);
        }
    }
  };

  StripContact::StripContact(const Geometry &geometry, std::shared_ptr<const FrictionTable> table,
                             std::shared_ptr<const ViscosityLaw>              law,
                             const LubricationSettings::BoundaryLayerPressure boundary_layer_pressure,
                             const double                                     phi_p_floor)
      : data(std::make_unique<Implementation>())
  {
    data->geometry       = geometry;
    data->table          = std::move(table);
    data->law            = std::move(law);
    data->layer_pressure = boundary_layer_pressure;
    data->phi_p_floor    = phi_p_floor;
    data->greatest_gap   = data->table->film(data->table->initial_cut_height).h_avg;
    data->make_stations();
    data->make_mesh();
  }

  StripContact::~StripContact() = default;

  StripContact::Result
  StripContact::solve(const Conditions &c) const
  {
    const timing::Scope timer("lubrication/strip contact");
    if (!(c.pressure > 0) || !(c.speed >= 0) || !(c.strain >= 0) || !(c.supplied_film >= 0))
      throw InputError(describe_error("The conditions of the strip contact are not physical", "strip contact",
                                      Implementation::describe(c), "pressure above zero, the others zero or more"));
    if (c.strain > data->table->max_strain())
      throw InputError(describe_error("The strain lies beyond the friction table", "strip contact",
                                      units::number(c.strain), "up to " + units::number(data->table->max_strain()),
                                      "Extend 'Friction table/Strains'."));
    const FlatteningCurve curve(*data->table, c.strain);
    Implementation::State state;
    unsigned              iterations = 0;
    const double          height     = data->find_height(curve, c, state, iterations);
    data->carried(height, curve, c, state);
    Result result          = data->measure(height, c, state);
    result.load_iterations = iterations;
    return result;
  }
} // namespace tribodraw
