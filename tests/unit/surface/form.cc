#include <tribodraw/surface/form.h>

#include <tribodraw/base/errors.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace tribodraw;

namespace
{
  /// Map of z(ix, iy).
  template <class Function>
  HeightMap
  make_map(std::size_t nx, std::size_t ny, const Function &z)
  {
    HeightMap map;
    map.nx       = nx;
    map.ny       = ny;
    map.dx       = 1e-3;
    map.dy       = 2e-3;
    map.periodic = true;
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix)
        map.z.push_back(z(static_cast<double>(ix), static_cast<double>(iy)));
    return map;
  }
} // namespace

TEST(Form, PlaneOfAPlaneLeavesNothing)
{
  auto map = make_map(31, 20, [](double x, double y) { return 0.5 + 0.01 * x - 0.03 * y; });
  remove_form(map, "plane");
  for (const double z : map.z)
    EXPECT_NEAR(z, 0., 1e-15);
  EXPECT_FALSE(map.periodic);
  EXPECT_NE(map.description.find("plane"), std::string::npos);
}

TEST(Form, PlaneKeepsWhatIsOrthogonalToPlanes)
{
  // (x - xm)^2 - <(x - xm)^2> and (x - xm)(y - ym) are orthogonal to 1, x and y on a full grid.
  const auto form = [](double x, double y) {
    return 1e-3 * ((x - 10) * (x - 10) - (21. * 21. - 1.) / 12.) + 2e-3 * (x - 10) * (y - 5);
  };
  auto       map      = make_map(21, 11, [&](double x, double y) { return form(x, y) + 3. + 0.2 * x - 0.1 * y; });
  const auto expected = make_map(21, 11, form);
  remove_form(map, "plane");
  for (std::size_t i = 0; i < map.z.size(); ++i)
    EXPECT_NEAR(map.z[i], expected.z[i], 1e-13);
}

TEST(Form, MeanSubtractsTheMeanOnly)
{
  auto map = make_map(4, 2, [](double x, double) { return 5. + x; });
  remove_form(map, "mean");
  EXPECT_NEAR(map(0, 0), -1.5, 1e-15); // mean of 5..8 is 6.5
  EXPECT_NEAR(map(3, 1), 1.5, 1e-15);
  EXPECT_TRUE(map.periodic);
}

TEST(Form, NoneInsistsOnZeroMean)
{
  auto       level_map = make_map(4, 2, [](double x, double) { return x - 1.5; });
  const auto before    = level_map.z;
  remove_form(level_map, "none");
  EXPECT_EQ(level_map.z, before);
  auto offset = make_map(4, 2, [](double x, double) { return x; });
  try
    {
      remove_form(offset, "none");
      FAIL() << "a map with offset was accepted";
    }
  catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find("mean height"), std::string::npos) << e.what();
    }
}

TEST(Form, EmptyMapStaysAndUnknownNamesAreRejected)
{
  HeightMap smooth;
  remove_form(smooth, "plane");
  EXPECT_EQ(smooth.size(), 0u);
  EXPECT_THROW(remove_form(smooth, "torus"), InputError);
}
