// Spatial, hybrid, functional and profile parameters and closed voids on surfaces whose values are known exactly.
#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/autocorrelation.h>
#include <tribodraw/surface/closed_voids.h>
#include <tribodraw/surface/evaluation.h>
#include <tribodraw/surface/material_ratio.h>
#include <tribodraw/surface/profile_parameters.h>
#include <tribodraw/surface/random_field.h>
#include <tribodraw/surface/slopes.h>

#include "claims.h"
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <set>

using namespace tribodraw;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  /// Map of z(x, y), x and y in mm from the lower left corner to the centres of the pixels.
  template <class Function>
  HeightMap
  map_of(std::size_t nx, std::size_t ny, double dx, double dy, bool periodic, const Function &z)
  {
    HeightMap map;
    map.nx       = nx;
    map.ny       = ny;
    map.dx       = dx;
    map.dy       = dy;
    map.periodic = periodic;
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix)
        map.z.push_back(z((static_cast<double>(ix) + 0.5) * dx, (static_cast<double>(iy) + 0.5) * dy));
    return map;
  }

  HeightMap
  gaussian(std::size_t n, const CorrelationLengths &lengths, std::uint64_t seed)
  {
    NormalDeviates deviates(seed);
    auto           map = map_of(n, n, 1e-3, 1e-3, true, [](double, double) { return 0.; });
    map.z              = gaussian_field({ n, n, 1e-3, 1e-3 }, lengths, deviates);
    return map;
  }

  HeightMap
  transposed(const HeightMap &map)
  {
    return map_of(map.ny, map.nx, map.dy, map.dx, map.periodic, [&](double x, double y) {
      return map(static_cast<std::size_t>(y / map.dx), static_cast<std::size_t>(x / map.dy));
    });
  }
} // namespace

TEST(Autocorrelation, OfASineIsItsCosine)
{
  // Periodic sine: C(x) = cos(2 pi x / wavelength), exact for sums over whole periods. It falls to 0.2 at
  // wavelength * acos(0.2) / (2 pi); linear interpolation between pixels is off by at most (2 pi/N)^2/8 * N/(2 pi)
  // pixels.
  const auto map = map_of(200, 8, 2e-3, 3e-3, true, [](double x, double) { return std::sin(2 * pi * x / 0.2) + 7.; });
  const Autocorrelation acf(map);
  EXPECT_NEAR(acf(0, 0), 1., 1e-13);
  EXPECT_NEAR(acf(13, 0), std::cos(2 * pi * 13 / 100), 1e-12);
  EXPECT_NEAR(acf(-13, 3), std::cos(2 * pi * 13 / 100), 1e-12);
  const auto s = spatial_parameters(map);
  ASSERT_TRUE(s.length_x);
  EXPECT_TRUE(claims::agrees("autocorrelation length of a sine, mm", "wavelength acos(0.2)/(2 pi)", *s.length_x,
                             0.2 * std::acos(0.2) / (2 * pi), 2 * pi / 100 / 8 * map.dx));
  EXPECT_FALSE(s.length_y); // constant along y
  EXPECT_FALSE(s.peklenik);
  EXPECT_FALSE(s.str);
  ASSERT_TRUE(s.sal);
  EXPECT_NEAR(*s.sal, *s.length_x, 1e-12);
}

