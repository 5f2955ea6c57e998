// Local Reynolds cells with a known result, without contact.
#include "maps.h"

#include <gtest/gtest.h>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  constexpr CellDiscretisation both_discretisations[] = { CellDiscretisation::paper, CellDiscretisation::mean_gap };

  // Gap 1 + a cos(2 pi x): ridges across x.
  HeightMap
  transverse(const std::size_t n, const double a)
  {
    return map_of_gap(n, 3, [a](const double x, double) { return 1 + a * std::cos(2 * pi * x); });
  }

  HeightMap
  longitudinal(const std::size_t n, const double a)
  {
    return map_of_gap(3, n, [a](double, const double y) { return 1 + a * std::cos(2 * pi * y); });
  }

  HeightMap
  bisinusoidal(const std::size_t n, const double a)
  {
    return map_of_gap(
        n, n, [a](const double x, const double y) { return 1 + a * std::sin(2 * pi * x) * std::sin(2 * pi * y); });
  }

  HeightMap
  rotated(const HeightMap &map)
  {
    // by 90 degrees: the new (x, y) was (y, -x)
    HeightMap result = map;
    result.nx        = map.ny;
    result.ny        = map.nx;
    result.dx        = map.dy;
    result.dy        = map.dx;
    for (std::size_t iy = 0; iy < result.ny; ++iy)
      for (std::size_t ix = 0; ix < result.nx; ++ix)
        result(ix, iy) = map(iy, map.ny - 1 - ix);
    return result;
  }
}

TEST(ExactCells, smooth_gap)
{
  for (const auto conditions : { CellBoundaryConditions::paper, CellBoundaryConditions::periodic })
    for (const auto discretisation : both_discretisations)
      {
        const HeightMap   map = map_of_gap(20, 30, [](double, double) { return 1.7; });
        const FlowFactors f   = solve(map, 0, 1, { conditions, discretisation });
        // definition of the factors: a smooth gap has PhiP = 1 and no effect of sliding
        EXPECT_NEAR(f.phi_p[0], 1, 1e-12);
        EXPECT_NEAR(f.phi_p[3], 1, 1e-12);
        EXPECT_NEAR(f.phi_p[1], 0, 1e-12);
        EXPECT_NEAR(f.phi_s[0], 0, 1e-12);
        EXPECT_NEAR(f.phi_s[3], 0, 1e-12);
        EXPECT_NEAR(f.h_avg, 1.7, 1e-12);
        EXPECT_EQ(f.contact_fraction, 0);
      }
}

TEST(ExactCells, transverse_sinus_converges_with_second_order)
{
  // h = h0 (1 + a cos): PhiP = (1-a^2)^2.5/(1+a^2/2), Sq PhiS/h0 = 1.5 a^2/(1+a^2/2), from the means of h^-2 and
  // h^-3 in the one-dimensional Reynolds equation; the digits are these formulas evaluated.
  const struct
  {
    double a, phi_p, sq_phi_s;
  } cases[] = { { .3, .75593976, .12918660 }, { .6, .27769492, .45762712 }, { .9, .01119973, .86476868 } };
  for (const auto &c : cases)
    {
      const double a     = c.a;
      const double phi_p = std::pow(1 - a * a, 2.5) / (1 + a * a / 2), sq_phi_s = 1.5 * a * a / (1 + a * a / 2);
      EXPECT_NEAR(phi_p, c.phi_p, 5e-9);
      EXPECT_NEAR(sq_phi_s, c.sq_phi_s, 5e-9);
      for (const auto discretisation : both_discretisations)
        {
          double error_p[2], error_s[2];
          for (const int i : { 0, 1 })
            {
              const FlowFactors f = solve(transverse(64u << i, a), 0, 1, periodic(discretisation));
              error_p[i]          = f.phi_p[0] - phi_p;
              error_s[i]          = f.phi_s[0] - sq_phi_s;
              // along the ridges: <h^3> of the 64 or 128 samples is exact for a trigonometric polynomial
              EXPECT_NEAR(f.phi_p[3], 1 + 1.5 * a * a, 1e-12);
              EXPECT_NEAR(f.phi_s[3], 0, 1e-12);
            }
          // For smooth periodic data a sum over equidistant points converges faster than any power: the harmonic means
          // add up to the sum of h^-3 itself.
          if (discretisation == CellDiscretisation::paper)
            {
              EXPECT_NEAR(error_p[1], 0, 1e-12) << a;
            }
          else
            {
              EXPECT_GT(order(error_p[0], error_p[1]), 1.9) << a;
            }
          EXPECT_GT(order(error_s[0], error_s[1]), 1.9) << a;
          EXPECT_NEAR(error_p[1] / phi_p, 0, 1e-2) << a;
          EXPECT_NEAR(error_s[1] / sq_phi_s, 0, 1e-2) << a;
        }
    }
}

