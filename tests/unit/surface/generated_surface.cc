// Generated surfaces through the parameter file, as the program makes them.
#include "surface_from_text.h"

#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/surface/autocorrelation.h>
#include <tribodraw/surface/random_field.h>
#include <tribodraw/surface/roughness.h>
#include <tribodraw/surface/surface.h>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

using namespace tribodraw;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  std::string
  generated(const std::string &texture, const std::string &common, const std::string &own)
  {
    const std::string section = texture == "gaussian" ? "Gaussian" : "Bimodal";
    return "set Model = generated\nsubsection Generated\nset Texture = " + texture + "\n" + common + "subsection "
           + section + "\n" + own + "end\nend\n";
  }

  std::string
  common(unsigned pixels, const std::string &sq, long seed)
  {
    return "set Pixels = " + std::to_string(pixels) + "\nset Pixel size = 3 um\nset Sq = " + sq
           + "\nset Seed = " + std::to_string(seed) + "\n";
  }

  std::string
  gaussian(unsigned pixels, long seed, const std::string &length)
  {
    return generated("gaussian", common(pixels, "1.56 um", seed), "set Correlation length = " + length + "\n");
  }

  std::string
  bimodal(unsigned pixels, long seed)
  {
    // The EDT-like surface of the shipped files: plateau offset 0.35 standard deviations, that is, an area fraction of
    // Phi(0.35) = 0.6368.
    return generated(
        "bimodal", common(pixels, "1.60 um", seed),
        "set Crater correlation length = 45 um\nset Plateau area fraction = 0.6368\nset Edge steepness = 2.2\n"
        "set Fine roughness ratio = 0.12\nset Fine correlation length = 9 um\n");
  }

  /// Mean and root mean square in extended precision, independent of the program's own sums.
  std::pair<double, double>
  mean_and_sq(const HeightMap &map)
  {
    long double sum = 0, squares = 0;
    for (const double z : map.z)
      {
        sum += z;
        squares += static_cast<long double>(z) * z;
      }
    return { static_cast<double>(sum / map.size()), static_cast<double>(std::sqrt(squares / map.size())) };
  }
} // namespace

TEST(NormalDeviates, FollowTheDocumentedConversion)
{
  // The first values of std::mt19937_64 are fixed by the C++ standard ([rand.predef]: the 10000th of the default seed
  // 5489 is 9981545732273789042); deviates computed here from the documented formula.
  std::mt19937_64 engine(5489);
  engine.discard(9998);
  const auto a = engine(), b = engine();
  EXPECT_EQ(b, 9981545732273789042u);
  const double u = static_cast<double>((a >> 11) + 1) / 9007199254740992.,
               v = static_cast<double>(b >> 11) / 9007199254740992.;
  NormalDeviates deviates(5489);
  for (int i = 0; i < 9998; ++i)
    deviates();
  EXPECT_NEAR(deviates(), std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * v), 1e-14);
  EXPECT_NEAR(deviates(), std::sqrt(-2 * std::log(u)) * std::sin(2 * pi * v), 1e-14);
}

TEST(GeneratedSurface, HasExactlyThePrescribedSqAndZeroMean)
{
  for (const auto &[text, sq] : { std::pair(gaussian(128, 1, "24 um"), 1.56e-3), std::pair(bimodal(128, 2), 1.60e-3) })
    {
      const auto map            = make(text);
      const auto [mean, actual] = mean_and_sq(map);
      EXPECT_NEAR(actual / sq, 1., 1e-12);
      EXPECT_NEAR(mean / sq, 0., 1e-12);
      EXPECT_EQ(map.nx, 128u);
      EXPECT_EQ(map.ny, 128u);
      EXPECT_DOUBLE_EQ(map.dx, 3e-3);
      EXPECT_TRUE(map.periodic);
      EXPECT_NE(map.description.find("seed"), std::string::npos);
    }
}

TEST(GeneratedSurface, SeedDeterminesTheMap)
{
  const auto a = make(gaussian(64, 7, "24 um")), b = make(gaussian(64, 7, "24 um")), c = make(gaussian(64, 8, "24 um"));
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_EQ(a.z, b.z);
  EXPECT_NE(a.hash(), c.hash());
  auto d = a;
  d.dx *= 2;
  EXPECT_NE(a.hash(), d.hash());
  auto e  = a;
  e.z[17] = std::nextafter(e.z[17], 1.);
  EXPECT_NE(a.hash(), e.hash());
}

TEST(GeneratedSurface, HeightsAreTheSameOnEveryMachine)
{
  // Computed apart from the program in Python: Mersenne twister and Box-Muller as documented in random_field.h, the
  // filter as a direct sum over the periodic noise with compensated summation; 32 x 32 pixels, seed 42, Sq 1.56 um.
  const auto map = make(gaussian(32, 42, "24 um, 12 um"));
  EXPECT_NEAR(map(0, 0), -0.955480372573044e-3, 1e-11);
  EXPECT_NEAR(map(31, 0), -0.8641500474447376e-3, 1e-11);
  EXPECT_NEAR(map(5, 17), -0.7894614774215511e-3, 1e-11);
  EXPECT_NEAR(map(31, 31), -1.570898451191664e-3, 1e-11);
}