TEST(Autocorrelation, EqualsTheSumOverPairs)
{
  // Definition summed directly, on open and periodic maps with odd and even, prime and composite sizes.
  for (const bool periodic : { false, true })
    for (const auto &size : { std::pair<std::size_t, std::size_t>(13, 10), { 16, 9 }, { 1, 7 }, { 103, 2 } })
      {
        const std::size_t nx = size.first, ny = size.second;
        NormalDeviates        deviates(4);
        const auto            map = map_of(nx, ny, 1., 2., periodic, [&](double, double) { return deviates(); });
        const Autocorrelation acf(map);
        double                mean = 0;
        for (const double z : map.z)
          mean += z / static_cast<double>(map.size());
        const auto covariance = [&](std::ptrdiff_t lx, std::ptrdiff_t ly) {
          double sum = 0, pairs = 0;
          for (std::ptrdiff_t iy = 0; iy < static_cast<std::ptrdiff_t>(ny); ++iy)
            for (std::ptrdiff_t ix = 0; ix < static_cast<std::ptrdiff_t>(nx); ++ix)
              {
                std::ptrdiff_t jx = ix + lx, jy = iy + ly;
                const auto     sx = static_cast<std::ptrdiff_t>(nx), sy = static_cast<std::ptrdiff_t>(ny);
                if (periodic)
                  {
                    jx = (jx + sx) % sx;
                    jy = (jy + sy) % sy;
                  }
                else if (jx < 0 || jx >= sx || jy < 0 || jy >= sy)
                  continue;
                sum += (map(static_cast<std::size_t>(ix), static_cast<std::size_t>(iy)) - mean)
                       * (map(static_cast<std::size_t>(jx), static_cast<std::size_t>(jy)) - mean);
                pairs += 1;
              }
          return sum / pairs;
        };
        const auto mx = static_cast<std::ptrdiff_t>(acf.largest_lag_x()),
                   my = static_cast<std::ptrdiff_t>(acf.largest_lag_y());
        for (std::ptrdiff_t ly = -my; ly <= my; ++ly)
          for (std::ptrdiff_t lx = -mx; lx <= mx; ++lx)
            EXPECT_NEAR(acf(lx, ly), covariance(lx, ly) / covariance(0, 0), 1e-12) << nx << ' ' << lx << ' ' << ly;
      }
}

TEST(Autocorrelation, ProductOfSinesHasKnownSalAndStr)
{
  // z = sin(k x) sin(k y): C = cos(k x) cos(k y). Along the axes it falls to 0.2 at acos(0.2)/k = 1.3694/k; along the
  // diagonal r (1, 1)/sqrt(2) at cos^2 = 0.2, r = sqrt(2) acos(sqrt(0.2))/k = 1.5657/k. The level curve cos u cos v =
  // 0.2 has its extremes of u^2 + v^2 there: on it d(u^2 + v^2) = 0 needs u = 0 or tan u / u = tan v / v. Bilinear
  // interpolation on N = 100 pixels a wave: (2 pi / N)^2 / 8 per direction, relative to a slope of 0.98 / 0.8.
  const double k = 2 * pi / 0.1;
  const auto   s = spatial_parameters(
        map_of(400, 400, 1e-3, 1e-3, true, [&](double x, double y) { return std::sin(k * x) * std::sin(k * y); }));
  ASSERT_TRUE(s.sal && s.str);
  EXPECT_NEAR(*s.sal * k, std::acos(0.2), 2e-3);
  EXPECT_NEAR(*s.str, std::acos(0.2) / (std::sqrt(2.) * std::acos(std::sqrt(0.2))), 2e-3);
  EXPECT_NEAR(*s.peklenik, 1., 1e-10);
}

TEST(Autocorrelation, GaussianSurfaceWithLayHasItsLengths)
{
  // C = exp(-(x^2/(2 lx^2) + y^2/(2 ly^2))) falls to s at l sqrt(-2 ln s); Sal is that of the shorter, Str and the
  // inverse Peklenik number are the ratio. 512 pixels, l = 16 and 4: A/(pi lx ly) = 1304. Standard deviation of C at
  // lag l: sqrt((1 + 3/e - 4 e^-0.75)/1304) = 0.0130 (Bartlett, see the tests of generated surfaces); near the level
  // 0.2 at most sqrt(1/1304) = 0.028 over a slope of 0.2 * 1.794 / l: 0.077 l. Four of them, of the ratio 4 sqrt(2) of
  // them.
  const auto map = gaussian(512, { 16e-3, 4e-3 }, 3);
  const auto s   = spatial_parameters(map);
  ASSERT_TRUE(s.sal && s.str && s.peklenik);
  const double factor = std::sqrt(2 * std::log(5.));
  EXPECT_NEAR(*s.sal, 4e-3 * factor, 4 * 0.077 * 4e-3);
  EXPECT_NEAR(*s.length_x, 16e-3 * factor, 4 * 0.077 * 16e-3);
  EXPECT_LE(*s.sal, *s.length_y + 1e-12);
  EXPECT_NEAR(*s.str, 0.25, 0.25 * 4 * 1.41 * 0.077 / factor);
  EXPECT_NEAR(*s.peklenik, 4., 4. * 4 * 1.41 * 0.05);
  EXPECT_NEAR(s.std_angle, 0., 2.);
  const auto t = spatial_parameters(transposed(map));
  EXPECT_NEAR(*t.sal, *s.sal, 1e-10);
  EXPECT_NEAR(*t.str, *s.str, 1e-10);
  EXPECT_NEAR(*t.peklenik * *s.peklenik, 1., 1e-10);
  EXPECT_NEAR(*t.length_y, *s.length_x, 1e-12);
  EXPECT_NEAR(std::abs(t.std_angle), 90., 2.);
}

