#include <tribodraw/boundary_friction/ploughing.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace tribodraw;

namespace
{
  const double pi = 3.14159265358979323846;

  /// Midpoint sum of ploughing_traction() over the leading half of a body of revolution with slope(r) = |d zeta/dr|.
  PloughingForces
  revolve(const double radius, const std::function<double(double)> &slope, const double tau)
  {
    PloughingForces    sum;
    const unsigned int n = 2000, m = 400;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < m; ++j)
        {
          const double r = radius * (i + 0.5) / n, phi = pi * ((j + 0.5) / m - 0.5);
          const double weight = r * (radius / n) * (pi / m);
          const auto   f      = ploughing_traction(-slope(r) * std::cos(phi), -slope(r) * std::sin(phi), 1., tau);
          sum.drag += weight * f.drag;
          sum.support += weight * f.support;
        }
    return sum;
  }

  HeightMap
  map_of(const std::size_t n, const double dx, const std::function<double(double, double)> &height)
  {
    HeightMap map;
    map.nx = map.ny = n;
    map.dx = map.dy = dx;
    for (std::size_t iy = 0; iy < n; ++iy)
      for (std::size_t ix = 0; ix < n; ++ix)
        map.z.push_back(height((ix + 0.5) * dx, (iy + 0.5) * dx));
    return map;
  }
} // namespace

// Closed forms of model.md 2.4: cone mu_p = (2/pi) tan th; values at 5, 10, 20, 30 degrees.
TEST(Ploughing, Cone)
{
  const double expected[][2] = { { 5., .05570 }, { 10., .11225 }, { 20., .23171 }, { 30., .36755 } };
  for (const auto &[degrees, mu] : expected)
    {
      const double slope = std::tan(degrees * pi / 180.);
      const auto   f     = revolve(
                1., [&](double) { return slope; }, 0.);
      EXPECT_NEAR(f.drag / f.support, mu, 6e-6);
      EXPECT_NEAR(f.drag / f.support, 2. / pi * slope, 1e-5 * slope);
    }
}

// Sphere: mu_p = (2/pi)(th - sin th cos th)/sin^2 th with sin th = a/R; values of model.md 2.4.
TEST(Ploughing, Sphere)
{
  const double expected[][2] = { { 5., .03707 }, { 10., .07438 }, { 20., .15060 }, { 30., .23068 } };
  for (const auto &[degrees, mu] : expected)
    {
      const double th = degrees * pi / 180.;
      const auto   f  = revolve(
             std::sin(th), [](double r) { return r / std::sqrt(1. - r * r); }, 0.);
      EXPECT_NEAR(f.drag / f.support, mu, 6e-6);
      EXPECT_NEAR(f.drag / f.support, 2. / pi * (th - std::sin(th) * std::cos(th)) / std::pow(std::sin(th), 2), 2e-6);
    }
}

// Wedge, face first: mu = tan(th + atan(tau/p)), exactly (model.md 2.4).
TEST(Ploughing, Wedge)
{
  for (const double th : { 0.01, 0.2, 0.7 })
    for (const double tau : { 0., 0.1, 0.5 })
      {
        const auto f = ploughing_traction(-std::tan(th), 0., 1., tau);
        EXPECT_NEAR(f.drag / f.support, std::tan(th + std::atan(tau)), 1e-14);
        EXPECT_EQ(f.lateral, 0.);
      }
}

// Values of model.md 2.3 for (a, b, w, psi).
TEST(Ploughing, ParaboloidValues)
{
  const double expected[][6] = { { 1, 1, .1, 0, .08488, .18696 },
                                 { 2, 1, .1, 0, .04244, .14355 },
                                 { 2, 1, .1, 90, .08488, .18659 },
                                 { 2, 1, .1, 45, .067105, .16855 } };
  for (const auto &[a, b, w, degrees, mu_dry, mu_shear] : expected)
    {
      const double psi = degrees * pi / 180.;
      const auto   dry = plough_paraboloid(a, b, w, psi, 1., 0.), shear = plough_paraboloid(a, b, w, psi, 1., 0.1);
      EXPECT_NEAR(dry.drag / dry.support, mu_dry, 6e-6);
      EXPECT_NEAR(shear.drag / shear.support, mu_shear, 6e-6);
      EXPECT_NEAR(dry.projected_area, 0.5 * pi * a * b, 1e-14);
      const double w_perp = std::hypot(a * std::sin(psi), b * std::cos(psi));
      EXPECT_NEAR(dry.drag / dry.support, 8. * w * w_perp / (3. * pi * a * b), 1e-14);
    }
}

