// The processing chain: each step on surfaces where its result is known, and the whole from a parameter file.
#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/surface/form.h>
#include <tribodraw/surface/map_operations.h>
#include <tribodraw/surface/missing_points.h>
#include <tribodraw/surface/processing.h>
#include <tribodraw/surface/random_field.h>

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace tribodraw;

namespace
{
  constexpr double pi      = 3.14159265358979323846;
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();

  /// Map of z(x, y), x and y in mm from the lower left corner to the centres of the pixels.
  template <class Function>
  HeightMap
  map_of(std::size_t nx, std::size_t ny, double dx, double dy, const Function &z)
  {
    HeightMap map;
    map.nx          = nx;
    map.ny          = ny;
    map.dx          = dx;
    map.dy          = dy;
    map.description = "test";
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix)
        map.z.push_back(z((static_cast<double>(ix) + 0.5) * dx, (static_cast<double>(iy) + 0.5) * dy));
    return map;
  }

  HeightMap
  processed(HeightMap map, const std::string &entries, bool measured = true)
  {
    auto             parameters = Parameters::from_text("subsection Processing\n" + entries + "end\n");
    const Processing processing(parameters, measured);
    parameters.finish();
    processing.apply(map);
    return map;
  }

  std::string
  refusal(const HeightMap &map, const std::string &entries, bool measured = true)
  {
    try
      {
        processed(map, entries, measured);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }

  double
  largest(const HeightMap &map)
  {
    double value = 0;
    for (const double z : map.z)
      value = std::max(value, std::abs(z));
    return value;
  }
} // namespace

TEST(FormRemoval, SecondOrderOfAQuadraticLeavesNothing)
{
  auto map = map_of(40, 30, 0.02, 0.05, [](double x, double y) {
    return 0.3 + 0.1 * x - 0.2 * y + 0.05 * x * x - 0.02 * x * y + 0.04 * y * y;
  });
  remove_form(map, "second order");
  EXPECT_LT(largest(map), 1e-14);
  EXPECT_NE(map.description.find("0.1, 0.08 1/mm"), std::string::npos) << map.description;
}

TEST(FormRemoval, SphereIsFound)
{
  // A ball of radius 8 mm with its top at (1.3, 0.4) mm of a map of 2 x 1.5 mm, hill and hollow.
  for (const double sign : { 1., -1. })
    {
      const auto map = map_of(80, 50, 0.025, 0.03, [&](double x, double y) {
        return sign * std::sqrt(64. - (x - 1.3) * (x - 1.3) - (y - 0.4) * (y - 0.4));
      });
      const auto fit = fit_sphere(map);
      EXPECT_NEAR(fit.curvature, sign / 8., 1e-10);
      EXPECT_NEAR(fit.x0, 0.3, 1e-8); // from the centre of the map at (1, 0.75)
      EXPECT_NEAR(fit.y0, -0.35, 1e-8);
      auto rest = map;
      remove_form(rest, "sphere");
      EXPECT_LT(largest(rest), 1e-12);
      EXPECT_NE(rest.description.find("radius 8 mm"), std::string::npos) << rest.description;
    }
}