TEST(TextureDirection, OfARotatedSineIsItsLay)
{
  // Crests at the angle a against x: z = sin(k (-x sin a + y cos a)). The map is open; its spectrum has a resolution of
  // one wave over the map, 1/20 of the wave number, that is 3 degrees between neighbouring points of the spectrum.
  for (const double angle : { 0., 17., 45., 80., 90., -30., -72. })
    {
      const double a = angle * pi / 180;
      const auto   s = spatial_parameters(map_of(256, 200, 1e-3, 1.3e-3, false, [&](double x, double y) {
        return std::sin(2 * pi / 0.0128 * (-x * std::sin(a) + y * std::cos(a)));
      }));
      EXPECT_NEAR(std::remainder(s.std_angle - angle, 180.), 0., 0.5) << angle;
      EXPECT_GT(s.std_angle, -90.);
      EXPECT_LE(s.std_angle, 90.);
    }
}

TEST(Slopes, ConvergeToThoseOfASineWithSixthOrder)
{
  // z = A sin(kx): m0 = A^2/2, m2_x = A^2 k^2 / 2, m4_x = A^2 k^4 / 2, nothing along y.
  double error[2][2];
  for (const int i : { 0, 1 })
    {
      const std::size_t n   = i ? 64 : 32;
      const auto        map = map_of(n, 8, 1. / static_cast<double>(n), 0.1, true,
                                     [](double x, double) { return 0.1 * std::sin(2 * pi * x) + 3.; });
      const auto        p   = slope_parameters(map);
      EXPECT_NEAR(p.m0, 0.005, 1e-14);
      error[0][i] = std::abs(p.m2_x / (0.005 * 4 * pi * pi) - 1);
      error[1][i] = std::abs(p.m4_x / (0.005 * std::pow(2 * pi, 4)) - 1);
      EXPECT_EQ(p.m2_y, 0.);
      EXPECT_NEAR(p.m4_y, 0., 1e-20);
      EXPECT_NEAR(p.sdq, std::sqrt(p.m2_x), 1e-14);
      EXPECT_NEAR(p.m2(), 0.5 * p.m2_x, 1e-14);
    }
  for (const auto &e : error)
    {
      EXPECT_LT(e[1], 1e-7);
      EXPECT_NEAR(std::log2(e[0] / e[1]), 6., 0.1);
    }
}

TEST(Slopes, SdrOfAPlaneAndOfASine)
{
  // Plane of slopes 0.3 and 0.4: sqrt(1 + 0.25) - 1 exactly, Sdq = 0.5.
  const auto plane
      = slope_parameters(map_of(20, 9, 0.1, 0.3, false, [](double x, double y) { return 0.3 * x + 0.4 * y; }));
  EXPECT_NEAR(plane.sdr, std::sqrt(1.25) - 1., 1e-13);
  EXPECT_NEAR(plane.sdq, 0.5, 1e-13);
  EXPECT_NEAR(plane.m4(), 0., 1e-20);
  // Sine of slope amplitude m = 1 (A k = 1): length per wave = (2/pi) sqrt(1 + m^2) E(m^2/(1 + m^2)) = 1.216006724
  // (complete elliptic integral of the second kind; std::comp_ellint_2 takes the modulus). Second order.
  const double exact = 2 / pi * std::sqrt(2.) * std::comp_ellint_2(std::sqrt(0.5)) - 1.;
  EXPECT_NEAR(exact, 0.216006724, 1e-8);
  double error[2];
  for (const int i : { 0, 1 })
    {
      const std::size_t n = i ? 80 : 40;
      error[i]            = std::abs(slope_parameters(map_of(n, 8, 1. / static_cast<double>(n), 1., true,
                                                             [](double x, double) { return std::sin(2 * pi * x) / (2 * pi); }))
                                         .sdr
                                     - exact);
    }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2., 0.05);
  EXPECT_THROW(slope_parameters(map_of(6, 20, 1., 1., true, [](double x, double) { return x; })), InputError);
}