// Against a brute-force sum of the tractions over the leading side, at any orientation, shallow and steep, with the
// lateral force. The angles of the sum are 2 pi/1500 wide: where the line zx = 0 falls between them moves the lateral
// force, linear in the offset, by up to 2e-3 of the load; the other forces change by less than 1e-5.
TEST(Ploughing, ParaboloidIntegralsAtAnyOrientation)
{
  for (const double w : { 0.005, 0.1, 0.4 })
    for (const double psi : { 0., 0.3, 1.1, pi / 2, 2.5, -0.8 })
      {
        const double       a = 1.7, b = 0.8, p = 1., tau = 0.3;
        PloughingForces    sum;
        const unsigned int n = 1500;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            {
              // polar grid on the unit disc: its border is exact, the line zx = 0 is not
              const double r = (i + 0.5) / n, phi = 2 * pi * (j + 0.5) / n;
              const double u = -2 * w * r * std::cos(phi) / a, v = -2 * w * r * std::sin(phi) / b;
              const double zx = u * std::cos(psi) - v * std::sin(psi), zy = u * std::sin(psi) + v * std::cos(psi);
              if (zx >= 0)
                continue;
              const double weight = a * b * r / n * 2 * pi / n;
              const auto   f      = ploughing_traction(zx, zy, p, tau);
              sum.drag += weight * f.drag;
              sum.support += weight * f.support;
              sum.lateral += weight * f.lateral;
              sum.frontal_area += weight * f.frontal_area;
            }
        const auto f = plough_paraboloid(a, b, w, psi, p, tau);
        EXPECT_NEAR(f.drag, sum.drag, 1e-5) << w << " " << psi;
        EXPECT_NEAR(f.support, sum.support, 1e-5) << w << " " << psi;
        EXPECT_NEAR(f.lateral, sum.lateral, 2e-3) << w << " " << psi;
        EXPECT_NEAR(f.frontal_area, sum.frontal_area, 1e-5) << w << " " << psi;
      }
}

// The two ways to evaluate the radial integrals (series, closed form) meet: no step where the slope crosses 0.1.
TEST(Ploughing, SeriesAndClosedFormAgree)
{
  const double w = 0.05, h = 1e-7; // c = 2 w / b = 0.1 at b = 1
  const auto   below = plough_paraboloid(1., 1., w - h, 0.7, 1., 1.),
             above = plough_paraboloid(1., 1., w + h, 0.7, 1., 1.), middle = plough_paraboloid(1., 1., w, 0.7, 1., 1.);
  EXPECT_NEAR(below.drag + above.drag, 2. * middle.drag, 1e-13);
  EXPECT_NEAR(below.support + above.support, 2. * middle.support, 1e-13);
}

// One spherical summit pressed into a flat plateau: the leading half of the patch carries at the hardness, so that
// its area is 2 P A/H (a little more with shear); the coefficient is that of the paraboloid cap. Error falls with the
// pixels.
TEST(Ploughing, OneSummitConverges)
{
  const double height = 0.01, radius = 0.4, p = 10.,
               hardness = 200.; // paraboloid of height 0.01 over radius 0.4 in 1 x 1
  const double area = 2. * p / hardness, a = std::sqrt(area / pi), w = height * (a / radius) * (a / radius);
  const double exact    = 8. * w / (3. * pi * a);
  double       previous = 0;
  for (const std::size_t n : { 64, 256 })
    {
      const HeightMap sheet = map_of(n, 1. / n, [](double, double) { return 0.; });
      const HeightMap tool  = map_of(n, 1. / n, [&](double x, double y) {
        return height * (1. - (std::pow(x - 0.5, 2) + std::pow(y - 0.5, 2)) / (radius * radius));
      });
      const auto      balance
          = balance_ploughing(PlateauContact(sheet, tool, pixels_by_height(tool), 0.), p, hardness, 0., 2);
      EXPECT_NEAR(balance.support, p, 1e-10 * p);
      EXPECT_NEAR(balance.patch_fraction, area, 1e-10);
      EXPECT_FALSE(balance.saturated);
      const double error = std::abs(balance.coefficient - exact) / exact;
      if (n == 64)
        previous = error;
      else
        EXPECT_LT(error, 0.3 * previous); // at least first order: 4 times the pixels
      EXPECT_LT(error, n == 64 ? 0.04 : 0.01);
    }
}