TEST(FormRemoval, CylinderIsFoundUnderRoughness)
{
  // Radius 5 mm, axis at 30 degrees to x, a quarter of a millimetre beside the centre of the map, tilted by 0.002.
  const double angle = pi / 6;
  const auto   shape = [&](double x, double y) {
    const double u = x - 1., v = y - 1., along = u * std::cos(angle) + v * std::sin(angle),
                 w = -u * std::sin(angle) + v * std::cos(angle) - 0.25;
    return std::sqrt(25. - w * w) + 0.002 * along;
  };
  const auto fit = fit_cylinder(map_of(100, 100, 0.02, 0.02, shape));
  EXPECT_NEAR(fit.curvature, 0.2, 1e-10);
  EXPECT_NEAR(std::remainder(fit.angle - angle, pi), 0., 1e-9);
  EXPECT_NEAR(fit.tilt * std::cos(fit.angle - angle), 0.002, 1e-10);
  EXPECT_NEAR(std::hypot(fit.x0, fit.y0), 0.25, 1e-8);

  // With a wave of 1 um, 20 periods in each direction: its correlation with the five parameters is small, and the
  // radius moves by less than amplitude / sag = 1e-3 / (1/(8*0.2...)): sag over 2 mm is 0.1 mm, so 1 per cent at most.
  auto rough = map_of(100, 100, 0.02, 0.02, [&](double x, double y) {
    return shape(x, y) + 1e-3 * std::sin(2 * pi * x / 0.1) * std::sin(2 * pi * y / 0.1);
  });
  EXPECT_NEAR(fit_cylinder(rough).curvature, 0.2, 0.002);
  remove_form(rough, "cylinder");
  double squares = 0;
  for (const double z : rough.z)
    squares += z * z;
  EXPECT_NEAR(std::sqrt(squares / 1e4), 0.5e-3, 0.5e-5); // Sq of a product of sines: amplitude / 2
}

TEST(FormRemoval, PlaneHasNoRadius)
{
  const auto plane = map_of(20, 20, 0.01, 0.01, [](double x, double y) { return 0.1 * x - 0.2 * y; });
  EXPECT_THROW(fit_sphere(plane), InputError);
  EXPECT_THROW(fit_cylinder(plane), InputError);
  EXPECT_THROW(fit_sphere(map_of(2, 2, 1., 1., [](double x, double) { return x; })), InputError);
}

TEST(MissingPoints, HarmonicFillContinuesHarmonicFunctions)
{
  // x y + 3 x - y satisfies the discrete Laplace equation exactly, also with unequal pixels: a hole in it is closed to
  // the solver's tolerance. 20 x 15 points of 60 x 40.
  auto       map  = map_of(60, 40, 0.01, 0.02, [](double x, double y) { return x * y + 3 * x - y; });
  const auto full = map;
  for (std::size_t iy = 10; iy < 25; ++iy)
    for (std::size_t ix = 20; ix < 40; ++ix)
      map(ix, iy) = missing;
  EXPECT_EQ(n_missing(map), 300u);
  EXPECT_EQ(fill_missing(map, 0.125), 300u); // 300 / 2400 exactly
  for (std::size_t i = 0; i < map.size(); ++i)
    EXPECT_NEAR(map.z[i], full.z[i], 1e-8);
}

TEST(MissingPoints, HoleAcrossTheBorderOfAPeriodicMapIsFilledFromBothSides)
{
  // Columns 30, 31, 0, 1 of 32 are missing between columns of height 1 (column 29) and 6 (column 2): the discrete
  // solution is linear, 2, 3, 4, 5.
  auto map     = map_of(32, 8, 1., 1., [](double x, double) { return x < 16 ? 6. : 1.; });
  map.periodic = true;
  for (std::size_t iy = 0; iy < 8; ++iy)
    for (const std::size_t ix : { 30, 31, 0, 1 })
      map(ix, iy) = missing;
  fill_missing(map, 0.2);
  const double expected[] = { 2, 3, 4, 5 };
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(map((30 + k) % 32, 3), expected[k], 1e-8);
}

TEST(MissingPoints, TooManyAreRefusedWithNumbers)
{
  auto map = map_of(10, 10, 1., 1., [](double x, double) { return x; });
  for (std::size_t i = 0; i < 11; ++i)
    map.z[7 * i] = missing;
  EXPECT_NE(refusal(map, "set Maximum missing fraction = 0.1\n").find("11 of 100 (11 %)"), std::string::npos);
  EXPECT_EQ(refusal(map, "set Maximum missing fraction = 0.11\n"), "");
  for (double &z : map.z)
    z = missing;
  EXPECT_NE(refusal(map, "set Maximum missing fraction = 0.5\n").find("all points"), std::string::npos);
}