TEST(Slopes, GaussianSurfaceHasTheMomentsOfItsSpectrum)
{
  // C = exp(-r^2/(2 l^2)): m2 = -C''(0) = 1/l^2, m4 = C''''(0) = 3/l^4 for unit variance. l = 8 pixels; scatter: the
  // mean of z_x^2 over A/(pi l^2) = 1304 independent areas has a relative standard deviation below sqrt(2/1304 * 3) =
  // 0.07.
  const auto p = slope_parameters(gaussian(512, { 8e-3, 8e-3 }, 6));
  EXPECT_NEAR(p.m2_x * 64e-6, 1., 4 * 0.07);
  EXPECT_NEAR(p.m2_y * 64e-6, 1., 4 * 0.07);
  EXPECT_NEAR(p.m4_x * 4096e-12, 3., 3 * 4 * 0.07);
}

TEST(MaterialRatio, OfARampIsAStraightLine)
{
  // Heights equally distributed over [-1/2, 1/2]: the core is the whole curve, S(p) = 1/2 - p. Vm(p) = p^2/2,
  // Vv(p) = (1-p)^2/2: Vmp = 0.005, Vmc = 0.32 - 0.005, Vvv = 0.02, Vvc = 0.405 - 0.02.
  const auto               map = map_of(1000, 1, 1e-3, 1., false, [](double x, double) { return 8. - x; });
  const MaterialRatioCurve curve(map);
  const auto               f = curve.functional_parameters();
  EXPECT_NEAR(f.sk, 1., 1e-9);
  EXPECT_NEAR(f.smr1, 0., 1e-3);
  EXPECT_NEAR(f.smr2, 1., 1e-3);
  EXPECT_NEAR(f.spk, 0., 1e-3);
  EXPECT_NEAR(f.svk, 0., 1e-3);
  EXPECT_NEAR(f.vmp, 0.005, 1e-6);
  EXPECT_NEAR(f.vmc, 0.315, 1e-5);
  EXPECT_NEAR(f.vvv, 0.02, 1e-5);
  EXPECT_NEAR(f.vvc, 0.385, 1e-5);
  EXPECT_NEAR(curve.ratio(0.25), 0.25, 1e-3);
  EXPECT_EQ(curve.ratio(0.6), 0.);
  EXPECT_EQ(curve.ratio(-0.6), 1.);
  EXPECT_NEAR(curve.height(0.25), 0.25, 1e-3);
}

TEST(MaterialRatio, PlateauWithPeaksAndValleys)
{
  // A curve of three straight parts: peaks from 3 down to 1 over 10 % of the area, a core from 1 to 0 over 70 %,
  // valleys from 0 to -4 over 20 %. The flattest 40 % lie in the core (any of them: all have its slope), so the line
  // runs from 1 + 0.1/0.7 = 8/7 at 0 to -0.2/0.7 = -2/7 at 100 %: Sk = 10/7. It meets the peaks where 3 - 20 p = 8/7, p
  // = 13/140, and the valleys where -20 (p - 0.8) = -2/7, p = 0.8 + 1/70. Peaks above 8/7: triangle of height 13/7, so
  // Spk = 13/7; valleys below -2/7: Svk = 26/7.
  constexpr std::size_t    n    = 200000;
  const auto               map  = map_of(n, 1, 1. / n, 1., false, [](double p, double) {
    return p < 0.1 ? 3 - 20 * p : p < 0.8 ? 1 - (p - 0.1) / 0.7 : -20 * (p - 0.8);
  });
  const double             mean = 0.1 * 2 + 0.7 * 0.5 - 0.2 * 2;
  const MaterialRatioCurve curve(map);
  const auto               f = curve.functional_parameters();
  EXPECT_NEAR(f.sk, 10. / 7, 1e-5);
  EXPECT_NEAR(f.smr1, 13. / 140, 1e-5);
  EXPECT_NEAR(f.smr2, 0.8 + 1. / 70, 1e-5);
  EXPECT_NEAR(f.spk, 13. / 7, 1e-4);
  EXPECT_NEAR(f.svk, 26. / 7, 1e-4);
  EXPECT_NEAR(curve.ratio(0.5 - mean), 0.45, 1e-5);
  // Vmp: triangle of 10 % and height 2; Vmc = Vm(80) - Vmp with Vm(80) = 0.1 + 0.1 * 1 + 0.7 / 2; Vvv: triangle of 20 %
  // and height 4; Vv(10) = 0.7 / 2 + 0.2 * 1 + Vvv. At a kink the height is off by a quarter of a point times the
  // change of slope, 18.6 / (4 n) = 2.3e-5.
  EXPECT_NEAR(f.vmp, 0.1, 1e-5);
  EXPECT_NEAR(f.vmc, 0.45, 3e-5);
  EXPECT_NEAR(f.vvv, 0.4, 1e-5);
  EXPECT_NEAR(f.vvc, 0.55, 3e-5);
}

