// Fourier transform and Gaussian filter against their definitions.
#include <tribodraw/surface/fourier.h>
#include <tribodraw/surface/gaussian_filter.h>
#include <tribodraw/surface/random_field.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace tribodraw;

namespace
{
  constexpr double pi = 3.14159265358979323846;
  using Complex       = std::complex<double>;

  std::vector<Complex>
  noise(std::size_t n)
  {
    NormalDeviates       deviates(5);
    std::vector<Complex> values(n);
    for (auto &v : values)
      v = { deviates(), deviates() };
    return values;
  }

  HeightMap
  map_of(std::size_t nx, std::size_t ny, bool periodic)
  {
    HeightMap map;
    map.nx = nx;
    map.ny = ny;
    map.dx = map.dy = 1e-3;
    map.periodic    = periodic;
    map.z.resize(map.size());
    return map;
  }
} // namespace

TEST(Fourier, EqualsItsDefinitionForEveryKindOfLength)
{
  // 1 and 2: degenerate; 60 = 2^2*3*5; 49 = 7^2 (general butterfly); 101 and 2 * 103: prime factors above 100
  // (Bluestein).
  for (const std::size_t n : { 1, 2, 60, 49, 101, 206 })
    {
      const auto       input  = noise(n);
      auto             values = input;
      FourierTransform transform(n);
      transform.forward(values.data());
      for (std::size_t k = 0; k < n; ++k)
        {
          Complex sum = 0;
          for (std::size_t j = 0; j < n; ++j)
            sum += input[j] * std::polar(1., -2. * pi * static_cast<double>(j * k % n) / static_cast<double>(n));
          EXPECT_NEAR(std::abs(values[k] - sum), 0., 1e-12 * static_cast<double>(n)) << n << ' ' << k;
        }
      transform.inverse(values.data());
      for (std::size_t j = 0; j < n; ++j)
        EXPECT_NEAR(std::abs(values[j] - input[j]), 0., 1e-13) << n << ' ' << j;
    }
}

TEST(Fourier, RowsReturnAndGoodLengthsHaveSmallFactors)
{
  const auto          values = noise(7 * 12); // 7 rows (an odd number: the last has no partner) of 12 values
  std::vector<double> rows;
  for (const auto &v : values)
    rows.push_back(v.real());
  for (const std::size_t px : { 12, 15, 16 })
    {
      const auto back = inverse_transform_rows(transform_rows(rows, 12, 7, 0., px, 7), 12);
      for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_NEAR(back[i], rows[i], 1e-14);
    }
  EXPECT_EQ(FourierTransform::good_length(1), 1u);
  EXPECT_EQ(FourierTransform::good_length(7), 8u);
  EXPECT_EQ(FourierTransform::good_length(121), 125u);
}

TEST(GaussianFilter, HalvesAWaveOfTheCutOff)
{
  // ISO 16610-61: transmission exp(-pi (alpha c / wavelength)^2), alpha^2 = ln 2 / pi, that is 2^-(c/wavelength)^2,
  // here 1/2 along x, 2^-(1/4) for twice the wavelength along y, both for the product of the two. Short (direct sum)
  // and long kernel (transform). Truncating the kernel at c leaves out erfc(pi / sqrt(ln 2)) = 1e-7; sampling is exact
  // to 1e-9.
  for (const std::size_t wave : { 20, 100 })
    {
      auto       map    = map_of(4 * wave, 4 * wave, true);
      const auto factor = [&](std::size_t ix, std::size_t iy) {
        return std::cos(2 * pi * static_cast<double>(ix) / static_cast<double>(wave))
               * std::cos(pi * static_cast<double>(iy) / static_cast<double>(wave));
      };
      for (std::size_t iy = 0; iy < map.ny; ++iy)
        for (std::size_t ix = 0; ix < map.nx; ++ix)
          map(ix, iy) = factor(ix, iy);
      gaussian_low_pass(map, static_cast<double>(wave) * map.dx);
      for (const auto &[ix, iy] : { std::pair(0, 0), std::pair(3, 5), std::pair(int(wave), 2 * int(wave)) })
        EXPECT_NEAR(map(ix, iy), std::pow(2., -1.25) * factor(ix, iy), 1e-6) << wave;
      EXPECT_TRUE(map.periodic);
    }
}

TEST(GaussianFilter, EqualsTheWeightedMeanAtTheBordersOfAnOpenMap)
{
  // Definition summed directly: sum of w(x) w(y) z over the existing points, divided by the sum of their weights.
  // Kernels within the direct sum (7.5 pixels), the transform (45 pixels) and longer than the line (90 pixels).
  for (const double cut_off : { 7.5, 45., 90. })
    {
      auto           map = map_of(61, 50, false);
      NormalDeviates deviates(2);
      for (double &z : map.z)
        z = deviates();
      const auto old    = map;
      const auto weight = [&](std::ptrdiff_t k) {
        const double x = static_cast<double>(k) / cut_off;
        return std::abs(x) <= 1. ? std::exp(-pi * pi / std::log(2.) * x * x) : 0.;
      };
      gaussian_low_pass(map, cut_off * map.dx);
      for (const auto &[ix, iy] : { std::pair(0, 0), std::pair(60, 49), std::pair(30, 25), std::pair(2, 40) })
        {
          double sum = 0, weights = 0;
          for (int jy = 0; jy < 50; ++jy)
            for (int jx = 0; jx < 61; ++jx)
              {
                const double w = weight(jx - ix) * weight(jy - iy);
                sum += w * old(jx, jy);
                weights += w;
              }
          EXPECT_NEAR(map(ix, iy), sum / weights, 1e-13) << cut_off << ' ' << ix << ' ' << iy;
        }
    }
}
