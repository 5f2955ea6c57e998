// On two ranks: films so large that they are solved with multigrid, the unknowns distributed.
#include "hand_made_table.h"

#include <tribodraw/base/parallel.h>
#include <tribodraw/lubrication/average_reynolds.h>
#include <tribodraw/lubrication/bounded_system.h>
#include <tribodraw/lubrication/lubricated_face.h>
#include <tribodraw/shell/blank_mesh.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  constexpr int side = 330; // 108 900 unknowns: above the limit of the direct solution

  BoundedSystem::Matrix
  laplacian()
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i)
        {
          const int k = j * side + i;
          entries.emplace_back(k, k, 4. + 1e-3 * std::sin(k));
          for (const int l : { i > 0 ? k - 1 : -1, i + 1 < side ? k + 1 : -1, j > 0 ? k - side : -1, j + 1 < side ? k + side : -1 })
            if (l >= 0)
              entries.emplace_back(k, l, -1.);
        }
    BoundedSystem::Matrix K(side * side, side * side);
    K.setFromTriplets(entries.begin(), entries.end());
    return K;
  }
} // namespace

// The same pressure as by the direct solution, on one and on two ranks: 1e-10 of the greatest.
TEST(LargeFilm, MultigridOnRanksEqualsTheDirectSolution)
{
  const int                             n = side * side;
  const BoundedSystem::Matrix           K = laplacian();
  Eigen::VectorXd                       f(n);
  for (int k = 0; k < n; ++k)
    f[k] = 1. + 0.5 * std::sin(0.01 * (k % side));
  Eigen::SimplicialLDLT<BoundedSystem::Matrix> direct(K);
  const Eigen::VectorXd                        exact = direct.solve(f);
  BoundedSystem                                system;
  system.analyse(K);
  const auto result = system.solve(K, f, Eigen::VectorXd::Constant(n, 1e300), std::vector<char>(n, BoundedSystem::free),
                                   Eigen::VectorXd::Zero(n));
  ASSERT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 1u);
  EXPECT_LT((result.x - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.maxCoeff());
}

// The film of a blank is found on every rank as a whole. From the same contact it must be the same: 1e-10 of the greatest
// pressure, volume and friction; they are equal to the last bit.
TEST(FilmOnRanks, OnAGivenBlank)
{
  const BlankMesh     mesh = make_quarter_rectangle(60, 60, 20, 20);
  LubricationSettings settings;
  settings.supply          = LubricationSettings::Supply::film_transport;
  settings.film_iterations = 30;
  LubricatedFace                       face(mesh.nodes, mesh.triangles, mesh.on_outer_edge, { test::hand_made_table() },
                                            std::make_shared<test::ConstantOil>(), std::vector<double>(mesh.nodes.size(), 2.2e-3), settings);
  std::vector<LubricatedFace::Contact> contacts(mesh.nodes.size());
  auto                                 positions = mesh.nodes;
  for (unsigned step = 1; step <= 4; ++step)
    {
      for (std::size_t i = 0; i < contacts.size(); ++i)
        {
          const Eigen::Vector3d &x     = mesh.nodes[i];
          positions[i]                 = (1 - 0.005 * step) * x; // drawn in
          contacts[i].table            = x.norm() > 25 ? 0 : -1;
          contacts[i].nominal_pressure = x.norm() > 25 ? 4 + 2 * std::sin(0.2 * x[0] + 0.1 * x[1] * step) : 0.;
          contacts[i].eps_p            = 1e-3 * step;
          contacts[i].sheet_velocity   = -0.3 * x;
        }
      face.update(positions, contacts, { 0.02, 1. });
    }
  ASSERT_GT(face.statistics().max_lubricant_pressure, 1.);
  std::vector<double> own, sum;
  for (const auto &node : face.nodes())
    own.insert(own.end(), { node.lubricant_pressure, node.supplied_film, node.friction_coefficient });
  sum = own;
  parallel::sum(sum);
  for (std::size_t i = 0; i < own.size(); ++i)
    EXPECT_NEAR(parallel::size() * own[i], sum[i], 1e-10 * std::abs(sum[i]));
}

// Square slider h1/h0 = 2, B/L = 1: W* = 0.0692765 (finite volumes 100^2 and 200^2, extrapolated).
TEST(LargeFilm, SquareSlider)
{
  const unsigned                         n    = 329;
  const BlankMesh                        mesh = make_quarter_rectangle(10, 10, n, n);
  std::vector<AverageReynolds::NodeData> nodes(mesh.nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const double x = mesh.nodes[i][0], y = mesh.nodes[i][1];
      nodes[i].fixed          = x <= 1e-9 || y <= 1e-9 || x >= 10 - 1e-9 || y >= 10 - 1e-9;
      nodes[i].film           = 4e-3 - 2e-4 * x;
      nodes[i].viscosity      = 3.2e-8;
      nodes[i].sheet_velocity = { 60, 0, 0 };
    }
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  const auto            result = reynolds.solve(mesh.nodes, nodes);
  ASSERT_TRUE(result.converged);
  const double exact = 0.0692765 * 3.2e-8 * 60 * 1000 / 4e-6; // eta U L^2 B/h0^2
  // Error of second order, 3.5e-5 on this mesh.
  EXPECT_NEAR(reynolds.load(mesh.nodes, result.pressure), exact, 5e-5 * exact);
  EXPECT_LT(result.flux_imbalance, 1e-9);
}