TEST(MaterialRatio, OfNormalHeights)
{
  // The curve is the normal quantile; its flattest 40 % lie between 30 % and 70 %. Least-squares slope over them and
  // the areas beyond the line by the sums over quantiles, computed here on 1e5 exact quantiles.
  constexpr int       n = 100000;
  std::vector<double> q(n);
  for (int i = 0; i < n; ++i)
    {
      double low = -9, high = 9; // the value exceeded with probability (i + 1/2) / n
      for (int k = 0; k < 60; ++k)
        (0.5 * std::erfc(0.5 * (low + high) / std::sqrt(2.)) > (i + 0.5) / n ? low : high) = 0.5 * (low + high);
      q[static_cast<std::size_t>(i)] = 0.5 * (low + high);
    }
  double moment = 0, squares = 0;
  for (int i = 30000; i < 70000; ++i)
    {
      const double t = (i + 0.5) / n - 0.5;
      moment += t * q[static_cast<std::size_t>(i)];
      squares += t * t;
    }
  const double sk    = -moment / squares;
  double       peaks = 0, smr1 = 0;
  for (int i = 0; i < n; ++i)
    if (q[static_cast<std::size_t>(i)] > sk / 2)
      {
        peaks += (q[static_cast<std::size_t>(i)] - sk / 2) / n;
        smr1 += 1. / n;
      }
  auto map     = map_of(n, 1, 1e-3, 1e-3, false, [](double, double) { return 0.; });
  map.z        = q;
  const auto f = MaterialRatioCurve(map).functional_parameters();
  EXPECT_NEAR(f.sk, sk, 1e-3);
  EXPECT_NEAR(f.sk, 2.56, 0.05); // about the slope of the quantile at its centre, sqrt(2 pi) = 2.51, and a little more
  EXPECT_NEAR(f.smr1, smr1, 1e-3);
  EXPECT_NEAR(f.spk, 2 * peaks / smr1, 1e-3);
  EXPECT_NEAR(f.svk, f.spk, 1e-3);
  EXPECT_NEAR(f.smr2, 1 - f.smr1, 1e-3);
}

