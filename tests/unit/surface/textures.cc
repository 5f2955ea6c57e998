// Textures beyond the plain Gaussian and bimodal ones: lay angle, prescribed moments, craters.
#include "surface_from_text.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/surface/autocorrelation.h>
#include <tribodraw/surface/johnson_curve.h>
#include <tribodraw/surface/roughness.h>
#include <tribodraw/surface/spectral_field.h>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace tribodraw;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  std::string
  generated(unsigned pixels, long seed, const std::string &texture, const std::string &section,
            const std::string &entries)
  {
    return "set Model = generated\nsubsection Generated\nset Pixels = " + std::to_string(pixels)
           + "\nset Pixel size = 3 um\nset Sq = 1.56 um\nset Seed = " + std::to_string(seed)
           + "\nset Texture = " + texture + "\nsubsection " + section + "\n" + entries + "end\nend\n";
  }

  std::string
  non_gaussian(unsigned pixels, long seed, const std::string &ssk, const std::string &sku,
               const std::string &lengths = "24 um, 12 um", const std::string &angle = "0 deg")
  {
    return generated(pixels, seed, "non-gaussian", "Non-gaussian",
                     "set Correlation length = " + lengths + "\nset Lay angle = " + angle + "\nset Skewness = " + ssk
                         + "\nset Kurtosis = " + sku + "\n");
  }

  std::string
  craters(unsigned pixels, long seed, const std::string &plateau, const std::string &fine_ratio = "0.05")
  {
    return generated(pixels, seed, "craters", "Craters",
                     "set Crater diameter = 90 um\nset Plateau area fraction = " + plateau
                         + "\nset Profile exponent = 4\nset Fine roughness ratio = " + fine_ratio
                         + "\nset Fine correlation length = 9 um\n");
  }
} // namespace

TEST(SpectralField, EqualsTheFilteredFieldAlongTheAxes)
{
  // The same noise and, up to the kernel's cut at 1e-9 and the aliasing of a Gaussian of 4 pixels, the same filter.
  const Grid     grid{ 66, 48, 3e-3, 2e-3 };
  NormalDeviates first(3), second(3);
  const auto     a = gaussian_field(grid, { 12e-3, 9e-3 }, first);
  const auto     b = spectral_field(grid, { { 12e-3, 9e-3 }, 0. }, second);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], 1e-7);
  // Turning by 90 degrees exchanges the lengths.
  NormalDeviates third(3);
  const auto     c = spectral_field(grid, { { 9e-3, 12e-3 }, pi / 2 }, third);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(c[i], b[i], 1e-12);
}

TEST(SpectralField, LayAngleIsThatOfTheTexture)
{
  // l = 48 um along, 12 um across at 30 degrees on 512 pixels of 3 um: A/(pi la lb) = 1304 independent areas, the
  // standard deviation of C at a correlation length is 0.0130 (Bartlett, see the tests of generated surfaces), so that
  // of the length at the level 0.2 at most 0.077 l; four of them.
  const auto map = make(
      generated(512, 11, "gaussian", "Gaussian", "set Correlation length = 48 um, 12 um\nset Lay angle = 30 deg\n"));
  const Autocorrelation acf(map);
  const double          a = pi / 6, factor = std::sqrt(2 * std::log(5.));
  ASSERT_TRUE(acf.decay_length(a, 0.2) && acf.decay_length(a + pi / 2, 0.2));
  EXPECT_NEAR(*acf.decay_length(a, 0.2), 48e-3 * factor, 4 * 0.077 * 48e-3);
  EXPECT_NEAR(*acf.decay_length(a + pi / 2, 0.2), 12e-3 * factor, 4 * 0.077 * 12e-3);
  EXPECT_NEAR(spatial_parameters(map).std_angle, 30., 2.);
  EXPECT_TRUE(map.periodic);
}

