#include <tribodraw/output/plot.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace tribodraw::plot;

namespace
{
  constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

  /// The rectangle [0, 2] x [0, 1] in two triangles.
  PlanMesh
  rectangle()
  {
    return { { { { 0, 0 } }, { { 2, 0 } }, { { 2, 1 } }, { { 0, 1 } } }, { { { 0, 1, 2 } }, { { 0, 2, 3 } } } };
  }
} // namespace

TEST(Raster, linear_field_is_reproduced_in_every_pixel)
{
  const PlanMesh      mesh = rectangle();
  std::vector<double> values;
  for (const auto &p : mesh.points)
    values.push_back(3 * p[0] - 5 * p[1] + 1);
  const Raster raster = rasterise_nodal(mesh, values, 40);
  ASSERT_EQ(raster.nx, 40u); // the longer side gets the pixels that were asked for
  ASSERT_EQ(raster.ny, 20u); // square pixels: half as many
  for (std::size_t iy = 0; iy < raster.ny; ++iy)
    for (std::size_t ix = 0; ix < raster.nx; ++ix)
      {
        const double x = (ix + 0.5) * 0.05, y = (iy + 0.5) * 0.05; // pixel size 2/40
        ASSERT_TRUE(raster.inside[iy * raster.nx + ix]);
        // linear interpolation is exact for a linear field, up to round-off
        EXPECT_NEAR(raster.value[iy * raster.nx + ix], 3 * x - 5 * y + 1, 1e-12);
      }
}

TEST(Raster, constant_cells_keep_their_value_and_the_outside_is_not_painted)
{
  PlanMesh mesh = rectangle();
  mesh.triangles.pop_back(); // only the lower right triangle is left
  const Raster raster = rasterise_cells(mesh, { 7. }, 10);
  // lower right pixel inside, upper left outside, by geometry
  EXPECT_TRUE(raster.inside[9]);
  EXPECT_EQ(raster.value[9], 7.);
  EXPECT_FALSE(raster.inside[(raster.ny - 1) * raster.nx]);
  EXPECT_TRUE(std::isnan(raster.value[(raster.ny - 1) * raster.nx]));
}

TEST(Raster, pixels_nearest_to_a_node_without_value_have_none)
{
  const PlanMesh mesh{ { { { 0, 0 } }, { { 1, 0 } }, { { 0, 1 } } }, { { { 0, 1, 2 } } } };
  const Raster   raster = rasterise_nodal(mesh, { nan_value, 4., 4. }, 100);
  EXPECT_TRUE(std::isnan(raster.value[0])); // at the corner without value
  EXPECT_TRUE(raster.inside[0]);
  EXPECT_NEAR(raster.value[98], 4., 1e-12); // at (0.985, 0.005): both other corners have the value 4
}

TEST(Raster, outline_of_a_mesh_with_a_hole_is_two_closed_chains)
{
  // A ring of 8 triangles around the hole [1, 2]^2 in [0, 3]^2.
  PlanMesh mesh;
  mesh.points       = { { { 0, 0 } }, { { 3, 0 } }, { { 3, 3 } }, { { 0, 3 } },
                        { { 1, 1 } }, { { 2, 1 } }, { { 2, 2 } }, { { 1, 2 } } };
  mesh.triangles    = { { { 0, 1, 5 } }, { { 0, 5, 4 } }, { { 1, 2, 6 } }, { { 1, 6, 5 } },
                        { { 2, 3, 7 } }, { { 2, 7, 6 } }, { { 3, 0, 4 } }, { { 3, 4, 7 } } };
  const auto chains = mesh.outline();
  ASSERT_EQ(chains.size(), 2u);
  for (const auto &chain : chains)
    {
      EXPECT_EQ(chain.size(), 5u); // four edges, first point repeated
      EXPECT_EQ(chain.front(), chain.back());
    }
}

TEST(Raster, value_range_ignores_missing_values_and_has_a_width)
{
  EXPECT_EQ(value_range({ 2., nan_value, -1. }), (std::pair<double, double>{ -1., 2. }));
  EXPECT_EQ(value_range({ nan_value }), (std::pair<double, double>{ 0., 1. })); // as documented
  const auto constant = value_range({ 5., 5. });
  EXPECT_LT(constant.first, 5.);
  EXPECT_GT(constant.second, 5.);
}