// Support equals load over many patches, whatever the load; pixels alone would miss it by up to one pixel's force.
TEST(Ploughing, ForcesBalanceOverPatches)
{
  std::mt19937_64                  engine(3);
  std::normal_distribution<double> normal;
  // smooth random tool of 0.3 um, made of waves; plateaus on one third of the sheet
  std::vector<std::array<double, 4>> waves;
  for (unsigned int i = 0; i < 40; ++i)
    waves.push_back({ normal(engine) * 200., normal(engine) * 200., 6.28 * normal(engine), normal(engine) });
  const auto tool  = map_of(120, 3e-3, [&](double x, double y) {
    double t = 0;
    for (const auto &[kx, ky, phase, amplitude] : waves)
      t += 0.3e-3 / std::sqrt(20.) * amplitude * std::cos(kx * x + ky * y + phase);
    return t;
  });
  const auto sheet = map_of(120, 3e-3, [](double x, double y) { return std::sin(30. * x) * std::sin(25. * y); });
  const PlateauContact contact(sheet, tool, pixels_by_height(tool), 0.3);
  const double         plateau = static_cast<double>(contact.n_plateau_pixels()) / tool.size();
  std::size_t          most    = 0;
  for (const double p : { 0.001, 0.1, 1., 7.3, 20., 60. })
    for (const double tau : { 0., 25. })
      {
        const double hardness = 600.;
        const auto   balance  = balance_ploughing(contact, p, hardness, tau, 4);
        EXPECT_NEAR(balance.support, p, 1e-10 * p);
        EXPECT_FALSE(balance.saturated) << p << " of at most " << 0.5 * hardness * plateau;
        EXPECT_GT(balance.coefficient, 0.);
        EXPECT_LT(balance.coefficient, 0.2); // slopes of this tool are about 0.3e-3 * 200 = 0.06
        EXPECT_EQ(balance.patch_pressure, hardness);
        most = std::max(most, balance.n_patches);
      }
  EXPECT_GT(most, 20u);
  // More load than half the plateaus carry at the hardness: all of them touch and the pressure rises.
  const auto balance = balance_ploughing(contact, 600. * plateau, 600., 25., 4);
  EXPECT_TRUE(balance.saturated);
  EXPECT_NEAR(balance.support, 600. * plateau, 1e-10 * 600.);
  EXPECT_NEAR(balance.patch_fraction, plateau, 1e-14);
  EXPECT_GT(balance.patch_pressure, 1200.); // twice, and a little for the shear
  EXPECT_LT(balance.patch_pressure, 1210.);
}

// A flat tool does not plough, whatever the shear: its friction is that of the boundary layer alone.
TEST(Ploughing, FlatToolDoesNotPlough)
{
  const auto flat = map_of(32, 1e-3, [](double, double) { return 0.; });
  for (const double tau : { 0., 20. })
    {
      const auto balance = balance_ploughing(PlateauContact(flat, flat, pixels_by_height(flat), 0.), 5., 600., tau, 4);
      EXPECT_NEAR(balance.coefficient, 0., 1e-14);
      EXPECT_NEAR(balance.support, 5., 1e-12);
    }
}

TEST(Ploughing, NoLoadNoFriction)
{
  const auto flat = map_of(8, 1e-3, [](double, double) { return 0.; });
  EXPECT_EQ(balance_ploughing(PlateauContact(flat, flat, pixels_by_height(flat), 0.), 0., 600., 20., 4).coefficient,
            0.);
}
