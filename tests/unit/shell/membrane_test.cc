#include <tribodraw/base/errors.h>
#include <tribodraw/shell/loads.h>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <map>

#include "support.h"

using namespace shell_test;
using Eigen::Vector3d;

namespace
{
  using Membrane = Shell::Membrane;

  BlankMesh
  grid(const unsigned n_u, const unsigned n_v, const std::function<Vector3d(double, double)> &map)
  {
    std::vector<Vector3d> points;
    for (unsigned j = 0; j <= n_v; ++j)
      for (unsigned i = 0; i <= n_u; ++i)
        points.push_back(map(double(i) / n_u, double(j) / n_v));
    return make_mapped_grid(n_u, n_v, points);
  }

  Shell
  elastic_shell(const BlankMesh &mesh, const double E, const double nu, const double h, const Membrane membrane)
  {
    return Shell(mesh, h, elastic_material(E, nu), 3, Shell::ThicknessPoints::gauss, membrane);
  }

  Eigen::VectorXd
  linear_solution(Shell &shell, const Supports &supports, const Loads &loads)
  {
    StaticProblem problem(shell);
    problem.fixed = supports.fixed();
    return problem.solve_linear(loads.forces(shell));
  }

  /// Deflection of the middle of the loaded side of Cook's membrane.
  double
  cook(const unsigned n, const Membrane membrane)
  {
    const BlankMesh mesh = grid(
        n, n, [](const double u, const double v) { return Vector3d(48 * u, 44 * u * (1 - v) + v * (44 + 16 * u), 0); });
    Shell    shell = elastic_shell(mesh, 1, 1. / 3, 1, membrane);
    Supports supports(shell);
    supports.fix(nodes_where(mesh, [](const Vector3d &) { return true; }), { 2, 3, 4 });
    supports.hinge(nodes_where(mesh, [](const Vector3d &x) { return x.x() == 0; }));
    Loads loads;
    loads.add_edge_force(mesh, boundary_edges(mesh, nodes_where(mesh, [](const Vector3d &x) { return x.x() == 48; })),
                         { 0, 1. / 16, 0 });
    return linear_solution(shell, supports, loads)[shell.dof((n + 1) * (n / 2) + n, 1)];
  }

  /// Deflection of the middle of the free edge of the Scordelis-Lo roof, a quarter.
  double
  roof(const unsigned n, const Membrane membrane)
  {
    const double opening = 40 * M_PI / 180;
    BlankMesh    mesh    = grid(n, n, [&](const double u, const double v) {
      return Vector3d(25 * std::sin(opening * u), 25 * v, 25 * std::cos(opening * u));
    });
    for (unsigned node = 0; node < mesh.nodes.size(); ++node)
      {
        mesh.on_x_plane[node] = node % (n + 1) == 0;
        mesh.on_y_plane[node] = node <= n;
        mesh.normals.push_back(Vector3d(mesh.nodes[node].x(), 0, mesh.nodes[node].z()).normalized());
      }
    Shell    shell = elastic_shell(mesh, 4.32e8, 0, 0.25, membrane);
    Supports supports(shell);
    for (unsigned node = 0; node < mesh.nodes.size(); ++node)
      {
        if (mesh.on_x_plane[node])
          supports.mirror({ node }, 0);
        if (mesh.on_y_plane[node])
          supports.mirror({ node }, 1);
        if (mesh.nodes[node].y() == 25)
          supports.fix({ node }, { 0, 2 });
      }
    Loads loads;
    loads.add_surface_force(mesh, { 0, 0, -90 });
    return -linear_solution(shell, supports, loads)[shell.dof(n, 2)];
  }

  Eigen::VectorXd
  smooth_increment(const Shell &shell, const double size)
  {
    Eigen::VectorXd u(shell.n_dofs());
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      for (unsigned c = 0; c < 5; ++c)
        u[shell.dof(node, c)]
            = size * std::sin(shell.mesh().nodes[node].dot(Vector3d(0.3 * (c + 1), 0.5, 0.2)) + c + 0.1 * node);
    return u;
  }
} // namespace

TEST(Membrane, CooksMembrane)
{
  // R. D. Cook, J. Struct. Div. ASCE 100 (1974) 1851: plane stress, E = 1, nu = 1/3, shear force 1; converged
  // deflection 23.96 (J. C. Simo, M. S. Rifai, Int. J. Numer. Meth. Engng 29 (1990) 1595).
  const double exact = 23.96;
  double       smoothed[3], constant[3];
  for (unsigned k = 0; k < 3; ++k)
    {
      smoothed[k] = 1 - cook(4u << k, Membrane::edge_smoothed) / exact;
      constant[k] = 1 - cook(4u << k, Membrane::constant_strain) / exact;
      EXPECT_GT(smoothed[k], 0);
      EXPECT_LT(smoothed[k], 0.6 * constant[k]) << "elements along a side: " << (4u << k);
    }
  EXPECT_LT(smoothed[2], 0.02);
  EXPECT_GT(std::log2(smoothed[1] / smoothed[2]), 1.4); // a corner singularity at the clamped side lowers the order 2
}

