#include <tribodraw/friction_table/monotone_curve.h>

#include <gtest/gtest.h>

#include <cmath>

using tribodraw::MonotoneCurve;

TEST(MonotoneCurve, GoesThroughItsPointsAndStaysBetweenThem)
{
  const std::vector<double> x{ 0., 1., 1.5, 4., 5., 5.1 }, y{ 0., 0., 3., 3.1, 2., -1. };
  const MonotoneCurve       curve(x, y);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_DOUBLE_EQ(curve(x[i]), y[i]);
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    {
      double previous = y[i];
      for (unsigned int j = 0; j <= 100; ++j)
        {
          const double value = curve(x[i] + (x[i + 1] - x[i]) * j / 100.);
          EXPECT_GE((value - previous) * (y[i + 1] - y[i]), 0.) << "interval " << i;
          EXPECT_LE(std::abs(value - previous), 0.1 * std::abs(y[i + 1] - y[i]) + 1e-15); // no jump
          previous = value;
        }
    }
  EXPECT_EQ(curve(-1.), 0.);
  EXPECT_EQ(curve(9.), -1.);
  EXPECT_EQ(MonotoneCurve({ 2. }, { 7. })(1.), 7.);
}

// Harmonic mean slopes are second order, hence the curve is third order in the middle of a monotone function.
TEST(MonotoneCurve, ConvergesWithThirdOrder)
{
  double previous = 0;
  for (const unsigned int n : { 10, 20, 40, 80 })
    {
      std::vector<double> x, y;
      for (unsigned int i = 0; i <= n; ++i)
        {
          x.push_back(static_cast<double>(i) / n);
          y.push_back(std::exp(-2. * x.back()));
        }
      const MonotoneCurve curve(x, y);
      double              error = 0;
      for (double t = 0.2; t < 0.8; t += 0.001)
        error = std::max(error, std::abs(curve(t) - std::exp(-2. * t)));
      if (previous > 0)
        {
          EXPECT_GT(std::log2(previous / error), 2.8) << n;
        }
      previous = error;
    }
}