TEST(ExactCells, longitudinal_sinus)
{
  // PhiP = 1 + 1.5 a^2 = <h^3>/<h>^3 along the ridges, no shear effect; exact on any grid of at least 4 points
  for (const double a : { .3, .6, .9 })
    for (const auto discretisation : both_discretisations)
      {
        const FlowFactors f = solve(longitudinal(16, a), 0, 1, periodic(discretisation));
        EXPECT_NEAR(f.phi_p[0], 1 + 1.5 * a * a, 1e-12);
        EXPECT_NEAR(f.phi_s[0], 0, 1e-12);
      }
}

TEST(ExactCells, half_amplitude_transverse)
{
  // a = .5: PhiP = .43301270, PhiS = .94280904 with Sq = a/sqrt 2 (closed form, also found to 1e-14 by an independent
  // spectral calculation). The rough surface moves with +Us/2, so the sign must be positive.
  const FlowFactors f = solve(transverse(1024, .5), 0, .5 / std::sqrt(2.), periodic());
  EXPECT_NEAR(f.phi_p[0], .43301270, 2e-5);
  EXPECT_NEAR(f.phi_s[0], .94280904, 2e-5);
}

TEST(ExactCells, stepped_grooves)
{
  // Gap h1 over the fraction c of x, h2 elsewhere: PhiP across = 1/(<h>^3 <h^-3>), along = <h^3>/<h>^3,
  // Sq PhiS across = <h> - <h^-2>/<h^-3>. Harmonic means are exact at a step in the pressure problem.
  constexpr double h1 = 2, h2 = .7, c = .25;
  const auto       mean  = [](const double power) { return c * std::pow(h1, power) + (1 - c) * std::pow(h2, power); };
  const double     h_avg = mean(1), across = 1 / (std::pow(h_avg, 3) * mean(-3)), along = mean(3) / std::pow(h_avg, 3);
  const double     sq_phi_s = h_avg - mean(-2) / mean(-3);
  const auto       grooves
      = [](const std::size_t n) { return map_of_gap(n, 4, [](const double x, double) { return x < c ? h1 : h2; }); };
  for (const auto discretisation : both_discretisations)
    {
      const FlowFactors coarse = solve(grooves(64), 0, 1, periodic(discretisation));
      const FlowFactors fine   = solve(grooves(128), 0, 1, periodic(discretisation));
      EXPECT_NEAR(coarse.phi_p[3], along, 1e-12);
      const double error = coarse.phi_p[0] - across, fine_error = fine.phi_p[0] - across;
      if (discretisation == CellDiscretisation::paper)
        {
          EXPECT_NEAR(error, 0, 1e-12);
        }
      else
        {
          EXPECT_NEAR(order(error, fine_error), 1, .1);
        }
      EXPECT_NEAR(order(coarse.phi_s[0] - sq_phi_s, fine.phi_s[0] - sq_phi_s), 1, .1);
      // first order: extrapolation to pixel size zero
      EXPECT_NEAR(2 * fine.phi_s[0] - coarse.phi_s[0], sq_phi_s, 1e-3 * sq_phi_s);
    }
}

TEST(ExactCells, checkerboard)
{
  // Dykhne: PhiP = (h1 h2)^1.5/((h1 + h2)/2)^3, isotropic. At the corners the pressure varies as r^lambda,
  // lambda = (4/pi) atan (h2/h1)^1.5 for this conductance ratio h^3: the energy converges with order 2 lambda = 1.351.
  constexpr double h1 = 1, h2 = .7;
  const double     exact          = std::pow(h1 * h2, 1.5) / std::pow((h1 + h2) / 2, 3);
  const double     singular_order = 8 / pi * std::atan(std::pow(h2 / h1, 1.5));
  for (const auto discretisation : both_discretisations)
    {
      double error[3];
      for (const int i : { 0, 1, 2 })
        {
          const auto        board = map_of_gap(32u << i, 32u << i,
                                               [](const double x, const double y) { return (x < .5) == (y < .5) ? h1 : h2; });
          const FlowFactors f     = solve(board, 0, 1, periodic(discretisation));
          error[i]                = f.phi_p[0] - exact;
          EXPECT_NEAR(f.phi_p[0], f.phi_p[3], 1e-12);
          EXPECT_NEAR(f.phi_p[1], 0, 1e-12);
        }
      const double coarse_order = order(error[0], error[1]), fine_order = order(error[1], error[2]);
      if (discretisation == CellDiscretisation::paper)
        {
          EXPECT_NEAR(fine_order, singular_order, .02);
          EXPECT_NEAR(error[2] / exact, 0, 1e-3);
        }
      else
        {
          // The mean gap smears the steps over a pixel: first order, reached from below because of the corners' part
          EXPECT_GT(fine_order, coarse_order);
          EXPECT_NEAR(fine_order, .9, .1);
          EXPECT_NEAR(error[2] / exact, 0, 4e-3);
        }
    }
}

