// Enclosures of the factors by energy principles: exact cases, refinement, duality.
#include "maps.h"

#include <tribodraw/flow_factors/cell_bounds.h>
#include <tribodraw/flow_factors/cell_flow.h>

#include <gtest/gtest.h>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  constexpr CellDiscretisation both_discretisations[] = { CellDiscretisation::paper, CellDiscretisation::mean_gap };

  FlowFactors
  bounded(const HeightMap &sheet, const double cut_height = 0, const double sq = 1,
          const CellDiscretisation     d          = CellDiscretisation::mean_gap,
          const CellBoundaryConditions conditions = CellBoundaryConditions::periodic, const HeightMap &tool = {})
  {
    CellSettings settings{ conditions, d };
    settings.error_bounds = true;
    return solve(sheet, cut_height, sq, settings, tool, 3e-4);
  }

  void
  expect_enclosed(const double value, const double lower, const double upper, const double most_width,
                  const std::string &what)
  {
    EXPECT_LE(lower, value) << what;
    EXPECT_GE(upper, value) << what;
    EXPECT_LE(upper - lower, most_width) << what;
  }

  // Each pixel divided into factor x factor pixels of the same height: the same gap on a finer mesh.
  HeightMap
  refined(const HeightMap &map, const std::size_t factor)
  {
    HeightMap result = map;
    result.nx *= factor;
    result.ny *= factor;
    result.dx /= static_cast<double>(factor);
    result.dy /= static_cast<double>(factor);
    result.z.resize(result.nx * result.ny);
    for (std::size_t iy = 0; iy < result.ny; ++iy)
      for (std::size_t ix = 0; ix < result.nx; ++ix)
        result(ix, iy) = map(ix / factor, iy / factor);
    return result;
  }

  // Map whose gap is the least (or largest) value of gap(x, y) in each pixel, from a grid of points that includes the
  // border of the pixel; the functions used here are monotone or have their extremes on those points.
  HeightMap
  envelope(const std::size_t n, const std::function<double(double, double)> &gap, const bool largest)
  {
    return map_of_gap(n, n, [&](const double x, const double y) {
      constexpr int points = 8;
      double        worst  = gap(x, y);
      for (int i = 0; i <= points; ++i)
        for (int j = 0; j <= points; ++j)
          {
            const double step = 1. / static_cast<double>(n), u = x + (i / double(points) - .5) * step,
                         v = y + (j / double(points) - .5) * step;
            worst          = largest ? std::max(worst, gap(u, v)) : std::min(worst, gap(u, v));
          }
      return worst;
    });
  }

  double
  conductance_lower(const HeightMap &map)
  {
    const FlowFactors f = bounded(map);
    return f.phi_p_lower[0] * std::pow(f.h_avg, 3);
  }
  double
  conductance_upper(const HeightMap &map)
  {
    const FlowFactors f = bounded(map);
    return f.phi_p_upper[0] * std::pow(f.h_avg, 3);
  }
}

TEST(Bounds, sinus)
{
  // PhiP across = (1-a^2)^2.5/(1+a^2/2), along = 1 + 1.5 a^2, Sq PhiS across = 1.5 a^2/(1+a^2/2), along 0. The sums of
  // h^-3, h^-2, h^3 over 128 equidistant points are those integrals to round-off, so the gap of pixels has the same
  // factors. One-dimensional fields are reached exactly by Q1 and RT0 up to what is left of the start.
  for (const auto discretisation : both_discretisations)
    for (const double a : { .3, .6, .9 })
      {
        const auto map      = map_of_gap(128, 4, [a](const double x, double) { return 1 + a * std::cos(2 * pi * x); });
        const FlowFactors f = bounded(map, 0, 1, discretisation);
        const double      width  = discretisation == CellDiscretisation::paper ? 1e-10 : 4e-5;
        const std::string what   = "a = " + std::to_string(a);
        const double      across = std::pow(1 - a * a, 2.5) / (1 + a * a / 2);
        expect_enclosed(across, f.phi_p_lower[0], f.phi_p_upper[0], width, what);
        expect_enclosed(1 + 1.5 * a * a, f.phi_p_lower[3], f.phi_p_upper[3], 1e-10, what);
        expect_enclosed(1.5 * a * a / (1 + a * a / 2), f.phi_s_lower[0], f.phi_s_upper[0], 4e-3, what);
        expect_enclosed(0, f.phi_s_lower[3], f.phi_s_upper[3], 1e-10, what);
        expect_enclosed(0, f.phi_p_lower[1], f.phi_p_upper[1], 1e-6, what);
      }
}