TEST(JohnsonCurve, QuantileInvertsTheNormalDistribution)
{
  // Abramowitz and Stegun, table 26.5: 97.5 % at 1.959964, 99.9 % at 3.090232.
  EXPECT_NEAR(normal_quantile(0.975), 1.959963985, 1e-9);
  EXPECT_NEAR(normal_quantile(0.001), -3.090232306, 1e-9);
  EXPECT_NEAR(normal_quantile(0.5), 0., 1e-15);
}

TEST(JohnsonCurve, ReachesTheMomentsInAllItsFamilies)
{
  // Normal, log-normal line (sigma = 0.3: skewness (w + 2) sqrt(w - 1), kurtosis w^4 + 2 w^3 + 3 w^2 - 3, w =
  // exp(0.09)), above, below, two-valued and mirrored; moments of all 1e5 quantiles summed here.
  const double w = std::exp(0.09);
  const double cases[][2]
      = { { 0, 3 },     { (w + 2) * std::sqrt(w - 1), w * w * w * w + 2 * w * w * w + 3 * w * w - 3 },
          { 0, 6 },     { 0, 1.8 },
          { -1, 4 },    { -1.5, 6 },
          { 0.7, 1.9 }, { 2, 12 },
          { 0.1, 3 } };
  for (const auto &[ssk, sku] : cases)
    {
      constexpr int      n = 100000;
      const JohnsonCurve curve(ssk, sku, n);
      double             m[5] = {}, last = -1e300;
      for (int i = 0; i < n; ++i)
        {
          const double z = curve(normal_quantile((i + 0.5) / n));
          EXPECT_GE(z, last);
          last = z;
          for (int k = 1; k <= 4; ++k)
            m[k] += std::pow(z, k) / n;
        }
      EXPECT_NEAR(m[1], 0., 1e-4) << ssk << ' ' << sku;
      EXPECT_NEAR(m[2], 1., 1e-4) << ssk << ' ' << sku;
      EXPECT_NEAR(m[3], ssk, 1e-3) << ssk << ' ' << sku;
      EXPECT_NEAR(m[4], sku, 1e-3 * sku) << ssk << ' ' << sku;
    }
}

TEST(JohnsonCurve, CorrelationOfTheLogNormalIsExact)
{
  // Two log-normal variables with normal correlation rho: (exp(rho s^2) - 1) / (exp(s^2) - 1).
  const double w = std::exp(0.25), ssk = (w + 2) * std::sqrt(w - 1),
               sku = w * w * w * w + 2 * w * w * w + 3 * w * w - 3;
  const JohnsonCurve curve(ssk, sku, 10000000);
  for (const double rho : { 0.1, 0.5, 0.9 })
    {
      EXPECT_NEAR(curve.correlation(rho), (std::exp(0.25 * rho) - 1) / (w - 1), 1e-3);
      EXPECT_NEAR(curve.normal_correlation(curve.correlation(rho)), rho, 1e-6);
    }
  EXPECT_EQ(curve.normal_correlation(0.), 0.);
  EXPECT_EQ(curve.normal_correlation(1.), 1.);
  EXPECT_THROW(JohnsonCurve(1., 1.9, 10000), InputError);
}

TEST(NonGaussian, SkewnessKurtosisAndLengthsAreReached)
{
  // Moments: the heights are the quantiles themselves, so only their rounding to 512^2 values counts. Lengths: l = 24
  // and 12 um on 512 pixels of 3 um, A/(pi lx ly) = 2608 independent areas; a length at the level 0.2 then has a
  // standard deviation of at most sqrt(1/2608) / (0.2 * 1.794) l = 0.055 l for Gaussian heights, and up to sqrt((Sku -
  // 1)/2) times that for others (variance of z^2). Three of them.
  const double factor = std::sqrt(2 * std::log(5.));
  for (const auto &[ssk, sku] : { std::pair(-1., 4.), { 0., 1.8 }, { 0.8, 6. } })
    {
      const auto map = make(non_gaussian(512, 21, std::to_string(ssk), std::to_string(sku)));
      const auto r   = roughness(map);
      EXPECT_NEAR(r.sq, 1.56e-3, 1e-12);
      EXPECT_NEAR(r.ssk, ssk, 1e-3);
      EXPECT_NEAR(r.sku, sku, 1e-3 * sku);
      const Autocorrelation acf(map);
      const double          bound = 3 * 0.055 * std::max(1., std::sqrt((sku - 1) / 2));
      ASSERT_TRUE(acf.decay_length(0., 0.2) && acf.decay_length(pi / 2, 0.2));
      EXPECT_NEAR(*acf.decay_length(0., 0.2) / 24e-3, factor, bound) << ssk;
      EXPECT_NEAR(*acf.decay_length(pi / 2, 0.2) / 12e-3, factor, bound) << ssk;
    }
}