TEST(GeneratedSurface, EveryRankMakesTheSameMap)
{
  const std::string mine  = make(bimodal(128, 42)).hash();
  std::string       first = mine;
  parallel::broadcast(first, 0);
  EXPECT_EQ(mine, first);
}

TEST(GeneratedSurface, GaussianFieldEqualsTheDirectlySummedFilter)
{
  // The separable filter against its definition as a double sum over the periodic noise, on a map that is smaller than
  // the kernel and not square.
  const Grid               grid{ 12, 17, 3e-3, 2e-3 };
  const CorrelationLengths lengths{ 9e-3, 7e-3 };
  NormalDeviates           first(3), second(3);
  const auto               field = gaussian_field(grid, lengths, first);
  std::vector<double>      noise(grid.nx * grid.ny), expected(noise.size(), 0.);
  for (double &x : noise)
    x = second();
  const auto kernel = [](double distance, double length) { return std::exp(-std::pow(distance / length, 2)); };
  for (int iy = 0; iy < 17; ++iy)
    for (int ix = 0; ix < 12; ++ix)
      for (int jy = -60; jy <= 60; ++jy)
        for (int jx = -60; jx <= 60; ++jx)
          expected[iy * 12 + ix] += kernel(jx * grid.dx, lengths[0]) * kernel(jy * grid.dy, lengths[1])
                                    * noise[((iy + jy + 170) % 17) * 12 + (ix + jx + 120) % 12];
  normalise(expected);
  for (std::size_t i = 0; i < field.size(); ++i)
    EXPECT_NEAR(field[i], expected[i], 1e-8); // the kernel is cut where it is below 1e-9
}

TEST(GeneratedSurface, GaussianMapHasThePrescribedAutocorrelation)
{
  // 666 x 666 pixels of 3 um, l = 24 um (8 pixels): area A = (1998 um)^2, A/(pi l^2) = 2206. Bartlett's formula for a
  // Gaussian field with autocorrelation r: var C(t) = 1/A int [r^2 + r(x+t) r(x-t) + 2 r(t)^2 r^2 - 4 r(t) r r(x-t)]
  // dx, which at t = l is (1 + e^-1 + 2 e^-1 - 4 e^-0.75)/2206: standard deviation 0.0099. Four of them are allowed.
  const auto            map   = make(gaussian(666, 42, "24 um"));
  const double          bound = 4 * 0.0099;
  const Autocorrelation acf(map);
  EXPECT_NEAR(acf(8, 0), std::exp(-0.5), bound);
  EXPECT_NEAR(acf(0, 8), std::exp(-0.5), bound);
  // C = 0.2 at l sqrt(2 ln 5) = 1.794 l = 43.06 um. The slope there is -0.2 * 1.794 / l and the standard deviation of C
  // at most sqrt(1/2206) = 0.021, so that of the length at most 1.4 um.
  const auto r = roughness(map);
  const auto s = spatial_parameters(map);
  ASSERT_TRUE(s.length_x && s.length_y);
  EXPECT_NEAR(*s.length_x, 43.06e-3, 4 * 1.4e-3);
  EXPECT_NEAR(*s.length_y, 43.06e-3, 4 * 1.4e-3);
  // var Ssk = 6 int r^3 / A = 4/2206: 0.0426; var Sku = 24 int r^4 / A = 12/2206: 0.0738.
  EXPECT_NEAR(r.ssk, 0., 4 * 0.0426);
  EXPECT_NEAR(r.sku, 3., 4 * 0.0738);
}

TEST(GeneratedSurface, TwoCorrelationLengthsGiveALay)
{
  // Ground tool: 60 um along the lay, 6 um across: A/(pi lx ly) = 3530 on 666 pixels of 3 um, bound as above: 4 *
  // 0.0078 (Bartlett scales with the product of the lengths).
  const auto            map = make(gaussian(666, 5, "60 um, 6 um"));
  const Autocorrelation acf(map);
  EXPECT_NEAR(acf(20, 0), std::exp(-0.5), 4 * 0.0078);
  EXPECT_NEAR(acf(0, 2), std::exp(-0.5), 4 * 0.0078);
}

TEST(GeneratedSurface, GaussianSaFollowsFromSq)
{
  // Sa = sqrt(2/pi) Sq for Gaussian heights. Sampling: the Hermite terms of |z| of order 4 and 6 (order 2 is removed by
  // the scaling to Sq) give var = (2/pi) [24/24^2 int r^4 + 9 * 720/720^2 int r^6] / A, with int r^n = 2 pi l^2 / n and
  // A/(pi l^2) = 2206: 0.0027 for one map (over seeds 0 to 399 it is 0.0029). The mean of eight maps, four deviations.
  double sum = 0;
  for (int seed = 11; seed < 19; ++seed)
    {
      const auto r = roughness(make(gaussian(666, seed, "24 um")));
      sum += r.sa / r.sq;
    }
  EXPECT_NEAR(sum / 8, std::sqrt(2 / pi), 4 * 0.0029 / std::sqrt(8.));
}