TEST(ClosedVoids, PocketAndChannel)
{
  // Plateau of height 0 with a pocket (depth 2, 3 x 2 pixels inside) and a groove (depth 1, 5 pixels from the border)
  // on 10 x 10 pixels. Just below the plateau the pocket is closed, the groove is open.
  auto map = map_of(10, 10, 1., 1., false, [](double, double) { return 0.; });
  for (std::size_t ix = 2; ix < 5; ++ix)
    map(ix, 3) = map(ix, 4) = -2.;
  for (std::size_t ix = 0; ix < 5; ++ix)
    map(ix, 8) = -1.;
  map(5, 5)         = -1e-9; // the height just below the plateau, itself a closed void of no depth
  const auto   all  = closed_voids(map, 100);
  const auto   s    = state_at(all, 0.88); // 12 of 100 pixels are below
  const double mean = -(6 * 2. + 5 * 1.) / 100;
  EXPECT_NEAR(s.height, 0. - mean, 1e-8);
  EXPECT_NEAR(s.volume, 0.17, 1e-8);
  EXPECT_NEAR(s.closed_volume, 0.12, 1e-8);
  EXPECT_NEAR(s.closed_area, 0.07, 1e-12);
  // At 6 pixels the pocket alone is under water and has no depth yet.
  EXPECT_NEAR(state_at(all, 0.94).closed_volume, 0., 1e-12);
  EXPECT_NEAR(state_at(all, 0.94).closed_area, 0.06, 1e-12);
  // One more pixel opens it diagonally: still closed. Through an edge: open.
  map(5, 5) = 0.;
  map(1, 5) = -0.5; // touches the pocket at a corner
  EXPECT_NEAR(state_at(closed_voids(map, 100), 0.88).closed_area, 0.07, 1e-12);
  map(1, 5) = 0.;
  for (std::size_t iy = 5; iy < 10; ++iy)
    map(4, iy) = std::min(map(4, iy), -0.5);
  EXPECT_NEAR(state_at(closed_voids(map, 100), 1 - 0.15).closed_area, 0., 1e-12);
}

TEST(ClosedVoids, OnAPeriodicMapAVoidIsOpenIfItLeadsAround)
{
  const auto pocket = [](std::size_t nx, std::size_t ny, const std::set<std::pair<int, int>> &low) {
    auto map = map_of(nx, ny, 1., 1., true, [](double, double) { return 0.; });
    for (const auto &[x, y] : low)
      map(static_cast<std::size_t>(x), static_cast<std::size_t>(y)) = -1.;
    return state_at(closed_voids(map, static_cast<unsigned>(nx * ny)),
                    1. - static_cast<double>(low.size()) / (static_cast<double>(nx * ny)))
        .closed_area;
  };
  // A pocket over the corner of the map is closed although it touches all four sides.
  EXPECT_NEAR(pocket(5, 4, { { 0, 0 }, { 4, 0 }, { 0, 3 }, { 4, 3 } }), 0.2, 1e-12);
  // A groove around is open, also if it winds; a ring is closed.
  EXPECT_NEAR(pocket(5, 4, { { 0, 1 }, { 1, 1 }, { 2, 1 }, { 3, 1 }, { 4, 1 } }), 0., 1e-12);
  EXPECT_NEAR(pocket(5, 4, { { 0, 1 }, { 1, 1 }, { 2, 1 }, { 2, 2 }, { 3, 2 }, { 4, 2 }, { 0, 2 } }), 0., 1e-12);
  EXPECT_NEAR(pocket(6, 5, { { 1, 1 }, { 2, 1 }, { 3, 1 }, { 1, 2 }, { 3, 2 }, { 1, 3 }, { 2, 3 }, { 3, 3 } }), 8. / 30,
              1e-12);
  // Interrupted, it is closed.
  EXPECT_NEAR(pocket(5, 4, { { 0, 1 }, { 1, 1 }, { 3, 1 }, { 4, 1 } }), 0.2, 1e-12);
}

TEST(ClosedVoids, AgreeWithFloodingOfARandomMap)
{
  // Reference: flood from the border at each height, everything below that it does not reach is closed.
  auto map          = gaussian(64, { 3e-3, 3e-3 }, 8);
  map.periodic      = false;
  const auto states = closed_voids(map, 16);
  double     mean   = 0;
  for (const double z : map.z)
    mean += z / 4096;
  unsigned with_closed = 0;
  for (const auto &s : states)
    {
      const double             c = s.height + mean + 1e-12;
      std::vector<int>         open(4096, 0);
      std::vector<std::size_t> stack;
      const auto               visit = [&](std::size_t i) {
        if (!open[i] && map.z[i] <= c)
          {
            open[i] = 1;
            stack.push_back(i);
          }
      };
      for (std::size_t i = 0; i < 64; ++i)
        for (const std::size_t at : { i, 63 * 64 + i, 64 * i, 64 * i + 63 })
          visit(at);
      while (!stack.empty())
        {
          const std::size_t i = stack.back(), x = i % 64, y = i / 64;
          stack.pop_back();
          if (x > 0)
            visit(i - 1);
          if (x < 63)
            visit(i + 1);
          if (y > 0)
            visit(i - 64);
          if (y < 63)
            visit(i + 64);
        }
      double area = 0, volume = 0;
      for (std::size_t i = 0; i < 4096; ++i)
        if (!open[i] && map.z[i] <= c)
          {
            area += 1. / 4096;
            volume += (c - map.z[i]) / 4096;
          }
      EXPECT_NEAR(s.closed_area, area, 1e-12);
      EXPECT_NEAR(s.closed_volume, volume, 1e-12);
      with_closed += area > 0.05;
    }
  EXPECT_GE(with_closed, 3u);
}

