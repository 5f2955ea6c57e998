#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/lubrication/average_reynolds.h>
#include <tribodraw/lubrication/prescribed_film.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    // Width of the elements that carry a jump of the gap, in parts of the length: its error in the load is of this
    // order.
    constexpr double jump_width = 1e-7;
    // Pressure and viscosity in turn: a contraction for all but pathological films.
    constexpr unsigned max_viscosity_iterations = 100;
    constexpr double   viscosity_tolerance      = 1e-10; // of the largest pressure
  }                                                      // namespace

  PrescribedFilm::PrescribedFilm(Parameters &parameters)
  {
    {
      const auto scope = parameters.section("Gap");
      shape            = parameters.model<GapShape>("Model", "Shape of the prescribed gap.");
      open_sides
          = parameters.choice("Sides", { "pressure zero", "no flow" },
                              "What happens at y = 0 and y = width. `no flow` makes a bearing of infinite width.")
            == "pressure zero";
      n_along         = static_cast<unsigned>(parameters.integer("Elements along", Range::between(2, 5000),
                                                                 "Elements along the direction of sliding.",
                                                                 Default{ "120", "error of the load below 0.1 %" }));
      n_across        = static_cast<unsigned>(parameters.integer("Elements across", Range::between(1, 5000),
                                                                 "Elements across the direction of sliding.",
                                                                 Default{ "60", "error of the load below 0.1 %" }));
      pressure_factor = parameters.quantity_list("Pressure factor", "", Range::positive().usual(1e-3, 10),
                                                 "Constant pressure flow factor along x and y.",
                                                 Default{ "1, 1", "smooth surfaces" });
      sheared_film    = parameters.quantity("Shear factor times Sq", "um", Range::any().usual(-100, 100),
                                            "Constant product of shear flow factor and Sq along x.",
                                            Default{ "0 um", "smooth surfaces" });
      if (pressure_factor.size() != 2 && !parameters.documentation_mode())
        parameters.problem("Pressure factor", "Two values are needed.", "one along x, one along y");
    }
    {
      const auto scope = parameters.section("Process");
      sheet_speed      = parameters.quantity("Sheet speed", "mm/s", Range::any().usual(-1e5, 1e5),
                                             "Velocity of the flat lower surface along x.");
      tool_speed       = parameters.quantity("Tool speed", "mm/s", Range::any().usual(-1e5, 1e5),
                                             "Velocity of the upper surface along x. The gap is steady, so this is a surface "
                                                   "that moves in itself.",
                                             Default{ "0 mm/s", "a tool at rest" });
    }
    const auto   scope     = parameters.section("Lubricant");
    const double viscosity = parameters.quantity(
        "Viscosity", "mPa s", Range::positive().usual(0.5, 5000),
        "Dynamic viscosity of the lubricant at ambient pressure and at the temperature of the process.");
    auto law = parameters.model<ViscosityLaw>(
        "Viscosity law", "How the viscosity depends on pressure and shear rate.",
        Default{ "constant", "needs no constants beside the viscosity, and is what the paper uses" });
    if (law)
      law->set_reference_viscosity(viscosity);
    viscosity_law = std::move(law);
  }

  std::vector<double>
  PrescribedFilm::lines_along() const
  {
    const double        l = shape->length(), size = l / n_along;
    std::vector<double> corners{ 0. };
    for (const double x : shape->jumps())
      {
        corners.push_back(x - 0.5 * jump_width * l);
        corners.push_back(x + 0.5 * jump_width * l);
      }
    corners.push_back(l);
    std::vector<double> lines{ 0. };
    for (std::size_t k = 0; k + 1 < corners.size(); ++k)
      {
        const double a = corners[k], b = corners[k + 1];
        const auto   n = std::max(1l, std::lround((b - a) / size));
        for (long i = 1; i <= n; ++i)
          lines.push_back(i == n ? b : a + (b - a) * i / n);
      }
    return lines;
  }

  void
  PrescribedFilm::make_mesh(Result &result) const
  {
    const std::vector<double> lines = lines_along();
    const auto                row   = static_cast<unsigned>(lines.size());
    for (unsigned j = 0; j <= n_across; ++j)
      for (const double x : lines)
        {
          const double y = shape->width() * j / n_across;
          result.nodes.emplace_back(x, y, 0.);
          result.film.push_back(shape->gap(x, y));
        }
    for (unsigned j = 0; j < n_across; ++j)
      for (unsigned i = 0; i + 1 < row; ++i)
        {
          // Diagonals alternate, so that the mesh prefers no direction.
          const unsigned p = j * row + i, q = p + 1, r = p + row, s = r + 1;
          if ((i + j) % 2 == 0)
            result.triangles.insert(result.triangles.end(), { { p, q, s }, { p, s, r } });
          else
            result.triangles.insert(result.triangles.end(), { { p, q, r }, { q, s, r } });
        }
  }

  PrescribedFilm::Result
  PrescribedFilm::solve() const
  {
    Result result;
    make_mesh(result);
    const std::size_t n = result.nodes.size();
    for (const double h : result.film)
      if (!(h > 0))
        throw InputError(describe_error("The gap is closed somewhere", "Gap", units::number(h) + " mm", "above zero"));

    std::vector<AverageReynolds::NodeData> data(n);
    for (std::size_t i = 0; i < n; ++i)
      {
        const double x = result.nodes[i][0], y = result.nodes[i][1];
        auto        &d   = data[i];
        d.fixed          = x == 0. || x == shape->length() || (open_sides && (y == 0. || y == shape->width()));
        d.film           = result.film[i];
        d.phi_p          = Eigen::Vector2d(pressure_factor[0], pressure_factor[1]).asDiagonal();
        d.sq_phi_s       = Eigen::Vector2d(sheared_film, 0.).asDiagonal();
        d.sheet_velocity = { sheet_speed, 0., 0. };
        d.tool_velocity  = { tool_speed, 0., 0. };
      }

    // The range of the entry keeps the factors above zero: no floor is needed.
    const AverageReynolds   reynolds(result.nodes, result.triangles, 0.);
    AverageReynolds::Result film;
    result.pressure.assign(n, 0.);
    double change = 1;
    for (unsigned iteration = 1; iteration <= max_viscosity_iterations && change > viscosity_tolerance; ++iteration)
      {
        bool piezoviscous = false;
        for (std::size_t i = 0; i < n; ++i)
          {
            const double shear_rate = std::abs(sheet_speed - tool_speed) / result.film[i];
            const auto   eta        = viscosity_law->viscosity(result.pressure[i], shear_rate);
            data[i].viscosity       = eta.viscosity;
            piezoviscous            = piezoviscous || eta.pressure_slope != 0;
          }
        film = reynolds.solve(result.nodes, data, film.pressure);
        if (!film.converged)
          throw ConvergenceError(describe_error("The active set of the film did not settle", "task film"));
        double largest = 0, largest_change = 0;
        for (std::size_t i = 0; i < n; ++i)
          {
            largest        = std::max(largest, film.pressure[i]);
            largest_change = std::max(largest_change, std::abs(film.pressure[i] - result.pressure[i]));
          }
        result.pressure             = film.pressure;
        result.viscosity_iterations = iteration;
        change                      = piezoviscous && largest > 0 ? largest_change / largest : 0.;
      }
    if (change > viscosity_tolerance)
      throw ConvergenceError(describe_error(
          "Pressure and viscosity did not settle", "task film, largest change of the pressure in the last step",
          units::number(change), "below " + units::number(viscosity_tolerance),
          "The viscosity rises too steeply with pressure: check the viscosity law, the film and the speed."));

    result.active_set_iterations = film.iterations;
    result.flux_imbalance        = film.flux_imbalance;
    result.load                  = reynolds.load(result.nodes, result.pressure);
    find_flow(result, film.outflow);
    find_friction(result);
    return result;
  }

  void
  PrescribedFilm::find_flow(Result &result, const std::vector<double> &outflow) const
  {
    double open = 0, cavitated = 0;
    for (std::size_t i = 0; i < result.nodes.size(); ++i)
      {
        const double x = result.nodes[i][0], y = result.nodes[i][1], p = result.pressure[i];
        if (x == 0.)
          result.flow_in -= outflow[i];
        else if (x == shape->length())
          result.flow_out += outflow[i];
        else if (open_sides && (y == 0. || y == shape->width()))
          result.flow_sides += outflow[i];
        else
          {
            open += 1;
            cavitated += p <= 0.;
          }
        if (p > result.max_pressure)
          {
            result.max_pressure = p;
            result.x_max        = x;
            result.y_max        = y;
          }
      }
    result.cavitated_fraction = open > 0 ? cavitated / open : 0.;
  }

  void
  PrescribedFilm::find_friction(Result &result) const
  {
    for (const auto &t : result.triangles)
      {
        const Eigen::Vector3d a = result.nodes[t[1]] - result.nodes[t[0]], b = result.nodes[t[2]] - result.nodes[t[0]];
        const double          twice_area = a.cross(b)[2];
        const double          slope      = ((result.pressure[t[1]] - result.pressure[t[0]]) * b[1]
                              - (result.pressure[t[2]] - result.pressure[t[0]]) * a[1])
                             / twice_area;
        // Eqs. 17 and 18 at the middles of the sides (exact for quadratic functions).
        for (unsigned k = 0; k < 3; ++k)
          {
            const unsigned i = t[k], j = t[(k + 1) % 3];
            const double   h       = 0.5 * (result.film[i] + result.film[j]);
            const double   p       = 0.5 * (result.pressure[i] + result.pressure[j]);
            const double   eta     = viscosity_law->viscosity(p, std::abs(sheet_speed - tool_speed) / h).viscosity;
            const double   couette = eta * (sheet_speed - tool_speed) / h, poiseuille = 0.5 * h * slope;
            result.friction_sheet += twice_area / 6. * (couette + poiseuille);
            result.friction_tool += twice_area / 6. * (couette - poiseuille);
          }
      }
  }

  CsvTable
  PrescribedFilm::table(const Result &r) const
  {
    CsvTable   table({ "quantity", "value", "unit" });
    const auto row = [&table](const std::string &name, const double value, const std::string &unit) {
      table.add_row({ name, value, unit });
    };
    row("load", r.load, "N");
    row("load_per_width", r.load / shape->width(), "N/mm");
    row("max_pressure", r.max_pressure, "MPa");
    row("max_pressure_x", r.x_max, "mm");
    row("max_pressure_y", r.y_max, "mm");
    row("flow_in", r.flow_in, "mm^3/s");
    row("flow_out", r.flow_out, "mm^3/s");
    row("flow_sides", r.flow_sides, "mm^3/s");
    row("friction_sheet", r.friction_sheet, "N");
    row("friction_tool", r.friction_tool, "N");
    row("friction_coefficient", r.load > 0 ? r.friction_sheet / r.load : 0., "");
    row("cavitated_node_fraction", r.cavitated_fraction, "");
    row("flux_imbalance", r.flux_imbalance, "");
    row("nodes", static_cast<double>(r.nodes.size()), "");
    row("active_set_iterations", r.active_set_iterations, "");
    row("viscosity_iterations", r.viscosity_iterations, "");
    return table;
  }

  std::string
  PrescribedFilm::describe() const
  {
    return "Film in a prescribed gap of " + units::number(shape->length()) + " x " + units::number(shape->width())
           + " mm, " + std::to_string(n_along) + " x " + std::to_string(n_across) + " squares of two triangles, sides "
           + (open_sides ? "open" : "closed") + ".";
  }
} // namespace tribodraw