TEST(NonGaussian, LengthsHaveNoBiasFromTheTransformation)
{
  // Mean over eight maps: without the correction of the correlation the strongly skewed heights (Ssk 2, Sku 9) would
  // have C(l) = 0.607 changed to about 0.55. Standard deviation of one map below sqrt((1 + 3/e - 4 e^-0.75)/815) *
  // sqrt((9 - 1)/2) = 0.033, of eight 0.0117.
  double sum = 0;
  for (long seed = 1; seed <= 8; ++seed)
    {
      const auto            map = make(non_gaussian(256, seed, "2", "9", "18 um, 12 um", "40 deg"));
      const Autocorrelation acf(map);
      // 18 um along the lay at 40 degrees: 6 pixels; bilinear between the points around
      const auto length = acf.decay_length(40 * pi / 180, std::exp(-0.5));
      ASSERT_TRUE(length);
      sum += *length / 18e-3 / 8;
    }
  // dC/dr at r = l is -0.607 / l: 0.0117 / 0.607 = 0.0193 of l; four of them.
  EXPECT_NEAR(sum, 1., 4 * 0.0193);
}

TEST(NonGaussian, ImpossibleMomentsAreRefused)
{
  EXPECT_NE(problems_of(non_gaussian(128, 1, "1", "1.9")).find("Ssk^2 + 1 = 2"), std::string::npos);
  EXPECT_NE(problems_of(non_gaussian(128, 1, "0", "1.001")).find("that many pixels"), std::string::npos);
  EXPECT_NE(problems_of(non_gaussian(128, 1, "0", "0.5")).find("Kurtosis"), std::string::npos);
  EXPECT_NE(problems_of(non_gaussian(128, 1, "0", "3", "200 um")).find("quarter of the map"), std::string::npos);
  EXPECT_NE(problems_of(non_gaussian(128, 1, "0", "3", "24 um", "400 deg")).find("Lay angle"), std::string::npos);
}

TEST(Craters, CoverTheStatedArea)
{
  // Without fine roughness plateaus are exactly flat. The share is reached to half the largest crater's, pi 45^2 um^2 /
  // (2 * 1998^2 um^2) = 0.0008.
  for (const double plateau : { 0.3, 0.6, 0.9 })
    {
      const auto   map = make(craters(666, 5, std::to_string(plateau), "0"));
      const double top = *std::max_element(map.z.begin(), map.z.end());
      const auto   n   = std::count(map.z.begin(), map.z.end(), top);
      EXPECT_NEAR(static_cast<double>(n) / static_cast<double>(map.size()), plateau, 0.0008);
      EXPECT_NEAR(roughness(map).sq, 1.56e-3, 1e-12);
    }
}

