#include <tribodraw/flattening/deformed_surface.h>

#include <tribodraw/base/errors.h>
#include <tribodraw/flattening/height_distribution.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace tribodraw;

namespace
{
  HeightMap
  random_map(const unsigned int seed, const double sq)
  {
    std::mt19937_64                  engine(seed);
    std::normal_distribution<double> normal;
    HeightMap                        map;
    map.nx = 180;
    map.ny = 150;
    map.dx = map.dy = 3e-3;
    long double sum = 0;
    for (std::size_t i = 0; i < map.size(); ++i)
      {
        map.z.push_back(sq * (std::tanh(1.5 * normal(engine)) + 0.2 * normal(engine)));
        sum += map.z.back();
      }
    for (double &z : map.z)
      z -= static_cast<double>(sum / map.size());
    return map;
  }

  double
  mean(const HeightMap &map)
  {
    long double sum = 0;
    for (const double z : map.z)
      sum += z;
    return static_cast<double>(sum / map.size());
  }
} // namespace

// Smooth and rough tool: the deformed sheet has the volume of the undeformed one (to 1e-12 of the roughness), the mean
// gap is s + u to round-off (model.md 1.1 (a), with the sum of the heights for a rough tool: T15), and the gap is what
// is left between the deformed sheet and the tool at the distance s + u.
TEST(DeformedSurface, VolumeAndMeanGap)
{
  const HeightMap sheet = random_map(1, 1.6e-3), rough = random_map(2, 0.4e-3);
  for (const HeightMap &tool : { HeightMap(), rough })
    {
      const HeightDistribution heights(sum_of_heights(sheet, tool));
      for (const double s : { 2e-3, 1e-3, 2e-4, -5e-4, -1.5e-3 })
        {
          const double    d        = s + heights.uniform_rise(s);
          const HeightMap deformed = deformed_sheet(sheet, tool, s), gap = deformed_gap(sheet, tool, s);
          EXPECT_NEAR(mean(deformed), 0., 1e-12 * 1.6e-3) << s;
          EXPECT_NEAR(heights.mean_gap(s), d, 1e-15) << s;
          EXPECT_NEAR(mean(gap), d, 1e-15) << s;
          double      largest  = 0;
          std::size_t touching = 0;
          for (std::size_t i = 0; i < gap.size(); ++i)
            {
              const double t = tool.size() > 0 ? tool.z[i] : 0.;
              largest        = std::max(largest, std::abs(d - deformed.z[i] - t - gap.z[i]));
              touching += gap.z[i] == 0.;
            }
          EXPECT_LT(largest, 1e-17);
          EXPECT_NEAR(static_cast<double>(touching) / static_cast<double>(gap.size()), heights.contact_fraction(s),
                      1e-15);
        }
    }
}

TEST(DeformedSurface, RefusesDifferentGrids)
{
  HeightMap other = random_map(3, 1e-3);
  other.nx /= 2;
  other.z.resize(other.size());
  EXPECT_THROW(sum_of_heights(random_map(1, 1e-3), other), InputError);
}
