// Contact, friction and increments against closed forms and an independent integration: strips on drums.
#include "validation.h"

#include <algorithm>

using namespace tribodraw;
using namespace tribodraw::test;
using Eigen::VectorXd;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  std::vector<bool>
  none(const BlankMesh &mesh)
  {
    return std::vector<bool>(mesh.nodes.size(), false);
  }

  /// A strip of unit width around a quarter of a drum, free of stress: level part x < 0, arc, part that hangs down.
  BlankMesh
  wrapped_strip(const double level, const double radius, const double hanging, const unsigned n)
  {
    const double arc = 0.5 * pi * radius, length = level + arc + hanging;
    BlankMesh    mesh = make_quarter_rectangle(length, 1., n, 1);
    for (auto &x : mesh.nodes)
      {
        const double s = x[0] - level, y = x[1], angle = std::clamp(s / radius, 0., 0.5 * pi);
        const Vector3d normal(std::sin(angle), 0, std::cos(angle));
        x = Vector3d(std::min(s, 0.), y, -std::max(s - arc, 0.)) + radius * normal;
        mesh.normals.push_back(normal);
      }
    mesh.on_x_plane = mesh.on_y_plane = none(mesh);
    return mesh;
  }
} // namespace

// Capstan (Eytelwein 1808): a thin strip that slides over a drum through the angle theta needs T2 = T1 exp(mu theta).
// 60 sides on the quarter circle turn by 1.5 degrees each; bending of the strip (0.05 mm) is negligible.
TEST(Validation, Capstan)
{
  const double t = 0.05, radius = 10, pull_down = 5 /* N per mm width */;
  for (const double mu : {0.05, 0.15, 0.3})
    {
      const BlankMesh mesh = wrapped_strip(3., radius + t / 2, 3., 82);
      Shell           shell(mesh, t, material("5000", "0.5", "0.1"), 3);
      Supports        supports(shell);
      const auto      pulled = nodes_where(mesh, [](const Vector3d &x) { return x[0] < -3 + 1e-6; });
      const auto      lower  = nodes_where(mesh, [](const Vector3d &x) { return x[2] < -3 + 1e-6; });
      const auto      all    = nodes_where(mesh, [](const Vector3d &) { return true; });
      supports.fix(all, {1});
      supports.prescribe(pulled, 0, -0.02);
      supports.fix(pulled, {2});
      ContactTool drum{"drum", std::make_shared<Round>(radius - 0.003, false), Vector3d::Zero(), Face::die_side};
      SolverSettings       settings = tight(5e-4);
      settings.contact.stiffness    = 1000; // the pressures here are a hundredth of those in forming
      settings.contact.transition   = 0.005;
      Contact              contact(shell, {drum}, settings.contact);
      contact.set_friction(Face::die_side, std::vector<double>(shell.n_nodes(), mu));
      IncrementSolver solver(shell, contact, supports.fixed(), 0, settings);
      Loads           weight;
      weight.add_edge_force(mesh, boundary_edges(mesh, lower), {0, 0, -pull_down});

      IncrementSolver::Load load;
      load.motion.assign(1, Vector3d::Zero());
      load.dt = 1;
      double friction_before = 0, work = 0;
      for (unsigned k = 0; k < 21; ++k)
        {
          load.external   = {{&weight, 1., 1.}}; // from the first increment on, which presses the strip on the drum
          load.prescribed = k < 1 ? VectorXd(VectorXd::Zero(shell.n_dofs())) : supports.motion();
          const auto outcome = solver.solve(load);
          ASSERT_TRUE(outcome.converged) << "mu " << mu << " increment " << k << ": " << outcome.reason;
          shell.commit();
          contact.commit();
          if (k == 16)
            friction_before = contact.friction_work() + shell.elastic_energy();
          if (k > 16)
            work += outcome.support_work + outcome.load_work;
        }
      double force = 0;
      for (const unsigned node : pulled)
        force -= solver.reactions()[shell.dof(node, 0)];
      EXPECT_TRUE(claims::agrees(claims::with("capstan, ratio of forces, mu =", mu), "exp(mu pi/2) (Eytelwein)", force / pull_down, std::exp(mu * 0.5 * pi), 0.01 * std::exp(mu * 0.5 * pi)));
      // The work of both ends goes into friction and bending (2 % at mu 0.05).
      EXPECT_NEAR(contact.friction_work() + shell.elastic_energy() - friction_before, work, 0.01 * work) << "mu " << mu;
    }
}

// A strip on two edges, pressed in the middle by a drum (Hertz-like: the contact grows with the force). Where it touches it
// has the curvature 1/R and, in beam theory, no load but two forces F/2 at the ends x = +-a of the contact, where the
// moment is EI/R (S. Timoshenko, Strength of Materials II): a = L - 2 EI/(R F) for the half span L, and the middle goes
// down by a^2/(2R) + a l/R + F l^3/(6 EI) with l = L - a. Small slopes (0.075: the square is 0.6 %).
TEST(Validation, StripPressedByADrum)
{
  const double   t = 0.1, R = 100, half_span = 10, EI = 2e5 * t * t * t / 12;
  const unsigned n = 80;
  BlankMesh      mesh = make_quarter_rectangle(half_span, 0.25, n, 1);
  Shell          shell(mesh, t, material("5000", "0.5", "0.1", "0"), 3);
  Supports       supports(shell);
  const auto     ends   = nodes_where(mesh, [&](const Vector3d &x) { return x[0] > half_span - 1e-9; });
  const auto     middle = nodes_where(mesh, [](const Vector3d &x) { return x[0] < 1e-9; });
  supports.fix(nodes_where(mesh, [](const Vector3d &) { return true; }), {1});
  supports.mirror(middle, 0);
  supports.fix(ends, {2});
  ContactTool drum{"drum", std::make_shared<Round>(R - t / 2, false), {0, 0, R + 0.02 * t}, Face::punch_side, false, 0};
  const SolverSettings settings = tight();
  Contact              contact(shell, {drum}, settings.contact);
  IncrementSolver      solver(shell, contact, supports.fixed(), 1, settings);
  IncrementSolver::Load load;
  load.motion.assign(1, Vector3d::Zero());
  load.dt = 1;
  for (const double a : {2., 5., 7.})
    {
      const double l = half_span - a, force = 2 * EI / (R * l);
      for (unsigned k = 1; k <= 4; ++k)
        {
          load.free_force = {0.25 * 0.5 * force * (a == 2. ? 0.25 * k : 1.)};
          advance(shell, contact, solver, load, "press");
        }
      const double down = a * a / (2 * R) + a * l / R + force * l * l * l / (6 * EI);
      EXPECT_TRUE(claims::agrees(claims::with("strip pressed by a drum, deflection in mm, half contact length", a), "beam theory (Timoshenko)", -shell.committed().position[middle[0]][2], down, 0.01 * down));
      // the load acts at the end of the contact, within half an element
      double load_sum = 0, moment = 0;
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        {
          const double f = shell.node_current_area()[i] * contact.face(Face::punch_side).pressure[i];
          load_sum += f;
          moment += f * mesh.nodes[i][0];
        }
      EXPECT_NEAR(moment / load_sum, a, 0.5 * half_span / n) << "a " << a;
    }
}
