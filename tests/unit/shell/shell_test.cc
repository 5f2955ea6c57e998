#include <tribodraw/base/errors.h>
#include <tribodraw/shell/element.h>

#include <deal.II/base/multithread_info.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support.h"

using namespace shell_test;

namespace
{
  constexpr double h = 0.8;

  /// A quarter of a cylinder of radius 10 and length 12.
  BlankMesh
  curved_mesh()
  {
    std::vector<Eigen::Vector3d> points;
    for (unsigned j = 0; j <= 6; ++j)
      for (unsigned i = 0; i <= 8; ++i)
        {
          const double angle = 0.5 * 3.14159 * i / 8;
          points.emplace_back(10 * std::sin(angle), 2. * j, 10 * std::cos(angle));
        }
    return make_mapped_grid(8, 6, points);
  }

  /// Some smooth deformation far into plasticity.
  Eigen::VectorXd
  deformation(const Shell &shell, const double size)
  {
    Eigen::VectorXd u(shell.n_dofs());
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      {
        const Eigen::Vector3d &x = shell.mesh().nodes[node];
        for (unsigned c = 0; c < 5; ++c)
          u[shell.dof(node, c)] = size * std::sin(0.3 * (c + 1) * x.x() + 0.5 * x.y() + 0.2 * x.z() + c);
      }
    return u;
  }

  std::shared_ptr<const SheetMaterial>
  material()
  {
    return plastic_material(70000, 0.33, 120, 0.01, 0.2);
  }
} // namespace

TEST(Shell, AssembledOnAllRanksEqualsTheSumOfItsElements)
{
  // Expected: element by element on one rank, with the element routine that is tested by itself.
  const BlankMesh mesh = curved_mesh();
  Shell           shell(mesh, h, material(), 5);
  shell.move(deformation(shell, 0.05));
  SparseMatrix    K = shell.make_matrix(1);
  Eigen::VectorXd force;
  ASSERT_EQ(K.size(), static_cast<int>(shell.n_dofs()) + 1);
  ASSERT_TRUE(shell.assemble(1, {}, force, &K));
  ASSERT_EQ(force.size(), K.size());

  Eigen::VectorXd       expected_force   = Eigen::VectorXd::Zero(K.size());
  Eigen::VectorXd       expected_product = expected_force;
  const Eigen::VectorXd x                = Eigen::VectorXd::LinSpaced(K.size(), -1, 1);
  const auto            rule             = shell_element::make_thickness_rule(5);
  const auto            sheet            = material();
  const auto            normals          = Shell(mesh, h, sheet, 5).node_normals();
  const auto            opposites        = mesh.opposite_nodes();
  double                plastic_work     = 0;
  for (const auto &triangle : mesh.triangles)
    {
      shell_element::NodeState  undeformed, nodes;
      Eigen::VectorXi           dofs(shell_element::n_dofs);
      shell_element::Neighbours neighbours;
      for (unsigned i = 0; i < 3; ++i)
        {
          undeformed.position[i] = mesh.nodes[triangle[i]];
          undeformed.director[i] = normals[triangle[i]];
          nodes.position[i]      = shell.trial().position[triangle[i]];
          nodes.director[i]      = shell.trial().director[triangle[i]];
          nodes.frame[i]         = shell.trial().frame[triangle[i]];
          const int opposite     = opposites[&triangle - mesh.triangles.data()][i];
          for (unsigned c = 0; c < 3; ++c)
            {
              dofs[shell_element::displacement_dof(i, c)] = static_cast<int>(shell.dof(triangle[i], c));
              // Without a neighbour the entries vanish, wherever they are added.
              dofs[shell_element::opposite_dof(i, c)]
                  = static_cast<int>(shell.dof(opposite < 0 ? 0 : static_cast<unsigned>(opposite), c));
            }
          for (unsigned t = 0; t < 2; ++t)
            dofs[shell_element::director_dof(i, t)] = static_cast<int>(shell.dof(triangle[i], 3 + t));
          neighbours.present[i] = opposite >= 0;
          if (opposite >= 0)
            {
              undeformed.opposite[i] = mesh.nodes[static_cast<unsigned>(opposite)];
              nodes.opposite[i]      = shell.trial().position[static_cast<unsigned>(opposite)];
            }
        }
      const std::vector<PlasticState> old_states(15);
      std::vector<PlasticState>       new_states(15);
      shell_element::ForceVector      f;
      shell_element::TangentMatrix    k;
      const auto                      summary
          = shell_element::integrate(shell_element::make_reference(undeformed, neighbours), nodes,
                                     { h, 1, &rule, sheet.get() }, {}, old_states.data(), new_states.data(), f, k);
      ASSERT_TRUE(summary.valid);
      plastic_work += summary.plastic_work;
      expected_force(dofs) += f;
      expected_product(dofs) += k * x(dofs);
    }
  EXPECT_GT(plastic_work, 0);
  EXPECT_LT((force - expected_force).norm(), 1e-12 * expected_force.norm());

  const Eigen::VectorXd part = K.multiply(x);
  std::vector<double>   product(part.data(), part.data() + part.size());
  parallel::sum(product);
  EXPECT_LT((Eigen::Map<Eigen::VectorXd>(product.data(), part.size()) - expected_product).norm(),
            1e-12 * expected_product.norm());
  shell.commit();
  EXPECT_NEAR(shell.plastic_work(), plastic_work, 1e-12 * plastic_work);
}

