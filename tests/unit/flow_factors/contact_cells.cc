// Local Reynolds cells with contact, with rough tools, and random surfaces.
#include "maps.h"

#include <tribodraw/base/parallel.h>
#include <tribodraw/flow_factors/cell_flow.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  constexpr CellDiscretisation both_discretisations[] = { CellDiscretisation::paper, CellDiscretisation::mean_gap };

  // Film of thickness h0 around one disc of contact per unit cell.
  HeightMap
  disc_array(const std::size_t n, const double fraction, const double h0)
  {
    return map_of_gap(n, n, [=](const double x, const double y) {
      return (x - .5) * (x - .5) + (y - .5) * (y - .5) < fraction / pi ? 0. : h0;
    });
  }

  // Largest difference between the flux of the shear solution and the one that the pressure solutions predict.
  double
  reciprocity_error(const HeightMap &sheet, const HeightMap &tool, const double cut_height, const CellDiscretisation d)
  {
    const CellGrid         grid = make_cell_grid(sheet.nx, sheet.ny, sheet.dx, sheet.dy, true);
    const CellGap          gap  = make_cell_gap(sheet, tool, cut_height, 3e-4);
    const CellFlow         flow(grid, gap, d, 0);
    const CellFlow::Window all{ { { 0, 0 } }, { { grid.nx, grid.ny } } };
    double                 worst = 0;
    for (const int i : { 0, 1 })
      for (const int j : { 0, 1 })
        worst = std::max(worst, std::abs(flow.mean_flux(flow.shear_flow(j), i, all)
                                         - flow.shear_flux_by_reciprocity(flow.pressure_flow(i), j)));
    return worst;
  }
}

TEST(ContactCells, two_valued_gap)
{
  // Gap h0 or 0: with kappa the conductivity relative to an open gap, PhiP = kappa/(1-alpha)^3 and
  // Sq PhiS = ((1-alpha) - kappa) h0: both problems are the same one. Holds for any shape, in the discrete equations
  // too.
  constexpr double h0 = 1.3, sq = .4;
  const HeightMap  field   = gaussian_map(40, 4, 5);
  HeightMap        islands = field;
  for (double &z : islands.z)
    z = z > .6 ? 0. : -h0;
  for (const auto discretisation : both_discretisations)
    {
      const FlowFactors f     = solve(islands, 0, sq, periodic(discretisation));
      const double      open  = 1 - f.contact_fraction;
      const double      kappa = f.phi_p[0] * std::pow(open, 3);
      EXPECT_GT(f.contact_fraction, .1);
      EXPECT_NEAR(f.h_avg, open * h0, 1e-12);
      EXPECT_NEAR(f.phi_s[0], (open - kappa) * h0 / sq, 1e-11);
      EXPECT_NEAR(f.phi_s[1], -f.phi_p[1] * std::pow(open, 3) * h0 / sq, 1e-11);
    }
}

TEST(ContactCells, array_of_discs)
{
  // Perrins, McKenzie, McPhedran 1979, square array of insulating discs of area fraction f:
  // kappa = 1 - 2f/(1 + f - .305827 f^4/(1 - 1.402958 f^8) - .013362 f^8)
  const auto perrins = [](const double f) {
    const double f4 = std::pow(f, 4), f8 = f4 * f4;
    return 1 - 2 * f / (1 + f - .305827 * f4 / (1 - 1.402958 * f8) - .013362 * f8);
  };
  for (const double f : { .1, .3, .5 })
    {
      double error[2];
      for (const int i : { 0, 1 })
        {
          const FlowFactors r = solve(disc_array(i == 0 ? 50 : 200, f, 1), 0, 1, periodic());
          const double      c = r.contact_fraction; // of the disc made of pixels
          EXPECT_NEAR(c, f, .01);
          error[i] = std::abs(r.phi_p[0] * std::pow(1 - c, 3) - perrins(c));
        }
      // the stairs at the border of the disc are an error of first order: four times finer, about a quarter
      EXPECT_NEAR(.5 * order(error[0], error[1]), 1, .2) << f;
      EXPECT_LT(error[1], .0035) << f;
    }
}

