#include "simulation_implementation.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>

#include <algorithm>
#include <cstdio>
#include <set>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr unsigned n_worst = 5;
    /// A sheet thinned to this share of its thickness is near or past its limit.
    constexpr double thinned = 0.75;
    /// A residual within this factor of its tolerance only lacked iterations.
    constexpr double nearly = 100;
    /// Iteration limits below this one end increments that need no halving.
    constexpr unsigned few = 30;
    /// Forces cannot be balanced much better than this part of their sum.
    constexpr double round_off = 1e-11;
    /// A smallest increment above this share of the first one leaves little room for halving.
    constexpr double coarse = 0.05;

    std::vector<Vector3d>
    forces_of_nodes(const Shell &shell, const Eigen::VectorXd &residual)
    {
      std::vector<Vector3d> forces;
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        forces.emplace_back(residual[shell.dof(i, 0)], residual[shell.dof(i, 1)], residual[shell.dof(i, 2)]);
      return forces;
    }

    std::vector<unsigned>
    worst_nodes(const std::vector<Vector3d> &forces)
    {
      std::vector<unsigned> nodes(forces.size());
      for (unsigned i = 0; i < nodes.size(); ++i)
        nodes[i] = i;
      const std::size_t n = std::min<std::size_t>(n_worst, nodes.size());
      std::partial_sort(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(n), nodes.end(), [&](const unsigned a, const unsigned b) {
        const double fa = forces[a].norm(), fb = forces[b].norm();
        return fa != fb ? fa > fb : a < b;
      });
      nodes.resize(n);
      return nodes;
    }
  } // namespace

  std::string
  Simulation::Implementation::tool_at(const unsigned node) const
  {
    for (const Face f : {Face::punch_side, Face::die_side})
      if (contact.face(f).tool[node] >= 0 && !tools_away)
        return contact.tools()[contact.face(f).tool[node]].name;
    return "no tool";
  }

  /// What the figures at hand say about the cause, each with what to try; the likeliest first.
  std::string
  Simulation::Implementation::diagnosis(const std::vector<unsigned> &worst, const IncrementSolver::Outcome &outcome, const Stage stage) const
  {
    std::vector<std::string> causes;
    const auto               say = [&](const std::string &text) { causes.push_back(text); };
    char                     residuals[80];
    std::snprintf(residuals, sizeof residuals, "residual %.1e, asked %.1e", outcome.residual, settings.residual_tolerance);
    if (outcome.iterations >= settings.max_iterations && (settings.max_iterations < few || outcome.residual < nearly * settings.residual_tolerance))
      say("It ran out of iterations (" + std::string(residuals) + "): allow more than " + std::to_string(settings.max_iterations) + " 'Solver/Maximal iterations'.");
    if (outcome.residual < round_off)
      say("The forces are balanced but for round-off (" + std::string(residuals) + "): ask for less in 'Solver/Residual tolerance' or 'Solver/Displacement tolerance'.");
    if (stage == Stage::drawing && settings.smallest_increment > coarse * settings.first_increment)
      say("There was little room for smaller increments: 'Solver/Smallest increment' is " + units::format(settings.smallest_increment, "mm") + ", 'Solver/First increment' " +
          units::format(settings.first_increment, "mm") + ".");
    if (record.forming_limit.ratio > 0.9 || record.min_thickness < thinned * blank.thickness)
      say("The sheet is about to neck: smallest thickness " + units::format(record.min_thickness, "mm") + " of " + units::format(blank.thickness, "mm") + ", strain " +
          units::number(record.forming_limit.ratio) + " times its forming limit. Lower holder force or friction, or take it as the result.");
    if (process.fluid_pressure)
      say("A fluid pressure has a maximum beyond which the sheet has no equilibrium; it is " + units::format(process.fluid_pressure->value(schedule.time(record.path)), "MPa") +
          " here. Prescribe a motion instead, or end before.");
    std::set<std::string> where;
    for (const unsigned node : worst)
      where.insert(tool_at(node));
    const std::string stiffness = units::format(contact.stiffness(), "MPa/mm");
    const bool one_tool = where.size() == 1 && *where.begin() != "no tool";
    if (outcome.reason.find("singular") != std::string::npos)
      say("Nothing holds some part of the blank, or it buckles: hold an edge ('Blank/Edges'), or give a small 'Solver/Stabilisation viscosity'.");
    else if (outcome.reason.find("material point") != std::string::npos)
      say("Single elements deform too much in one increment, typically where they are large against a radius of a tool: a finer 'Blank/Element size' or 'Blank/Fine zones' there.");
    else if (one_tool)
      say("All of these nodes touch " + *where.begin() + ": nodes that touch and leave it in turn. A wider 'Solver/Contact transition', a 'Solver/Contact stiffness' below the " + stiffness + " in use, or elements that are smaller against its radii help.");
    else if (where.count("no tool") && where.size() == 1)
      say("None of these nodes touches a tool: the free sheet buckles or wrinkles. More holder force, or a small 'Solver/Stabilisation viscosity', which makes the path through the snap.");
    else
      say("The nodes lie on several tools: the sheet changes from one to the other. A 'Solver/Contact stiffness' below the " + stiffness + " in use, a wider 'Solver/Contact transition' or a finer 'Blank/Element size' help.");
    std::string text = "\nWhat the figures say:";
    for (const std::string &cause : causes)
      text += "\n  - " + cause;
    return text;
  }

  void
  Simulation::Implementation::fail(const IncrementSolver &failing, const IncrementSolver::Outcome &outcome, const Stage stage)
  {
    const auto        unbalanced = forces_of_nodes(shell, failing.residual());
    const auto        worst      = worst_nodes(unbalanced);
    const std::string smallest   = units::format(settings.smallest_increment, "mm");
    std::string       text       = stage == Stage::closing   ? "The closing of the tools at the start does not converge: "
                                   : stage == Stage::drawing ? "The increment at travel " + units::format(record.path, "mm") + " does not converge at the smallest size of " + smallest + ": "
                                                             : "The removal of the tools does not converge after " + units::number(100 * record.unloaded) + " % of it: ";
    text += outcome.reason + ". The last converged state and the unbalanced forces have been written (not_converged.vtu).\nLargest unbalanced forces:";
    for (const unsigned i : worst)
      {
        const Vector3d &x = shell.committed().position[i];
        char            line[200];
        std::snprintf(line, sizeof(line), "\n  node %u at (%.2f, %.2f, %.2f) mm, %.3g N, touching %s", i, x[0], x[1], x[2], unbalanced[i].norm(), tool_at(i).c_str());
        text += line;
      }
    text += diagnosis(worst, outcome, stage);
    for (const auto &o : observers)
      {
        o->failed(owner, unbalanced);
        o->finished(owner, false);
      }
    throw ConvergenceError(text);
  }
} // namespace tribodraw
