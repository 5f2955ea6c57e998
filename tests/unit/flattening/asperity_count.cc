#include <tribodraw/flattening/asperity_count.h>

#include <tribodraw/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace tribodraw;

namespace
{
  HeightMap
  map_of(const std::size_t nx, const std::size_t ny, const std::function<double(double, double)> &height)
  {
    HeightMap map;
    map.nx = nx;
    map.ny = ny;
    map.dx = map.dy = 1e-3;
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix)
        map.z.push_back(height(static_cast<double>(ix), static_cast<double>(iy)));
    return map;
  }

  double
  bump(const double x, const double y, const double cx, const double cy, const double height, const double radius)
  {
    return height * std::exp(-(std::pow(x - cx, 2) + std::pow(y - cy, 2)) / (radius * radius));
  }
} // namespace

// Five separate bumps of different heights in 100 x 80 um: all five stand apart at some height.
TEST(AsperityCount, SeparateBumps)
{
  const HeightMap     map   = map_of(100, 80, [](double x, double y) {
    return bump(x, y, 20, 20, 1., 6) + bump(x, y, 60, 20, .8, 6) + bump(x, y, 20, 60, .6, 6) + bump(x, y, 60, 60, .9, 6)
           + bump(x, y, 85, 40, .7, 6);
  });
  const AsperityCount count = count_asperities(map);
  const double        area  = 0.1 * 0.08; // mm^2
  EXPECT_NEAR(count.density, 5. / area, 1e-9 / area);
  EXPECT_NEAR(count.half_spacing, 0.5 * std::sqrt(area / 5.), 1e-15);
  EXPECT_LT(count.cut_height, 0.6 - 0.05 + 1e-12); // the lowest bump counts from 5 % of the range below its summit
  EXPECT_GT(count.cut_height, 0.);
  EXPECT_GT(count.contact_fraction, 0.);
  EXPECT_LT(count.contact_fraction, 0.5);
}

// Ripples on a plateau are no asperities unless their depth exceeds the pruning.
TEST(AsperityCount, RipplesArePruned)
{
  const HeightMap map = map_of(
      100, 100, [](double x, double y) { return bump(x, y, 50, 50, 1., 30) + 0.01 * std::cos(x) * std::cos(y); });
  EXPECT_NEAR(count_asperities(map, 0.05).density, 1. / 0.01, 1e-9); // one asperity in 0.01 mm^2
  EXPECT_GT(count_asperities(map, 0.).density, 10. / 0.01);
}

// Translating a periodic map does not change the count; without continuation, pieces at the borders count each.
TEST(AsperityCount, PeriodicMapsHaveNoBorders)
{
  const auto height = [](double x, double y) {
    double sum = 0;
    for (const double sx : { -64., 0., 64. })
      for (const double sy : { -64., 0., 64. })
        sum += bump(x, y, 0. + sx, 0. + sy, 1., 6) + bump(x, y, 30. + sx, 35. + sy, .8, 6);
    return sum;
  };
  HeightMap    map  = map_of(64, 64, height);
  const double area = 0.064 * 0.064;
  map.periodic      = true;
  EXPECT_NEAR(count_asperities(map).density * area, 2., 1e-9);
  map.periodic = false;
  EXPECT_NEAR(count_asperities(map).density * area, 5., 1e-9); // four quarters and one
}

TEST(AsperityCount, FlatMapIsOneAsperity)
{
  EXPECT_NEAR(count_asperities(map_of(10, 10, [](double, double) { return 0.; })).density, 1. / 1e-4, 1e-6);
  EXPECT_THROW(count_asperities(HeightMap()), InputError);
}
