#include "../shell/support.h"
#include "temporary_folder.h"

#include <tribodraw/base/face_mesh.h>
#include <tribodraw/base/files.h>
#include <tribodraw/output/dynain.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <sstream>

using namespace tribodraw;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
  std::array<double, 6>
  components(const Matrix3d &a)
  {
    return { a(0, 0), a(1, 1), a(2, 2), a(0, 1), a(1, 2), a(2, 0) };
  }

  /// Put the sheet into a state and commit it.
  template <class Place, class Director>
  void
  deform(Shell &shell, const Place &place, const Director &director)
  {
    auto state = shell.trial();
    for (unsigned i = 0; i < shell.n_nodes(); ++i)
      {
        const Vector3d &x    = shell.mesh().nodes[i];
        const Vector3d  d    = director(x);
        const auto      turn = Eigen::Quaterniond::FromTwoVectors(state.director[i], d);
        state.position[i]    = place(x);
        state.director[i]    = d;
        for (auto &axis : state.frame[i])
          axis = turn * axis;
      }
    shell.set_trial(state);
    Eigen::VectorXd force;
    ASSERT_TRUE(shell.assemble(1, {}, force, nullptr));
    shell.commit();
  }
} // namespace

TEST(Dynain, StressAndStrainTurnWithTheSheet)
{
  const auto     material = shell_test::plastic_material(210000, 0.3, 200, 0.01, 0.2);
  Shell          shell(shell_test::rectangle(20, 10, 4, 2), 0.8, material, 5);
  const Matrix3d R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  deform(
      shell, [&](const Vector3d &x) { return Vector3d(R * Vector3d(1.05 * x[0], 0.99 * x[1], 0) + Vector3d(1, 2, 3)); },
      [&](const Vector3d &) { return Vector3d(R.col(2)); });
  // One material point under the same strain; Cauchy stress = Kirchhoff stress / volume ratio.
  PlasticState  state;
  const Vector3 E      = { std::log(1.05), std::log(0.99), 0 };
  const auto    update = material->update(E, {}, 1, state);
  const double  e33    = material->thickness_strain(E, state);
  const double  J      = 1.05 * 0.99 * std::exp(e33);
  const auto stress = components(R * Vector3d(update.stress[0], update.stress[1], 0).asDiagonal() * R.transpose() / J);
  const auto strain = components(R * Vector3d(E[0], E[1], e33).asDiagonal() * R.transpose());
  const auto layers = shell.layers();
  ASSERT_EQ(layers.place.size(), 5u);
  ASSERT_EQ(layers.stress.size(), 5u * shell.n_elements());
  for (std::size_t i = 0; i < layers.stress.size(); ++i)
    {
      for (unsigned c = 0; c < 6; ++c)
        {
          EXPECT_NEAR(layers.stress[i][c], stress[c], 1e-7 * 400);
          EXPECT_NEAR(layers.strain[i][c], strain[c], 1e-10);
        }
      EXPECT_NEAR(layers.eps_p[i], state.eps_p, 1e-10);
    }
}

TEST(Dynain, LayersOfABentSheet)
{
  const double radius = 50, t = 0.8;
  Shell        shell(shell_test::rectangle(20, 10, 20, 10), t, shell_test::elastic_material(210000, 0), 5);
  // Rolled about the y axis, hollow below: the upper side is stretched by z / radius.
  deform(
      shell,
      [&](const Vector3d &x) {
        return Vector3d(radius * std::sin(x[0] / radius), x[1], radius * (std::cos(x[0] / radius) - 1));
      },
      [&](const Vector3d &x) { return Vector3d(std::sin(x[0] / radius), 0, std::cos(x[0] / radius)); });
  const auto layers = shell.layers();
  for (unsigned e = 0; e < shell.n_elements(); ++e)
    for (unsigned l = 0; l < 5; ++l)
      {
        const auto  &s     = layers.strain[5 * e + l];
        const double along = s[0] + s[1] + s[2]; // the strain across is zero, and so is Poisson's ratio
        EXPECT_NEAR(along, std::log(1 + 0.5 * t * layers.place[l] / radius), 0.02 * 0.5 * t / radius);
      }
  EXPECT_LT(layers.place.front(), layers.place.back());
}

TEST(Dynain, FileHoldsTheMeshAndAllLayers)
{
  const TemporaryFolder folder;
  Shell                 shell(shell_test::rectangle(20, 10, 4, 2), 0.8, shell_test::elastic_material(210000, 0.3), 3);
  deform(
      shell, [](const Vector3d &x) { return Vector3d(1.001 * x[0], x[1], 0); },
      [](const Vector3d &) { return Vector3d(0, 0, 1); });
  write_dynain(folder / "dynain.k", shell, "test");
  // The reader of LS-DYNA meshes finds the sheet again.
  const FaceMesh mesh = read_face_mesh(folder / "dynain.k", "1");
  ASSERT_EQ(mesh.triangles.size(), shell.n_elements());
  double area = 0;
  for (const auto &v : mesh.triangles)
    area += 0.5 * (mesh.nodes[v[1]] - mesh.nodes[v[0]]).cross(mesh.nodes[v[2]] - mesh.nodes[v[0]]).z();
  EXPECT_NEAR(area, 200 * 1.001, 1e-6);
  // Cards by columns: head, then two cards for each layer.
  std::istringstream lines(read_file(folder / "dynain.k"));
  std::string        line;
  const auto         layers = shell.layers();
  while (std::getline(lines, line) && line != "*INITIAL_STRESS_SHELL")
    ;
  std::getline(lines, line);
  EXPECT_EQ(line, "         1         1         3         0         0         1");
  std::getline(lines, line);
  ASSERT_EQ(line.size(), 80u);
  EXPECT_NEAR(std::stod(line.substr(0, 16)), -std::sqrt(0.6), 1e-8); // first of three Gauss points
  EXPECT_NEAR(std::stod(line.substr(16, 16)), layers.stress[0][0], 1e-5);
  EXPECT_NEAR(std::stod(line.substr(32, 16)), layers.stress[0][1], 1e-5);
  // Plane stress with the width held: E / (1 - nu^2) ln 1.001, over the change of volume 1.001^(1 - nu / (1 - nu)).
  const double xx = 210000 / (1 - 0.09) * std::log(1.001) / std::pow(1.001, 1 - 0.3 / 0.7);
  EXPECT_NEAR(layers.stress[0][0], xx, 1e-6 * xx);
  EXPECT_NEAR(layers.stress[0][1], 0.3 * xx, 1e-6 * xx);
  std::getline(lines, line);
  EXPECT_EQ(line.size(), 48u);
  std::size_t n = 3;
  while (std::getline(lines, line) && line[0] != '*')
    ++n;
  EXPECT_EQ(n, shell.n_elements() * 7u);
  EXPECT_EQ(line, "*INITIAL_STRAIN_SHELL");
}
