#include <tribodraw/boundary_friction/ploughing.h>

#include "claims.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

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
      EXPECT_TRUE(claims::agrees(claims::with("ploughing cone, friction at degrees", degrees), "(2/pi) tan(theta)",
                                 f.drag / f.support, mu, 6e-6));
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
      EXPECT_TRUE(claims::agrees(claims::with("ploughing sphere, friction at degrees", degrees),
                                 "(2/pi)(th - sin th cos th)/sin^2 th", f.drag / f.support, mu, 6e-6));
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
        EXPECT_TRUE(
            claims::agrees(claims::with(claims::with("ploughing wedge, friction at angle", th) + ", shear", tau),
                           "tan(th + atan(tau/p))", f.drag / f.support, std::tan(th + std::atan(tau)), 1e-14));
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

// Closed forms for paraboloids along and across the sliding. With sx = 2w/a, sy = 2w/b (a along the sliding), the
// support lost to shear is
//   ab (sx/sy) [ asinh(sy) - (sy sqrt(1+sy^2) - asinh(sy)) / (2 sy^2) ],
// from the integral over the angle, 2 asinh(sy r)/(sy r), and over r by parts. The drag of shear on a circular one is
// the integral of 2 r E(i s r), E the complete elliptic integral of the second kind.
TEST(Ploughing, ParaboloidClosedForms)
{
  for (const double w : { 1e-4, 0.02, 0.049, 0.051, 0.25 }) // slopes up to 1
    for (const double b : { 1., 0.5, 3. })
      for (const double psi : { 0., pi })
        {
          const double sx = 2. * w, sy = 2. * w / b;
          const double lost
              = b * sx / sy
                * (sy < 1e-2 ? 2. * sy / 3. - pow(sy, 3) / 15.
                             : std::asinh(sy) - (sy * std::sqrt(1. + sy * sy) - std::asinh(sy)) / (2. * sy * sy));
          const auto f = plough_paraboloid(1., b, w, psi, 0., 1.);
          EXPECT_NEAR(-f.support, lost, 1e-10 * lost) << w << " " << b;
          EXPECT_NEAR(f.lateral, 0., 1e-13);
        }
  for (const double w : { 0.02, 0.049, 0.051, 0.3 })
    {
      // sqrt(1 + s^2 r^2 sin^2): E with imaginary modulus, brought to a real one by cos^2 = 1 - sin^2
      double             drag = 0;
      const unsigned int n    = 2000;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double r = (i + 0.5) / n, q = 4. * w * w * r * r;
          drag += 2. * r / n * std::sqrt(1. + q) * std::comp_ellint_2(std::sqrt(q / (1. + q)));
        }
      EXPECT_NEAR(plough_paraboloid(1., 1., w, 0.7, 0., 1.).drag, drag, 1e-6); // midpoint rule: 1/(24 n^2)
    }
}

// The rule with few angles for shallow summits and the fine one agree where they meet.
TEST(Ploughing, CoarseAndFineRulesAgree)
{
  for (const double psi : { 0., 0.4, 1.3 })
    {
      const double w = 0.05, h = 1e-8;
      const auto   coarse = plough_paraboloid(3., 1., w - h, psi, 1., 1.),
                 fine     = plough_paraboloid(3., 1., w, psi, 1., 1.);
      EXPECT_NEAR(coarse.drag, fine.drag, 1e-6);
      // second difference: the linear change over h drops out
      const auto two = plough_paraboloid(3., 1., w + h, psi, 1., 1.);
      EXPECT_NEAR(coarse.drag + two.drag - 2. * fine.drag, 0., 1e-12);
      EXPECT_NEAR(coarse.support + two.support - 2. * fine.support, 0., 1e-12);
      EXPECT_NEAR(coarse.lateral + two.lateral - 2. * fine.lateral, 0., 1e-12);
    }
}
