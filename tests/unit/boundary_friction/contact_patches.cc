#include <tribodraw/base/errors.h>
#include <tribodraw/boundary_friction/contact_patches.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  const double pi = 3.14159265358979323846;

  HeightMap
  flat_map(const std::size_t n, const double dx, const double dy, const double height)
  {
    HeightMap map;
    map.nx = map.ny = n;
    map.dx          = dx;
    map.dy          = dy;
    map.z.assign(n * n, height);
    return map;
  }

  /// A tool of height -1 everywhere, but for one elliptical paraboloid of the given depth above 0.
  HeightMap
  paraboloid(const std::size_t n, const double length, const double a, const double b, const double w, const double psi)
  {
    HeightMap map = flat_map(n, length / n, length / n, -1.);
    for (std::size_t iy = 0; iy < n; ++iy)
      for (std::size_t ix = 0; ix < n; ++ix)
        {
          const double x = (ix + 0.5) * map.dx - 0.5 * length, y = (iy + 0.5) * map.dy - 0.5 * length;
          const double u = (x * std::cos(psi) + y * std::sin(psi)) / a,
                       v = (-x * std::sin(psi) + y * std::cos(psi)) / b;
          map(ix, iy)    = std::max(-1., w * (1. - u * u - v * v));
        }
    return map;
  }

  std::size_t
  pixels_above(const HeightMap &map, const double level)
  {
    std::size_t n = 0;
    for (const double t : map.z)
      n += t > level;
    return n;
  }
} // namespace

// A digital elliptical paraboloid is found again: area pi a b, volume pi a b w / 2, orientation.
TEST(ContactPatches, FindsAParaboloid)
{
  const double         a = 0.3, b = 0.12, w = 0.01, psi = 0.4;
  const HeightMap      tool = paraboloid(400, 1., a, b, w, psi), sheet = flat_map(400, tool.dx, tool.dy, 0.);
  const ToolSurface    surface(tool, 4);
  const PlateauContact contact(sheet, surface, 0.);
  EXPECT_EQ(contact.n_plateau_pixels(), tool.size());
  EXPECT_NEAR(contact.nominal_area(), 1., 1e-12);
  const auto patches = contact.patches(pixels_above(tool, 0.));
  ASSERT_EQ(patches.size(), 1u);
  const ContactPatch &p = patches[0];
  // Pixel counting: relative error of the order of the pixel over the small axis squared, (0.0025/0.12)^2 = 4e-4.
  EXPECT_NEAR(p.area, pi * a * b, 1e-3 * pi * a * b);
  EXPECT_NEAR(p.a, a, 1e-3 * a);
  EXPECT_NEAR(p.b, b, 1e-3 * b);
  EXPECT_NEAR(p.psi, psi, 1e-3);
  EXPECT_NEAR(p.centre_x, 0.5 - 0.5 * tool.dx, 1e-4);
  EXPECT_NEAR(pi * p.a * p.b, p.area, 1e-12);
  // The level is the height of the next pixel, a little below 0.
  EXPECT_NEAR(p.depth_of_volume(), w, 0.02 * w);
  EXPECT_NEAR(p.volume, 0.5 * p.area * p.depth_of_volume(), 1e-15);
  // Slopes at the rim look half a pixel outwards: relative error pixel / axis = 0.02 at most.
  EXPECT_NEAR(p.depth_of_slope(), w, 0.02 * w);
}

TEST(ContactPatches, RectangularPixels)
{
  // The same ellipse with axes 0.2 x 0.1 on pixels of 0.005 x 0.0025 is a circle of 40 pixels.
  HeightMap tool = flat_map(200, 0.005, 0.0025, -1.);
  for (std::size_t iy = 0; iy < 200; ++iy)
    for (std::size_t ix = 0; ix < 200; ++ix)
      tool(ix, iy) = 1. - (std::pow(ix - 99.5, 2) + std::pow(iy - 99.5, 2)) / 1600.;
  const HeightMap      sheet = flat_map(200, 0.005, 0.0025, 0.);
  const ToolSurface    surface(tool, 4);
  const PlateauContact contact(sheet, surface, 0.);
  const auto           patches = contact.patches(pixels_above(tool, 0.));
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_NEAR(patches[0].a, 0.2, 1e-3);
  EXPECT_NEAR(patches[0].b, 0.1, 1e-3);
  EXPECT_NEAR(patches[0].psi, 0., 1e-6);
}

