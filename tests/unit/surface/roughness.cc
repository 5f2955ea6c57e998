// Roughness parameters, histogram and Abbott curve on surfaces whose values are known exactly.
#include <tribodraw/base/errors.h>
#include <tribodraw/surface/roughness.h>

#include "claims.h"
#include <cmath>

#include <gtest/gtest.h>

using namespace tribodraw;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  /// z = amplitude * sin(2 pi n x / L) + mean, sampled at pixel centres of a periodic map.
  HeightMap
  sine(std::size_t nx, std::size_t ny, unsigned n_waves, double amplitude, double mean = 0)
  {
    HeightMap map;
    map.nx       = nx;
    map.ny       = ny;
    map.dx       = 2e-3;
    map.dy       = 3e-3;
    map.periodic = true;
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix)
        map.z.push_back(mean + amplitude * std::sin(2 * pi * n_waves * (ix + 0.5) / nx));
    return map;
  }
} // namespace

TEST(Roughness, SineHasTheAnalyticMoments)
{
  // Integrals over a period: Sq = A/sqrt(2), Sku = <sin^4>/<sin^2>^2 = (3/8)/(1/4) = 1.5, Ssk = 0: trigonometric sums
  // over equidistant points are exact. Sa = 2A/pi is not a trigonometric polynomial; the midpoint sum over N = 200
  // points per wave is A * (2/N) / sin(pi/N) exactly.
  const double amplitude = 2e-3;
  const auto   r         = roughness(sine(400, 10, 2, amplitude, 0.7));
  EXPECT_TRUE(
      claims::agrees("Sq of a sine over its amplitude", "1/sqrt(2)", r.sq / amplitude, 1 / std::sqrt(2.), 1e-12));
  EXPECT_NEAR(r.ssk, 0., 1e-10);
  EXPECT_TRUE(claims::agrees("Sku of a sine", "closed form", r.sku, 1.5, 1e-10));
  EXPECT_NEAR(r.sa, amplitude * (2. / 200) / std::sin(pi / 200), 1e-12 * amplitude);
  EXPECT_NEAR(r.sp, amplitude * std::cos(pi / 200), 1e-12 * amplitude); // highest sample: half a pixel beside the peak
  EXPECT_NEAR(r.sv, r.sp, 1e-12 * amplitude);
  EXPECT_DOUBLE_EQ(r.sz, r.sp + r.sv);
}

TEST(Roughness, SaOfTheSineConvergesWithSecondOrder)
{
  // Sa -> 2A/pi; leading error of the sum is (pi/N)^2/6.
  double error[2];
  for (const int i : { 0, 1 })
    error[i] = std::abs(roughness(sine(i ? 64 : 32, 4, 1, 1e-3)).sa / (2e-3 / pi) - 1.);
  EXPECT_TRUE(claims::agrees("order of Sa with the pixel", "closed form of the sine", std::log2(error[0] / error[1]),
                             2., 0.05));
}

TEST(Roughness, TwoLevelsGiveTheMomentsOfABernoulliVariable)
{
  // A quarter of the points at 3, the others at -1 (mean 0): Sq = sqrt(3), Ssk = (27/4 - 3/4)/3^1.5 = 2/sqrt(3),
  // Sku = (81/4 + 3/4)/9 = 7/3, Sa = 3/2.
  HeightMap map;
  map.nx = map.ny = 4;
  map.dx = map.dy = 1e-3;
  map.z           = { 3, -1, -1, -1, -1, 3, -1, -1, -1, -1, 3, -1, -1, -1, -1, 3 };
  const auto r    = roughness(map);
  EXPECT_NEAR(r.sq, std::sqrt(3.), 1e-14);
  EXPECT_NEAR(r.ssk, 2. / std::sqrt(3.), 1e-14);
  EXPECT_NEAR(r.sku, 7. / 3., 1e-14);
  EXPECT_NEAR(r.sa, 1.5, 1e-14);
  EXPECT_EQ(r.sp, 3.);
  EXPECT_EQ(r.sv, 1.);
}

TEST(Roughness, HistogramOfARampIsUniformAndHasUnitArea)
{
  HeightMap map;
  map.nx = 100;
  map.ny = 2;
  map.dx = map.dy = 1e-3;
  for (int i = 0; i < 200; ++i)
    map.z.push_back(1e-3 * (i % 100 + 0.25) / 100.); // 100 levels over 0.99 um
  const auto h = height_histogram(map, 10);
  ASSERT_EQ(h.edges.size(), 11u);
  double area = 0;
  for (int i = 0; i < 10; ++i)
    {
      // 10 of 100 levels in each bin, width 0.099 um
      EXPECT_NEAR(h.density[i], 0.1 / 0.099, 1e-9);
      area += h.density[i] * (h.edges[i + 1] - h.edges[i]);
    }
  EXPECT_NEAR(area, 1., 1e-12);
  EXPECT_NEAR(h.edges.front(), -0.495, 1e-12); // um, about the mean
  EXPECT_NEAR(h.edges.back(), 0.495, 1e-12);
}

TEST(Roughness, AbbottCurveOfASineIsItsArcCosine)
{
  // Fraction of the area above z = A cos(pi m) is m.
  const auto map   = sine(1000, 4, 1, 2e-3);
  const auto curve = abbott_curve(map, 21);
  for (unsigned i = 0; i < 21; ++i)
    EXPECT_NEAR(curve.height[i], 2. * std::cos(pi * curve.material_ratio[i]), 2. * pi / 1000) << i;
  EXPECT_EQ(curve.material_ratio.back(), 1.);
}

TEST(Roughness, EmptyAndFlatMapsAreRejected)
{
  HeightMap map;
  EXPECT_THROW(roughness(map), InputError);
  EXPECT_THROW(height_histogram(map), InputError);
  map.nx = map.ny = 2;
  map.dx = map.dy = 1e-3;
  map.z.assign(4, 0.5);
  EXPECT_THROW(roughness(map), InputError);
  EXPECT_THROW(height_histogram(map), InputError);
}
