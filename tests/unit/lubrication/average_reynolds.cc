#include "film_mesh.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/lubrication/surface_patch.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <iostream>

using namespace tribodraw;
using Node = AverageReynolds::NodeData;

namespace
{
  constexpr double eta = 3.2e-8; // 32 mPa s in MPa s
  constexpr double pi  = 3.14159265358979323846;

  double
  order(const double coarse, const double fine)
  {
    return std::log2(coarse / fine);
  }

  // Plane slider: film h0 (1 + K (1 - x/L)), the lower surface (1) moves with U to the outlet x = L. L = 10 mm, h0 = 2
  // um.
  struct Slider
  {
    double K = 1, L = 10, h0 = 2e-3, U = 60;

    double
    film(const double x) const
    {
      return h0 * (1 + K * (1 - x / L));
    }
    double
    unit_pressure() const
    {
      return eta * U * L / (h0 * h0);
    }
    double
    pressure(const double x) const
    {
      // model.md 6: p = 6 eta U L (h1-h)(h-h2) / (h^2 (h1^2-h2^2))
      const double h = film(x), h1 = h0 * (1 + K);
      return 6 * eta * U * L * (h1 - h) * (h - h0) / (h * h * (h1 * h1 - h0 * h0));
    }
    std::vector<Node>
    nodes(const FilmMesh &mesh, const bool closed_sides = true) const
    {
      std::vector<Node> result(mesh.nodes.size());
      for (unsigned n = 0; n < result.size(); ++n)
        {
          result[n].fixed          = mesh.at_end(n) || (!closed_sides && mesh.at_side(n));
          result[n].film           = film(mesh.nodes[n][0]);
          result[n].viscosity      = eta;
          result[n].sheet_velocity = { U, 0, 0 };
        }
      return result;
    }
  };

  Eigen::Matrix3d
  some_rotation()
  {
    return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  }

  double
  largest_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    double d = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      d = std::max(d, std::abs(a[i] - b[i]));
    return d;
  }
} // namespace

class SliderOnMesh : public testing::TestWithParam<double>
{
};

TEST_P(SliderOnMesh, PressureAndLoadConvergeWithOrderTwo)
{
  const Slider slider;
  // benchmarks.md 7.1, K = 1: W* = 6 [ln 2 - 2/3], p*max = 0.25 at x/L = 2/3.
  const double        load_exact = 6 * (std::log(2.) - 2. / 3.) * slider.unit_pressure() * slider.L;
  std::vector<double> pressure_error, largest_error, load_error;
  for (const unsigned n : { 24u, 48u, 96u })
    {
      const FilmMesh        mesh(n, n / 3, slider.L, 3., GetParam());
      const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
      const auto            result = reynolds.solve(mesh.nodes, slider.nodes(mesh));
      EXPECT_TRUE(result.converged);
      double largest = 0, sum = 0;
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        {
          const double e = std::abs(result.pressure[i] - slider.pressure(mesh.nodes[i][0])) / slider.unit_pressure();
          largest        = std::max(largest, e);
          sum += e * e;
        }
      pressure_error.push_back(std::sqrt(sum / mesh.nodes.size()));
      largest_error.push_back(largest);
      load_error.push_back(std::abs(reynolds.load(mesh.nodes, result.pressure) / 3. / load_exact - 1));
    }
  for (int i = 0; i < 2; ++i)
    {
      EXPECT_NEAR(order(pressure_error[i], pressure_error[i + 1]), 2., 0.1) << pressure_error[i];
      EXPECT_NEAR(order(load_error[i], load_error[i + 1]), 2., 0.1) << load_error[i];
    }
  EXPECT_NEAR(order(largest_error[0], largest_error[2]) / 2, 2., 0.2);
  EXPECT_LT(largest_error[2], 2e-4); // of 0.25
  EXPECT_LT(load_error[2], 3e-4);
}
// Distortion in parts of the element size: structured and irregular (with obtuse triangles).
INSTANTIATE_TEST_SUITE_P(Meshes, SliderOnMesh, testing::Values(0., 0.25));

