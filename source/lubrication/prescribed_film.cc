#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/lubrication/average_reynolds.h>
#include <tribodraw/lubrication/prescribed_film.h>
#include <tribodraw/shell/blank_mesh.h>

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
    // Growth of the elements away from a jump of the gap, if they are smaller there.
    constexpr double growth = 1.04;
    // A film that carries negative pressure is solved at this multiple of its greatest pressure above zero.
    constexpr double shift_factor = 100;
    // Gaps at which the time of fall is integrated; the integrand is constant for parallel surfaces.
    constexpr unsigned n_fall = 8;

    /// Stations from a (left out) to b, smaller elements at a graded end.
    std::vector<double>
    graded(const double a, const double b, const double size, const double smallest, const bool at_a, const bool at_b)
    {
      const double        middle = 0.5 * (a + b);
      std::vector<double> left, right;
      for (double s = smallest * size, x = a + s; at_a && s < size && x < middle; s = std::min(size, s * growth), x += s)
        left.push_back(x);
      for (double s = smallest * size, x = b - s; at_b && s < size && x > middle; s = std::min(size, s * growth), x -= s)
        right.push_back(x);
      const double from = left.empty() ? a : left.back(), to = right.empty() ? b : right.back();
      const auto   n    = std::max(1l, std::lround((to - from) / size));
      for (long i = 1; i <= n; ++i)
        left.push_back(i == n ? to : from + (to - from) * i / n);
      if (!right.empty())
        {
          right.pop_back();
          left.insert(left.end(), right.rbegin(), right.rend());
          left.push_back(b);
        }
      return left;
    }
  } // namespace

  struct PrescribedFilm::Solver
  {
    std::unique_ptr<AverageReynolds> reynolds;
    std::unique_ptr<FilmTransport>   transport;
  };

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
      smallest_element = parameters.quantity(
          "Smallest element at jumps", "", Range{ 0., 1., true }.usual(1e-4, 1),
          "Size of the elements at a jump of the gap in parts of the others; they grow by 4 % from one to the next.",
          Default{ "1", "only a film that ruptures or reforms close to a jump needs smaller ones" });
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
      approach = parameters.quantity("Approach speed", "mm/s", Range::any().usual(-1e4, 1e4),
                                     "Velocity of the upper surface towards the lower one (squeeze film).",
                                     Default{ "0 mm/s", "a steady gap" });
      ambient  = parameters.quantity("Ambient pressure", "MPa", Range::non_negative().usual(0, 10),
                                     "Pressure at the open ends and sides above that of the cavitated film.",
                                     Default{ "0 MPa", "small against pressures in bearings" });
      read_cavitation(parameters);
      fall_load = parameters.quantity("Load", "N", Range::non_negative(),
                                      "Asks for the time in which this load brings the surfaces down to `Final gap`.",
                                      Default{ "0 N", "no fall" });
      final_gap = parameters.quantity("Final gap", "um", Range::non_negative(),
                                      "Least gap at the end of the fall.", Default{ "0 um", "no fall" });
      if ((fall_load > 0) != (final_gap > 0) && !parameters.has_problems() && !parameters.documentation_mode())
        parameters.problem(fall_load > 0 ? "Final gap" : "Load", "A fall needs both a load and a final gap.", "more than zero");
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

  void
  PrescribedFilm::read_cavitation(Parameters &parameters)
  {
    const std::vector<std::string> names{ "Reynolds", "mass conserving", "cut off", "none" };
    const std::string              name = parameters.choice(
        "Cavitation", names,
        "What happens where the pressure would be negative. `Reynolds`: p >= 0 without gradient where the film ruptures. "
                     "`mass conserving`: also the partly filled film is computed (Jakobsson, Floberg, Olsson; Elrod). `none`: "
                     "negative pressure is carried (Sommerfeld). `cut off`: it is set to zero afterwards (half Sommerfeld).",
        Default{ "Reynolds", "the right load without the cost of the partly filled film" });
    cavitation = name == "mass conserving" ? Cavitation::mass_conserving
                 : name == "cut off"       ? Cavitation::cut_off
                 : name == "none"          ? Cavitation::none
                                           : Cavitation::reynolds;
    if (cavitation == Cavitation::mass_conserving && approach != 0 && !parameters.documentation_mode())
      parameters.problem("Cavitation", "The mass-conserving film is computed in the steady state.",
                         "another choice with an `Approach speed`");
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
        const auto part = graded(corners[k], corners[k + 1], size, smallest_element, k > 0, k + 2 < corners.size());
        lines.insert(lines.end(), part.begin(), part.end());
      }
    return lines;
  }

  void
  PrescribedFilm::make_mesh(Result &result) const
  {
    const double radius = shape->disc_radius(), l = shape->length(), b = shape->width();
    if (radius > 0)
      {
        const BlankMesh disc = make_disc(radius, SizeField{ l / n_along, {}, 0.3 }, false);
        result.nodes         = disc.nodes;
        result.triangles     = disc.triangles;
        result.open          = disc.on_outer_edge;
      }
    else
      {
        make_rectangle(result);
        for (const auto &x : result.nodes)
          result.open.push_back(x[0] == 0. || x[0] == l || (open_sides && (x[1] == 0. || x[1] == b)));
      }
    for (const auto &x : result.nodes)
      result.film.push_back(shape->gap(x[0], x[1]));
  }

  void
  PrescribedFilm::make_rectangle(Result &result) const
  {
    const std::vector<double> lines = lines_along();
    const auto                row   = static_cast<unsigned>(lines.size());
    for (unsigned j = 0; j <= n_across; ++j)
      for (const double x : lines)
        result.nodes.emplace_back(x, shape->width() * j / n_across, 0.);
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

  std::vector<FilmTransport::NodeData>
  PrescribedFilm::make_data(const Result &result) const
  {
    std::vector<FilmTransport::NodeData> data(result.nodes.size());
    for (std::size_t i = 0; i < data.size(); ++i)
      {
        auto &d          = data[i];
        d.fixed          = result.open[i];
        d.kind           = d.fixed ? FilmTransport::Kind::reservoir : FilmTransport::Kind::film;
        d.fixed_pressure = ambient;
        d.film           = result.film[i];
        d.phi_p          = Eigen::Vector2d(pressure_factor[0], pressure_factor[1]).asDiagonal();
        d.sq_phi_s       = Eigen::Vector2d(sheared_film, 0.).asDiagonal();
        d.sheet_velocity = { sheet_speed, 0., 0. };
        d.tool_velocity  = { tool_speed, 0., 0. };
        d.squeeze        = -approach;
      }
    return data;
  }

  /// So much above zero that no pressure of the film becomes negative: the greatest pressures of sliders and squeeze
  /// films of these measures, and a large factor.
  double
  PrescribedFilm::pressure_shift(const Result &result) const
  {
    if (cavitation != Cavitation::none && cavitation != Cavitation::cut_off)
      return 0.;
    const double h = *std::min_element(result.film.begin(), result.film.end()), l = shape->length();
    const double slide   = std::abs(sheet_speed) + std::abs(tool_speed);
    const double squeeze = 2. * std::abs(approach) * l / h;
    return shift_factor * 6. * viscosity_law->reference_viscosity() * (slide + squeeze) * l / (h * h)
           / std::min(pressure_factor[0], pressure_factor[1]);
  }

  PrescribedFilm::Result
  PrescribedFilm::solve(const Watcher &watcher) const
  {
    Result result;
    make_mesh(result);
    for (const double h : result.film)
      if (!(h > 0))
        throw InputError(describe_error("The gap is closed somewhere", "Gap", units::number(h) + " mm", "above zero"));
    // The range of the entry keeps the factors above zero: no floor is needed.
    Solver solver;
    if (cavitation == Cavitation::mass_conserving)
      solver.transport = std::make_unique<FilmTransport>(result.nodes, result.triangles, 0.);
    else
      solver.reynolds = std::make_unique<AverageReynolds>(result.nodes, result.triangles, 0.);
    Pass pass;
    pass.n_gaps = fall_load > 0 ? n_fall + 2 : 1;
    solve_film(solver, result, pass, watcher);
    find_load(result);
    find_friction(result);
    if (fall_load > 0)
      result.fall_time = find_fall_time(solver, result, watcher);
    return result;
  }

  void
  PrescribedFilm::solve_film(const Solver &solver, Result &result, Pass pass, const Watcher &watcher) const
  {
    const std::size_t       n     = result.nodes.size();
    const double            shift = pressure_shift(result);
    auto                    data  = make_data(result);
    AverageReynolds::Result film;
    FilmTransport::Result   transported;
    result.pressure.assign(n, ambient);
    result.fill.assign(n, 1.);
    pass.least_gap = *std::min_element(result.film.begin(), result.film.end());
    double change  = 1;
    for (unsigned iteration = 1; iteration <= max_viscosity_iterations && change > viscosity_tolerance; ++iteration)
      {
        bool piezoviscous = false;
        for (std::size_t i = 0; i < n; ++i)
          {
            const double shear_rate = std::abs(sheet_speed - tool_speed) / result.film[i];
            const auto   eta        = viscosity_law->viscosity(std::max(0., result.pressure[i]), shear_rate);
            data[i].viscosity       = eta.viscosity;
            data[i].fixed_pressure  = ambient + shift;
            piezoviscous            = piezoviscous || eta.pressure_slope != 0;
          }
        bool converged;
        if (solver.transport)
          {
            transported = solver.transport->solve(result.nodes, data, FilmTransport::steady,
                                                  iteration > 1 ? &transported : nullptr);
            film.pressure       = transported.pressure;
            film.outflow        = transported.outflow;
            film.iterations     = transported.iterations;
            result.fill         = transported.fill;
            result.volume_error = transported.volume_error;
            converged           = transported.converged;
          }
        else
          {
            film      = solver.reynolds->solve(result.nodes, { data.begin(), data.end() }, film.pressure);
            converged = film.converged;
          }
        if (!converged)
          throw ConvergenceError(describe_error("The active set of the film did not settle", "task film"));
        double largest = 0, largest_change = 0;
        for (std::size_t i = 0; i < n; ++i)
          {
            const double p = film.pressure[i] - shift;
            largest        = std::max(largest, std::abs(p));
            largest_change = std::max(largest_change, std::abs(p - result.pressure[i]));
            result.pressure[i] = p;
          }
        result.viscosity_iterations = iteration;
        change                      = piezoviscous && largest > 0 ? largest_change / largest : 0.;
        pass.number                 = iteration;
        pass.active_set_iterations  = film.iterations;
        pass.change                 = change;
        pass.settled                = change <= viscosity_tolerance;
        if (watcher)
          watcher(pass, result);
      }
    if (change > viscosity_tolerance)
      throw ConvergenceError(describe_error(
          "Pressure and viscosity did not settle", "task film, largest change of the pressure in the last step",
          units::number(change), "below " + units::number(viscosity_tolerance),
          "The viscosity rises too steeply with pressure: check the viscosity law, the film and the speed."));
    if (cavitation == Cavitation::cut_off)
      for (double &p : result.pressure)
        p = std::max(0., p);
    result.active_set_iterations = film.iterations;
    result.flux_imbalance        = film.flux_imbalance;
    find_flow(result, film.outflow);
  }

  /// Resultant of the pressure, and how far it is turned from the line to the narrowest gap of a journal.
  void
  PrescribedFilm::find_load(Result &result) const
  {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    for (const auto &t : result.triangles)
      {
        const Eigen::Vector3d a = result.nodes[t[1]] - result.nodes[t[0]], b = result.nodes[t[2]] - result.nodes[t[0]];
        const double          twice_area = a.cross(b)[2];
        // Linear pressure and direction at the middles of the sides.
        for (unsigned k = 0; k < 3; ++k)
          {
            const unsigned i = t[k], j = t[(k + 1) % 3];
            const double   angle = shape->direction(0.5 * (result.nodes[i][0] + result.nodes[j][0]));
            force += twice_area / 12. * (result.pressure[i] + result.pressure[j])
                     * Eigen::Vector2d(std::cos(angle), std::sin(angle));
          }
      }
    result.load     = force.norm();
    result.attitude = shape->direction(shape->length()) > 0 ? std::atan2(std::abs(force[1]), -force[0]) : 0.;
  }

  /// t = int (load per approach speed)/(load) dh from the final to the present least gap, by the variable 1/h^2 in which
  /// the integrand of parallel surfaces is constant (Simpson's rule).
  double
  PrescribedFilm::find_fall_time(const Solver &solver, Result film, const Watcher &watcher) const
  {
    const std::vector<double> start = film.film;
    const double              high = *std::min_element(start.begin(), start.end()), low = final_gap;
    if (!(low < high))
      throw InputError(describe_error("The final gap of the fall is not below the first one", "Process/Final gap",
                                      units::format(low, "um"), "below " + units::format(high, "um")));
    PrescribedFilm falling = *this;
    falling.sheet_speed = falling.tool_speed = falling.ambient = 0;
    falling.approach                                           = 1;
    const double from = 1. / (high * high), to = 1. / (low * low);
    double       time = 0;
    for (unsigned k = 0; k <= n_fall; ++k)
      {
        const double u = from + (to - from) * k / n_fall, h = 1. / std::sqrt(u);
        for (std::size_t i = 0; i < start.size(); ++i)
          film.film[i] = start[i] - (high - h);
        Pass pass;
        pass.gap    = k + 1;
        pass.n_gaps = n_fall + 2;
        falling.solve_film(solver, film, pass, watcher);
        falling.find_load(film);
        const double weight = k == 0 || k == n_fall ? 1. : k % 2 == 1 ? 4. : 2.;
        time += weight * film.load / fall_load * 0.5 * std::pow(u, -1.5);
      }
    return time * (to - from) / n_fall / 3.;
  }

  void
  PrescribedFilm::find_flow(Result &result, const std::vector<double> &outflow) const
  {
    const bool disc = shape->disc_radius() > 0;
    double     free = 0, cavitated = 0;
    result.flow_in = result.flow_out = result.flow_sides = result.max_pressure = 0;
    for (std::size_t i = 0; i < result.nodes.size(); ++i)
      {
        const double x = result.nodes[i][0], p = result.pressure[i];
        if (!result.open[i])
          {
            free += 1;
            cavitated += p <= 0.;
          }
        else if (!disc && x == 0.)
          result.flow_in -= outflow[i];
        else if (!disc && x == shape->length())
          result.flow_out += outflow[i];
        else
          result.flow_sides += outflow[i];
        if (p > result.max_pressure)
          {
            result.max_pressure = p;
            result.x_max        = x;
            result.y_max        = result.nodes[i][1];
          }
      }
    result.cavitated_fraction = free > 0 ? cavitated / free : 0.;
    result.rupture_x          = disc ? 0. : shape->length();
    for (std::size_t i = 0; i < result.nodes.size(); ++i)
      if (const double x = result.nodes[i][0];
          !disc && x > result.x_max && result.nodes[i][1] == result.y_max && result.pressure[i] <= 0.)
        result.rupture_x = std::min(result.rupture_x, x);
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
    row("attitude", r.attitude * 180. / M_PI, "deg");
    row("max_pressure", r.max_pressure, "MPa");
    row("max_pressure_x", r.x_max, "mm");
    row("max_pressure_y", r.y_max, "mm");
    row("rupture_x", r.rupture_x, "mm");
    row("flow_in", r.flow_in, "mm^3/s");
    row("flow_out", r.flow_out, "mm^3/s");
    row("flow_sides", r.flow_sides, "mm^3/s");
    row("friction_sheet", r.friction_sheet, "N");
    row("friction_tool", r.friction_tool, "N");
    row("friction_coefficient", r.load > 0 ? r.friction_sheet / r.load : 0., "");
    row("cavitated_node_fraction", r.cavitated_fraction, "");
    row("flux_imbalance", r.flux_imbalance, "");
    row("volume_error", r.volume_error, "");
    if (fall_load > 0)
      row("fall_time", r.fall_time, "s");
    row("nodes", static_cast<double>(r.nodes.size()), "");
    row("active_set_iterations", r.active_set_iterations, "");
    row("viscosity_iterations", r.viscosity_iterations, "");
    return table;
  }

  std::string
  PrescribedFilm::describe() const
  {
    if (shape->disc_radius() > 0)
      return "Film between discs of radius " + units::number(shape->disc_radius()) + " mm.";
    return "Film in a prescribed gap of " + units::number(shape->length()) + " x " + units::number(shape->width())
           + " mm, " + std::to_string(n_along) + " x " + std::to_string(n_across) + " squares of two triangles, sides "
           + (open_sides ? "open" : "closed") + ".";
  }
} // namespace tribodraw
