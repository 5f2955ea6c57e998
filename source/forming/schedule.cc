#include <tribodraw/forming/schedule.h>
#include <tribodraw/tools/placement.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector3d;

    /// Length that stands for the duration of a process in which nothing has a prescribed way [mm]: with the default
    /// largest increment it is done in 50 increments or more.
    constexpr double length_without_motion = 100;

    double largest_change(const TimeTable &table, const double duration)
    {
      double      largest = 0;
      const auto  at      = [&](const double t) { largest = std::max(largest, std::abs(table.value(t) - table.value(0))); };
      for (const double t : table.breakpoints())
        if (t <= duration)
          at(t);
      at(duration);
      return largest;
    }

    NodeSet marked(const std::vector<bool> &marks)
    {
      NodeSet nodes;
      for (unsigned i = 0; i < marks.size(); ++i)
        if (marks[i])
          nodes.push_back(i);
      return nodes;
    }
  } // namespace

  Schedule::Schedule(Shell &shell, const Blank &b, const ToolSet &t, const Process &p)
    : blank(b)
    , tools(t)
    , process(p)
    , symmetry(shell.mesh().symmetry_factor)
    , supports(shell)
  {
    for (std::size_t i = 0; i < tools.tools.size(); ++i)
      if (tools.tools[i].control == ProcessTool::Control::force || (static_cast<int>(i) == tools.holder && process.holder_control == Process::HolderControl::force))
        free_tools.push_back(i);
    fluid.add_pressure(shell.mesh(), 1.);
    add_edges(shell);
    measure_path();
  }

  void
  Schedule::add_edges(Shell &shell)
  {
    using Condition          = BlankEdges::Condition;
    const BlankMesh  &mesh   = shell.mesh();
    supports.mirror(marked(mesh.on_x_plane), 0);
    supports.mirror(marked(mesh.on_y_plane), 1);
    if (blank.edges.outer == Condition::clamped)
      supports.clamp(marked(mesh.on_outer_edge));
    else if (blank.edges.outer == Condition::hinged)
      supports.hinge(marked(mesh.on_outer_edge));
    for (unsigned s = 0; s < 4; ++s)
      {
        const BlankEdges::Edge &edge = blank.edges.side[s];
        if (edge.condition == Condition::free)
          continue;
        const NodeSet  nodes = BlankEdges::nodes(mesh, s);
        const unsigned axis  = BlankEdges::axis(s);
        const double   sign  = BlankEdges::sign(s);
        if (edge.condition == Condition::mirrored)
          supports.mirror(nodes, axis);
        else if (edge.condition == Condition::hinged)
          supports.hinge(nodes);
        else if (edge.force)
          supports.fix(nodes, {2});
        else
          supports.clamp(nodes);
        if (edge.motion)
          {
            Grip grip{&*edge.motion, {}, sign};
            for (const unsigned n : nodes)
              grip.unknowns.push_back(shell.dof(n, axis));
            grips.push_back(grip);
          }
        if (edge.force)
          {
            const double full_width = axis == 0 ? blank.width : blank.length;
            Pull         pull{&*edge.force, {}};
            pull.loads.add_edge_force(mesh, boundary_edges(mesh, nodes), sign / full_width * Vector3d::Unit(axis));
            pulls.push_back(pull);
          }
      }
  }

  void
  Schedule::measure_path()
  {
    path_length = process.punch_travel;
    if (tools.punch < 0)
      {
        path_length = 0;
        for (const ProcessTool &tool : tools.tools)
          if (tool.control == ProcessTool::Control::motion && tool.curve)
            path_length = std::max(path_length, largest_change(*tool.curve, process.duration));
        for (const Grip &grip : grips)
          path_length = std::max(path_length, largest_change(*grip.motion, process.duration));
        if (path_length == 0)
          path_length = length_without_motion;
      }
    speed = path_length / process.duration;
  }

  std::vector<ContactTool>
  Schedule::place(const BlankMesh &mesh, const double thickness) const
  {
    std::vector<ContactTool> placed = tools.place(thickness, mesh.nodes);
    number_free_tools(placed);
    if (tools.holder >= 0 && process.holder_control == Process::HolderControl::gap && tools.die >= 0)
      placed[tools.holder].place[2] += process.holder_gap - thickness;
    return placed;
  }

  void
  Schedule::number_free_tools(std::vector<ContactTool> &placed) const
  {
    for (auto &tool : placed)
      tool.free_index = -1;
    for (std::size_t k = 0; k < free_tools.size(); ++k)
      placed[free_tools[k]].free_index = static_cast<int>(k);
  }

  bool
  Schedule::is_free(const std::size_t tool) const
  {
    return std::find(free_tools.begin(), free_tools.end(), tool) != free_tools.end();
  }

  void
  Schedule::stop(const std::size_t tool, std::vector<ContactTool> &placed)
  {
    free_tools.erase(std::remove(free_tools.begin(), free_tools.end(), tool), free_tools.end());
    number_free_tools(placed);
  }

  double
  Schedule::force(const std::size_t tool, const double path) const
  {
    const double full = static_cast<int>(tool) == tools.holder ? process.holder_force(path) : tools.tools[tool].curve->value(time(path));
    return full / symmetry;
  }

  double
  Schedule::pressure(const double path) const
  {
    return process.fluid_pressure ? process.fluid_pressure->value(time(path)) : 0.;
  }

  bool
  Schedule::has_closing() const
  {
    return !free_tools.empty() || pressure(0) != 0 || std::any_of(pulls.begin(), pulls.end(), [](const Pull &p) { return p.force->value(0) != 0; });
  }

  IncrementSolver::Load
  Schedule::closing(const double from, const double to) const
  {
    IncrementSolver::Load load;
    load.motion.assign(tools.tools.size(), Vector3d::Zero());
    for (const std::size_t t : free_tools)
      load.free_force.push_back(to * force(t, 0));
    if (process.fluid_pressure)
      load.external.push_back({&fluid, from * pressure(0), to * pressure(0)});
    for (const Pull &pull : pulls)
      load.external.push_back({&pull.loads, from * pull.force->value(0), to * pull.force->value(0)});
    return load;
  }

  IncrementSolver::Load
  Schedule::drawing(const double from, const double to) const
  {
    const double          t0 = time(from), t1 = time(to);
    IncrementSolver::Load load;
    load.dt = t1 - t0;
    for (std::size_t i = 0; i < tools.tools.size(); ++i)
      {
        const ProcessTool &tool = tools.tools[i];
        Vector3d           way  = Vector3d::Zero();
        if (static_cast<int>(i) == tools.punch)
          way[2] = from - to;
        else if (tool.control == ProcessTool::Control::motion)
          way = (tool.curve->value(t1) - tool.curve->value(t0)) * tool.direction;
        load.motion.push_back(way);
      }
    for (const std::size_t t : free_tools)
      load.free_force.push_back(force(t, to));
    if (process.fluid_pressure)
      load.external.push_back({&fluid, pressure(from), pressure(to)});
    for (const Pull &pull : pulls)
      load.external.push_back({&pull.loads, pull.force->value(t0), pull.force->value(t1)});
    if (!grips.empty())
      {
        load.prescribed = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(supports.fixed().size()));
        for (const Grip &grip : grips)
          for (const unsigned i : grip.unknowns)
            load.prescribed[i] = grip.sign * (grip.motion->value(t1) - grip.motion->value(t0));
      }
    return load;
  }

  std::vector<bool>
  Schedule::held_without_tools(const Shell &shell) const
  {
    std::vector<bool> held = supports.fixed();
    const auto       &mesh = shell.mesh();
    if (blank.edges.outer != BlankEdges::Condition::free)
      return held;
    for (const auto &edge : blank.edges.side)
      if (edge.condition == BlankEdges::Condition::clamped || edge.condition == BlankEdges::Condition::hinged || (edge.condition == BlankEdges::Condition::pulled && edge.motion))
        return held;
    // Three nodes that hold a rigid body without constraining it: one near the middle, one far from it along each axis.
    const auto best = [&](const auto &value) {
      unsigned best_node = 0;
      for (unsigned i = 1; i < shell.n_nodes(); ++i)
        if (value(mesh.nodes[i]) > value(mesh.nodes[best_node]))
          best_node = i;
      return best_node;
    };
    const bool     mirrored_x = blank.mirrored(0) || blank.edges.side[BlankEdges::x].condition == BlankEdges::Condition::mirrored,
               mirrored_y     = blank.mirrored(1) || blank.edges.side[BlankEdges::y].condition == BlankEdges::Condition::mirrored;
    const unsigned middle     = best([](const Vector3d &x) { return -x.head<2>().squaredNorm(); });
    const unsigned far_x      = best([](const Vector3d &x) { return x[0] - 2 * std::abs(x[1]); });
    const unsigned far_y      = best([](const Vector3d &x) { return x[1] - 2 * std::abs(x[0]); });
    held[shell.dof(middle, 2)] = true;
    if (!mirrored_x)
      held[shell.dof(middle, 0)] = held[shell.dof(far_x, 2)] = true; // along x, about y
    if (!mirrored_y)
      held[shell.dof(middle, 1)] = held[shell.dof(far_y, 2)] = true; // along y, about x
    if (!mirrored_x && !mirrored_y)
      held[shell.dof(far_x, 1)] = true; // about z
    return held;
  }
} // namespace tribodraw