TEST(Outliers, SpikesAreFoundAndNothingElse)
{
  // Normal noise of 1 um on a slope. The distance from a median of 25 has a standard deviation near 1 um; among 10000
  // points the largest stays below 5 of them (probability 6e-3). Spikes of 40 um: three single, one of two pixels.
  NormalDeviates    deviates(9);
  auto              map = map_of(100, 100, 0.01, 0.01, [&](double x, double) { return 1e-3 * deviates() + 0.01 * x; });
  const std::size_t spikes[] = { 0, 5050, 5051, 777, 9999 };
  for (const auto at : spikes)
    map.z[at] += 0.04;
  const auto report = mark_outliers(map, 6., 5);
  EXPECT_EQ(report.found, 5u);
  for (const auto at : spikes)
    EXPECT_TRUE(std::isnan(map.z[at])) << at;
  EXPECT_NEAR(report.spread, 1e-3, 0.1e-3);

  // More than half of a flat map is equal to its median: one spike is still one outlier.
  auto flat = map_of(20, 20, 1., 1., [](double, double) { return 2.; });
  EXPECT_EQ(mark_outliers(flat, 5., 3).found, 0u);
  flat(3, 4) = 9.;
  EXPECT_EQ(mark_outliers(flat, 5., 3).found, 1u);
  EXPECT_THROW(mark_outliers(flat, 5., 4), InputError);
}

TEST(Orientation, TurningMovesTheRollingDirectionToX)
{
  // z = 10 x + y counted in pixels: what grew along y by 1 a pixel must grow along x.
  auto map = map_of(3, 2, 1., 2., [](double x, double y) { return 10 * (x - 0.5) + (y - 1.) / 2.; });
  turn_y_to_x(map);
  EXPECT_EQ(map.nx, 2u);
  EXPECT_EQ(map.ny, 3u);
  EXPECT_EQ(map.dx, 2.);
  EXPECT_EQ(map.dy, 1.);
  EXPECT_EQ(map(1, 0) - map(0, 0), 1.);
  EXPECT_EQ(map(0, 0) - map(0, 1), 10.); // what ran along x runs along -y
  // A rotation, not a mirror image: four of them are the identity.
  const auto once = map;
  for (int i = 0; i < 4; ++i)
    turn_y_to_x(map);
  EXPECT_EQ(map.z, once.z);
  flip_x(map);
  EXPECT_EQ(map(0, 2), once(1, 2));
  flip_y(map);
  EXPECT_EQ(map(0, 2), once(1, 0));
  invert_heights(map);
  EXPECT_EQ(map(0, 2), -once(1, 0));
}

TEST(Crop, KeepsThePixelsOfTheWindow)
{
  auto map = map_of(10, 8, 0.1, 0.2, [](double x, double y) { return x + 100 * y; });
  crop(map, { 0.2, 0.7, 0.4, 1.6 });
  EXPECT_EQ(map.nx, 5u); // centres 0.25 ... 0.65
  EXPECT_EQ(map.ny, 6u); // centres 0.5 ... 1.5
  EXPECT_NEAR(map(0, 0), 0.25 + 50, 1e-12);
  EXPECT_NEAR(map(4, 5), 0.65 + 150, 1e-12);
  EXPECT_THROW(crop(map, { 0., 0.6, 0., 1. }), InputError);   // beyond 0.5 mm
  EXPECT_THROW(crop(map, { 0.1, 0.15, 0., 1. }), InputError); // one pixel
  EXPECT_THROW(crop(map, { -0.1, 0.4, 0., 1. }), InputError);
  EXPECT_THROW(crop(map, { 0., missing, 0., 1. }), InputError);
}