TEST(Bounds, stepped_grooves)
{
  constexpr double h1 = 2, h2 = .7, c = .25;
  const auto       mean = [](const double power) { return c * std::pow(h1, power) + (1 - c) * std::pow(h2, power); };
  const double     h    = mean(1);
  const auto       map  = map_of_gap(64, 4, [](const double x, double) { return x < c ? h1 : h2; });
  for (const auto discretisation : both_discretisations)
    {
      // 1/(<h>^3 <h^-3>) and <h^3>/<h>^3, Sq PhiS = <h> - <h^-2>/<h^-3>; exact for the gap of pixels
      const FlowFactors f = bounded(map, 0, 1, discretisation);
      expect_enclosed(1 / (std::pow(h, 3) * mean(-3)), f.phi_p_lower[0], f.phi_p_upper[0], 1e-3, "across");
      expect_enclosed(mean(3) / std::pow(h, 3), f.phi_p_lower[3], f.phi_p_upper[3], 1e-10, "along");
      expect_enclosed(h - mean(-2) / mean(-3), f.phi_s_lower[0], f.phi_s_upper[0], 2e-2, "shear");
    }
}

TEST(Bounds, checkerboard)
{
  // Dykhne: PhiP = (h1 h2)^1.5/((h1 + h2)/2)^3, also at the large contrast where the estimate itself is poor
  for (const double h2 : { .7, .2 })
    {
      const double exact = std::pow(h2, 1.5) / std::pow((1 + h2) / 2, 3);
      const double most  = h2 > .5 ? .02 : .9; // the singularity at the corners: r^0.114 at h2 = .2
      double       width[2];
      for (const int i : { 0, 1 })
        {
          const auto        map = map_of_gap(32u << i, 32u << i,
                                             [h2](const double x, const double y) { return (x < .5) == (y < .5) ? 1. : h2; });
          const FlowFactors f   = bounded(map, 0, 1, CellDiscretisation::paper);
          expect_enclosed(exact, f.phi_p_lower[0], f.phi_p_upper[0], most, "checkerboard");
          expect_enclosed(exact, f.phi_p_lower[3], f.phi_p_upper[3], most, "checkerboard");
          width[i] = f.phi_p_upper[0] - f.phi_p_lower[0];
        }
      EXPECT_LT(width[1], width[0]);
    }
}

TEST(Bounds, bisinusoidal_gap_between_its_envelopes)
{
  // Values of an independent spectral solution. Conductance is monotone in the gap, so the lower bound of the least gap
  // in each pixel and the upper bound of the largest enclose the smooth gap for certain.
  const struct
  {
    double a, phi_p;
  } cases[] = { { .2, .98544454 }, { .4, .94685674 }, { .5, .92253471 },
                { .6, .89764332 }, { .8, .85451919 }, { .9, .83959142 } };
  for (const auto &c : cases)
    {
      const double a = c.a;
      const auto   gap
          = [a](const double x, const double y) { return 1 + a * std::sin(2 * pi * x) * std::sin(2 * pi * y); };
      double width[2];
      for (const int i : { 0, 1 })
        {
          const std::size_t n     = 32u << i;
          const double      lower = conductance_lower(envelope(n, gap, false)),
                       upper      = conductance_upper(envelope(n, gap, true));
          EXPECT_LT(lower, c.phi_p) << a;
          EXPECT_GT(upper, c.phi_p) << a;
          width[i] = upper - lower;
          // the gap at the centres differs from the smooth one by the square of the pixel size only
          const FlowFactors f = bounded(map_of_gap(n, n, gap));
          EXPECT_LT(f.phi_p_lower[0], c.phi_p * (1 + 20. / static_cast<double>(n * n)));
          EXPECT_GT(f.phi_p_upper[0], c.phi_p * (1 - 20. / static_cast<double>(n * n)));
        }
      EXPECT_NEAR(order(width[0], width[1]), 1, .1) << a;
    }
}