TEST(Shell, AssemblyIsRepeatableToTheLastBit)
{
  Shell shell(curved_mesh(), h, material(), 5);
  shell.move(deformation(shell, 0.05));
  SparseMatrix    K = shell.make_matrix(), L = shell.make_matrix();
  Eigen::VectorXd first, second;
  ASSERT_TRUE(shell.assemble(1, {}, first, &K));
  ASSERT_TRUE(shell.assemble(1, {}, second, &L));
  EXPECT_EQ((first - second).norm(), 0);
  EXPECT_EQ(K.values(), L.values());
}

TEST(Shell, AssemblyDoesNotDependOnTheNumberOfThreads)
{
  // A mesh large enough to be cut into many pieces.
  const unsigned before = dealii::MultithreadInfo::n_threads();
  Shell          shell(rectangle(20, 20, 24, 24), h, material(), 5);
  shell.move(deformation(shell, 0.02));
  std::vector<std::vector<double>> tangents, forces;
  for (const unsigned n : { 1u, 2u, 4u })
    {
      dealii::MultithreadInfo::set_thread_limit(n);
      SparseMatrix    K = shell.make_matrix();
      Eigen::VectorXd force;
      ASSERT_TRUE(shell.assemble(1, {}, force, &K));
      tangents.push_back(K.values());
      forces.emplace_back(force.data(), force.data() + force.size());
    }
  dealii::MultithreadInfo::set_thread_limit(before);
  for (unsigned k = 1; k < 3; ++k)
    {
      EXPECT_EQ(tangents[0], tangents[k]);
      EXPECT_EQ(forces[0], forces[k]);
    }
}

TEST(Shell, ExtraUnknownCouplesWithAllDisplacements)
{
  const Shell        shell(curved_mesh(), h, material(), 3);
  const SparseMatrix K     = shell.make_matrix(1);
  const int          extra = static_cast<int>(shell.n_dofs());
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    for (unsigned c = 0; c < 3; ++c)
      {
        EXPECT_NO_THROW(K.position(extra, static_cast<int>(shell.dof(node, c))));
        EXPECT_NO_THROW(K.position(static_cast<int>(shell.dof(node, c)), extra));
      }
  EXPECT_NO_THROW(K.position(extra, extra));
}

TEST(Shell, RigidMotionOfACurvedShellIsFree)
{
  Shell                   shell(curved_mesh(), h, material(), 5);
  Shell::Configuration    c = shell.trial();
  const Eigen::AngleAxisd turn(2.2, Eigen::Vector3d(1, -2, 0.5).normalized());
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    {
      c.position[node] = turn * c.position[node] + Eigen::Vector3d(3, -40, 7);
      c.director[node] = turn * c.director[node];
      for (auto &e : c.frame[node])
        e = turn * e;
    }
  shell.set_trial(c);
  Eigen::VectorXd force;
  ASSERT_TRUE(shell.assemble(1, {}, force, nullptr));
  shell.commit();
  // E h = 56000 N/mm; round-off of lengths of 50 mm in 1 mm elements is some 1e-14.
  EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT(shell.elastic_energy(), 1e-16);
}

TEST(Shell, DirectorsStayUnitVectorsWithTheirFrames)
{
  Shell shell(curved_mesh(), h, material(), 3);
  // A node on the symmetry plane y = 0 whose first increment is held: its frame must stay on the axis.
  shell.align_director_frame(4, Eigen::Vector3d::UnitY());
  for (unsigned k = 0; k < 1000; ++k)
    {
      Eigen::VectorXd u  = deformation(shell, 0.3);
      u[shell.dof(4, 3)] = 0;
      shell.move(u);
    }
  const auto &c = shell.trial();
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    {
      Eigen::Matrix3d frame;
      frame << c.frame[node][0], c.frame[node][1], c.director[node];
      EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-13);
      EXPECT_NEAR(frame.determinant(), 1, 1e-13);
    }
  EXPECT_LT((c.frame[4][0] - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(Shell, AreasAndNormals)
{
  const Shell shell(make_quarter_rectangle(3, 2, 6, 4), h, material(), 3);
  double      reference = 0, current = 0;
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    {
      reference += shell.node_reference_area()[node];
      current += shell.node_current_area()[node];
      EXPECT_LT((shell.node_normals()[node] - Eigen::Vector3d::UnitZ()).norm(), 1e-15); // flat
      EXPECT_NEAR(shell.node_thickness()[node], h, 1e-14);
    }
  EXPECT_NEAR(reference, 6, 1e-12); // 3 x 2
  EXPECT_NEAR(current, 6, 1e-12);
}

TEST(Shell, FailsOnEachRankIfAnElementIsInverted)
{
  Shell           shell(rectangle(4, 4, 4, 4), h, material(), 3);
  Eigen::VectorXd u   = Eigen::VectorXd::Zero(shell.n_dofs());
  u[shell.dof(12, 0)] = 5; // the centre node beyond the edge
  Eigen::VectorXd force;
  shell.move(u);
  EXPECT_FALSE(shell.assemble(1, {}, force, nullptr));
  EXPECT_THROW(shell.commit(), std::logic_error);
  shell.revert();
  EXPECT_TRUE(shell.assemble(1, {}, force, nullptr));
}

TEST(Shell, RejectsWrongInput)
{
  EXPECT_THROW(Shell(rectangle(1, 1, 1, 1), -1, material(), 5), InputError);
  EXPECT_THROW(Shell(rectangle(1, 1, 1, 1), 1, material(), 2), InputError);
  EXPECT_THROW(Shell(BlankMesh(), 1, material(), 5), InputError);
}