TEST(ExactCells, bisinusoidal)
{
  // h = 1 + a sin sin, Sq = a/2: values of an independent spectral (Fourier) solution of the periodic cell
  const struct
  {
    double a, phi_p, phi_s;
  } cases[] = { { .2, .98544454, .14888263 }, { .5, .92253471, .35814022 }, { .9, .83959142, .58485301 } };
  for (const auto &c : cases)
    for (const auto discretisation : both_discretisations)
      {
        double error_p[2], error_s[2];
        for (const int i : { 0, 1 })
          {
            const FlowFactors f = solve(bisinusoidal(64u << i, c.a), 0, c.a / 2, periodic(discretisation));
            error_p[i]          = f.phi_p[0] - c.phi_p;
            error_s[i]          = f.phi_s[3] - c.phi_s;
            EXPECT_NEAR(f.phi_p[0], f.phi_p[3], 1e-12);
            EXPECT_NEAR(f.phi_p[1], f.phi_p[2], 1e-12); // symmetric tensor
          }
        EXPECT_GT(order(error_p[0], error_p[1]), 1.9) << c.a;
        EXPECT_GT(order(error_s[0], error_s[1]), 1.9) << c.a;
        EXPECT_NEAR(error_p[1], 0, 2e-3) << c.a;
        EXPECT_NEAR(error_s[1], 0, 2e-3) << c.a;
      }
}

TEST(ExactCells, scaling_and_rotation)
{
  HeightMap map    = gaussian_map(48, 5, 3);
  map.dy           = 2;
  const auto check = [](const FlowFactors &a, const std::array<double, 4> &p, const std::array<double, 4> &s) {
    for (const std::size_t k : { 0, 1, 2, 3 })
      {
        EXPECT_NEAR(a.phi_p[k], p[k], 1e-11) << k;
        EXPECT_NEAR(a.phi_s[k], s[k], 1e-11) << k;
      }
  };
  for (const auto discretisation : both_discretisations)
    {
      const FlowFactors f = solve(map, .8, 1, periodic(discretisation), {}, 3e-4);
      EXPECT_GT(std::abs(f.phi_p[1]), 1e-3); // else the test of the rotation would see nothing
      // heights and Sq times 1e-3, lengths times 7: dimensionless results stay
      HeightMap scaled = map;
      for (double &z : scaled.z)
        z *= 1e-3;
      scaled.dx *= 7;
      scaled.dy *= 7;
      check(solve(scaled, .8e-3, 1e-3, periodic(discretisation), {}, 3e-4), f.phi_p, f.phi_s);
      // a tensor A turns into Q A Q^T: xx and yy change places, xy becomes -yx
      check(solve(rotated(map), .8, 1, periodic(discretisation), {}, 3e-4),
            { { f.phi_p[3], -f.phi_p[2], -f.phi_p[1], f.phi_p[0] } },
            { { f.phi_s[3], -f.phi_s[2], -f.phi_s[1], f.phi_s[0] } });
    }
}

TEST(PaperBoundaryConditions, sinus)
{
  // 20 waves on 320 pixels: the central window holds 16 whole waves, so the window changes nothing and the
  // one-dimensional formulas hold (see above); with walls along the flow also for the longitudinal sinus.
  constexpr double a     = .6;
  const auto       waves = [](const std::size_t nx, const std::size_t ny, const int axis) {
    return map_of_gap(
              nx, ny, [axis](const double x, const double y) { return 1 + a * std::cos(40 * pi * (axis == 0 ? x : y)); });
  };
  double error_p[2], error_s[2];
  for (const int i : { 0, 1 })
    {
      const FlowFactors f
          = solve(waves(640u << i, 10, 0), 0, 1, { CellBoundaryConditions::paper, CellDiscretisation::mean_gap });
      error_p[i] = f.phi_p[0] - .27769492;
      error_s[i] = f.phi_s[0] - .45762712;
      EXPECT_NEAR(f.phi_p[3], 1 + 1.5 * a * a, 1e-9);
      EXPECT_EQ(f.phi_p[1], 0);
    }
  EXPECT_GT(order(error_p[0], error_p[1]), 1.9);
  EXPECT_GT(order(error_s[0], error_s[1]), 1.9);
  EXPECT_NEAR(error_s[1], 0, 1e-2);

  const FlowFactors f = solve(waves(10, 640, 1), 0, 1, { CellBoundaryConditions::paper, CellDiscretisation::paper });
  EXPECT_NEAR(f.phi_p[0], 1 + 1.5 * a * a, 1e-9);
  EXPECT_NEAR(f.phi_s[0], 0, 1e-9);
  // Appendix A adds up h^-3 exactly (no fluctuation of the flux), in the given direction too
  EXPECT_NEAR(f.phi_p[3], .27769492, 1e-8);
}