TEST(Bounds, array_of_discs_between_its_envelopes)
{
  // Perrins, McKenzie, McPhedran 1979, see ContactCells.array_of_discs
  for (const double f : { .1, .3, .5 })
    {
      const double f4 = std::pow(f, 4), f8 = f4 * f4;
      const double exact = 1 - 2 * f / (1 + f - .305827 * f4 / (1 - 1.402958 * f8) - .013362 * f8);
      const auto   gap   = [f](const double x, const double y) {
        return (x - .5) * (x - .5) + (y - .5) * (y - .5) < f / pi ? 0. : 1.;
      };
      const double lower = conductance_lower(envelope(96, gap, false)),
                   upper = conductance_upper(envelope(96, gap, true));
      EXPECT_LT(lower, exact) << f;
      EXPECT_GT(upper, exact) << f;
      EXPECT_LT(upper - lower, .12 * exact) << f; // one ring of pixels at the rim
    }
}

TEST(Bounds, refined_pixels_tighten_them)
{
  // The same gap on finer meshes has the same factors: all intervals contain them, so they overlap, and become
  // narrower. Two rough surfaces, non-square pixels, contact fraction about .2 and .45.
  HeightMap sheet = gaussian_map(32, 3, 5), tool = gaussian_map(32, 4, 6);
  for (double &t : tool.z)
    t *= .4;
  for (HeightMap *map : { &sheet, &tool })
    map->dy = 1.3;
  for (const auto conditions : { CellBoundaryConditions::periodic, CellBoundaryConditions::paper })
    for (const double cut_height : { 5., .8, .2 })
      {
        const auto at = [&](const std::size_t r) {
          return bounded(refined(sheet, r), cut_height, 1.077, CellDiscretisation::mean_gap, conditions,
                         refined(tool, r));
        };
        const FlowFactors coarse = at(1), fine = at(4);
        for (const std::size_t k : { 0, 1, 2, 3 })
          {
            if (conditions == CellBoundaryConditions::paper && (k == 1 || k == 2))
              continue;
            EXPECT_LT(coarse.phi_p_lower[k], fine.phi_p_upper[k]);
            EXPECT_GT(coarse.phi_p_upper[k], fine.phi_p_lower[k]);
            EXPECT_LT(coarse.phi_s_lower[k], fine.phi_s_upper[k]);
            EXPECT_GT(coarse.phi_s_upper[k], fine.phi_s_lower[k]);
            EXPECT_LT(fine.phi_p_upper[k] - fine.phi_p_lower[k], .7 * (coarse.phi_p_upper[k] - coarse.phi_p_lower[k]));
            EXPECT_LT(fine.phi_s_upper[k] - fine.phi_s_lower[k], .7 * (coarse.phi_s_upper[k] - coarse.phi_s_lower[k]));
          }
      }
}

TEST(Bounds, finest_solution_lies_inside)
{
  // Finite volumes with harmonic means on pixels divided by 8 are within 1 % of the gap of pixels; the bounds of the
  // coarse mesh must contain this value up to that error.
  const HeightMap map = gaussian_map(16, 3, 15);
  for (const double cut_height : { 3., 1., .5 })
    {
      const FlowFactors f     = bounded(map, cut_height),
                        fine  = solve(refined(map, 8), cut_height, 1, periodic(CellDiscretisation::paper), {}, 3e-4),
                        finer = solve(refined(map, 16), cut_height, 1, periodic(CellDiscretisation::paper), {}, 3e-4);
      for (const std::size_t k : { 0, 3 })
        {
          const double error_p = 2 * std::abs(finer.phi_p[k] - fine.phi_p[k]),
                       error_s = 2 * std::abs(finer.phi_s[k] - fine.phi_s[k]);
          EXPECT_LT(error_p, .01 * finer.phi_p[k]);
          EXPECT_GT(finer.phi_p[k], f.phi_p_lower[k] - error_p);
          EXPECT_LT(finer.phi_p[k], f.phi_p_upper[k] + error_p);
          EXPECT_GT(finer.phi_s[k], f.phi_s_lower[k] - error_s);
          EXPECT_LT(finer.phi_s[k], f.phi_s_upper[k] + error_s);
        }
    }
}

TEST(Bounds, harmonic_means_are_below)
{
  // The energy of two-point fluxes is the one of RT0 with the trapezoidal rule, which is larger: the factor of the
  // paper's scheme is itself a lower bound, and never better than the one given.
  const HeightMap map = gaussian_map(64, 4, 16);
  for (const double cut_height : { 4., 1., .4 })
    {
      const FlowFactors f = bounded(map, cut_height, 1, CellDiscretisation::paper);
      for (const std::size_t k : { 0, 3 })
        {
          EXPECT_GT(f.phi_p[k], .01);
          EXPECT_LT(f.phi_p[k], f.phi_p_lower[k]);
          EXPECT_LT(f.phi_p_lower[k], f.phi_p_upper[k]);
        }
    }
}