TEST(Craters, ShapeOfASingleCraterIsItsProfile)
{
  // 98 % plateau on 128 x 128 pixels of 3 um leave room for 0.46 craters of 90 um: one brings the share nearer than
  // none, a second does not. Depths follow 1 - (r/R)^4 about some centre: the area deeper than d is pi R^2 sqrt(1 - d).
  const auto map         = make(craters(128, 2, "0.96", "0"));
  const double high      = *std::max_element(map.z.begin(), map.z.end());
  const double depth     = high - *std::min_element(map.z.begin(), map.z.end());
  for (const double d : { 0.2, 0.5, 0.8 })
    {
      const auto n = std::count_if(map.z.begin(), map.z.end(), [&](double z) { return high - z > d * depth; });
      // a circle of 30 pixels across is counted to about its edge length over ten
      EXPECT_NEAR(static_cast<double>(n), pi * 15 * 15 * std::sqrt(1 - d), 12.) << d;
    }
}

TEST(Craters, DistributionIsBimodalWithATailOfValleys)
{
  const auto r = roughness(make(craters(666, 1, "0.6")));
  EXPECT_LT(r.ssk, -0.3); // plateaus above, floors below
  EXPECT_LT(r.sku, 2.2);  // two levels: below the 3 of a Gaussian surface
  const auto h     = height_histogram(make(craters(666, 1, "0.6")), 40);
  const auto upper = std::max_element(h.density.begin() + 20, h.density.end());
  const auto lower = std::max_element(h.density.begin(), h.density.begin() + 20);
  EXPECT_LT(*std::min_element(lower, upper), 0.5 * *lower);
}

TEST(Craters, NonsenseIsRefused)
{
  EXPECT_NE(problems_of(craters(64, 1, "0.6")).find("quarter of the map"), std::string::npos);
  EXPECT_NE(problems_of(craters(666, 1, "0.999")).find("Plateau area fraction"), std::string::npos);
  auto text = craters(666, 1, "0.6");
  text.replace(text.find("90 um"), 5, "11 um");
  EXPECT_NE(problems_of(text).find("below four pixels"), std::string::npos);
}

TEST(Textures, HostileSizesAreRefusedBeforeMemoryIsTaken)
{
  EXPECT_NE(problems_of(craters(1000000, 1, "0.6")).find("Pixels"), std::string::npos);
  EXPECT_NE(problems_of(craters(0, 1, "0.6")).find("Pixels"), std::string::npos);
}

TEST(Textures, EveryRankMakesTheSameMap)
{
  for (const std::string &text :
       { non_gaussian(128, 3, "-0.8", "3.5", "24 um, 12 um", "20 deg"), craters(128, 3, "0.5") })
    {
      const std::string mine  = make(text).hash();
      std::string       first = mine;
      parallel::broadcast(first, 0);
      EXPECT_EQ(mine, first);
    }
}

TEST(Textures, HeightsAreTheSameOnEveryMachine)
{
  // Computed apart from the program in Python from the documented random numbers: the lay by a double sum over all
  // waves (which treats the shortest wave of a map with an even number of pixels in another way, 1e-6 of the largest),
  // the craters by testing all pixels around each centre.
  const auto lay = make(
      generated(16, 42, "gaussian", "Gaussian", "set Correlation length = 9 um, 6 um\nset Lay angle = 30 deg\n"));
  EXPECT_NEAR(lay(0, 0), 1.5764625984156038e-3, 1e-8);
  EXPECT_NEAR(lay(15, 0), 0.7751258613093052e-3, 1e-8);
  EXPECT_NEAR(lay(5, 5), -0.16654953496661898e-3, 1e-8);
  EXPECT_NEAR(lay(15, 15), 1.4994899948093583e-3, 1e-8);

  auto text = craters(32, 7, "0.5", "0");
  text.replace(text.find("90 um"), 5, "24 um");
  text.replace(text.find("1.56 um"), 7, "1.60 um");
  const auto map = make(text);
  EXPECT_NEAR(map(0, 0), -2.485198485236215e-3, 1e-14);
  EXPECT_NEAR(map(31, 0), -2.4922498699974525e-3, 1e-14);
  EXPECT_NEAR(map(5, 17), 1.380795726334714e-3, 1e-14);
  EXPECT_NEAR(map(31, 31), -2.4973291958938013e-3, 1e-14);
}
