#include <tribodraw/base/units.h>
#include <tribodraw/forming/necking.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// Rates are taken over at least this travel: those of a tiny increment mean nothing [mm].
    constexpr double shortest_travel = 0.2;
    /// Thinning of the critical element per travel, over the slowest since the limit was exceeded, from which on it counts as
    /// accelerating. In a part that is only drawn in further it slows down.
    constexpr double accelerated = 1.5;
    /// Force over its largest value below which it counts as falling.
    constexpr double fallen = 0.99;
  } // namespace

  NeckingMonitor::NeckingMonitor(const Shell &shell, std::shared_ptr<const FormingLimitCurve> forming_limit)
    : sheet(shell)
    , limit(std::move(forming_limit))
    , neighbours(shell.n_elements())
    , last_thinning(shell.n_elements(), 0.)
  {
    const auto                        &triangles = shell.mesh().triangles;
    std::vector<std::vector<unsigned>> at_node(shell.n_nodes());
    for (unsigned e = 0; e < triangles.size(); ++e)
      for (const unsigned n : triangles[e])
        at_node[n].push_back(e);
    for (unsigned e = 0; e < triangles.size(); ++e)
      {
        for (const unsigned n : triangles[e])
          neighbours[e].insert(neighbours[e].end(), at_node[n].begin(), at_node[n].end());
        std::sort(neighbours[e].begin(), neighbours[e].end());
        neighbours[e].erase(std::unique(neighbours[e].begin(), neighbours[e].end()), neighbours[e].end());
        neighbours[e].erase(std::find(neighbours[e].begin(), neighbours[e].end(), e));
      }
    initial_thickness = *std::max_element(shell.node_thickness().begin(), shell.node_thickness().end());
  }

  void
  NeckingMonitor::observe(const Shell::ElementResults &elements, const double path, const double force)
  {
    critical = {};
    for (unsigned e = 0; e < elements.major_strain.size(); ++e)
      {
        const double ratio = forming_limit_margin(*limit, elements.major_strain[e], elements.minor_strain[e]);
        if (ratio > critical.ratio)
          {
            critical.ratio   = ratio;
            critical.element = e;
          }
      }
    for (const unsigned n : sheet.mesh().triangles[critical.element])
      {
        critical.place += sheet.committed().position[n] / 3;
        critical.place_undeformed += sheet.mesh().nodes[n] / 3;
      }
    seen_path     = path;
    largest_force = std::max(largest_force, force);
    if (path - last_path < shortest_travel)
      return;
    const auto   thinning = [&](const unsigned e) { return -std::log(elements.thickness[e] / initial_thickness); };
    const auto   rate     = [&](const unsigned e) { return (thinning(e) - last_thinning[e]) / (path - last_path); };
    double       around   = 0;
    for (const unsigned e : neighbours[critical.element])
      around += rate(e) / neighbours[critical.element].size();
    const double here    = rate(critical.element);
    const bool   falling = force < fallen * largest_force;
    if (limit_exceeded() && here > 0)
      slowest = std::min(slowest, here);
    if (why.empty() && limit_exceeded() && falling && here > accelerated * slowest)
      {
        char text[400];
        std::snprintf(text, sizeof(text),
                      "At %.2f mm of travel the major strain is %.3f times its limit at (%.1f, %.1f, %.1f) mm (undeformed: %.1f, %.1f), where the sheet thins %.1f times as fast as "
                      "around and %.1f times as fast as when the limit was passed, and the force has fallen to %.1f %% of its maximum.",
                      path, critical.ratio, critical.place[0], critical.place[1], critical.place[2], critical.place_undeformed[0], critical.place_undeformed[1],
                      here / std::max(around, 1e-3 * here), here / slowest, 100 * force / largest_force);
        recognise(text);
      }
    for (unsigned e = 0; e < last_thinning.size(); ++e)
      last_thinning[e] = thinning(e);
    last_path = path;
  }

  void
  NeckingMonitor::recognise(const std::string &reason)
  {
    why         = reason;
    neck_travel = seen_path;
    neck_place  = critical.place;
  }

  void
  NeckingMonitor::without_equilibrium(const std::string &solver_says)
  {
    char text[400];
    std::snprintf(text, sizeof(text), "After %.2f mm of travel there is no equilibrium any more (%s); the major strain is %.3f times its limit at (%.1f, %.1f, %.1f) mm (undeformed: %.1f, %.1f).",
                  seen_path, solver_says.c_str(), critical.ratio, critical.place[0], critical.place[1], critical.place[2], critical.place_undeformed[0], critical.place_undeformed[1]);
    if (why.empty())
      recognise(text);
  }

  void
  NeckingMonitor::save(Archive &archive) const
  {
    archive.put("necking/thinning", last_thinning);
    archive.put("necking/state", std::vector<double>{last_path, largest_force, neck_travel, neck_place[0], neck_place[1], neck_place[2], slowest, seen_path, critical.ratio, static_cast<double>(critical.element),
                                                           critical.place[0], critical.place[1], critical.place[2], critical.place_undeformed[0], critical.place_undeformed[1], critical.place_undeformed[2]});
    archive.put("necking/reason", why);
  }

  void
  NeckingMonitor::load(const Archive &archive)
  {
    last_thinning     = archive.numbers("necking/thinning", last_thinning.size());
    const auto &state = archive.numbers("necking/state", 16);
    last_path         = state[0];
    largest_force     = state[1];
    neck_travel       = state[2];
    neck_place        = {state[3], state[4], state[5]};
    slowest           = state[6];
    seen_path         = state[7];
    critical          = {state[8], static_cast<unsigned>(state[9]), {state[10], state[11], state[12]}, {state[13], state[14], state[15]}};
    why               = archive.text("necking/reason");
  }
} // namespace tribodraw