TEST(GeneratedSurface, BimodalMapHasPlateausAndCraters)
{
  const auto map = make(bimodal(666, 42));
  const auto r   = roughness(map);
  // More plateau than crater means a tail towards the valleys, and two levels a kurtosis below the Gaussian's 3.
  // Expected values: moments of tanh(2.2 (g + b)) + 0.12 r over the normal distribution of g and r.
  double       m[5] = { 0, 0, 0, 0, 0 };
  const double b = 0.34995, n = 20000; // Phi(0.34995) = 0.6368
  double       mean = 0, weight = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (int i = 0; i < n; ++i)
      {
        const double g = -8 + 16 * (i + 0.5) / n, density = std::exp(-0.5 * g * g) / std::sqrt(2 * pi) * 16 / n;
        const double t = std::tanh(2.2 * (g + b));
        if (pass == 0)
          {
            mean += density * t;
            weight += density;
          }
        else
          for (int k = 2; k <= 4; ++k)
            m[k] += density * std::pow(t - mean, k);
      }
  ASSERT_NEAR(weight, 1., 1e-12);
  const double fine = 0.12 * 0.12, variance = m[2] + fine;
  const double ssk = m[3] / std::pow(variance, 1.5),
               sku = (m[4] + 6 * m[2] * fine + 3 * fine * fine) / (variance * variance);
  // Standard deviation over seeds 0 to 199 of this surface: Ssk 0.0258, Sku 0.0299. Four of them are allowed.
  EXPECT_LT(r.ssk, 0.);
  EXPECT_NEAR(r.ssk, ssk, 4 * 0.0258);
  EXPECT_NEAR(r.sku, sku, 4 * 0.0299);
  EXPECT_LT(r.sku, 2.);
}

TEST(GeneratedSurface, BimodalHistogramHasTwoMaxima)
{
  const auto h      = height_histogram(make(bimodal(666, 42)), 40);
  const auto valley = [&](double from, double to) { // smallest density between two heights [um]
    double lowest = 1e300;
    for (unsigned i = 0; i < 40; ++i)
      if (const double z = 0.5 * (h.edges[i] + h.edges[i + 1]); z > from && z < to)
        lowest = std::min(lowest, h.density[i]);
    return lowest;
  };
  const auto upper  = std::max_element(h.density.begin() + 20, h.density.end());
  const auto lower  = std::max_element(h.density.begin(), h.density.begin() + 20);
  const auto height = [&](auto it) { return h.edges[it - h.density.begin()]; };
  // Plateau level above the mean, crater floor below, and clearly fewer heights between them.
  EXPECT_GT(height(upper), 0.5);
  EXPECT_LT(height(lower), -1.);
  EXPECT_LT(valley(height(lower), height(upper)), 0.5 * *lower);
  EXPECT_GT(*upper, *lower); // more plateau than crater
}

TEST(GeneratedSurface, SmoothIsAnEmptyMap)
{
  const auto map = make("set Model = smooth\n");
  EXPECT_EQ(map.size(), 0u);
  EXPECT_EQ(map.nx, 0u);
  EXPECT_TRUE(map.z.empty());
}

TEST(GeneratedSurface, WrongEntriesAreNamed)
{
  const struct
  {
    std::string text, expected;
  } cases[] = {
    { gaussian(128, 1, "200 um"), "quarter of the map" },
    { gaussian(128, 1, "2 um"), "below the pixel size" },
    { gaussian(128, 1, "24 um, 12 um, 3 um"), "3 values are given" },
    { gaussian(128, 1, "24"), "Correlation length" },
    { gaussian(8, 1, "24 um"), "Pixels" },
    { gaussian(128, -1, "24 um"), "Seed" },
    { "set Model = generate\n", "generated" },
    { "set Model = generated\nsubsection Generated\nset Texture = gaussian\nend\n", "Generated/Pixels" },
    { generated("gaussian", common(128, "1.56 mm", 1), "set Correlation length = 24 um\n"), "Generated/Sq" },
    { gaussian(128, 1, "24 um") + "subsection Processing\nset Form = tilt\nend\n", "Processing/Form" },
  };
  for (const auto &c : cases)
    EXPECT_NE(problems_of(c.text).find(c.expected), std::string::npos)
        << c.expected << " not in: " << problems_of(c.text);
}

TEST(GeneratedSurface, DocumentationNamesEveryEntry)
{
  auto parameters = Parameters::for_documentation();
  read_surface(parameters);
  for (const std::string path :
       { "Model", "Processing/Form", "Generated/Texture", "Generated/Pixels", "Generated/Pixel size", "Generated/Sq",
         "Generated/Seed", "Generated/Gaussian/Correlation length", "Generated/Bimodal/Plateau area fraction",
         "File/Path", "File/Pixel size", "File/Height unit" })
    EXPECT_TRUE(std::any_of(parameters.entries().begin(), parameters.entries().end(), [&](const EntryInfo &info) {
      return info.path == path;
    })) << path;
}