TEST(ContactCells, reciprocity)
{
  // The shear flux follows from the pressure problem alone: B_ij = <c d(y_i + chi_i)/dy_j>
  const HeightMap sheet = gaussian_map(64, 5, 1);
  HeightMap       tool  = gaussian_map(64, 4, 2);
  for (double &t : tool.z)
    t *= .5;
  for (const auto discretisation : both_discretisations)
    for (const double cut_height : { 5., 1., .5 })
      {
        EXPECT_LT(reciprocity_error(sheet, {}, cut_height, discretisation), 1e-9);
        EXPECT_LT(reciprocity_error(sheet, tool, cut_height, discretisation), 1e-9);
      }
}

TEST(ContactCells, same_flux_through_every_section)
{
  const HeightMap map = gaussian_map(96, 3, 4);
  for (const auto conditions : { CellBoundaryConditions::paper, CellBoundaryConditions::periodic })
    for (const auto discretisation : both_discretisations)
      for (const double cut_height : { 3., .7, .4 })
        {
          const FlowFactors f = solve(map, cut_height, 1, { conditions, discretisation }, {}, 3e-4);
          EXPECT_GT(f.phi_p[0], 0);
          EXPECT_LT(f.flux_error, 1e-10);
          EXPECT_LT(f.residual, 1e-12);
        }
}

TEST(ContactCells, isolated_pools_carry_nothing)
{
  // Pools of two depths surrounded by contact: no pressure flow at all, everything is carried with the sheet, so
  // PhiS = h_avg/Sq (the kinematic limit).
  const auto pools = map_of_gap(40, 40, [](const double x, const double y) {
    const double u = std::fmod(4 * x, 1.), v = std::fmod(4 * y, 1.);
    return u > .2 && u < .8 && v > .2 && v < .8 ? 1 + x : 0.;
  });
  for (const auto conditions : { CellBoundaryConditions::paper, CellBoundaryConditions::periodic })
    {
      const FlowFactors f = solve(pools, 0, .5, { conditions, CellDiscretisation::mean_gap });
      EXPECT_EQ(f.phi_p[0], 0);
      EXPECT_EQ(f.phi_p[3], 0);
      if (conditions == CellBoundaryConditions::periodic)
        {
          EXPECT_DOUBLE_EQ(f.phi_s[0], f.h_avg / .5);
          EXPECT_DOUBLE_EQ(f.phi_s[3], f.h_avg / .5);
        }
    }
  // A channel along x beside the pools: they still add nothing to the flow through it.
  const auto with_channel = [](const double depth) {
    return map_of_gap(40, 40, [depth](const double x, const double y) {
      if (y > .9)
        return 1.;
      return x > .3 && x < .6 && y > .3 && y < .6 ? depth : 0.;
    });
  };
  for (const double depth : { 0., 1., 50. })
    {
      const FlowFactors f = solve(with_channel(depth), 0, 1, periodic());
      // <h^3> of a channel over a tenth of the width
      EXPECT_NEAR(f.phi_p[0] * std::pow(f.h_avg, 3), .1, 1e-12) << depth;
      EXPECT_EQ(f.phi_p[3], 0);
    }
}

TEST(ContactCells, region_across_the_border_of_the_cell_is_not_a_channel)
{
  // One pool that the border of the periodic cell cuts in four: open pixels on all sides, but no way through.
  const auto pool = map_of_gap(
      20, 20, [](const double x, const double y) { return (x < .3 || x > .7) && (y < .3 || y > .7) ? 1. : 0.; });
  const FlowFactors f = solve(pool, 0, 1, periodic());
  EXPECT_EQ(f.phi_p[0], 0);
  EXPECT_EQ(f.phi_p[3], 0);
  // With a diagonal staircase it becomes one that leads through in both directions at once.
  const auto        stairs = map_of_gap(20, 20, [](const double x, const double y) {
    const double d = std::fmod(x - y + 1 + .025, 1.);
    return d < .15 ? 1. : 0.;
  });
  const FlowFactors g      = solve(stairs, 0, 1, periodic());
  EXPECT_GT(g.phi_p[0], .01);
  EXPECT_NEAR(g.phi_p[0], g.phi_p[1], 1e-12); // all flow is along the diagonal
}

