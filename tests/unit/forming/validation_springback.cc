// Bending over a drum under tension and springback against an independent integration through the thickness.
#include "validation.h"

#include <Eigen/Dense>

#include <algorithm>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  constexpr double E = 2e5, nu = 0.3;

  /// Longitudinal stress of a von Mises sheet in plane strain, stretched to the logarithmic strain @p strain in one
  /// direction: explicit integration in small steps, no return mapping.
  double
  plane_strain_stress(const double strain)
  {
    const unsigned  n = 2000;
    Eigen::Matrix2d D;
    D << 1, nu, nu, 1;
    D *= E / (1 - nu * nu);
    Eigen::Vector2d       s = Eigen::Vector2d::Zero();
    const Eigen::Vector2d de(strain / n, 0);
    double                eps = 0;
    for (unsigned k = 0; k < n; ++k)
      {
        const double q = std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1]), yield = 550 * std::pow(0.01 + eps, 0.25);
        double       flow = 0;
        Eigen::Vector2d direction = Eigen::Vector2d::Zero();
        if (q >= yield)
          {
            direction = Eigen::Vector2d(2 * s[0] - s[1], 2 * s[1] - s[0]) / (2 * q);
            flow      = std::max(0., direction.dot(D * de) / (direction.dot(D * direction) + 0.25 * yield / (0.01 + eps)));
          }
        s += D * (de - flow * direction);
        eps += flow;
      }
    return s[0];
  }

  /// Force and moment per width of a section with the stretch @p stretch of its middle and the curvature @p curvature.
  Eigen::Vector2d
  section(const double thickness, const double stretch, const double curvature)
  {
    const unsigned  n = 200;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    const double    now = thickness / stretch; // plane strain without change of volume
    for (unsigned k = 0; k < n; ++k)
      {
        const double z = now * ((k + 0.5) / n - 0.5), fibre = stretch * (1 + curvature * z);
        sum += now / n * plane_strain_stress(std::log(fibre)) * Eigen::Vector2d(1, z);
      }
    return sum;
  }

  /// Turn of the directors by the current length between two undeformed places.
  double
  mean_curvature(const Shell &shell, const double from, const double to)
  {
    std::vector<unsigned> row; // at y = 0, in the order of x
    for (unsigned i = 0; i < shell.n_nodes(); ++i)
      if (shell.mesh().nodes[i][1] < 1e-9 && shell.mesh().nodes[i][0] > from - 1e-6 && shell.mesh().nodes[i][0] < to + 1e-6)
        row.push_back(i);
    std::sort(row.begin(), row.end(), [&](const unsigned a, const unsigned b) { return shell.mesh().nodes[a][0] < shell.mesh().nodes[b][0]; });
    const auto &c      = shell.committed();
    double      length = 0;
    for (std::size_t k = 1; k < row.size(); ++k)
      {
        const double chord = (c.position[row[k]] - c.position[row[k - 1]]).norm();
        const double turn  = std::acos(std::min(1., c.director[row[k]].dot(c.director[row[k - 1]])));
        length += turn > 1e-6 ? chord * 0.5 * turn / std::sin(0.5 * turn) : chord;
      }
    return std::acos(c.director[row.front()].dot(c.director[row.back()])) / length;
  }
} // namespace

// A wide strip is bent over a drum by a pull whose direction turns, without friction: each section is bent from 0 to the
// drum's curvature under the same tension. Then pull and drum are taken away. The section's force and moment come from the
// integration above with the measured curvature; unloading is elastic, M / (E' I) with E' = E/(1 - nu^2).
TEST(Validation, BendingUnderTensionAndSpringback)
{
  const double t = 1, R = 20, length = 30, width = 0.5, tension = 80 /* N per mm of width */;
  BlankMesh    mesh = make_quarter_rectangle(length, width, 60, 1);
  Shell        shell(mesh, t, material("550", "0.01", "0.25"), 6, Shell::ThicknessPoints::halves);
  const auto   all = nodes_where(mesh, [](const Vector3d &) { return true; }), middle = nodes_where(mesh, [](const Vector3d &x) { return x[0] < 1e-9; }),
             end = nodes_where(mesh, [&](const Vector3d &x) { return x[0] > length - 1e-9; });
  Supports supports(shell);
  supports.fix(all, {1});
  for (const unsigned node : all)
    supports.hold_director(node, Vector3d::UnitY());
  supports.fix(middle, {0, 4});
  ContactTool          drum{"drum", std::make_shared<Round>(R, false), {0, 0, -R - 0.5 * t}, Face::die_side};
  const SolverSettings settings = tight();
  Contact              contact(shell, {drum}, settings.contact);
  IncrementSolver      solver(shell, contact, supports.fixed(), 0, settings);
  Loads                across, down;
  across.add_edge_force(mesh, boundary_edges(mesh, end), {1, 0, 0});
  down.add_edge_force(mesh, boundary_edges(mesh, end), {0, 0, -1});

  IncrementSolver::Load load;
  load.motion.assign(1, Vector3d::Zero());
  load.dt = 1;
  double angle = 0.02, pull = 0;
  const unsigned n_pull = 4, n_turn = 30;
  for (unsigned k = 0; k < n_pull + n_turn; ++k)
    {
      const double old_angle = angle, old_pull = pull;
      if (k < n_pull)
        pull += tension / n_pull;
      else
        angle += 0.6 / n_turn;
      load.external = {{&across, old_pull * std::cos(old_angle), pull * std::cos(angle)}, {&down, old_pull * std::sin(old_angle), pull * std::sin(angle)}};
      advance(shell, contact, solver, load, "wrap");
      if (::testing::Test::HasFatalFailure())
        return;
    }
  // Away from the middle, where bending began before the strip lay on the drum, and from the end of the contact at 12 mm.
  const double loaded = mean_curvature(shell, 6, 9);
  EXPECT_NEAR(loaded, 1 / (R + 0.5 * t), 0.02 / R);

  // without tools, held at its middle only against falling
  const Loads frozen = contact.frozen_forces();
  supports.fix(middle, {2});
  IncrementSolver alone(shell, contact, supports.fixed(), 0, settings);
  load.contact = false;
  for (unsigned k = 0; k < 5; ++k)
    {
      const double before = 1 - 0.2 * k, after = 1 - 0.2 * (k + 1);
      load.external = {{&across, before * pull * std::cos(angle), after * pull * std::cos(angle)},
                       {&down, before * pull * std::sin(angle), after * pull * std::sin(angle)},
                       {&frozen, before, after}};
      advance(shell, contact, alone, load, "release");
      if (::testing::Test::HasFatalFailure())
        return;
    }
  const double released = mean_curvature(shell, 6, 9);

  // stretch of the middle that gives the tension
  double low = 1, high = 1.05;
  for (unsigned k = 0; k < 40; ++k)
    {
      const double stretch = 0.5 * (low + high);
      (section(t, stretch, loaded)[0] < tension ? low : high) = stretch;
    }
  const double moment = section(t, low, loaded)[1], I = std::pow(t / low, 3) / 12;
  const double springback = moment * (1 - nu * nu) / (E * I);
  EXPECT_GT(springback, 0.04 * loaded);
  EXPECT_TRUE(claims::agrees("bending under tension, springback of the curvature over that of the section", "explicit integration over 200 points", (loaded - released) / springback, 1, 0.03)) << "moment " << moment << ", stretch " << low;
}
