#include <tribodraw/boundary_friction/challen_oxley.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  const double pi = 3.14159265358979323846;

  double
  friction(const double theta, const double f)
  {
    return challen_oxley(theta, f).friction(theta);
  }
} // namespace

// model.md 2.4.
TEST(ChallenOxley, Values)
{
  const double expected[][3] = { { .3, 10., .25423 }, { .6, 10., .36454 }, { .6, 20., .66747 }, { .9, 5., .43023 } };
  for (const auto &[f, degrees, mu] : expected)
    EXPECT_NEAR(friction(degrees * pi / 180., f), mu, 6e-6) << f << " " << degrees;
}

// Without shear every solution is a frictionless wedge: mu = tan theta.
TEST(ChallenOxley, FrictionlessIsTheWedge)
{
  for (double theta = 0.01; theta < 1.5; theta += 0.01)
    EXPECT_NEAR(friction(theta, 0.), std::tan(theta), 1e-12 * std::tan(theta)) << theta;
}

// A flat punch: the slip-line pressure 2 + pi without shear; sticking, f = 1, gives 1 + pi/2 and mu = 1 / (1 + pi/2).
TEST(ChallenOxley, FlatPunch)
{
  EXPECT_NEAR(challen_oxley(0., 0.).pressure, 2. + pi, 1e-14);
  EXPECT_NEAR(friction(0., 1.), 1. / (1. + pi / 2), 1e-12);
}

// Wave and wedge meet at theta = acos(f)/2 with mu = 1; cutting starts at (pi - acos f)/2 with mu = 1.
TEST(ChallenOxley, Junctions)
{
  for (const double f : { 0.05, 0.2, 0.33, 0.6, 0.95 })
    {
      const double first = 0.5 * std::acos(f), second = 0.5 * (pi - std::acos(f)), h = 1e-9;
      EXPECT_EQ(challen_oxley(first - h, f).regime, ChallenOxley::Regime::wave);
      EXPECT_EQ(challen_oxley(first + h, f).regime, ChallenOxley::Regime::wedge);
      EXPECT_EQ(challen_oxley(second - h, f).regime, ChallenOxley::Regime::wedge);
      EXPECT_EQ(challen_oxley(second + h, f).regime, ChallenOxley::Regime::cutting);
      EXPECT_NEAR(friction(first - h, f), 1., 1e-7) << f;
      EXPECT_NEAR(friction(first + h, f), 1., 1e-7) << f;
      EXPECT_NEAR(friction(second + h, f), 1., 1e-7) << f;
      // Cutting as it is usually written: mu = tan(theta - pi/4 + acos(f)/2).
      EXPECT_NEAR(friction(second + 0.1, f), std::tan(second + 0.1 - pi / 4 + 0.5 * std::acos(f)), 1e-12) << f;
      // The wedge regime pulls harder than either neighbour: the step at its end is in the model.
      EXPECT_GT(friction(0.5 * (first + std::min(second, std::asin(std::sqrt(1. - f)))), f), 1.) << f;
    }
}

// In the wave regime friction rises with the slope and with the film strength, and is at least that of the wedge
// without shear. Nothing is infinite anywhere, also where the wedge solution has ended (f > 1/3) and for f = 1.
TEST(ChallenOxley, GrowsAndStaysFinite)
{
  for (const double f : { 0., 0.1, 0.4, 0.8, 0.99, 1. })
    {
      double previous = -1;
      for (double theta = 0.; theta <= 0.5 * std::acos(f); theta += 0.01)
        {
          const double mu = friction(theta, f);
          EXPECT_GT(mu, previous) << f << " " << theta;
          EXPECT_GE(mu, std::tan(theta) * (1. - 1e-12));
          previous = mu;
        }
      for (double theta = 0.; theta < 1.57; theta += 0.01)
        {
          const ChallenOxley wedge = challen_oxley(theta, f);
          EXPECT_TRUE(std::isfinite(wedge.pressure) && wedge.pressure >= 0.) << f << " " << theta;
        }
    }
}
