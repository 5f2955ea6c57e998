#include <gtest/gtest.h>

#include "support.h"

using namespace shell_test;

namespace
{
  /// Deflection at the centre of a square plate of side 2 under uniform load, as multiple of q side^4 / D; linear
  /// theory, a quarter with n x n squares.
  double
  centre_deflection(const unsigned n, const bool clamped)
  {
    const double    E = 1000, nu = 0.3, h = 0.02, q = 1e-3;
    const BlankMesh mesh = make_quarter_rectangle(1, 1, n, n);
    Shell           shell(mesh, h, elastic_material(E, nu), 3);
    StaticProblem   problem(shell);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(shell.n_dofs());
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      {
        // Frames of a flat blank: increment 3 turns the director to x, increment 4 to y.
        if (mesh.on_x_plane[node])
          problem.fix(node, { 0, 3 });
        if (mesh.on_y_plane[node])
          problem.fix(node, { 1, 4 });
        if (mesh.on_outer_edge[node])
          problem.fix(node, { 2 });
        // Hard simple support: no rotation along the edge either.
        if (mesh.on_outer_edge[node] && (clamped || mesh.nodes[node].y() == 1))
          problem.fix(node, { 3 });
        if (mesh.on_outer_edge[node] && (clamped || mesh.nodes[node].x() == 1))
          problem.fix(node, { 4 });
        load[shell.dof(node, 2)] = q * shell.node_reference_area()[node];
      }
    const Eigen::VectorXd u = problem.solve_linear(load);
    const double          D = E * h * h * h / (12 * (1 - nu * nu));
    return u[shell.dof(0, 2)] * D / (q * 16); // side^4 = 16
  }

  void
  expect_second_order(const bool clamped, const double exact, const double tolerance)
  {
    double error[3];
    for (unsigned k = 0; k < 3; ++k)
      error[k] = std::abs(centre_deflection(4u << k, clamped) / exact - 1);
    EXPECT_LT(error[2], tolerance);
    for (unsigned k = 0; k < 2; ++k)
      {
        const double order = std::log2(error[k] / error[k + 1]);
        // DKT converges with the square of the element size.
        EXPECT_GT(order, 1.8) << "errors " << error[0] << " " << error[1] << " " << error[2];
        EXPECT_LT(order, 2.4) << "errors " << error[0] << " " << error[1] << " " << error[2];
      }
  }
} // namespace

TEST(SquarePlate, SimplySupportedConvergesToNavier)
{
  // Navier series, nu-independent: w = 0.004062353 q a^4 / D.
  expect_second_order(false, 0.004062353, 1e-3);
}

TEST(SquarePlate, ClampedConvergesToTaylorGovindjee)
{
  // R. L. Taylor, S. Govindjee, Comm. Numer. Meth. Engng 20 (2004) 757: w = 0.00126532 q a^4 / D.
  expect_second_order(true, 0.00126532, 2e-3);
}