TEST(Resample, CoarserPixelsKeepTheVolume)
{
  NormalDeviates deviates(1);
  auto           map = map_of(60, 45, 1e-3, 1e-3, [&](double, double) { return deviates(); });
  map.periodic       = true;
  double mean = 0, coarse = 0;
  for (const double z : map.z)
    mean += z / 2700.;
  resample(map, { 2.5e-3, 3e-3 });
  EXPECT_EQ(map.nx, 24u);
  EXPECT_EQ(map.ny, 15u);
  for (const double z : map.z)
    coarse += z / 360.;
  EXPECT_NEAR(coarse, mean, 1e-14);
}

TEST(Resample, MeansOfAnIntegerRatioAreThoseOfTheBlocks)
{
  auto       map = map_of(6, 4, 1., 1., [](double x, double y) { return x * x + 7 * y; });
  const auto old = map;
  resample(map, { 3., 2. });
  EXPECT_EQ(map.nx, 2u);
  EXPECT_EQ(map.ny, 2u);
  double sum = 0;
  for (std::size_t iy = 2; iy < 4; ++iy)
    for (std::size_t ix = 0; ix < 3; ++ix)
      sum += old(ix, iy);
  EXPECT_NEAR(map(0, 1), sum / 6., 1e-13);
}

TEST(Resample, FinerPixelsConvergeWithThirdOrder)
{
  // Keys 1981: cubic convolution is of third order. One wave on n pixels, resampled to 2.5 times as many.
  double error[2];
  for (const int i : { 0, 1 })
    {
      const std::size_t n   = i ? 64 : 32;
      const auto        z   = [](double x, double y) { return std::sin(2 * pi * x) * std::cos(2 * pi * y + 1); };
      auto              map = map_of(n, n, 1. / n, 1. / n, z);
      map.periodic          = true;
      resample(map, { 0.4 / n, 0.4 / n });
      EXPECT_EQ(map.nx, n * 5 / 2);
      const auto exact = map_of(map.nx, map.ny, map.dx, map.dy, z);
      error[i]         = 0;
      for (std::size_t k = 0; k < map.size(); ++k)
        error[i] = std::max(error[i], std::abs(map.z[k] - exact.z[k]));
    }
  EXPECT_LT(error[1], 2e-3);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 3., 0.2);
}

TEST(Resample, OpenMapsKeepThePixelSizeExactly)
{
  auto map = map_of(10, 10, 1., 1., [](double x, double y) { return 2 * x - y; });
  resample(map, { 0.3, 3. });
  EXPECT_EQ(map.nx, 33u); // 9.9 of 10, the rest lost at both sides
  EXPECT_EQ(map.ny, 3u);
  EXPECT_EQ(map.dx, 0.3);
  // linear heights are reproduced up to the border
  EXPECT_NEAR(map(0, 0), 2 * (0.05 + 0.15) - (0.5 + 1.5), 1e-12);
  EXPECT_NEAR(map(32, 2), 2 * (9.95 - 0.15) - (9.5 - 1.5), 1e-12);
  EXPECT_THROW(resample(map, { 100., 1. }), InputError);
  EXPECT_THROW(resample(map, { 1e-9, 1. }), InputError);
}