TEST(AverageReynolds, ClosedFormsOfTheSlider)
{
  // benchmarks.md 7.1: K, W*, p*max, q/(U h0). Node at the maximum x/L = (1+K)/(2+K) for n = 60; error O(n^-2).
  const double rows[][4] = {
    { .5, .1311626, .2, .6 }, { 1, .1588831, .25, .6666667 }, { 2, .1479184, .25, .75 }, { 3, .1241962, .225, .8 }
  };
  for (const auto &row : rows)
    {
      Slider slider;
      slider.K = row[0];
      const FilmMesh        mesh(120, 2, slider.L, 0.5);
      const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
      const auto            result = reynolds.solve(mesh.nodes, slider.nodes(mesh));
      const double          p      = slider.unit_pressure();
      EXPECT_NEAR(reynolds.load(mesh.nodes, result.pressure) / (0.5 * slider.L * p), row[1], 3e-4 * row[1]);
      EXPECT_NEAR(*std::max_element(result.pressure.begin(), result.pressure.end()) / p, row[2], 3e-4 * row[2]);
      double flow_out = 0;
      for (unsigned n = 0; n < mesh.nodes.size(); ++n)
        if (n % (mesh.nx + 1) == mesh.nx)
          flow_out += result.outflow[n];
      EXPECT_NEAR(flow_out / (0.5 * slider.U * slider.h0), row[3], 1e-3 * row[3]);
    }
}

TEST(AverageReynolds, SameResultOnATiltedPlane)
{
  const Slider          slider;
  const FilmMesh        mesh(24, 9, slider.L, 6., 0.25);
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  auto                  nodes = slider.nodes(mesh, false);
  for (auto &node : nodes)
    {
      node.phi_p << 0.8, 0.1, 0.1, 0.5; // tensors turn with the material, so nothing may change
      node.sq_phi_s << 3e-4, 1e-4, 0, 2e-4;
      node.sq_phi_s *= node.film / slider.h0;
    }
  const auto flat = reynolds.solve(mesh.nodes, nodes);

  const Eigen::Matrix3d Q         = some_rotation();
  auto                  positions = mesh.nodes;
  for (auto &x : positions)
    x = Q * x + Eigen::Vector3d(5, -3, 2);
  for (auto &node : nodes)
    {
      // A velocity normal to the surface carries no film along it.
      node.sheet_velocity = Q * (node.sheet_velocity + Eigen::Vector3d(0, 0, 17));
      node.tool_velocity  = Q * (node.tool_velocity + Eigen::Vector3d(0, 0, 17));
    }
  const auto tilted = reynolds.solve(positions, nodes);
  EXPECT_LT(largest_difference(flat.pressure, tilted.pressure), 1e-10 * slider.unit_pressure());
  EXPECT_NEAR(reynolds.load(positions, tilted.pressure), reynolds.load(mesh.nodes, flat.pressure), 1e-10);
}

TEST(SurfacePatch, GradientOfALinearFunctionOnATiltedSurface)
{
  const FilmMesh        mesh(7, 5, 10., 6., 0.25);
  const Eigen::Matrix3d Q    = some_rotation();
  const Eigen::Vector3d slope(0.7, -0.3, 0); // in the plane of the sheet, turned with it
  auto                  positions = mesh.nodes;
  std::vector<double>   values;
  for (auto &x : positions)
    {
      values.push_back(slope.dot(x) + 2);
      x = Q * x + Eigen::Vector3d(5, -3, 2);
    }
  SurfacePatch patch(positions.size(), mesh.triangles);
  patch.move_to(positions);
  for (const auto &g : patch.gradient(values))
    EXPECT_LT((g - Q * slope).norm(), 1e-13);
}