// Pixels that touch at a corner belong together; plateaus decide which pixels can touch.
TEST(ContactPatches, EightNeighbours)
{
  HeightMap tool = flat_map(8, 1., 1., 0.), sheet = flat_map(8, 1., 1., -1.);
  for (const auto &[ix, iy] : { std::pair{ 1, 1 }, { 2, 2 }, { 3, 1 }, { 6, 6 }, { 6, 4 } })
    {
      tool(ix, iy)  = 1.;
      sheet(ix, iy) = 0.;
    }
  tool(0, 7) = 2.; // the highest tool pixel faces a valley
  const ToolSurface    surface(tool, 4);
  const PlateauContact contact(sheet, surface, 0.);
  EXPECT_EQ(contact.n_plateau_pixels(), 5u);
  const auto patches = contact.patches(5);
  ASSERT_EQ(patches.size(), 3u);
  std::size_t pixels = 0, largest = 0;
  for (const ContactPatch &p : patches)
    {
      pixels += p.pixels;
      largest = std::max(largest, p.pixels);
      EXPECT_NEAR(pi * p.a * p.b, p.area, 1e-12);
    }
  EXPECT_EQ(pixels, 5u);
  EXPECT_EQ(largest, 3u);
  // The work space is clean: asking again gives the same.
  EXPECT_EQ(contact.patches(5).size(), 3u);
  EXPECT_TRUE(contact.patches(0).empty());
}

// A paraboloid cut by the borders of a periodic map is one patch; in a map without continuation it is four.
TEST(ContactPatches, ContinuesAcrossTheBordersOfPeriodicMaps)
{
  const double      a = 0.3, b = 0.12, w = 0.01, psi = 0.4;
  const std::size_t n     = 200;
  HeightMap         whole = paraboloid(n, 1., a, b, w, psi), tool = whole, sheet = flat_map(n, whole.dx, whole.dy, 0.);
  for (std::size_t iy = 0; iy < n; ++iy)
    for (std::size_t ix = 0; ix < n; ++ix)
      tool((ix + n / 2) % n, (iy + n / 2) % n) = whole(ix, iy);
  tool.periodic = sheet.periodic = true;
  const std::size_t  pixels      = pixels_above(tool, 0.);
  const ToolSurface  surface(tool, 4), whole_surface(whole, 4);
  const auto         moved  = PlateauContact(sheet, surface, 0.).patches(pixels);
  const ContactPatch in_one = PlateauContact(sheet, whole_surface, 0.).patches(pixels).at(0);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].pixels, in_one.pixels);
  EXPECT_NEAR(moved[0].a, in_one.a, 1e-12);
  EXPECT_NEAR(moved[0].b, in_one.b, 1e-12);
  EXPECT_NEAR(moved[0].psi, in_one.psi, 1e-12);
  EXPECT_NEAR(moved[0].volume, in_one.volume, 1e-12 * in_one.volume);
  EXPECT_NEAR(moved[0].slope, in_one.slope, 1e-7 * in_one.slope);
  tool.periodic = false;
  EXPECT_EQ(PlateauContact(sheet, ToolSurface(tool, 4), 0.).patches(pixels).size(), 4u);
}

// Where patches are cut by the edge of a plateau, the volume depends on the cut and the slope does not: a tool of
// slope 0.05 everywhere, on a plateau of one pixel, is 0.05 steep.
TEST(ContactPatches, SlopesAreThoseOfTheTool)
{
  HeightMap tool = flat_map(32, 1., 1., 0.), sheet = flat_map(32, 1., 1., -1.);
  for (std::size_t iy = 0; iy < 32; ++iy)
    for (std::size_t ix = 0; ix < 32; ++ix)
      tool(ix, iy) = 0.05 * std::abs(static_cast<double>(ix) - 15.5);
  for (const auto &[ix, iy] : { std::pair{ 3, 3 }, { 10, 5 }, { 11, 5 }, { 12, 6 }, { 29, 20 } })
    sheet(ix, iy) = 0.;
  const ToolSurface    surface(tool, 4);
  const PlateauContact contact(sheet, surface, 0.);
  const auto           patches = contact.patches(5);
  ASSERT_EQ(patches.size(), 3u);
  for (const ContactPatch &patch : patches)
    {
      EXPECT_NEAR(patch.slope, 0.05, 1e-8);
      EXPECT_NEAR(patch.depth_of_slope() * std::hypot(1. / patch.a, 1. / patch.b), 0.05, 1e-8);
    }
}

TEST(ContactPatches, RefusesDifferentGrids)
{
  const HeightMap tool = flat_map(8, 1., 1., 0.), sheet = flat_map(9, 1., 1., 0.);
  EXPECT_THROW(PlateauContact(sheet, ToolSurface(tool, 4), 0.), InputError);
}