TEST(Profiles, SineHasItsRaAndPeakCount)
{
  // z = A sin(2 pi y / w) with A = 2 um, w = 0.1 mm on 5 x 12.5 mm, periodic. Cut-off 2.5 mm passes 1 - 2^-(25)^2 = 1,
  // the short-wave filter of 8 um passes 2^-(0.08)^2 = 0.99557. Ra = 2 A / pi of that (midpoint sum over 25 points a
  // wave: within 3e-3); 1 peak a wave: 100 per cm.
  const auto map = map_of(8, 3125, 0.1, 4e-3, true, [](double, double y) { return 2e-3 * std::sin(2 * pi * y / 0.1); });
  const auto p   = profile_parameters(map, {});
  ASSERT_TRUE(p.ra && p.rpc);
  EXPECT_NEAR(*p.ra, 2e-3 * 2 / pi * std::pow(2., -0.0064), 3e-3 * 2e-3);
  EXPECT_NEAR(*p.rpc * 10, 100., 1e-9);
  EXPECT_EQ(p.noise_cut_off, 8e-3);
  // Section levels above the amplitude: no peak.
  ProfileSettings high;
  high.peak_height = 2.1e-3;
  EXPECT_EQ(*profile_parameters(map, high).rpc, 0.);
  // The map is long enough for roughness but not for waviness, and along x for neither.
  EXPECT_FALSE(p.wsa);
  EXPECT_NE(p.no_waviness->find("25"), std::string::npos);
  ProfileSettings along_x;
  along_x.along_x = true;
  EXPECT_FALSE(profile_parameters(map, along_x).ra);
  EXPECT_FALSE(profile_parameters(map, along_x).rpc);
  EXPECT_NE(profile_parameters(map, along_x).no_roughness->find("12.5 mm, the map has 0.8 mm along x"),
            std::string::npos);
  // An open map needs the run-in of half a cut-off at either end.
  auto open     = map;
  open.periodic = false;
  EXPECT_NE(profile_parameters(open, {}).no_roughness->find("15 mm"), std::string::npos);
  ProfileSettings shorter;
  shorter.cut_off = 0.8;
  const auto q    = profile_parameters(open, shorter);
  ASSERT_TRUE(q.ra);
  EXPECT_NEAR(*q.ra, 2e-3 * 2 / pi, 3e-3 * 2e-3);
  EXPECT_NEAR(*q.rpc * 10, 100., 1.); // at most one peak of 117 is cut off
}

TEST(Profiles, WavinessIsTheBandBetweenOneAndFiveMillimetres)
{
  // z = A sin(2 pi x / w) on 40 mm: w = 2 mm passes the first filter with 2^-(1/2)^2 and the second, which
  // works on what the first left, with 1 - 2^-(5/2)^2; w = 0.1 mm hardly, 2^-100. Midpoint sum over 100 points a wave:
  // (pi/100)^2/6 = 1.6e-4.
  ProfileSettings settings;
  settings.along_x = true;
  const auto wsa   = [&](double w) {
    return *profile_parameters(
                  map_of(2000, 3, 0.02, 1., true, [&](double x, double) { return 1e-3 * std::sin(2 * pi * x / w); }),
                  settings)
                .wsa;
  };
  const double passed = std::pow(2., -0.25) * (1 - std::pow(2., -6.25));
  EXPECT_NEAR(wsa(2.) / (1e-3 * 2 / pi), passed, 2e-4);
  EXPECT_LT(wsa(0.1), 1e-9);
}