TEST(AverageReynolds, TensorsTurnWithTheMaterial)
{
  // The blank turned in its plane by 40 degrees under a flow in x of space must give what a blank at rest gives with
  // tensors turned by hand: PhiP -> Q PhiP Q^T.
  const Slider    slider;
  const FilmMesh  mesh(20, 10, slider.L, 5., 0.2);
  Eigen::Matrix2d phi_p, sq_phi_s;
  phi_p << 0.9, 0.15, 0.15, 0.3;
  sq_phi_s << 4e-4, 1e-4, -2e-4, 1e-4;
  const Eigen::Matrix3d Q  = Eigen::AngleAxisd(40. * pi / 180., Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix2d Q2 = Q.topLeftCorner<2, 2>();

  auto turned_positions = mesh.nodes;
  for (auto &x : turned_positions)
    x = Q * x;
  auto nodes = slider.nodes(mesh, false);
  for (unsigned n = 0; n < nodes.size(); ++n)
    {
      nodes[n].phi_p    = phi_p;
      nodes[n].sq_phi_s = sq_phi_s * (1. + 0.1 * mesh.nodes[n][1]);
    }
  const AverageReynolds material(mesh.nodes, mesh.triangles);
  const auto            turned = material.solve(turned_positions, nodes);

  for (auto &node : nodes)
    {
      node.phi_p    = Q2 * node.phi_p * Q2.transpose();
      node.sq_phi_s = (Q2 * node.sq_phi_s * Q2.transpose()).eval();
    }
  const AverageReynolds space(turned_positions, mesh.triangles);
  const auto            by_hand = space.solve(turned_positions, nodes);
  EXPECT_LT(largest_difference(turned.pressure, by_hand.pressure), 1e-12 * slider.unit_pressure());
  // ... and differs from the one with tensors that stay in space (the test can fail).
  EXPECT_GT(largest_difference(turned.pressure, material.solve(mesh.nodes, nodes).pressure),
            1e-3 * slider.unit_pressure());
}

TEST(AverageReynolds, StretchOfTheSheetDoesNotTurnTensors)
{
  // F = R U with U a stretch along the diagonal: only R may act on the tensor. The prescribed pressures of a linear
  // field then give the outflow of a homogeneous flow, K = h^3/(12 eta) R PhiP R^T.
  const FilmMesh        mesh(4, 4, 2., 2.);
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  Eigen::Matrix2d       U, phi;
  U << 1.3, 0.2, 0.2, 0.9;
  phi << 0.7, 0.1, 0.1, 0.4;
  const double          angle = 0.3;
  const Eigen::Matrix2d R     = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Eigen::Vector2d slope(0.4, -0.7); // grad p in space [MPa/mm]
  const double          h         = 1.5e-3;
  auto                  positions = mesh.nodes;
  std::vector<Node>     nodes(mesh.nodes.size());
  for (unsigned n = 0; n < nodes.size(); ++n)
    {
      positions[n].head<2>()  = R * U * mesh.nodes[n].head<2>();
      nodes[n].film           = h;
      nodes[n].viscosity      = eta;
      nodes[n].phi_p          = phi;
      nodes[n].fixed_pressure = 10 + slope.dot(positions[n].head<2>());
    }
  const auto            result = reynolds.solve(positions, nodes);
  const Eigen::Vector2d q      = -(h * h * h / (12 * eta)) * (R * phi * R.transpose()) * slope;
  // Sum of x times outflow = integral of q (divergence theorem with div q = 0).
  Eigen::Vector2d moment(0, 0);
  for (unsigned n = 0; n < nodes.size(); ++n)
    moment += positions[n].head<2>() * result.outflow[n];
  const double area = 4. * U.determinant();
  EXPECT_LT((moment - area * q).norm(), 1e-12 * (area * q).norm());
}

TEST(AverageReynolds, ProductsOfLinearFieldsAreIntegratedExactly)
{
  // One triangle (0,0),(1,0),(0,1), p = x prescribed: outflow of node 1 is -int h^3/(12 eta) PhiP_xx dA for film, 1/eta
  // and PhiP linear. With h = 1+x, PhiP = 1+2x, 1/(12 eta) = 1+x/2 (any units): int (1+x)^3 (1+2x) (1+x/2) (1-x) dx =
  // int (1+5.5x+12x^2+13x^3+7x^4+... ) worked out by sums below.
  const std::vector<Eigen::Vector3d> x{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  const AverageReynolds              reynolds(x, { { 0, 1, 2 } });
  std::vector<Node>                  nodes(3);
  for (int n = 0; n < 3; ++n)
    {
      const double s          = x[n][0];
      nodes[n].film           = 1 + s;
      nodes[n].viscosity      = 1. / (12. * (1 + s / 2));
      nodes[n].phi_p          = (1 + 2 * s) * Eigen::Matrix2d::Identity();
      nodes[n].fixed_pressure = s;
    }
  // Coefficients of (1+x)^3 (1+2x) (1+x/2): product of the polynomials, then int x^k (1-x) dx = 1/((k+1)(k+2)).
  std::vector<double> c{ 1, 3, 3, 1 };
  for (const double a : { 2., 0.5 })
    {
      c.push_back(0);
      for (std::size_t k = c.size() - 1; k > 0; --k)
        c[k] += a * c[k - 1];
    }
  double exact = 0;
  for (std::size_t k = 0; k < c.size(); ++k)
    exact += c[k] / ((k + 1.) * (k + 2.));
  EXPECT_NEAR(reynolds.solve(x, nodes).outflow[1], -exact, 1e-13 * exact);
}

TEST(AverageReynolds, ConstantPressureFactorScalesThePressure)
{
  const Slider          slider;
  const FilmMesh        mesh(24, 8, slider.L, 4., 0.2);
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  auto                  nodes  = slider.nodes(mesh, false);
  const auto            smooth = reynolds.solve(mesh.nodes, nodes);
  for (auto &node : nodes)
    node.phi_p *= 0.25;
  auto rough = reynolds.solve(mesh.nodes, nodes);
  for (auto &p : rough.pressure)
    p *= 0.25; // benchmarks.md 7.6: p -> p / PhiP
  EXPECT_LT(largest_difference(smooth.pressure, rough.pressure), 1e-12 * slider.unit_pressure());
}

TEST(AverageReynolds, PressureFactorIsBoundedFromBelow)
{
  const Slider          slider;
  const FilmMesh        mesh(12, 6, slider.L, 4.);
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles, 1e-2);
  auto                  nodes = slider.nodes(mesh, false), floor = nodes;
  for (unsigned n = 0; n < nodes.size(); ++n)
    {
      nodes[n].phi_p.setZero();
      floor[n].phi_p *= 1e-2;
    }
  const auto a = reynolds.solve(mesh.nodes, nodes), b = reynolds.solve(mesh.nodes, floor);
  EXPECT_TRUE(a.converged);
  EXPECT_LT(largest_difference(a.pressure, b.pressure), 1e-12 * b.pressure[mesh.nodes.size() / 2]);
  // A tensor with one closed direction (1,1)/sqrt2: that eigenvalue alone is lifted.
  for (unsigned n = 0; n < nodes.size(); ++n)
    {
      nodes[n].phi_p << 0.5, -0.5, -0.5, 0.5;
      floor[n].phi_p << 0.505, -0.495, -0.495, 0.505;
    }
  const auto c = reynolds.solve(mesh.nodes, nodes), d = reynolds.solve(mesh.nodes, floor);
  EXPECT_LT(largest_difference(c.pressure, d.pressure), 1e-10 * slider.unit_pressure());
}

TEST(AverageReynolds, ConstantShearFactorHasNoEffectAndAJumpActsAsAStep)
{
  const Slider          slider;
  const FilmMesh        mesh(24, 4, slider.L, 2.);
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  auto                  nodes = slider.nodes(mesh);
  const auto            plain = reynolds.solve(mesh.nodes, nodes);
  for (auto &node : nodes)
    node.sq_phi_s << 5e-4, 2e-4, -1e-4, 3e-4;
  // div(const) = 0; the sides are closed, so only the flow in x may carry the term: take off the part through the
  // sides.
  for (auto &node : nodes)
    node.sq_phi_s(1, 0) = 0;
  EXPECT_LT(largest_difference(plain.pressure, reynolds.solve(mesh.nodes, nodes).pressure),
            1e-12 * slider.unit_pressure());

  // Parallel gap h, Sq PhiS = +s before and -s behind x = L/2: equal flow h U/2 + s U/2 - k p1' = h U/2 - s U/2 - k
  // p2', k = h^3/(12 eta), p(0) = p(L) = 0, so p' = +- s U/(2 k) and the peak is s U L/(4 k). The jump is a column of
  // elements of width 1e-6 L.
  const double h = 3e-3, s = 4e-4, k = h * h * h / (12 * eta);
  FilmMesh     odd(25, 3, slider.L, 2.);
  for (auto &x : odd.nodes)
    if (std::abs(x[0] - slider.L / 2) < slider.L / 25)
      x[0] = slider.L / 2 + (x[0] > slider.L / 2 ? 0.5e-6 : -0.5e-6) * slider.L;
  auto parallel = slider.nodes(odd);
  for (unsigned n = 0; n < parallel.size(); ++n)
    {
      parallel[n].film     = h;
      parallel[n].sq_phi_s = (odd.nodes[n][0] < slider.L / 2 ? s : -s) * Eigen::Matrix2d::Identity();
    }
  const AverageReynolds on_odd(odd.nodes, odd.triangles);
  const auto            result = on_odd.solve(odd.nodes, parallel);
  const double          peak   = *std::max_element(result.pressure.begin(), result.pressure.end());
  EXPECT_NEAR(peak, s * slider.U * slider.L / (4 * k), 1e-5 * peak);
}

TEST(AverageReynolds, SqueezeOfStripAndDisc)
{
  // benchmarks.md 7.5: strip p = 6 eta V/h^3 (B^2/4 - x^2), W = eta V B^3/h^3 per length; disc p = 3 eta V/h^3 (R^2 -
  // r^2), W = 3 pi eta V R^4/(2 h^3). V = 2 mm/s closing: squeeze = -V.
  const double V = 2, h = 5e-3, B = 8;
  {
    const FilmMesh        mesh(32, 3, B, 1.);
    const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
    std::vector<Node>     nodes(mesh.nodes.size());
    for (unsigned n = 0; n < nodes.size(); ++n)
      {
        nodes[n].fixed     = mesh.at_end(n);
        nodes[n].film      = h;
        nodes[n].viscosity = eta;
        nodes[n].squeeze   = -V;
      }
    const auto   result = reynolds.solve(mesh.nodes, nodes);
    const double scale  = 6 * eta * V / (h * h * h);
    for (unsigned n = 0; n < nodes.size(); ++n)
      {
        // Linear elements are exact at the nodes in one dimension; the cross-cut mesh feels it within O(h^2) only.
        const double x = mesh.nodes[n][0] - B / 2;
        EXPECT_NEAR(result.pressure[n], scale * (B * B / 4 - x * x), 1e-3 * scale * B * B / 4);
      }
    double out = 0;
    for (const double q : result.outflow)
      out += q;
    EXPECT_NEAR(out, V * B * 1., 1e-12 * V * B); // all that is squeezed leaves
  }
  std::vector<double> error;
  const double        R = 6;
  for (const unsigned n : { 16u, 32u, 64u })
    {
      // Square [-1,1]^2 mapped to the disc: x sqrt(1 - y^2/2), y sqrt(1 - x^2/2).
      FilmMesh mesh(n, n, 2., 2.);
      for (auto &x : mesh.nodes)
        {
          const double u = x[0] - 1, v = x[1] - 1;
          x = Eigen::Vector3d(R * u * std::sqrt(1 - v * v / 2), R * v * std::sqrt(1 - u * u / 2), 0);
        }
      // The corners of the square become flat angles on the circle: cut them by the other diagonal is not needed, the
      // triangles there are thin but have area.
      const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
      std::vector<Node>     nodes(mesh.nodes.size());
      for (unsigned i = 0; i < nodes.size(); ++i)
        {
          nodes[i].fixed     = mesh.at_end(i) || mesh.at_side(i);
          nodes[i].film      = h;
          nodes[i].viscosity = eta;
          nodes[i].squeeze   = -V;
        }
      const auto   result = reynolds.solve(mesh.nodes, nodes);
      const double exact  = 3 * pi * eta * V * std::pow(R, 4) / (2 * h * h * h);
      error.push_back(std::abs(reynolds.load(mesh.nodes, result.pressure) / exact - 1));
    }
  EXPECT_GT(order(error[0], error[1]), 1.8);
  EXPECT_GT(order(error[1], error[2]), 1.8);
  EXPECT_LT(error[2], 2e-3);
}

TEST(AverageReynolds, FiniteWidthSlider)
{
  // benchmarks.md 7.2, B/L = 1, h1/h0 = 2: W* = 0.0692765 (finite volumes 200^2 + Richardson).
  const Slider        slider;
  std::vector<double> load;
  for (const unsigned n : { 24u, 48u, 96u })
    {
      const FilmMesh        mesh(n, n, slider.L, slider.L);
      const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
      const auto            result = reynolds.solve(mesh.nodes, slider.nodes(mesh, false));
      load.push_back(reynolds.load(mesh.nodes, result.pressure) / (slider.unit_pressure() * slider.L * slider.L));
    }
  EXPECT_NEAR((load[1] - load[0]) / (load[2] - load[1]), 4., 0.15); // order 2
  EXPECT_NEAR(load[2] + (load[2] - load[1]) / 3, 0.0692765, 3e-6);
}

TEST(AverageReynolds, ManufacturedSolutionWithFullTensors)
{
  // p = sin(pi x) sin(pi y) (1 + 0.3 x) on the unit square, h = 1 + 0.5 x + 0.2 cos(pi y) (benchmarks.md 7.6), 12 eta =
  // 1, PhiP = [[.8+.1x, .1+.05y],[., .6-.1y]], Sq PhiS = [[.2 h, .05],[.1 x, .1 h]]; U1 = (1, .5), U2 = (.2, -.3). Flux
  // q = h um + S ud - h^3 PhiP grad p in closed form; its divergence by central differences (error < 1e-9) as squeeze.
  const auto film     = [](double x, double y) { return 1 + 0.5 * x + 0.2 * std::cos(pi * y); };
  const auto pressure = [](double x, double y) { return std::sin(pi * x) * std::sin(pi * y) * (1 + 0.3 * x); };
  const auto phi_p    = [](double x, double y) {
    Eigen::Matrix2d phi;
    phi << 0.8 + 0.1 * x, 0.1 + 0.05 * y, 0.1 + 0.05 * y, 0.6 - 0.1 * y;
    return phi;
  };
  const auto sheared = [&](double x, double y) {
    Eigen::Matrix2d s;
    s << 0.2 * film(x, y), 0.05, 0.1 * x, 0.1 * film(x, y);
    return s;
  };
  const Eigen::Vector3d u1(1, 0.5, 0), u2(0.2, -0.3, 0);
  const auto            flux = [&](double x, double y) -> Eigen::Vector2d {
    const double          h = film(x, y);
    const Eigen::Vector2d grad(std::sin(pi * y) * (pi * std::cos(pi * x) * (1 + 0.3 * x) + 0.3 * std::sin(pi * x)),
                                          pi * std::cos(pi * y) * std::sin(pi * x) * (1 + 0.3 * x));
    return h * (0.5 * (u1 + u2)).head<2>() + sheared(x, y) * (0.5 * (u1 - u2)).head<2>()
           - h * h * h * phi_p(x, y) * grad;
  };
  for (const double distortion : { 0., 0.2 })
    {
      std::vector<double> error;
      for (const unsigned n : { 16u, 32u, 64u })
        {
          const FilmMesh        mesh(n, n, 1., 1., distortion);
          const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
          std::vector<Node>     nodes(mesh.nodes.size());
          for (unsigned i = 0; i < nodes.size(); ++i)
            {
              const double x = mesh.nodes[i][0], y = mesh.nodes[i][1], d = 1e-5;
              nodes[i].fixed          = mesh.at_end(i) || mesh.at_side(i);
              nodes[i].film           = film(x, y);
              nodes[i].viscosity      = 1. / 12.;
              nodes[i].phi_p          = phi_p(x, y);
              nodes[i].sq_phi_s       = sheared(x, y);
              nodes[i].sheet_velocity = u1;
              nodes[i].tool_velocity  = u2;
              nodes[i].squeeze
                  = -((flux(x + d, y) - flux(x - d, y))[0] + (flux(x, y + d) - flux(x, y - d))[1]) / (2 * d);
            }
          const auto result = reynolds.solve(mesh.nodes, nodes);
          double     sum    = 0;
          for (unsigned i = 0; i < nodes.size(); ++i)
            sum += std::pow(result.pressure[i] - pressure(mesh.nodes[i][0], mesh.nodes[i][1]), 2);
          error.push_back(std::sqrt(sum / nodes.size()));
        }
      EXPECT_GT(order(error[0], error[1]), 1.85) << distortion;
      EXPECT_GT(order(error[1], error[2]), 1.85) << distortion;
      EXPECT_LT(error[2], 3e-3);
    }
}

TEST(AverageReynolds, ObstacleIsComplementary)
{
  // Converging-diverging gap: cavitation at the outlet, a cap in the middle.
  for (const double distortion : { 0., 0.35 })
    {
      const FilmMesh        mesh(40, 20, 20., 10., distortion);
      const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
      std::vector<Node>     nodes(mesh.nodes.size());
      for (unsigned i = 0; i < nodes.size(); ++i)
        {
          const double x = mesh.nodes[i][0] / 20., y = mesh.nodes[i][1] / 10.;
          nodes[i].fixed          = mesh.at_end(i) || mesh.at_side(i);
          nodes[i].film           = 2e-3 * (1 + 4 * (x - 0.5) * (x - 0.5) + 0.1 * std::sin(9 * x) * std::cos(7 * y));
          nodes[i].viscosity      = eta;
          nodes[i].sheet_velocity = { 60, 10, 0 };
          nodes[i].p_limit        = 0.4 + 0.1 * std::sin(11 * y);
        }
      const auto result = reynolds.solve(mesh.nodes, nodes);
      EXPECT_TRUE(result.converged);
      EXPECT_LE(result.iterations, 15u);
      EXPECT_LT(result.flux_imbalance, 1e-12);
      unsigned n_zero = 0, n_cap = 0, n_between = 0;
      double   total = 0, magnitude = 0, largest = 0;
      for (const double q : result.outflow)
        largest = std::max(largest, std::abs(q));
      for (unsigned i = 0; i < nodes.size(); ++i)
        {
          total += result.outflow[i];
          magnitude += std::abs(result.outflow[i]);
          if (nodes[i].fixed)
            continue;
          const double p = result.pressure[i], r = result.outflow[i];
          EXPECT_GE(p, 0.);
          EXPECT_LE(p, nodes[i].p_limit);
          if (p == 0.)
            {
              ++n_zero;
              EXPECT_LE(r, 1e-9 * largest); // nothing would flow out if it could
              EXPECT_EQ(result.opening_rate[i], 0.);
            }
          else if (p == nodes[i].p_limit)
            {
              ++n_cap;
              EXPECT_GE(r, -1e-9 * largest);
              EXPECT_GE(result.opening_rate[i], 0.);
            }
          else
            {
              ++n_between;
              EXPECT_LT(std::abs(r), 1e-9 * largest);
              EXPECT_EQ(result.opening_rate[i], 0.);
            }
        }
      EXPECT_GT(n_zero, 50u);
      EXPECT_GT(n_cap, 50u);
      EXPECT_GT(n_between, 50u);
      EXPECT_LT(std::abs(total), 1e-12 * magnitude); // what enters leaves, opens the gap or fills the cavity

      // The same solution from other starting sets.
      auto start = result.pressure;
      for (unsigned i = 0; i < start.size(); ++i)
        start[i] = nodes[i].p_limit;
      EXPECT_LT(largest_difference(result.pressure, reynolds.solve(mesh.nodes, nodes, start).pressure), 1e-9);
      const auto again = reynolds.solve(mesh.nodes, nodes, result.pressure);
      EXPECT_LE(again.iterations, 2u);
    }
}

TEST(AverageReynolds, ReynoldsConditionOfTheHalfSommerfeldWedge)
{
  // Parabolic 1-D gap h = h0 (1 + x^2/(2 R h0)), long inlet and outlet: Swift-Stieber rupture where p = p' = 0. The
  // classic result of the flooded rigid roll: rupture at x = 0.4751 sqrt(2 R h0), tan(psi) = 0.47513 (from the integral
  // condition int_{-pi/2}^{psi} (cos^2 - cos^4/cos^2 psi) dpsi = 0, recomputed below by bisection).
  double lower = 0.1, upper = 1.;
  for (int i = 0; i < 60; ++i)
    {
      const double psi      = 0.5 * (lower + upper);
      const auto   integral = [psi](double t) {
        const double c2 = t / 2 + std::sin(2 * t) / 4, c4 = 3 * t / 8 + std::sin(2 * t) / 4 + std::sin(4 * t) / 32;
        return c2 - c4 / std::pow(std::cos(psi), 2);
      };
      // The pressure at psi falls with psi.
      (integral(psi) - integral(-pi / 2) > 0 ? lower : upper) = psi;
    }
  const double rupture = std::tan(lower);
  EXPECT_NEAR(rupture, 0.4751, 1e-4);

  const double h0 = 2e-3, R = 100, unit = std::sqrt(2 * R * h0); // 0.632 mm
  FilmMesh     mesh(1200, 1, 30 * unit, 0.05);
  for (auto &x : mesh.nodes)
    x[0] -= 25 * unit; // element 0.025 unit
  std::vector<Node> nodes(mesh.nodes.size());
  for (unsigned i = 0; i < nodes.size(); ++i)
    {
      nodes[i].fixed          = mesh.at_end(i);
      nodes[i].film           = h0 * (1 + std::pow(mesh.nodes[i][0] / unit, 2));
      nodes[i].viscosity      = eta;
      nodes[i].sheet_velocity = { 60, 0, 0 };
    }
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  const auto            result = reynolds.solve(mesh.nodes, nodes);
  double                last   = -1e9;
  for (unsigned i = 0; i < nodes.size(); ++i)
    if (result.pressure[i] > 0)
      last = std::max(last, mesh.nodes[i][0] / unit);
  EXPECT_NEAR(last, rupture, 0.03); // within about an element
}

// In a frame that moves with velocity V against the tool both surfaces are faster by V and the gap changes at a fixed point
// by -V . grad h: with the squeeze term kept the pressure is the same (model without it: it is not).
TEST(AverageReynolds, FrameInvarianceWithTheSqueezeTerm)
{
  const FilmMesh                         mesh(18, 11, 2., 1., 0.15);
  const Eigen::Vector3d                  frame(35, -20, 0);
  const Eigen::Vector3d                  slope(-0.6e-3, 1.5e-4, 0); // of the gap
  std::vector<AverageReynolds::NodeData> tool(mesh.nodes.size());
  for (unsigned i = 0; i < tool.size(); ++i)
    {
      auto &d     = tool[i];
      d.fixed     = mesh.at_end(i) || mesh.at_side(i);
      d.film      = 2e-3 + slope.dot(mesh.nodes[i]);
      d.viscosity = 3e-8;
      d.phi_p << 0.8, 0.05, 0.05, 0.5;
      d.sq_phi_s << 4e-4, 1e-4, 0, 2e-4;
      d.sheet_velocity = { 60, 5, 0 };
    }
  auto moving = tool, without = tool;
  for (unsigned i = 0; i < tool.size(); ++i)
    {
      moving[i].sheet_velocity += frame;
      moving[i].tool_velocity += frame;
      without[i]        = moving[i];
      moving[i].squeeze = -frame.dot(slope);
    }
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  const auto            a = reynolds.solve(mesh.nodes, tool).pressure, b = reynolds.solve(mesh.nodes, moving).pressure,
             c     = reynolds.solve(mesh.nodes, without).pressure;
  const double p_max = *std::max_element(a.begin(), a.end());
  double       worst = 0;
  for (unsigned i = 0; i < a.size(); ++i)
    {
      EXPECT_NEAR(a[i], b[i], 1e-12 * p_max);
      worst = std::max(worst, std::abs(a[i] - c[i]) / p_max);
    }
  EXPECT_GT(worst, 0.2);
}

TEST(AverageReynolds, NodesWithoutFilmTakeTheFilmOfTheirNeighbours)
{
  const FilmMesh        mesh(10, 2, 10., 2.);
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  Slider                slider;
  slider.K  = 0;
  auto full = slider.nodes(mesh);
  for (unsigned n = 0; n < full.size(); ++n)
    full[n].fixed_pressure = mesh.nodes[n][0]; // Poiseuille flow
  auto bare = full;
  for (unsigned n = 0; n < bare.size(); ++n)
    if (mesh.at_end(n))
      bare[n].film = bare[n].viscosity = 0;
  EXPECT_LT(largest_difference(reynolds.solve(mesh.nodes, full).pressure, reynolds.solve(mesh.nodes, bare).pressure),
            1e-12);
  bare[5].film = 0; // a free node
  EXPECT_THROW(reynolds.solve(mesh.nodes, bare), InputError);
  EXPECT_THROW(reynolds.solve(mesh.nodes, {}), InputError);
}

TEST(AverageReynolds, WrongMeshesAreRefused)
{
  const std::vector<Eigen::Vector3d> x{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 2, 2, 0 } };
  EXPECT_THROW(AverageReynolds(x, { { 0, 1, 2 } }), InputError);                           // node 3 unused
  EXPECT_THROW(AverageReynolds(x, { { 0, 1, 7 } }), InputError);                           // no such node
  EXPECT_THROW(AverageReynolds({ x[0], x[1], { 2, 0, 0 } }, { { 0, 1, 2 } }), InputError); // no area
}

