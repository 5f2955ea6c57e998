// Local Reynolds cells with a known result, without contact.
#include "maps.h"

#include "claims.h"

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
              EXPECT_TRUE(claims::at_least(claims::with("transverse sine, order of the pressure factor, a =", a),
                                           "(1-a^2)^2.5/(1+a^2/2)", order(error_p[0], error_p[1]), 1.9));
            }
          EXPECT_GT(order(error_s[0], error_s[1]), 1.9) << a;
          const std::string how = discretisation == CellDiscretisation::paper ? ", the paper's cells" : "";
          EXPECT_TRUE(claims::agrees(claims::with("transverse sine" + how + ", pressure factor, a =", a),
                                     "(1-a^2)^2.5/(1+a^2/2)", error_p[1] + phi_p, phi_p, 1e-2 * phi_p));
          EXPECT_TRUE(claims::agrees(claims::with("transverse sine" + how + ", Sq times shear factor, a =", a),
                                     "1.5 a^2/(1+a^2/2)", error_s[1] + sq_phi_s, sq_phi_s, 1e-2 * sq_phi_s));
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
        EXPECT_TRUE(claims::agrees(claims::with("longitudinal sine, pressure factor, a =", a), "1 + 1.5 a^2",
                                   f.phi_p[0], 1 + 1.5 * a * a, 1e-12));
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

TEST(ExactCells, checkerboard_extrapolated)
{
  // Harmonic means converge slowly at the corners, but with a known order p = (8/pi) atan (h2/h1)^1.5: the value for
  // vanishing pixels follows from two sizes, f + (f - f_coarse)/(2^p - 1).
  for (const double h2 : { .7, .6, .5 })
    {
      const double exact = std::pow(h2, 1.5) / std::pow((1 + h2) / 2, 3), p = 8 / pi * std::atan(std::pow(h2, 1.5));
      double       phi[3];
      for (const int i : { 0, 1, 2 })
        phi[i] = solve(map_of_gap(32u << i, 32u << i,
                                  [h2](const double x, const double y) { return (x < .5) == (y < .5) ? 1. : h2; }),
                       0, 1, periodic(CellDiscretisation::paper))
                     .phi_p[0];
      const double extrapolated = phi[2] + (phi[2] - phi[1]) / (std::pow(2, p) - 1);
      EXPECT_NEAR(order(phi[1] - exact, phi[2] - exact), p, .06) << h2;
      EXPECT_NEAR(extrapolated, exact, 1e-3 * exact) << h2;
      EXPECT_LT(std::abs(extrapolated - exact), .1 * std::abs(phi[2] - exact)) << h2;
    }
}

TEST(ExactCells, log_normal_gap)
{
  // ln h = s f with f(x + 1/2, y + 1/2) = -f: the coefficient and its inverse are the same up to a shift, and f is even
  // in x and in y and symmetric to their exchange, so the tensor is isotropic. By duality the conductance is then that
  // of the geometric mean, exp(3 <ln h>) = 1 exactly: PhiP = <h>^-3. The mean of a smooth periodic function is exact on
  // the pixels used here.
  const auto exponent = [](const double x, const double y) {
    const double cx = std::cos(2 * pi * x), cy = std::cos(2 * pi * y), c2x = std::cos(4 * pi * x),
                 c2y = std::cos(4 * pi * y);
    return cx + cy + c2x * cy + cx * c2y;
  };
  for (const double s : { .2, .4 })
    for (const auto discretisation : both_discretisations)
      {
        double error[2];
        for (const int i : { 0, 1 })
          {
            const FlowFactors r
                = solve(map_of_gap(64u << i, 64u << i,
                                   [&](const double x, const double y) { return std::exp(s * exponent(x, y)); }),
                        0, 1, periodic(discretisation));
            error[i] = r.phi_p[0] - std::pow(r.h_avg, -3);
            EXPECT_NEAR(r.phi_p[0], r.phi_p[3], 1e-12);
          }
        EXPECT_NEAR(order(error[0], error[1]), 2, .1) << s;
        EXPECT_NEAR(error[1], 0, 5e-3) << s;
      }
  // Gaussian ln h of variance s^2 (Matheron 1967): exp(-1.5 s^2) = .94176, .78663. On one map exp(3 <ln h>)/<h>^3 for
  // the mean of both directions (geometric, as the product of the principal values is what duality fixes).
  HeightMap map = gaussian_map(256, 6, 61);
  for (const double s : { .2, .4 })
    {
      HeightMap h = map;
      for (double &z : h.z)
        z = -std::exp(s * z);
      const FlowFactors f           = solve(h, 0, 1, periodic());
      const double      determinant = f.phi_p[0] * f.phi_p[3] - f.phi_p[1] * f.phi_p[2];
      EXPECT_NEAR(std::sqrt(determinant), std::pow(f.h_avg, -3), .003) << s;
      EXPECT_NEAR(std::sqrt(determinant), std::exp(-1.5 * s * s), .006) << s;
    }
}

TEST(ExactCells, bisinusoidal)
{
  // h = 1 + a sin sin, Sq = a/2: values of an independent spectral (Fourier) solution of the periodic cell
  const struct
  {
    double a, phi_p, phi_s;
  } cases[] = { { .2, .98544454, .14888263 }, { .4, .94685674, .29123911 }, { .5, .92253471, .35814022 },
                { .6, .89764332, .42137909 }, { .8, .85451919, .53505486 }, { .9, .83959142, .58485301 } };
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

TEST(ExactCells, one_reference_roughness)
{
  // Sq only scales PhiS: whatever the surfaces are, PhiP and Sq PhiS do not know it
  const HeightMap   map = gaussian_map(48, 4, 62);
  const FlowFactors a = solve(map, 1, 1, periodic(), {}, 3e-4), b = solve(map, 1, 4, periodic(), {}, 3e-4 / 4);
  for (const std::size_t k : { 0, 1, 2, 3 })
    {
      EXPECT_NEAR(a.phi_p[k], b.phi_p[k], 1e-12);
      EXPECT_NEAR(a.phi_s[k], 4 * b.phi_s[k], 1e-12);
    }
}

TEST(PaperBoundaryConditions, scaling_and_sign)
{
  // Without the pixel area in A.7 PhiS would change with the unit of length, with the printed sign of Eq. 4 PhiP would
  // be negative. Pixels that are not square, both directions.
  HeightMap map = gaussian_map(50, 4, 63);
  map.dy        = 1.7;
  for (const auto discretisation : both_discretisations)
    {
      const CellSettings settings{ CellBoundaryConditions::paper, discretisation };
      const FlowFactors  f      = solve(map, 1.2, 1, settings, {}, 3e-4);
      HeightMap          scaled = map;
      for (double &z : scaled.z)
        z *= 1e-3;
      scaled.dx *= 7;
      scaled.dy *= 7;
      const FlowFactors g = solve(scaled, 1.2e-3, 1e-3, settings, {}, 3e-4),
                        r = solve(rotated(map), 1.2, 1, settings, {}, 3e-4);
      for (const std::size_t k : { 0, 3 })
        {
          EXPECT_GT(f.phi_p[k], .2);
          EXPECT_GT(f.phi_s[k], .2);
          EXPECT_NEAR(g.phi_p[k], f.phi_p[k], 1e-11);
          EXPECT_NEAR(g.phi_s[k], f.phi_s[k], 1e-11);
          EXPECT_NEAR(r.phi_p[3 - k], f.phi_p[k], 1e-11);
          EXPECT_NEAR(r.phi_s[3 - k], f.phi_s[k], 1e-11);
        }
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