TEST(ContactCells, multigrid_equals_direct_solution)
{
  // Two solvers of the same equations; odd and even sizes (across the border of an odd periodic map neighbours have the
  // same colour), non-square pixels, no contact, contact, and just above percolation (0.4).
  const HeightMap field = gaussian_map(97, 6, 12);
  struct Size
  {
    std::size_t nx, ny;
  };
  for (const Size size : { Size{ 97, 90 }, Size{ 96, 97 }, Size{ 97, 97 }, Size{ 64, 32 } })
    for (const bool periodic_cell : { true, false })
      for (const double cut_height : { 4., 1.2, .3 })
        {
          HeightMap map = field;
          map.nx        = size.nx;
          map.ny        = size.ny;
          map.dy        = 1.5;
          map.z.clear();
          for (std::size_t iy = 0; iy < size.ny; ++iy)
            for (std::size_t ix = 0; ix < size.nx; ++ix)
              map.z.push_back(field(ix, iy));
          const CellGrid grid = make_cell_grid(map.nx, map.ny, map.dx, map.dy, periodic_cell);
          const CellGap  gap  = make_cell_gap(map, {}, cut_height, 3e-4);
          for (const int driven_axis : { 0, 1 })
            {
              const CellFlow direct(grid, gap, CellDiscretisation::mean_gap, driven_axis, CellSolverChoice::direct);
              const CellFlow multigrid(grid, gap, CellDiscretisation::mean_gap, driven_axis,
                                       CellSolverChoice::multigrid, 1e-13);
              const CellFlow::Window all{ { { 0, 0 } }, { { grid.nx, grid.ny } } };
              const auto drives = { CellFlow::Drive{ driven_axis, false }, CellFlow::Drive{ driven_axis, true } };
              const auto a = direct.solve(drives), b = multigrid.solve(drives);
              for (const std::size_t i : { 0, 1 })
                {
                  for (const int axis : { 0, 1 })
                    EXPECT_NEAR(direct.mean_flux(a[i], axis, all), multigrid.mean_flux(b[i], axis, all), 1e-11);
                  EXPECT_LT(multigrid.section_mismatch(b[i], driven_axis), 1e-12);
                  EXPECT_LT(b[i].residual, 1e-12);
                  if (direct.blocked() || (i == 0 && !direct.conducts(driven_axis)))
                    continue;
                  // conjugate gradients have worked, and did not give up (150) in favour of the factorisation
                  EXPECT_GT(b[i].iterations, 4u);
                  EXPECT_LT(b[i].iterations, 40u) << size.nx << " x " << size.ny << " " << cut_height;
                }
            }
        }
}

TEST(ContactCells, narrow_neck_keeps_its_digits)
{
  // A pool that hangs on the channel by two pixels of 1e-3 of the film: pressures behind the neck become 1e9 times
  // larger than in the channel. The flux balance must not suffer.
  const auto neck = map_of_gap(30, 30, [](const double x, const double y) {
    if (y > .8)
      return 1.;
    if (x > .5 && x < .53 && y > .7)
      return 1e-3;
    return x > .3 && x < .8 && y > .2 && y <= .7 ? 1 + x * y : 0.;
  });
  for (const auto discretisation : both_discretisations)
    {
      const FlowFactors f = solve(neck, 0, 1, periodic(discretisation), {}, 3e-4);
      EXPECT_LT(f.flux_error, 1e-10);
      EXPECT_LT(reciprocity_error(neck, {}, 0, discretisation), 1e-9);
    }
}

TEST(ContactCells, vanishing_film)
{
  // Films so thin that h^3 is beyond the range of single precision, with no closed gap to remove them: the multigrid
  // solution is that without these pixels, as next to nothing flows there.
  HeightMap thin = gaussian_map(96, 6, 13), closed = thin;
  for (std::size_t i = 0; i < thin.size(); i += 7)
    if (thin.z[i] > .9)
      {
        thin.z[i]   = 1 - 1e-14;
        closed.z[i] = 2;
      }
  const CellGrid         grid = make_cell_grid(96, 96, 1, 1, true);
  const CellFlow::Window all{ { { 0, 0 } }, { { 96, 96 } } };
  CellGap                gap = make_cell_gap(thin, {}, 1, 0);
  const CellFlow         with(grid, gap, CellDiscretisation::paper, 0, CellSolverChoice::multigrid);
  const CellGap          without_gap = make_cell_gap(closed, {}, 1, 0);
  const CellFlow         without(grid, without_gap, CellDiscretisation::paper, 0, CellSolverChoice::multigrid);
  const auto             a = with.pressure_flow(0), b = without.pressure_flow(0);
  EXPECT_NEAR(with.mean_flux(a, 0, all), without.mean_flux(b, 0, all), 1e-9);
  EXPECT_LT(a.residual, 1e-10);
  EXPECT_LT(a.iterations, 40u); // no factorisation was needed
}