TEST(Membrane, ScordelisLoRoof)
{
  // Kirchhoff-Love shells converge to 0.3006 (T. J. R. Hughes, J. A. Cottrell, Y. Bazilevs, Comput. Methods Appl. Mech.
  // Engrg. 194 (2005) 4135).
  const double exact = 0.3006;
  double       smoothed[2], constant[2];
  for (unsigned k = 0; k < 2; ++k)
    {
      smoothed[k] = std::abs(1 - roof(8u << k, Membrane::edge_smoothed) / exact);
      constant[k] = std::abs(1 - roof(8u << k, Membrane::constant_strain) / exact);
      EXPECT_LT(smoothed[k], 0.4 * constant[k]);
    }
  EXPECT_LT(smoothed[1], 0.015);
  EXPECT_GT(std::log2(smoothed[0] / smoothed[1]), 1.5);
}

TEST(Membrane, OnlyRigidMotionsAreFree)
{
  // A free patch: six eigenvalues of the stiffness vanish, the others do not.
  std::vector<BlankMesh> meshes{ rectangle(3, 3, 3, 3), distorted_rectangle(4, 3, 4, 3), rectangle(1, 1, 1, 1),
                                 rectangle(2, 1, 2, 1) };
  for (const BlankMesh &mesh : meshes)
    {
      Shell               shell = elastic_shell(mesh, 1000, 0.3, 0.5, Membrane::edge_smoothed);
      StaticProblem       problem(shell);
      const SparseMatrix &K = problem.tangent(false);
      Eigen::MatrixXd     dense(K.size(), K.size());
      for (int j = 0; j < K.size(); ++j)
        dense.col(j) = problem.global_product(Eigen::VectorXd::Unit(K.size(), j));
      EXPECT_LT((dense - dense.transpose()).norm(), 1e-13 * dense.norm());
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
      EXPECT_LT(std::abs(values[5]), 1e-11 * values.tail<1>()[0]);
      EXPECT_GT(values[6], 1e-4 * values.tail<1>()[0]) << mesh.triangles.size() << " triangles";
    }
}

TEST(Membrane, MirroredAndRotatedMeshesGiveMirroredAndRotatedForces)
{
  // Isotropic, deep in plasticity. Origin: the symmetry of space.
  const BlankMesh mesh   = grid(5, 4, [](const double u, const double v) {
    return Vector3d(10 * std::sin(1.4 * u), 8 * v + u, 10 * std::cos(1.4 * u));
  });
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(1, 1)           = -1;
  const Eigen::Matrix3d rotation
      = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix() * mirror * mirror;
  const auto material = plastic_material(70000, 0.33, 120, 0.01, 0.2);
  Shell      shell(mesh, 0.8, material, 5);
  shell.move(smooth_increment(shell, 0.1));
  Eigen::VectorXd force;
  ASSERT_TRUE(shell.assemble(1, {}, force, nullptr));
  for (const Eigen::Matrix3d &Q : { mirror, rotation })
    {
      BlankMesh image = mesh;
      for (Vector3d &x : image.nodes)
        x = Q * x;
      if (Q.determinant() < 0)
        for (auto &t : image.triangles)
          std::swap(t[1], t[2]);
      Shell                other(image, 0.8, material, 5);
      Shell::Configuration c = shell.trial();
      for (unsigned node = 0; node < other.n_nodes(); ++node)
        {
          c.position[node] = Q * c.position[node];
          c.director[node] = Q * c.director[node];
          for (Vector3d &e : c.frame[node])
            e = Q * e;
        }
      other.set_trial(c);
      Eigen::VectorXd image_force;
      ASSERT_TRUE(other.assemble(1, {}, image_force, nullptr));
      double difference = 0;
      for (unsigned node = 0; node < other.n_nodes(); ++node)
        {
          Vector3d f, g;
          for (unsigned k = 0; k < 3; ++k)
            {
              f[k] = force[shell.dof(node, k)];
              g[k] = image_force[other.dof(node, k)];
            }
          difference = std::max(difference, (Q * f - g).norm());
          for (unsigned t = 3; t < 5; ++t)
            difference = std::max(difference, std::abs(force[shell.dof(node, t)] - image_force[other.dof(node, t)]));
        }
      EXPECT_LT(difference, 1e-11 * force.norm());
      other.commit();
      EXPECT_GT(other.plastic_work(), 0);
    }
}

