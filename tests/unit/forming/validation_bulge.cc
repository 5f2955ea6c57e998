// Stretching of clamped discs against the balance of forces at the pole.
#include "validation.h"

#include <Eigen/Dense>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  struct Disc
  {
    BlankMesh mesh;
    Shell     shell;
    Supports  supports;
    Disc(const double radius, const double thickness, const double size, const std::shared_ptr<const SheetMaterial> &sheet)
      : mesh(make_disc(radius, {size, {{{0, 0}, {0.35 * radius, 0.35 * radius}, 0.6 * size}}, 0.3}, true))
      , shell(mesh, thickness, sheet, 5)
      , supports(shell)
    {
      supports.clamp(nodes_where(mesh, [&](const Vector3d &x) { return x.norm() > radius * (1 - 1e-6); }));
      supports.mirror(nodes_where(mesh, [&](const Vector3d &x) { return x[0] < 1e-9 && x.norm() < radius * (1 - 1e-6); }), 0);
      supports.mirror(nodes_where(mesh, [&](const Vector3d &x) { return x[1] < 1e-9 && x.norm() < radius * (1 - 1e-6); }), 1);
    }
    unsigned pole() const
    {
      unsigned best = 0;
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        if (mesh.nodes[i].norm() < mesh.nodes[best].norm())
          best = i;
      return best;
    }
    /// Radius of the sphere through the nodes that were within @p within of the axis: x^2 + y^2 + z^2 = 2 z c + k.
    double radius_at_pole(const double within) const
    {
      Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
      Eigen::Vector2d b = Eigen::Vector2d::Zero();
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        if (mesh.nodes[i].norm() < within)
          {
            const Vector3d       &x = shell.committed().position[i];
            const Eigen::Vector2d row(2 * x[2], 1);
            A += row * row.transpose();
            b += row * x.squaredNorm();
          }
      const Eigen::Vector2d s = A.ldlt().solve(b);
      return std::sqrt(s[1] + s[0] * s[0]);
    }
  };
  double
  swift(const double eps)
  {
    return 550 * std::pow(0.01 + eps, 0.25);
  }
} // namespace

// Hydraulic bulge, clamped: at the pole p R/2 = t sigma with the flow stress of the plastic strain there (balanced biaxial
// tension, von Mises), and t = t0 exp(-eps) (elastic volume change: (1-2 nu)/E sigma, 1e-3).
TEST(Validation, HydraulicBulge)
{
  const double  a = 50, t0 = 1;
  Disc          disc(a, t0, 4., material("550", "0.01", "0.25"));
  Shell        &shell = disc.shell;
  const SolverSettings settings = tight();
  Contact              contact(shell, {}, settings.contact);
  IncrementSolver      solver(shell, contact, disc.supports.fixed(), 0, settings);
  Loads                fluid;
  fluid.add_pressure(disc.mesh, 1.);
  IncrementSolver::Load load;
  load.dt = 1;
  // the highest stays below the instability of a bulge at a strain of 4/11 (1 + 2 n): some 9 MPa here
  const double final_pressure = 6.;
  const unsigned n_steps = 24;
  double         work = 0;
  for (unsigned k = 0; k < n_steps; ++k)
    {
      load.external      = {{&fluid, final_pressure * k / n_steps, final_pressure * (k + 1) / n_steps}};
      const auto outcome = solver.solve(load);
      ASSERT_TRUE(outcome.converged) << "increment " << k << ": " << outcome.reason;
      shell.commit();
      contact.commit();
      work += outcome.load_work;
    }
  const unsigned pole = disc.pole();
  const double   t = shell.node_thickness()[pole], eps = shell.node_eps_p()[pole], R = disc.radius_at_pole(0.25 * a);
  EXPECT_GT(eps, 0.1);
  EXPECT_TRUE(claims::agrees("hydraulic bulge, p R/(2 t) over flow stress at the pole", "balance of forces at the pole", final_pressure * R / (2 * t) / swift(eps), 1, 0.01)) << "R " << R << " t " << t << " eps " << eps;
  EXPECT_NEAR(t, t0 * std::exp(-eps), 0.005 * t0);
  EXPECT_NEAR(work, shell.elastic_energy() + shell.plastic_work(), 0.01 * work);
}

// Stretching over a sphere without friction: the sheet lies on the sphere, so that the pressure at the pole is 2 t sigma/R
// on its middle surface; on the face, which is smaller by (R - t/2)^2/R^2, the load is the same. The thinnest point is the pole.
TEST(Validation, StretchingOverASphereWithoutFriction)
{
  const double a = 59.18, t0 = 1, Rp = 50.8; // NUMIFORM'89 without the die radius
  Disc         disc(a, t0, 3.5, material("550", "0.01", "0.25"));
  Shell       &shell = disc.shell;
  const SolverSettings settings = tight();
  ContactTool          punch{"punch", std::make_shared<Round>(Rp, true), {0, 0, -Rp - t0 / 2}, Face::die_side};
  Contact              contact(shell, {punch}, settings.contact);
  IncrementSolver      solver(shell, contact, disc.supports.fixed(), 0, settings);
  IncrementSolver::Load load;
  load.dt = 1;
  for (unsigned k = 0; k < 30; ++k)
    {
      load.motion = {{0, 0, 1.}};
      advance(shell, contact, solver, load, "stretch");
      if (::testing::Test::HasFatalFailure())
        return;
    }
  const unsigned pole = disc.pole();
  const double   R = Rp + 0.5 * shell.node_thickness()[pole];
  double         pressure = 0, area = 0, tension = 0, thinnest = 1e9;
  for (unsigned i = 0; i < shell.n_nodes(); ++i)
    {
      thinnest = std::min(thinnest, shell.node_thickness()[i]);
      if (disc.mesh.nodes[i].norm() > 12)
        continue;
      const double w = shell.node_current_area()[i];
      area += w;
      pressure += w * contact.face(Face::die_side).pressure[i];
      tension += w * shell.node_thickness()[i] * swift(shell.node_eps_p()[i]);
    }
  EXPECT_TRUE(claims::agrees("stretching over a sphere, p R/(2 t sigma)", "balance of forces at the pole", pressure * R / (2 * tension), 1, 0.02));
  EXPECT_NEAR(shell.node_thickness()[pole], thinnest, 0.005 * t0);
  EXPECT_LT(contact.max_penetration(), 0.03 * t0);
  // the clamp holds what the punch pushes
  double held = 0;
  for (unsigned i = 0; i < shell.n_nodes(); ++i)
    held -= solver.reactions()[shell.dof(i, 2)];
  EXPECT_NEAR(-contact.tool_forces()[0][2], held, 1e-3 * held);
}