TEST(ContactCells, exchange_of_surfaces)
{
  const HeightMap a = gaussian_map(48, 4, 7);
  HeightMap       b = gaussian_map(48, 6, 8), flat = a;
  for (double &z : b.z)
    z *= .6;
  std::fill(flat.z.begin(), flat.z.end(), 0.);
  for (const double cut_height : { 4., .8 })
    {
      // the rough tool slides the other way relative to the gap: PhiS changes its sign
      const FlowFactors sheet_rough = solve(a, cut_height, 1, periodic()),
                        tool_rough  = solve(flat, cut_height, 1, periodic(), a);
      const FlowFactors ab = solve(a, cut_height, 1, periodic(), b), ba = solve(b, cut_height, 1, periodic(), a);
      EXPECT_GT(sheet_rough.phi_s[0], .1);
      for (const std::size_t k : { 0, 1, 2, 3 })
        {
          EXPECT_NEAR(sheet_rough.phi_p[k], tool_rough.phi_p[k], 1e-12);
          EXPECT_NEAR(sheet_rough.phi_s[k], -tool_rough.phi_s[k], 1e-12);
          EXPECT_NEAR(ab.phi_p[k], ba.phi_p[k], 1e-12);
          EXPECT_NEAR(ab.phi_s[k], -ba.phi_s[k], 1e-12);
          // identical surfaces: no preferred one
          EXPECT_NEAR(solve(a, cut_height, 1, periodic(), a).phi_s[k], 0, 1e-12);
        }
    }
}

TEST(ContactCells, two_rough_surfaces_to_second_order)
{
  // Far apart the carried flux Sq PhiS of a pair is the difference of those of each surface alone at the same gap: both
  // are quadratic in the roughness and the cross terms vanish in the mean over relative positions along the
  // sliding direction. With Sq_i PhiS_i = Sq_i^2 P(h) this is Patir and Cheng's Sq^2 PhiS = Sq1^2 PhiS1 - Sq2^2 PhiS2.
  const HeightMap a = gaussian_map(32, 3, 9);
  HeightMap       b = gaussian_map(32, 4, 10);
  for (double &z : b.z)
    z *= .7;
  const double sq1 = 1, sq2 = .7, sq = std::sqrt(sq1 * sq1 + sq2 * sq2), h = 30 * sq;
  double       pair = 0;
  for (std::size_t shift = 0; shift < 32; ++shift)
    {
      HeightMap moved = b;
      for (std::size_t iy = 0; iy < 32; ++iy)
        for (std::size_t ix = 0; ix < 32; ++ix)
          moved(ix, iy) = b((ix + shift) % 32, iy);
      pair += solve(a, h, sq, periodic(), moved).phi_s[0] / 32;
    }
  const double first = solve(a, h, sq1, periodic()).phi_s[0], second = solve(b, h, sq2, periodic()).phi_s[0];
  // the next terms are smaller by (Sq/h)^2 = 1e-3
  const double expected = (sq1 * first - sq2 * second) / sq;
  EXPECT_NEAR(pair, expected, 5e-3 * first);
}

TEST(RandomSurfaces, tripp_limit)
{
  // Second-order perturbation (Tripp 1983), isotropic: PhiP = 1 - 1.5/H^2, PhiS = 1.5/H. A sample is not isotropic, but
  // the mean of x and y is free of that: the sum of cos^2 over the two directions is one for each wave. Discretisation
  // error and higher orders remain.
  constexpr double  H     = 20;
  const HeightMap   map   = gaussian_map(128, 10, 11);
  const FlowFactors f     = solve(map, H, 1, periodic());
  const double      phi_p = (f.phi_p[0] + f.phi_p[3]) / 2, phi_s = (f.phi_s[0] + f.phi_s[3]) / 2;
  EXPECT_NEAR((1 - phi_p) / (1.5 / (H * H)), 1, .03);
  EXPECT_NEAR(phi_s / (1.5 / H), 1, .03);
}