TEST(Bounds, duality_of_the_log_normal_gap)
{
  // In two dimensions the tensor of the inverse coefficient is K/det K (Keller, Dykhne, Matheron): an exact statement
  // on any periodic map. For ln h Gaussian both maps are alike, and K is the geometric mean in the limit of a large
  // map.
  constexpr double s   = .4;
  const HeightMap  map = gaussian_map(128, 5, 17);
  HeightMap        h = map, inverse = map;
  for (std::size_t i = 0; i < map.z.size(); ++i)
    {
      h.z[i]       = -std::exp(s * map.z[i]);
      inverse.z[i] = -std::exp(-s * map.z[i]);
    }
  const FlowFactors a = bounded(h), b = bounded(inverse);
  const double      scale_a = std::pow(a.h_avg, 3), scale_b = std::pow(b.h_avg, 3);
  const auto        xx = [](const std::array<double, 4> &k, const double scale) { return k[0] * scale; };
  // K_xx of the inverse lies between K_xx/(K_xx K_yy - K_xy^2) with the extreme values of each
  const double largest_xy2 = std::pow(std::max(std::abs(a.phi_p_lower[1]), std::abs(a.phi_p_upper[1])) * scale_a, 2);
  const double lowest      = 1 / (a.phi_p_upper[3] * scale_a);
  const double highest     = 1 / (a.phi_p_lower[3] * scale_a - largest_xy2 / xx(a.phi_p_lower, scale_a));
  EXPECT_LT(xx(b.phi_p_lower, scale_b), highest);
  EXPECT_GT(xx(b.phi_p_upper, scale_b), lowest);
  EXPECT_LT(highest / lowest, 1.05); // the statement is not empty
  // Matheron: PhiP = exp(-1.5 s^2); on one map exp(3 <ln h>)/<h>^3, up to a sample scatter of both directions' mean
  EXPECT_NEAR((a.phi_p[0] + a.phi_p[3]) / 2, 1 / scale_a, .02);
  EXPECT_NEAR(1 / scale_a, std::exp(-1.5 * s * s), .02);
}

TEST(Bounds, two_valued_gap_couples_both_factors)
{
  // Sq PhiS = (1 - alpha - kappa) h0, PhiP = kappa/(1-alpha)^3 exactly: one interval follows from the other
  HeightMap islands = gaussian_map(64, 4, 18);
  for (double &z : islands.z)
    z = z > .6 ? 0. : -1.3;
  const FlowFactors f    = bounded(islands);
  const double      open = 1 - f.contact_fraction;
  for (const std::size_t k : { 0, 3 })
    {
      const double lower = (open - f.phi_p_upper[k] * std::pow(open, 3)) * 1.3,
                   upper = (open - f.phi_p_lower[k] * std::pow(open, 3)) * 1.3;
      EXPECT_LT(f.phi_s_lower[k], upper);
      EXPECT_GT(f.phi_s_upper[k], lower);
      EXPECT_LT(f.phi_s_upper[k] - f.phi_s_lower[k], 3 * (upper - lower));
    }
}

TEST(Bounds, blocked_cell)
{
  // No way through: both factors are known exactly, also where open pixels meet in corners only.
  const auto board = map_of_gap(16, 16, [](const double x, const double y) {
    return static_cast<int>(16 * x) % 2 == static_cast<int>(16 * y) % 2 ? 1. : 0.;
  });
  for (const auto conditions : { CellBoundaryConditions::periodic, CellBoundaryConditions::paper })
    {
      const FlowFactors f = bounded(board, 0, .5, CellDiscretisation::mean_gap, conditions);
      for (const std::size_t k : { 0, 3 })
        {
          EXPECT_EQ(f.phi_p_lower[k], 0);
          EXPECT_EQ(f.phi_p_upper[k], 0);
          EXPECT_EQ(f.phi_s_lower[k], f.h_avg / .5);
          EXPECT_EQ(f.phi_s_upper[k], f.h_avg / .5);
        }
    }
  // Channels along x only
  const auto        channels = map_of_gap(16, 16, [](const double x, const double y) {
    return std::fmod(4 * y, 1.) < .5 ? 1 + .5 * std::sin(2 * pi * x) : 0.;
  });
  const FlowFactors f        = bounded(channels, 0, .5);
  EXPECT_GT(f.phi_p_lower[0], .1);
  EXPECT_EQ(f.phi_p_upper[3], 0);
  EXPECT_EQ(f.phi_s_upper[3], f.h_avg / .5);
}