TEST(AverageReynolds, FastOnABlankOfTheCrossDie)
{
#ifndef NDEBUG
  GTEST_SKIP() << "times are measured with optimisation only";
#endif
  // The aim is below 1 ms for 625 nodes on an idle core (also with both bounds active); the limit here only catches a
  // change of the order of the cost.
  const FilmMesh        mesh(24, 24, 130., 130., 0.2);
  const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
  for (const char *const what : { "no bound active", "both bounds active", "both, started from the last" })
    {
      const bool        bounds = what[0] == 'b';
      std::vector<Node> nodes(mesh.nodes.size());
      for (unsigned i = 0; i < nodes.size(); ++i)
        {
          const double x = mesh.nodes[i][0] / 130., y = mesh.nodes[i][1] / 130.;
          nodes[i].fixed = mesh.at_end(i) || mesh.at_side(i);
          nodes[i].film
              = 2e-3 * (bounds ? 1 + 4 * (x - 0.5) * (x - 0.5) + 0.1 * std::sin(9 * x) * std::cos(7 * y) : 2 - x);
          nodes[i].viscosity      = eta;
          nodes[i].sheet_velocity = { 60, 10, 0 };
          nodes[i].p_limit        = bounds ? 5. : 1e300;
        }
      auto                positions = mesh.nodes;
      std::vector<double> last;
      const int           n_solves   = 50;
      unsigned            iterations = 0;
      const auto          start      = std::clock();
      for (int i = 0; i < n_solves; ++i)
        {
          positions[100][2] = 1e-3 * i; // new geometry in each
          auto result       = reynolds.solve(positions, nodes, last);
          iterations += result.iterations;
          if (std::strstr(what, "started"))
            last = std::move(result.pressure);
          EXPECT_TRUE(result.converged);
        }
      const double ms = 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC / n_solves;
      std::cout << "average Reynolds, 625 nodes, " << what << ": " << ms << " ms of CPU time per solve, "
                << double(iterations) / n_solves << " active-set steps\n";
      EXPECT_LT(ms, 20.);
    }
}
