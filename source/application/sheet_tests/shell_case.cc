#include "shell_case.h"

#include <tribodraw/base/errors.h>

#include <deal.II/base/function_parser.h>

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <optional>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    const std::vector<std::string> side_names{ "u min", "u max", "v min", "v max" }, axis_names{ "x", "y", "z" };
    constexpr unsigned             largest_number = 9; ///< of numbered sections

    unsigned
    position_of(const std::vector<std::string> &names, const std::string &name)
    {
      for (unsigned k = 0; k < names.size(); ++k)
        if (names[k] == name)
          return k;
      return 0;
    }

    ShellCase::Side
    read_side(Parameters &p, const std::string &documentation)
    {
      return static_cast<ShellCase::Side>(position_of(side_names, p.choice("Side", side_names, documentation)));
    }

    Vector3d
    read_vector(Parameters &p, const std::string &entry, const std::string &unit, const std::string &documentation,
                const std::optional<Default> &default_value = {})
    {
      const std::vector<double> values
          = p.quantity_list(entry, unit, Range::between(-1e9, 1e9), documentation, default_value);
      if (values.size() != 3)
        {
          if (!p.documentation_mode())
            p.problem(entry, "expected three numbers, found " + std::to_string(values.size()) + ".", "x, y, z");
          return Vector3d::Zero();
        }
      return { values[0], values[1], values[2] };
    }

    /// Visit the sections `<name> 1`, `<name> 2` ... that the file has (the first for the documentation).
    template <class Function>
    void
    for_each_section(Parameters &p, const std::string &name, const Function &read)
    {
      for (unsigned k = 1; k <= largest_number; ++k)
        {
          const std::string numbered = name + " " + std::to_string(k);
          if (p.documentation_mode() ? k > 1 : !p.has_section(numbered))
            return;
          const auto scope = p.section(numbered);
          read();
        }
    }

    std::shared_ptr<dealii::FunctionParser<2>>
    parse(const std::array<std::string, 3> &expression)
    {
      auto parser = std::make_shared<dealii::FunctionParser<2>>(3);
      parser->initialize("u,v", std::vector<std::string>(expression.begin(), expression.end()),
                         std::map<std::string, double>{ { "pi", 3.14159265358979323846 } });
      return parser;
    }

    Vector3d
    evaluate(const dealii::FunctionParser<2> &parser, const double u, const double v)
    {
      const dealii::Point<2> point(u, v);
      return { parser.value(point, 0), parser.value(point, 1), parser.value(point, 2) };
    }

    std::array<double, 2>
    read_range(Parameters &p, const std::string &name)
    {
      const std::vector<double> range = p.quantity_list(name + " range", "", Range::between(-1e9, 1e9),
                                                        "First and last value of the parameter " + name + ".");
      if (p.documentation_mode())
        return { { 0, 1 } };
      if (range.size() != 2 || !(range[1] > range[0]))
        {
          p.problem(name + " range", "expected two numbers in ascending order.");
          return { { 0, 1 } };
        }
      return { { range[0], range[1] } };
    }

    /// The entry of a coordinate: `X position`.
    std::string
    entry_of(const unsigned axis)
    {
      return std::string(1, "XYZ"[axis]) + " position";
    }

    void
    check_expression(Parameters &p, const std::string &entry, const std::string &expression, const double u,
                     const double v)
    {
      constexpr double largest = 1e9; // mm
      if (expression.empty())
        return; // missing, which is a problem already
      try
        {
          const double x = evaluate(*parse({ { expression, "0", "0" } }), u, v)[0];
          if (!(std::abs(x) <= largest))
            p.problem(entry, "the position in the middle of the surface is not finite or too large.");
        }
      catch (const std::exception &)
        {
          p.problem(entry, "`" + expression + "` cannot be evaluated.", "an expression of u and v in mm, without unit",
                    "Write products with *, powers with ^.");
        }
    }

    ShellCase::Surface
    read_surface_of_shell(Parameters &p)
    {
      ShellCase::Surface surface;
      for (unsigned k = 0; k < 3; ++k)
        surface.expression[k]
            = p.text(entry_of(k), "Coordinate " + axis_names[k]
                                      + " of the mid-surface in mm, an expression of u and v (angles in rad; sin, "
                                        "cos, sqrt, if(condition, a, b) and so on; pi).");
      surface.u_range = read_range(p, "U");
      surface.v_range = read_range(p, "V");
      surface.n_u     = static_cast<unsigned>(p.integer("U elements", Range::between(1, 2000), "Squares along u."));
      surface.n_v     = static_cast<unsigned>(p.integer(
              "V elements", Range::between(1, 2000), "Squares along v; with the pattern polar, sides of the first ring."));
      const std::vector<std::string> patterns{ "alternating", "uniform", "crossed", "polar" };
      surface.pattern = static_cast<GridPattern>(position_of(
          patterns,
          p.choice("Pattern", patterns,
                   "How the squares are cut into triangles: by diagonals of alternating or uniform direction, crossed "
                   "(four triangles), or polar: the side u min is one point and ring k has k times as many sides.",
                   Default{ "alternating", "no direction is preferred" })));
      if (p.documentation_mode())
        return surface;
      for (unsigned k = 0; k < 3; ++k)
        check_expression(p, entry_of(k), surface.expression[k], 0.5 * (surface.u_range[0] + surface.u_range[1]),
                         0.5 * (surface.v_range[0] + surface.v_range[1]));
      return surface;
    }

    SideSupport
    read_support(Parameters &p, const std::string &side)
    {
      std::vector<std::string> names{ "free", "clamped", "hinged" };
      for (const char *kind : { "symmetry ", "diaphragm ", "held " })
        for (const std::string &axis : axis_names)
          names.push_back(kind + axis);
      const unsigned k = position_of(
          names, p.choice("Side " + side, names,
                          "Support of this side. hinged: no displacement, the sheet turns about the side. symmetry: "
                          "plane of symmetry with this normal. diaphragm: stiff in the plane with this normal, free to "
                          "warp. held: no displacement along this axis, the sheet turns about the side.",
                          Default{ "free", "a side that is not named is not held" }));
      const unsigned axis = k % 3;
      if (k < 3)
        return k == 0 ? SideSupport() : k == 1 ? SideSupport::clamped() : SideSupport::hinged();
      return k < 6   ? SideSupport::symmetry(axis)
             : k < 9 ? SideSupport::diaphragm(axis)
                     : SideSupport::supported({ { axis == 0, axis == 1, axis == 2 } });
    }

    void
    read_supports(Parameters &p, ShellCase &c)
    {
      const auto scope = p.section("Supports");
      for (unsigned s = 0; s < SurfaceMesh::n_sides; ++s)
        c.supports[s] = read_support(p, side_names[s]);
      for_each_section(p, "Held point", [&] {
        ShellCase::HeldPoint point;
        point.position = read_vector(p, "Position", "mm", "The nearest node is held.");
        const std::vector<std::string> sets{ "x", "y", "z", "xy", "xz", "yz", "xyz" };
        const std::string              set = p.choice("Axes", sets, "Displacements that are held.");
        for (unsigned k = 0; k < 3; ++k)
          point.axes[k] = set.find(axis_names[k]) != std::string::npos;
        c.held_points.push_back(point);
      });
    }

    void
    read_loads(Parameters &p, ShellCase &c)
    {
      const auto scope = p.section("Loads");
      for_each_section(p, "Point force", [&] {
        ShellCase::PointForce load;
        load.position = read_vector(p, "Position", "mm", "The force acts on the nearest node of the undeformed mesh.");
        load.force    = read_vector(p, "Force", "N", "Dead force at load factor one, on the modelled part.");
        c.point_forces.push_back(load);
      });
      for_each_section(p, "Side force", [&] {
        ShellCase::SideLoad load;
        load.side  = read_side(p, "Loaded side.");
        load.value = read_vector(p, "Force per length", "N/mm", "Dead force per undeformed length at load factor one.");
        c.side_forces.push_back(load);
      });
      for_each_section(p, "Side moment", [&] {
        ShellCase::SideLoad load;
        load.side  = read_side(p, "Loaded side.");
        load.value = read_vector(p, "Moment per length", "N",
                                 "Moment per undeformed length with an axis fixed in space, at load factor one.");
        c.side_moments.push_back(load);
      });
      for_each_section(p, "Moved side", [&] {
        ShellCase::MovedSide moved;
        moved.side         = read_side(p, "Side that is moved.");
        moved.component    = position_of(axis_names, p.choice("Component", axis_names, "Direction of the motion."));
        moved.displacement = p.quantity("Displacement", "mm", Range::between(-1e9, 1e9), "At load factor one.");
        c.moved_sides.push_back(moved);
      });
      for_each_section(p, "Turned side", [&] {
        ShellCase::TurnedSide turned;
        turned.side  = read_side(p, "Side that is turned about its direction.");
        turned.angle = p.quantity(
            "Angle", "", Range::between(-1e9, 1e9),
            "In rad; right-handed about the direction in which the parameter grows along the side, at load "
            "factor one.");
        c.turned_sides.push_back(turned);
      });
      c.surface_force
          = read_vector(p, "Surface force", "MPa", "Dead force per undeformed area at load factor one, such as weight.",
                        Default{ "0, 0, 0 MPa", "an unloaded sheet" });
      c.pressure = p.quantity("Pressure", "MPa", Range::between(-1e9, 1e9),
                              "Along the normal X_u x X_v of the deformed surface at load factor one.",
                              Default{ "0 MPa", "an unloaded sheet" });
      if (!p.documentation_mode() && c.point_forces.empty() && c.side_forces.empty() && c.side_moments.empty()
          && c.moved_sides.empty() && c.turned_sides.empty() && c.surface_force.isZero() && c.pressure == 0)
        p.problem(
            "", "there is no load.", "",
            "Give a section `Point force 1`, `Side force 1`, `Side moment 1`, `Moved side 1` or `Turned side 1`, or "
            "an entry `Surface force` or `Pressure`.");
    }

    ShellCase::Measure
    read_measure(Parameters &p)
    {
      ShellCase::Measure m;
      m.name      = p.text("Name", "Word for this displacement, a column of load_displacement.csv.");
      m.position  = read_vector(p, "Position", "mm", "The displacement of the nearest node is written.");
      m.component = position_of(axis_names, p.choice("Component", axis_names, "Component of the displacement."));
      m.weight
          = p.quantity("Factor", "", Range::between(-1e9, 1e9), "The displacement is multiplied by it, such as -1.",
                       Default{ "1", "the displacement itself" });
      {
        m.reference_factor = p.quantity_list("Reference load factors", "", Range::between(-1e9, 1e9),
                                             "Load factors of published points; drawn and compared.",
                                             Default{ "0", "no published points" });
        m.reference_displacement
            = p.quantity_list("Reference displacements", "mm", Range::between(-1e9, 1e9),
                              "Displacements of the published points.", Default{ "0 mm", "no published points" });
        if (m.reference_factor == std::vector<double>{ 0. } && m.reference_displacement == std::vector<double>{ 0. })
          {
            m.reference_factor.clear();
            m.reference_displacement.clear();
          }
        if (!p.documentation_mode() && m.reference_factor.size() != m.reference_displacement.size())
          p.problem("Reference displacements", "there are " + std::to_string(m.reference_displacement.size())
                                                   + " displacements and " + std::to_string(m.reference_factor.size())
                                                   + " load factors.");
      }
      if (!p.documentation_mode() && m.name.find_first_of(",\"\n") != std::string::npos)
        p.problem("Name", "a column of a CSV file cannot be called so.", "letters, digits, `_`");
      return m;
    }

    void
    check_plane(const SurfaceMesh &mesh, const unsigned side, const unsigned axis)
    {
      for (const unsigned node : mesh.side[side])
        if (std::abs(mesh.mesh.normals[node][axis]) > 1e-9
            || std::abs(mesh.mesh.nodes[node][axis] - mesh.mesh.nodes[mesh.side[side].front()][axis]) > 1e-9)
          throw InputError(describe_error("This side cannot be a plane of symmetry: it does not lie in such a plane or "
                                          "the sheet is not perpendicular to it.",
                                          "Sheet test/Shell/Supports/Side " + side_names[side],
                                          "symmetry " + axis_names[axis]));
    }

    /// The increment (3 or 4) that turns the director across a side.
    unsigned
    across(const Shell &shell, const unsigned node, const Vector3d &tangent)
    {
      return std::abs(shell.committed().frame[node][0].dot(tangent)) > 0.5 ? 4 : 3;
    }
  } // namespace

  ShellCase
  ShellCase::read(Parameters &p)
  {
    ShellCase c;
    c.thickness
        = p.quantity("Thickness", "mm", Range::positive().usual(1e-3, 1e3), "Thickness of the undeformed sheet.");
    c.n_points = static_cast<unsigned>(
        p.integer("Thickness points", Range::between(3, 11), "Integration points over the thickness.",
                  Default{ "5", "stretching exactly, the moment of a plastic section to 5 percent; 6 in halves to a "
                                "few tenths of a percent" }));
    const std::vector<std::string> rules{ "Gauss", "Lobatto", "halves" };
    c.rule = static_cast<Shell::ThicknessPoints>(position_of(
        rules, p.choice("Thickness rule", rules,
                        "Positions of these points. halves: Gauss points in each half, an even number; most exact for "
                        "plastic bending and springback.",
                        Default{ "Gauss", "most exact for a given number while the sheet is elastic or stretched" })));
    if (!p.documentation_mode() && c.rule == Shell::ThicknessPoints::halves && (c.n_points % 2 != 0 || c.n_points < 4))
      p.problem("Thickness points", "the rule halves needs an even number.", "4, 6, 8, 10");
    {
      const auto scope = p.section("Surface");
      c.surface        = read_surface_of_shell(p);
    }
    read_supports(p, c);
    read_loads(p, c);
    for_each_section(p, "Measure", [&] { c.measures.push_back(read_measure(p)); });
    if (c.measures.empty())
      p.problem("", "no displacement is measured.", "", "Give a section `Measure 1`.");
    return c;
  }

  SurfaceMesh
  ShellCase::mesh() const
  {
    const auto        parser = parse(surface.expression);
    ParametricSurface parametric;
    parametric.position = [parser](const double u, const double v) { return evaluate(*parser, u, v); };
    parametric.u_min    = surface.u_range[0];
    parametric.u_max    = surface.u_range[1];
    parametric.v_min    = surface.v_range[0];
    parametric.v_max    = surface.v_range[1];
    SurfaceMesh result  = make_surface_mesh(parametric, surface.n_u, surface.n_v, surface.pattern);
    for (unsigned s = 0; s < SurfaceMesh::n_sides; ++s)
      if (supports[s].mirror >= 0)
        result.mirror(static_cast<Side>(s), static_cast<unsigned>(supports[s].mirror));
    return result;
  }

  Supports
  ShellCase::make_supports(Shell &shell, const SurfaceMesh &mesh, const bool with_motion) const
  {
    Supports result(shell);
    for (unsigned s = 0; s < SurfaceMesh::n_sides; ++s)
      {
        if (supports[s].mirror >= 0)
          check_plane(mesh, s, static_cast<unsigned>(supports[s].mirror));
        apply_support(result, mesh, static_cast<Side>(s), supports[s]);
      }
    for (const HeldPoint &point : held_points)
      for (unsigned k = 0; k < 3; ++k)
        if (point.axes[k])
          result.fix(mesh.nearest(point.position), k);
    for (const TurnedSide &turned : turned_sides)
      for (std::size_t k = 0; k < mesh.side[turned.side].size(); ++k)
        {
          const unsigned  node    = mesh.side[turned.side][k];
          const Vector3d &tangent = mesh.tangent[turned.side][k];
          result.hold_director(node, tangent);
          const unsigned component = across(shell, node, tangent);
          const double   arm       = tangent.cross(shell.committed().director[node])
                                 .dot(shell.committed().frame[node][component - 3]); // 1 or -1
          if (with_motion)
            result.prescribe({ node }, component, turned.angle * arm);
        }
    if (with_motion)
      for (const MovedSide &moved : moved_sides)
        result.prescribe(mesh.side[moved.side], moved.component, moved.displacement);
    return result;
  }

  Loads
  ShellCase::make_loads(const SurfaceMesh &mesh) const
  {
    Loads loads;
    for (const PointForce &load : point_forces)
      loads.add_point_force(mesh.nearest(load.position), load.force);
    for (const SideLoad &load : side_forces)
      loads.add_edge_force(mesh.mesh, boundary_edges(mesh.mesh, mesh.side[load.side]), load.value);
    for (const SideLoad &load : side_moments)
      loads.add_edge_moment(mesh.mesh, boundary_edges(mesh.mesh, mesh.side[load.side]), load.value);
    if (!surface_force.isZero())
      loads.add_surface_force(mesh.mesh, surface_force);
    if (pressure != 0)
      loads.add_pressure(mesh.mesh, pressure);
    return loads;
  }

  Loads
  ShellCase::holding_loads(const Shell &shell, const SurfaceMesh &mesh, const Eigen::VectorXd &reactions) const
  {
    Loads loads;
    for (const MovedSide &moved : moved_sides)
      for (const unsigned node : mesh.side[moved.side])
        loads.add_point_force(node, reactions[shell.dof(node, moved.component)] * Vector3d::Unit(moved.component));
    for (const TurnedSide &turned : turned_sides)
      for (std::size_t k = 0; k < mesh.side[turned.side].size(); ++k)
        {
          // The moment m does the work m . (d x e) of the increment along e.
          const unsigned node      = mesh.side[turned.side][k],
                         component = across(shell, node, mesh.tangent[turned.side][k]);
          const Vector3d &tangent  = mesh.tangent[turned.side][k];
          const double    arm
              = tangent.dot(shell.committed().director[node].cross(shell.committed().frame[node][component - 3]));
          loads.add_point_moment(node, reactions[shell.dof(node, component)] / arm * tangent);
        }
    return loads;
  }

  DisplacementMeasure
  ShellCase::measure(const Measure &quantity, const SurfaceMesh &mesh) const
  {
    return DisplacementMeasure::at(mesh.nearest(quantity.position), quantity.component, quantity.weight);
  }

  double
  ShellCase::length(const SurfaceMesh &mesh, const Side side)
  {
    double sum = 0;
    for (const Edge &edge : boundary_edges(mesh.mesh, mesh.side[side]))
      sum += (mesh.mesh.nodes[edge[1]] - mesh.mesh.nodes[edge[0]]).norm();
    return sum;
  }
} // namespace tribodraw