TEST(RandomSurfaces, tripp_limit_is_approached)
{
  // The relative deviation from the second-order result falls at least with 1/H: halving from H = 10 to 20 to 40, apart
  // from the discretisation error, which does not depend on H (10 pixels a correlation length: 1 %).
  const HeightMap map      = gaussian_map(128, 10, 11);
  double          before_p = .1, before_s = .1;
  for (const double H : { 10., 20., 40. })
    {
      const FlowFactors f = solve(map, H, 1, periodic());
      const double      p = std::abs((1 - (f.phi_p[0] + f.phi_p[3]) / 2) / (1.5 / (H * H)) - 1),
                   s      = std::abs((f.phi_s[0] + f.phi_s[3]) / 2 / (1.5 / H) - 1);
      EXPECT_LT(p, std::max(.6 * before_p, .015)) << H;
      EXPECT_LT(s, std::max(.6 * before_s, .015)) << H;
      before_p = p;
      before_s = s;
    }
}

TEST(RandomSurfaces, percolation_of_a_gaussian_gap)
{
  // Heights and depths of a Gaussian field are alike, so the film and the contact percolate at the same fraction: 1/2.
  // On pixels a corner connects contacts but not the film, which lowers the value; finite maps scatter by some .03.
  double mean = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed)
    {
      const HeightMap map  = gaussian_map(256, 8, 200 + seed);
      const CellGrid  grid = make_cell_grid(256, 256, 1, 1, true);
      for (const int axis : { 0, 1 })
        {
          double open = 1, blocked = -1;
          while (open - blocked > 1e-3)
            {
              const double  middle                                          = .5 * (open + blocked);
              const CellGap gap                                             = make_cell_gap(map, {}, middle, 0);
              (CellConnectivity(grid, gap).conducts(axis) ? open : blocked) = middle;
            }
          mean += make_cell_gap(map, {}, blocked, 0).contact_fraction / 16;
        }
    }
  EXPECT_NEAR(mean, .5, .03);
}

TEST(RandomSurfaces, gaussian_reference_curve)
{
  // Isotropic Gaussian surfaces, 256 x 256 pixels, autocorrelation exp(-r^2/(2 (8 px)^2)), smooth tool: mean and
  // standard deviation of single results over 6 realisations x 2 directions of an independent periodic solver; h_avg
  // and alpha of the untruncated normal distribution. Bands: one standard deviation of a single result, about twice
  // that of the difference of the two means.
  const struct
  {
    double s, h_avg, alpha, phi_p, scatter, phi_s;
  } reference[]                  = { { 1.5, 1.531, .0685, .637, .057, .771 },
                                     { 1, 1.085, .1588, .462, .084, .763 },
                                     { .5, .699, .3062, .202, .103, .629 },
                                     { .25, .537, .3981, .093, .094, .517 },
                                     { -.25, .286, .5964, .001, .003, .285 } };
  constexpr std::size_t  n_seeds = 4;
  std::vector<HeightMap> maps;
  for (std::size_t seed = 0; seed < n_seeds; ++seed)
    maps.push_back(gaussian_map(256, 8, 100 + seed));
  const CellGrid grid = make_cell_grid(256, 256, 1, 1, true);
  for (const auto &r : reference)
    {
      std::vector<FlowFactors> results(n_seeds);
      parallel::for_range(n_seeds, 1, [&](const std::size_t begin, const std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          results[i] = solve_cell_problem(grid, make_cell_gap(maps[i], {}, r.s, 3e-4), periodic(), 1);
      });
      double h_avg = 0, alpha = 0, phi_p = 0, phi_s = 0;
      for (const FlowFactors &f : results)
        {
          h_avg += f.h_avg / n_seeds;
          alpha += f.contact_fraction / n_seeds;
          phi_p += (f.phi_p[0] + f.phi_p[3]) / (2 * n_seeds);
          phi_s += (f.phi_s[0] + f.phi_s[3]) / (2 * n_seeds);
          EXPECT_LE(f.phi_s[0], f.h_avg * (1 + 1e-12)); // kinematic limit
          EXPECT_GE(f.phi_s[0], 0);
        }
      EXPECT_NEAR(h_avg, r.h_avg, .02) << r.s;
      EXPECT_NEAR(alpha, r.alpha, .02) << r.s;
      EXPECT_NEAR(phi_p, r.phi_p, r.scatter) << r.s;
      EXPECT_NEAR(phi_s, r.phi_s, .03) << r.s;
    }
}