TEST(Bounds, corners_between_contacts_let_nothing_through)
{
  // Two channels that touch in corners only: split corners keep them apart, otherwise the upper bound across would not
  // vanish with the mesh.
  const auto        map = map_of_gap(24, 24, [](const double x, const double y) {
    const int i = static_cast<int>(24 * x), j = static_cast<int>(24 * y);
    if (j % 8 == 0) // a row of alternating contacts
      return i % 2 == 0 ? 1. : 0.;
    if (j % 8 == 1)
      return i % 2 == 0 ? 0. : 1.;
    return 1.;
  });
  const FlowFactors f   = bounded(map);
  EXPECT_EQ(f.phi_p_upper[3], 0);
  EXPECT_GT(f.phi_p_lower[0], .5);
}

TEST(Bounds, useful_on_a_rough_surface)
{
  // Width of the intervals at 8 pixels a correlation length, and where the estimate lies. The gap of the estimate `mean
  // gap` is smoother than that of pixels, so it may lie outside, but by no more than the pixel size can change.
  const HeightMap map = gaussian_map(128, 8, 19);
  for (const double cut_height : { 6., 3., 1.5, 1., .7, .5 })
    {
      const FlowFactors f = bounded(map, cut_height);
      for (const std::size_t k : { 0, 3 })
        {
          EXPECT_LT(f.phi_p_upper[k] - f.phi_p_lower[k], .012 * f.phi_p[k]) << cut_height;
          EXPECT_LT(f.phi_s_upper[k] - f.phi_s_lower[k], .05 * f.phi_s[k]) << cut_height;
          EXPECT_NEAR(f.phi_p[k], .5 * (f.phi_p_lower[k] + f.phi_p_upper[k]), .02 * f.phi_p[k]) << cut_height;
          EXPECT_NEAR(f.phi_s[k], .5 * (f.phi_s_lower[k] + f.phi_s_upper[k]), .02 * f.phi_s[k]) << cut_height;
        }
    }
}

TEST(Bounds, hold_for_a_bad_solution)
{
  // Fields far from the solution: the enclosure becomes wide, never wrong.
  const HeightMap     map   = gaussian_map(48, 4, 20);
  const CellGrid      grid  = make_cell_grid(48, 48, 1, 1, true);
  const CellGap       gap   = make_cell_gap(map, {}, 1, 3e-4);
  const FlowFactors   exact = bounded(map, 1);
  const CellFlow      flow(grid, gap, CellDiscretisation::mean_gap, 0);
  std::vector<double> noise(grid.size());
  std::mt19937_64     random(3);
  CellBounding        bounding(grid, gap, 0);
  for (const int axis : { 0, 1 })
    for (const bool shear : { false, true })
      {
        CellFlow::Solution s = shear ? flow.shear_flow(axis) : flow.pressure_flow(axis);
        for (std::size_t i = 0; i < grid.size(); ++i)
          {
            s.pressure[i] += 1e-10 * static_cast<double>(random() % 1000000000);
            for (auto &flux : s.upper_flux)
              if (flux[i] != 0)
                flux[i] *= 1 + 1e-10 * static_cast<double>(random() % 1000000000);
          }
        if (shear)
          bounding.add_shear_flow(axis, s.pressure, s.upper_flux);
        else
          bounding.add_pressure_flow(axis, s.pressure, s.upper_flux);
      }
  FlowFactors bad;
  bounding.finish(bad, 1);
  for (const std::size_t k : { 0, 1, 2, 3 })
    {
      EXPECT_LE(bad.phi_p_lower[k], exact.phi_p_upper[k]);
      EXPECT_GE(bad.phi_p_upper[k], exact.phi_p_lower[k]);
      EXPECT_LE(bad.phi_s_lower[k], exact.phi_s_upper[k]);
      EXPECT_GE(bad.phi_s_upper[k], exact.phi_s_lower[k]);
    }
  EXPECT_GT(bad.phi_p_upper[0] - bad.phi_p_lower[0], 1.05 * (exact.phi_p_upper[0] - exact.phi_p_lower[0]));
}