TEST(Evaluation, HasAllRowsWithUnits)
{
  // 200 x 200 pixels of 3 um with two levels are enough for everything except the profiles.
  auto               map = map_of(200, 200, 3e-3, 3e-3, true,
                                  [](double x, double y) { return 2e-3 * std::sin(2 * pi * x / 0.1) * std::sin(2 * pi * y / 0.1); });
  EvaluationSettings settings;
  auto               e = evaluate_surface(map, settings);
  for (const char *name : { "pixels_x",
                            "pixels_y",
                            "pixel_size_x",
                            "pixel_size_y",
                            "Sa",
                            "Sq",
                            "Ssk",
                            "Sku",
                            "Sp",
                            "Sv",
                            "Sz",
                            "autocorrelation_length_x",
                            "autocorrelation_length_y",
                            "Sal",
                            "Str",
                            "Std",
                            "Sdq",
                            "Sdr",
                            "Sk",
                            "Spk",
                            "Svk",
                            "Smr",
                            "Smr1",
                            "Smr2",
                            "Vmp",
                            "Vmc",
                            "Vvc",
                            "Vvv",
                            "m0",
                            "m2",
                            "m4",
                            "peklenik_gamma",
                            "Vcl" })
    EXPECT_TRUE(std::isfinite(e.value(name))) << name;
  EXPECT_NEAR(e.value("Sq"), 1., 1e-10); // 2 um / 2
  EXPECT_NEAR(e.value("m0"), 1., 1e-9);
  EXPECT_NEAR(e.value("Smr"), 50., 0.1);
  EXPECT_TRUE(std::isnan(e.value("Ra"))); // 2.5 mm do not fit into 0.6 mm
  EXPECT_TRUE(std::isnan(e.value("Wsa")));
  EXPECT_EQ(e.notes.size(), 2u);
  for (const auto &row : e.rows)
    EXPECT_TRUE(units::parse_unit(row.unit)) << row.parameter << " in " << row.unit;

  settings.profiles.cut_off = 0.12;
  e                         = evaluate_surface(map, settings);
  EXPECT_TRUE(std::isfinite(e.value("Ra")));
  EXPECT_EQ(e.value("profile_cut_off"), 0.12);
  map.z.assign(map.size(), 1.);
  EXPECT_THROW(evaluate_surface(map, settings), InputError);
  EXPECT_THROW(evaluate_surface(HeightMap(), settings), InputError);
}

TEST(Evaluation, SmallestMapsAreEvaluatedAsFarAsTheyGo)
{
  // Two rows or columns have no lag across them: no Str, no slopes, but heights and material ratio.
  for (const bool periodic : { false, true })
    for (const auto &[nx, ny] : { std::pair<std::size_t, std::size_t>(2, 2), { 9, 2 }, { 2, 9 }, { 3, 3 }, { 6, 40 } })
      {
        NormalDeviates deviates(nx);
        const auto     e
            = evaluate_surface(map_of(nx, ny, 1e-3, 1e-3, periodic, [&](double, double) { return deviates(); }), {});
        EXPECT_GT(e.value("Sq"), 0.) << nx << ' ' << ny;
        EXPECT_TRUE(std::isnan(e.value("Sdq")));
        EXPECT_TRUE(ny > 2 || std::isnan(e.value("autocorrelation_length_y")));
        for (const auto &row : e.rows)
          EXPECT_TRUE(std::isfinite(row.value)) << row.parameter << ' ' << nx << ' ' << ny;
      }
}

TEST(Evaluation, SettingsAreReadAndNonsenseIsRefused)
{
  auto parameters = Parameters::from_text("subsection Evaluation\nset Smr height = 1 um\nset Profile direction = x\n"
                                          "set Profile cut-off = 0.8 mm\nend\n");
  const auto s    = read_evaluation(parameters);
  parameters.finish();
  EXPECT_EQ(s.smr_height, 1e-3);
  EXPECT_TRUE(s.profiles.along_x);
  EXPECT_EQ(s.profiles.cut_off, 0.8);
  EXPECT_EQ(s.profiles.peak_height, 0.5e-3);
  for (const std::string entry :
       { "Void contact fraction = 1", "Profile cut-off = 0 mm", "Profile direction = z", "Peak count height = -1 um" })
    {
      auto p = Parameters::from_text("subsection Evaluation\nset " + entry + "\nend\n");
      read_evaluation(p);
      EXPECT_THROW(p.finish(), InputError) << entry;
    }
}