TEST(Processing, AppliesAllStepsInTheStatedOrder)
{
  // A tilted wave of 0.1 mm with a hole and a spike, stored as depths with the rolling direction along y.
  auto map      = map_of(200, 150, 0.01, 0.01, [](double x, double y) {
    return -(2e-3 * std::sin(2 * pi * y / 0.1) + 0.5e-3 * std::sin(2 * pi * x / 0.02)) + 0.01 * x + 5.;
  });
  map(50, 50)   = missing;
  map(100, 100) = 7.;
  const auto result
      = processed(map, "set Invert heights = true\nset Rolling direction = y\nset Outlier threshold = 8\n"
                       "set S-filter = 30 um\nset L-filter = 0.8 mm\nset Crop = 0.3 mm, 1.2 mm, 0.4 mm, 1.6 mm\n"
                       "set Resample to = 5 um\n");
  EXPECT_EQ(result.nx, 180u); // 0.9 mm
  EXPECT_EQ(result.ny, 240u); // 1.2 mm
  const char *steps[] = { "heights inverted",
                          "turned",
                          "1 outliers",
                          "2 missing points",
                          "least-squares plane subtracted",
                          "S-filter 30 um",
                          "L-filter 0.8 mm",
                          "cropped to 90 x 120",
                          "resampled to 180 x 240",
                          "mean subtracted" };
  std::size_t last    = 0;
  for (const char *step : steps)
    {
      const std::size_t at = result.description.find(step);
      ASSERT_NE(at, std::string::npos) << step << " in " << result.description;
      EXPECT_GT(at, last) << step;
      last = at;
    }
  // The wave now runs along x. It passes the S-filter with 2^-(30/100)^2 and the L-filter with 1 - 2^-(800/100)^2 = 1;
  // the short wave keeps 2^-(30/20)^2 = 21 per cent, which adds 0.16 per cent to the root of the sum of squares.
  double squares = 0;
  for (const double z : result.z)
    squares += z * z;
  const double amplitude = 2e-3 * std::pow(2., -0.09);
  EXPECT_NEAR(std::sqrt(2. * squares / static_cast<double>(result.size())), amplitude, 0.01 * amplitude);
}

TEST(Processing, LeavesAPeriodicMapAloneUnlessAsked)
{
  auto map        = map_of(8, 8, 1e-3, 1e-3, [](double x, double) { return x < 4e-3 ? 1e-3 : -1e-3; });
  map.periodic    = true;
  const auto same = processed(map, "", false);
  EXPECT_EQ(same.z, map.z);
  EXPECT_TRUE(same.periodic);
  EXPECT_FALSE(processed(map, "", true).periodic); // a measured map is levelled with a plane
  EXPECT_TRUE(processed(map, "set S-filter = 3 um\n", false).periodic);
  EXPECT_FALSE(processed(map, "set Crop = 0 mm, 0.004 mm, 0 mm, 0.008 mm\n", false).periodic);
}

TEST(Processing, NonsenseIsRefusedWithItsName)
{
  const auto map = map_of(20, 20, 5e-3, 5e-3, [](double x, double y) { return std::sin(80 * x) + std::cos(70 * y); });
  const struct
  {
    std::string entries, expected;
  } cases[] = {
    { "set S-filter = 4 um\n", "below the pixel size" },
    { "set S-filter = 120 um\n", "longer than the map" },
    { "set L-filter = 0.2 mm\n", "longer than the map" },
    { "set S-filter = 50 um\nset L-filter = 0.02 mm\n", "S-filter" },
    { "set S-filter = 0 um\n", "S-filter" },
    { "set Crop = 0 mm, 0.2 mm, 0 mm, 0.1 mm\n", "not within the map" },
    { "set Crop = 0 mm, 0.2 mm\n", "2 values" },
    { "set Crop = 0.05 mm, 0.02 mm, 0 mm, 0.1 mm\n", "window is empty" },
    { "set Resample to = 1 um, 1 um, 1 um\n", "3 values" },
    { "set Outlier window = 5\n", "no effect" },
    { "set Outlier threshold = 5\nset Outlier window = 4\n", "odd" },
    { "set Resample to = 49.9 um, 0.005 um\n", "Resample to" },
    { "set Maximum missing fraction = 0.9\n", "Maximum missing fraction" },
    { "set Form = torus\n", "Form" },
    { "set Form = none\n", "mean height" },
    { "set Rolling direction = z\n", "Rolling direction" },
  };
  for (const auto &c : cases)
    EXPECT_NE(refusal(map, c.entries).find(c.expected), std::string::npos)
        << c.entries << " gives: " << refusal(map, c.entries);
}

TEST(Processing, MemoryIsBounded)
{
  EXPECT_EQ(memory_problem(1000, 1000), "");
  EXPECT_NE(memory_problem(1e7, 1e7).find("GB"), std::string::npos);
  EXPECT_THROW(check_memory(1e7, 1e7, "test"), InputError);
}
