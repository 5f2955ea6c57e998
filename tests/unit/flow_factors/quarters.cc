// Quarter maps as a measure of how representative a map is.
#include "maps.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/flow_factors/quarter_maps.h>

#include <gtest/gtest.h>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  FlowFactors
  quartered(const HeightMap &map, const double cut_height, const double sq, const CellSettings &settings)
  {
    FlowFactors f = solve(map, cut_height, sq, settings, {}, 3e-4);
    add_quarter_maps(f, map, {}, settings, 3e-4 * sq, sq);
    return f;
  }
}

TEST(QuarterMaps, equal_quarters)
{
  // Four equal quarters that are mirror images of themselves: the mixed conditions at the sides are exact for them, so
  // each gives what the whole gives.
  const auto        map = map_of_gap(64, 64, [](const double x, const double y) {
    return 1 + .5 * std::cos(4 * pi * x) * std::cos(4 * pi * y) + .2 * std::cos(8 * pi * x);
  });
  const FlowFactors f   = quartered(map, 0, .5, periodic());
  EXPECT_TRUE(f.quartered);
  EXPECT_GT(std::abs(f.phi_p[0] - f.phi_p[3]), .01);
  for (const std::size_t k : { 0, 1 })
    {
      EXPECT_NEAR(f.phi_p_quarter_mean[k], f.phi_p[3 * k], 1e-10);
      EXPECT_NEAR(f.phi_s_quarter_mean[k], f.phi_s[3 * k], 1e-10);
      EXPECT_NEAR(f.phi_p_quarter_sd[k], 0, 1e-7);
      EXPECT_NEAR(f.phi_s_quarter_sd[k], 0, 1e-7);
    }
}

TEST(QuarterMaps, one_quarter_differs)
{
  // Smooth but for one quarter with transverse waves about the same mean: levelled and cut at the same mean gap the
  // other three give 1 and 0, this one phi and psi: mean 1 + (phi - 1)/4, standard deviation |phi - 1|/2.
  constexpr double  a   = .6;
  const auto        map = map_of_gap(128, 64, [](const double x, const double y) {
    return x < .5 && y < .5 ? 1 + a * std::cos(4 * pi * x) : 1.3; // the mean of a quarter does not matter
  });
  const FlowFactors f   = quartered(map, 0, .4, periodic());
  // one wave at the mean gap of the whole map, (1 + 3 * 1.3)/4: relative amplitude a/that; 64 pixels per wave
  const double b = a / 1.225, phi = std::pow(1 - b * b, 2.5) / (1 + b * b / 2),
               psi = 1.225 * 1.5 * b * b / (1 + b * b / 2) / .4;
  EXPECT_NEAR(f.h_avg, 1.225, 1e-12);
  EXPECT_NEAR(f.phi_p_quarter_mean[0], 1 + (phi - 1) / 4, 1e-3);
  EXPECT_NEAR(f.phi_p_quarter_sd[0], (1 - phi) / 2, 2e-3);
  EXPECT_NEAR(f.phi_s_quarter_mean[0], psi / 4, 1e-3 * psi);
  EXPECT_NEAR(f.phi_s_quarter_sd[0], psi / 2, 2e-3 * psi);
  // along the waves <h^3>/<h>^3
  EXPECT_NEAR(f.phi_p_quarter_mean[1], 1 + 1.5 * b * b / 4, 1e-10);
  EXPECT_NEAR(f.phi_s_quarter_mean[1], 0, 1e-10);
}

TEST(QuarterMaps, scatter_of_a_random_map)
{
  // The scatter of the quarters predicts that of whole maps: their standard deviation over independent maps is half of
  // the one between quarters. Six maps estimate a standard deviation to some 30 %, hence the factor 2 both ways.
  double whole = 0, whole_square = 0, quarter_variance = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed)
    {
      const FlowFactors f = quartered(gaussian_map(96, 5, 40 + seed), 1, 1, periodic());
      for (const std::size_t k : { 0, 1 })
        {
          whole += f.phi_p[3 * k] / 12;
          whole_square += f.phi_p[3 * k] * f.phi_p[3 * k] / 12;
          quarter_variance += f.phi_p_quarter_sd[k] * f.phi_p_quarter_sd[k] / 12;
        }
    }
  const double sd = std::sqrt(whole_square - whole * whole);
  EXPECT_GT(std::sqrt(quarter_variance) / 2, sd / 2);
  EXPECT_LT(std::sqrt(quarter_variance) / 2, sd * 2);
}

TEST(QuarterMaps, paper_conditions_and_odd_sizes)
{
  HeightMap map = gaussian_map(61, 4, 50);
  map.ny        = 53;
  map.z.resize(map.nx * map.ny);
  const FlowFactors f = quartered(map, 1, 1, { CellBoundaryConditions::paper, CellDiscretisation::paper });
  // the first quarter by itself, at the same mean gap: one of the four
  EXPECT_NEAR(f.phi_p_quarter_mean[0], f.phi_p[0], 3 * f.phi_p_quarter_sd[0]);
  EXPECT_GT(f.phi_p_quarter_sd[0], 1e-3);
  EXPECT_GT(f.phi_s_quarter_mean[1], .3);
}

TEST(QuarterMaps, too_small)
{
  FlowFactors f;
  EXPECT_THROW(add_quarter_maps(f, gaussian_map(19, 2, 1), {}, periodic(), 0, 1), InputError);
}
