#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support.h"

using namespace shell_test;

namespace
{
  constexpr double E = 70000, nu = 0.3, h = 0.8, lx = 10, ly = 7;

  Eigen::Matrix3d
  plane_stress_elasticity()
  {
    Eigen::Matrix3d D;
    D << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
    return E / (1 - nu * nu) * D;
  }
} // namespace

TEST(PatchTest, LargeUniformStretchIsExactOnADistortedMesh)
{
  // Patch test (Irons): the boundary follows an affine map; the inner nodes must follow it too, and the logarithmic
  // stress is D ln(U) everywhere, U = (F^T F)^(1/2).
  const BlankMesh mesh = distorted_rectangle(lx, ly, 5, 4);
  Shell           shell(mesh, h, elastic_material(E, nu), 5);
  Eigen::Matrix2d F;
  F << 1.12, 0.06, -0.03, 0.95;

  StaticProblem   problem(shell);
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(shell.n_dofs());
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    if (mesh.on_outer_edge[node])
      {
        problem.fix(node, { 0, 1, 2 });
        const Eigen::Vector2d u  = (F - Eigen::Matrix2d::Identity()) * mesh.nodes[node].head<2>();
        jump[shell.dof(node, 0)] = u[0];
        jump[shell.dof(node, 1)] = u[1];
      }
  problem.solve(Eigen::VectorXd::Zero(shell.n_dofs()), 1e-9, &jump);
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    {
      const Eigen::Vector3d x = shell.trial().position[node];
      EXPECT_LT((x.head<2>() - F * mesh.nodes[node].head<2>()).norm(), 1e-10);
      EXPECT_LT(std::abs(x.z()), 1e-12);
    }

  shell.commit();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(F.transpose() * F);
  const Eigen::Matrix2d                                logarithm = eigen.eigenvectors()
                                    * (0.5 * eigen.eigenvalues().array().log()).matrix().asDiagonal()
                                    * eigen.eigenvectors().transpose();
  const Eigen::Vector3d stress
      = plane_stress_elasticity() * Eigen::Vector3d(logarithm(0, 0), logarithm(1, 1), 2 * logarithm(0, 1));
  const double thickness = h * std::exp(-nu / (1 - nu) * logarithm.trace()); // plane stress, Hooke in logarithms
  const auto   results   = shell.element_results();
  for (unsigned e = 0; e < shell.n_elements(); ++e)
    {
      EXPECT_NEAR(results.membrane_stress_xx[e], stress[0], 1e-10 * E);
      EXPECT_NEAR(results.membrane_stress_yy[e], stress[1], 1e-10 * E);
      EXPECT_NEAR(results.membrane_stress_xy[e], stress[2], 1e-10 * E);
      EXPECT_NEAR(results.thickness[e], thickness, 1e-10);
      EXPECT_NEAR(results.major_strain[e], 0.5 * std::log(eigen.eigenvalues()[1]), 1e-10);
      EXPECT_NEAR(results.minor_strain[e], 0.5 * std::log(eigen.eigenvalues()[0]), 1e-10);
    }
  // Stored energy: volume times 1/2 stress . strain.
  EXPECT_NEAR(shell.elastic_energy(),
              0.5 * lx * ly * h * stress.dot(Eigen::Vector3d(logarithm(0, 0), logarithm(1, 1), 2 * logarithm(0, 1))),
              1e-10 * shell.elastic_energy());
}

TEST(PatchTest, ConstantMomentsAreExactOnADistortedMesh)
{
  // Batoz, Bathe, Ho (1980): the DKT triangle passes the patch test of constant curvature on any mesh. Linear, in the
  // flat state: w = 1/2 (a x^2 + b y^2) + c x y, director increments -grad w.
  const double    a = 0.3, b = -0.2, c = 0.15;
  const BlankMesh mesh = distorted_rectangle(lx, ly, 5, 4);
  Shell           shell(mesh, h, elastic_material(E, nu), 3);
  StaticProblem   problem(shell);

  Eigen::VectorXd exact = Eigen::VectorXd::Zero(shell.n_dofs());
  Eigen::VectorXd outer = exact;
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    {
      const double          x = mesh.nodes[node].x(), y = mesh.nodes[node].y();
      const Eigen::Vector3d slope(a * x + c * y, b * y + c * x, 0);
      exact[shell.dof(node, 2)] = 0.5 * (a * x * x + b * y * y) + c * x * y;
      for (unsigned t = 0; t < 2; ++t)
        exact[shell.dof(node, 3 + t)] = -slope.dot(shell.trial().frame[node][t]);
      if (mesh.on_outer_edge[node])
        problem.fix(node, { 0, 1, 2, 3, 4 });
    }
  for (unsigned i = 0; i < shell.n_dofs(); ++i)
    if (problem.fixed[i])
      outer[i] = exact[i];

  problem.tangent(false);
  const Eigen::VectorXd forces = problem.global_product(exact);
  // Energy of a plate of constant curvature.
  const double stiffness = E * h * h * h / (12 * (1 - nu * nu));
  const double expected  = 0.5 * stiffness * lx * ly * (a * a + b * b + 2 * nu * a * b + 2 * (1 - nu) * c * c);
  EXPECT_NEAR(0.5 * exact.dot(forces), expected, 1e-10 * expected);

  const Eigen::VectorXd load  = -problem.global_product(outer);
  const Eigen::VectorXd inner = problem.solve_linear(load);
  EXPECT_LT((inner + outer - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.cwiseAbs().maxCoeff());
}
