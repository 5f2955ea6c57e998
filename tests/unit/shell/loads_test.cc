#include <tribodraw/shell/loads.h>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support.h"

using namespace shell_test;
using Eigen::Vector3d;

namespace
{
  /// A quarter of a cylinder of radius 10 and length 12, x to z.
  BlankMesh
  curved_mesh()
  {
    std::vector<Vector3d> points;
    for (unsigned j = 0; j <= 3; ++j)
      for (unsigned i = 0; i <= 4; ++i)
        {
          const double angle = M_PI / 8 * i;
          points.emplace_back(10 * std::sin(angle), 4. * j, 10 * std::cos(angle));
        }
    return make_mapped_grid(4, 3, points);
  }

  Eigen::VectorXd
  some_increment(const Shell &shell, const double size)
  {
    Eigen::VectorXd u(shell.n_dofs());
    for (Eigen::Index i = 0; i < u.size(); ++i)
      u[i] = size * std::sin(1.3 * static_cast<double>(i * i) + 0.4);
    return u;
  }

  Eigen::VectorXd
  product(const SparseMatrix &K, const Eigen::VectorXd &x)
  {
    const Eigen::VectorXd part = K.multiply(x);
    std::vector<double>   sum(part.data(), part.data() + part.size());
    parallel::sum(sum);
    return Eigen::Map<Eigen::VectorXd>(sum.data(), part.size());
  }

  Vector3d
  resultant(const Shell &shell, const Eigen::VectorXd &forces)
  {
    Vector3d sum = Vector3d::Zero();
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      for (unsigned k = 0; k < 3; ++k)
        sum[k] += forces[shell.dof(node, k)];
    return sum;
  }
} // namespace

TEST(Loads, ResultantsAreTheLoads)
{
  const BlankMesh mesh = distorted_rectangle(6, 4, 5, 3);
  const Shell     shell(mesh, 1, elastic_material(1000, 0.3), 3);
  const auto      edge = boundary_edges(mesh, nodes_where(mesh, [](const Vector3d &x) { return x.x() == 6; }));
  ASSERT_EQ(edge.size(), 3u);                  // three squares along y
  EXPECT_EQ(boundary_edges(mesh).size(), 16u); // 2 (5 + 3)
  Loads line, weight, pressure;
  line.add_edge_force(mesh, edge, { 1, 2, 3 });
  weight.add_surface_force(mesh, { 0, 0, -0.5 });
  pressure.add_pressure(mesh, 0.25);
  EXPECT_LT((resultant(shell, line.forces(shell)) - 4 * Vector3d(1, 2, 3)).norm(), 1e-12);       // side of 4 mm
  EXPECT_LT((resultant(shell, weight.forces(shell)) - 24 * Vector3d(0, 0, -0.5)).norm(), 1e-12); // area 24 mm^2
  // Counter-clockwise seen from +z: the pressure pushes upwards.
  EXPECT_LT((resultant(shell, pressure.forces(shell)) - 24 * Vector3d(0, 0, 0.25)).norm(), 1e-12);
}

TEST(Loads, PressureActsOnTheProjectionOfTheDeformedSurface)
{
  // Uniform pressure on any surface spanned over a curve: the resultant depends on the curve only. Quarter cylinder of
  // radius 10, length 12: 120 mm^2 seen along x and along z. The triangles turn around -r here.
  const BlankMesh mesh = curved_mesh();
  Shell           shell(mesh, 1, elastic_material(1000, 0.3), 3);
  Eigen::VectorXd u = some_increment(shell, 0.2);
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    if (mesh.on_outer_edge[node])
      for (unsigned c = 0; c < 5; ++c)
        u[shell.dof(node, c)] = 0;
  shell.move(u);
  Loads pressure;
  pressure.add_pressure(mesh, 0.5);
  const double sign = shell.node_normals()[7].dot(mesh.nodes[7]) > 0 ? 1 : -1;
  EXPECT_LT((resultant(shell, pressure.forces(shell)) - sign * 60 * Vector3d(1, 0, 1)).norm(), 1e-11);
}