TEST(Membrane, AQuarterWithSymmetryPlanesEqualsTheWhole)
{
  // The whole is the quarter mirrored at x = 0 and y = 0; a load that is symmetric and not uniform.
  const BlankMesh quarter = [] {
    BlankMesh m = make_quarter_rectangle(3, 2, 3, 2);
    for (std::size_t i = 0; i < m.nodes.size(); ++i)
      if (!m.on_outer_edge[i])
        {
          m.nodes[i].x() += m.on_x_plane[i] ? 0 : 0.2 * std::sin(5. * static_cast<double>(i));
          m.nodes[i].y() += m.on_y_plane[i] ? 0 : 0.2 * std::cos(3. * static_cast<double>(i));
        }
    return m;
  }();
  BlankMesh                                     whole;
  std::map<std::pair<double, double>, unsigned> known;
  for (const double sx : { 1., -1. })
    for (const double sy : { 1., -1. })
      for (const auto &t : quarter.triangles)
        {
          std::array<unsigned, 3> image{};
          for (unsigned k = 0; k < 3; ++k)
            {
              const Vector3d x(sx * quarter.nodes[t[k]].x(), sy * quarter.nodes[t[k]].y(), 0);
              const auto     found = known.emplace(std::make_pair(x.x() + 0., x.y() + 0.), whole.nodes.size());
              if (found.second)
                whole.nodes.push_back(x);
              image[k] = found.first->second;
            }
          if (sx * sy < 0)
            std::swap(image[1], image[2]);
          whole.triangles.push_back(image);
        }
  const auto pull  = [](const Vector3d &x) { return Vector3d(20 * x.x(), -5 * x.y() * x.x() * x.x(), 0.2); };
  const auto solve = [&](const BlankMesh &mesh, const bool supported) {
    auto     shell = std::make_unique<Shell>(mesh, 0.8, plastic_material(70000, 0.33, 120, 0.01, 0.2), 5);
    Supports supports(*shell);
    for (unsigned node = 0; node < mesh.nodes.size(); ++node)
      {
        if (supported && mesh.on_x_plane[node])
          supports.mirror({ node }, 0);
        if (supported && mesh.on_y_plane[node])
          supports.mirror({ node }, 1);
        if (!supported && mesh.nodes[node].x() == 0)
          supports.fix(node, 0);
        if (!supported && mesh.nodes[node].y() == 0)
          supports.fix(node, 1);
        if (std::abs(mesh.nodes[node].x()) == 3)
          supports.fix(node, 2);
      }
    Loads loads;
    for (unsigned node = 0; node < mesh.nodes.size(); ++node)
      {
        const Vector3d &x     = mesh.nodes[node];
        const double    share = supported ? (x.x() == 0 ? 0.5 : 1.) * (x.y() == 0 ? 0.5 : 1.) : 1.;
        loads.add_point_force(node, share * pull({ x.x(), x.y(), 0 }));
      }
    StaticProblem problem(*shell);
    problem.fixed = supports.fixed();
    for (const double factor : { 0.4, 0.5, 0.6 })
      {
        problem.solve(factor * loads.forces(*shell), 1e-9);
        shell->commit();
      }
    return shell;
  };
  const auto part = solve(quarter, true), all = solve(whole, false);
  EXPECT_GT(part->plastic_work(), 0.1);
  for (unsigned node = 0; node < quarter.nodes.size(); ++node)
    {
      const unsigned image = known.at({ quarter.nodes[node].x(), quarter.nodes[node].y() });
      EXPECT_LT((part->trial().position[node] - all->trial().position[image]).norm(), 1e-10);
    }
}

TEST(Membrane, RefusesWhatIsNoSurface)
{
  // Third triangle at the side from node 0 to node 1; neighbours of opposite sense.
  BlankMesh mesh;
  mesh.nodes     = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 } };
  mesh.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 } };
  EXPECT_THROW(mesh.opposite_nodes(), InputError);
  mesh.triangles = { { 0, 1, 2 }, { 0, 1, 3 } };
  EXPECT_THROW(mesh.opposite_nodes(), InputError);
  mesh.triangles      = { { 0, 1, 2 }, { 1, 0, 3 } };
  const auto opposite = mesh.opposite_nodes();
  EXPECT_EQ(opposite[0], (std::array<int, 3>{ 3, -1, -1 }));
  EXPECT_EQ(opposite[1], (std::array<int, 3>{ 2, -1, -1 }));
}
