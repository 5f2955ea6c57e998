#include "gaussian_map.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/flattening/height_distribution.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace tribodraw;
using test::gaussian_map;
using test::normal_density;
using test::normal_distribution;

namespace
{
  /// Plateaus with craters: far from Gaussian, and not of zero mean.
  HeightMap
  random_map(const std::size_t pixels)
  {
    std::mt19937_64                  engine(7);
    std::normal_distribution<double> normal;
    HeightMap                        map;
    map.nx = map.ny = pixels;
    map.dx = map.dy = 3e-3;
    for (std::size_t i = 0; i < pixels * pixels; ++i)
      map.z.push_back(1e-3 * (std::tanh(2. * normal(engine)) + 0.1 * normal(engine) + 5.));
    return map;
  }
} // namespace

// model.md 1.1: for zero mean heights the mean gap equals d = s + u exactly (identity (a)).
TEST(HeightDistribution, MeanGapEqualsCutHeightPlusRise)
{
  const HeightDistribution heights(random_map(300));
  for (double s = heights.lowest(); s <= heights.highest(); s += 1e-5)
    EXPECT_NEAR(heights.mean_gap(s), s + heights.uniform_rise(s), 1e-15 /* mm, heights of 1e-3 mm */);
}

// model.md 1.1(e): the flattened surface is d above s, z + u below. Volume conservation: its mean stays zero.
TEST(HeightDistribution, FlatteningConservesVolume)
{
  const HeightMap          map = random_map(200);
  const HeightDistribution heights(map);
  long double              mean = 0;
  for (const double z : map.z)
    mean += z;
  mean /= map.z.size();
  for (const double s : { heights.lowest(), -1e-3, -3e-4, 0., 4e-4, 9e-4, heights.highest() })
    {
      const double u = heights.uniform_rise(s), d = heights.mean_gap(s);
      long double  sum = 0;
      for (const double z : map.z)
        {
          const double height = z - static_cast<double>(mean);
          sum += height >= s ? d : height + u;
        }
      EXPECT_NEAR(static_cast<double>(sum / map.z.size()) / heights.sq(), 0., 1e-12) << "s = " << s;
    }
}

// Gaussian closed forms and values of model.md 1.1; the quantile map has an error of about 1/n = 1e-6.
TEST(HeightDistribution, GaussianClosedForms)
{
  const HeightDistribution heights(gaussian_map(1000, 1.));
  const double             expected[][3] = { { 3., 3.00038, 0.00135 },
                                             { 2., 2.00849, 0.02275 },
                                             { 1., 1.08332, 0.15866 },
                                             { 0.5, 0.69780, 0.30854 },
                                             { 0., 0.39894, 0.5 } };
  for (const auto &[s, h_avg, alpha] : expected)
    {
      EXPECT_NEAR(heights.mean_gap(s), h_avg, 6e-6);
      EXPECT_NEAR(heights.contact_fraction(s), alpha, 6e-6);
      EXPECT_NEAR(heights.mean_gap(s), s * normal_distribution(s) + normal_density(s), 2e-6);
      EXPECT_NEAR(heights.uniform_rise(s), normal_density(s) - s * normal_distribution(-s), 2e-6);
      EXPECT_NEAR(heights.contact_fraction(s), normal_distribution(-s), 2e-6);
    }
  EXPECT_NEAR(heights.sq(), 1., 1e-5);
}

TEST(HeightDistribution, InversesReturnTheArgument)
{
  const HeightDistribution heights(random_map(100));
  for (const double h : { 1e-9, 1e-5, 3e-4, 1e-3, 1.5e-3, 5e-3 })
    EXPECT_NEAR(heights.mean_gap(heights.cut_height_for_mean_gap(h)), h, 1e-15);
  EXPECT_EQ(heights.cut_height_for_mean_gap(0.), heights.lowest());
  for (const double alpha : { 1e-4, 0.1, 0.37, 0.9, 1. }) // whole numbers of the 10000 pixels
    EXPECT_NEAR(heights.contact_fraction(heights.cut_height_for_contact_fraction(alpha)), alpha, 1e-15);
  EXPECT_EQ(heights.cut_height_for_contact_fraction(0.), heights.highest());
  EXPECT_EQ(heights.cut_height_for_contact_fraction(1.), heights.lowest());
}

TEST(HeightDistribution, OneHeightIsAPlateau)
{
  HeightMap map;
  map.nx = 3;
  map.ny = 2;
  map.z  = std::vector<double>(6, 2.5);
  const HeightDistribution heights(map);
  EXPECT_EQ(heights.contact_fraction(0.), 1.);
  EXPECT_EQ(heights.contact_fraction(1e-9), 0.);
  EXPECT_EQ(heights.mean_gap(1.), 1.); // everything 1 mm below
}

TEST(HeightDistribution, RefusesMapsWithoutHeights)
{
  EXPECT_THROW(HeightDistribution{ HeightMap{} }, InputError);
  HeightMap map;
  map.nx = map.ny = 2;
  map.z           = { 0., 1., std::nan(""), 2. };
  EXPECT_THROW(HeightDistribution{ map }, InputError);
}