TEST(Loads, StiffnessIsTheDerivativeOfTheForces)
{
  // Origin: the definition, central differences.
  const BlankMesh mesh = curved_mesh();
  Shell           shell(mesh, 1, elastic_material(1000, 0.3), 3);
  shell.move(some_increment(shell, 0.2));
  const Shell::Configuration at = shell.trial();
  Loads                      loads;
  loads.add_pressure(mesh, 0.7);
  loads.add_point_moment(7, { 3, -1, 2 });
  loads.add_edge_moment(mesh, boundary_edges(mesh), { 0.3, 0.1, -0.2 });
  loads.add_point_force(3, { 1, 1, 1 });
  EXPECT_FALSE(loads.conservative());

  SparseMatrix    K        = shell.make_matrix();
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(shell.n_dofs());
  loads.subtract(shell, 1.5, residual, &K);
  EXPECT_LT((residual + 1.5 * loads.forces(shell)).norm(), 1e-13 * residual.norm());
  const Eigen::VectorXd direction = some_increment(shell, 1);
  const double          step      = 1e-5;
  shell.move(step * direction);
  const Eigen::VectorXd plus = loads.forces(shell);
  shell.set_trial(at);
  shell.move(-step * direction);
  const Eigen::VectorXd difference = -1.5 * (plus - loads.forces(shell)) / (2 * step);
  EXPECT_LT((product(K, direction) - difference).norm(), 1e-8 * difference.norm());
}

TEST(Loads, MomentDoesTheWorkOfItsRotation)
{
  // Rotate all directors by a small angle about the moment: the work is moment times angle for a moment in the
  // tangent plane.
  const BlankMesh mesh = rectangle(2, 2, 2, 2);
  const Shell     shell(mesh, 1, elastic_material(1000, 0.3), 3);
  Loads           loads;
  loads.add_point_moment(4, { 0, 5, 0 });
  // Turning about +y moves the director z to +x: increment along e_1 = x.
  const Eigen::VectorXd f = loads.forces(shell);
  EXPECT_NEAR(f[shell.dof(4, 3)], 5, 1e-14);
  EXPECT_NEAR(f[shell.dof(4, 4)], 0, 1e-14);
}

TEST(Supports, MirrorPlanesHoldTheirDirections)
{
  const BlankMesh mesh = make_quarter_rectangle(3, 2, 3, 2);
  Shell           shell(mesh, 1, elastic_material(1000, 0.3), 3);
  Supports        supports(shell);
  supports.mirror(nodes_where(mesh, [](const Vector3d &x) { return x.x() == 0; }), 0);
  supports.mirror(nodes_where(mesh, [](const Vector3d &x) { return x.y() == 0; }), 1);
  const auto held = [&](const unsigned node) {
    std::vector<unsigned> components;
    for (unsigned c = 0; c < 5; ++c)
      if (supports.fixed()[shell.dof(node, c)])
        components.push_back(c);
    return components;
  };
  EXPECT_EQ(held(0), (std::vector<unsigned>{ 0, 1, 3, 4 })); // the corner on both planes: only z is free
  EXPECT_EQ(held(1), (std::vector<unsigned>{ 1, 3 }));       // on y = 0; e_1 is turned to y
  EXPECT_LT((shell.trial().frame[1][0] - Vector3d::UnitY()).norm(), 1e-14);
  EXPECT_EQ(held(4), (std::vector<unsigned>{ 0, 3 })); // on x = 0
  EXPECT_TRUE(held(5).empty());
  EXPECT_THROW(supports.mirror({ 5 }, 2), std::logic_error); // the directors point along z
}

TEST(Supports, HingesClampsAndMotion)
{
  const BlankMesh mesh = make_quarter_rectangle(3, 2, 3, 2);
  Shell           shell(mesh, 1, elastic_material(1000, 0.3), 3);
  Supports        supports(shell);
  supports.hinge({ 1 });
  supports.hinge({ 2 }, Vector3d::UnitY());
  supports.clamp({ 3 });
  supports.prescribe({ 6 }, 2, -0.4);
  unsigned n = 0;
  for (const bool fixed : supports.fixed())
    n += fixed;
  EXPECT_EQ(n, 3u + 4u + 5u + 1u);
  EXPECT_TRUE(supports.fixed()[shell.dof(2, 3)]);
  EXPECT_LT((shell.trial().frame[2][0] - Vector3d::UnitY()).norm(), 1e-14);
  EXPECT_EQ(supports.motion()[shell.dof(6, 2)], -0.4);
  EXPECT_EQ(supports.motion().cwiseAbs().sum(), 0.4);
}
