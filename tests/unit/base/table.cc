#include <tribodraw/base/errors.h>
#include <tribodraw/base/table.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

// Multilinear interpolation reproduces multilinear functions exactly.
TEST(Table, ReproducesTrilinearFunctions)
{
  const Axis x{{0, 1, 3}}, y{{-1, 2}}, z{{0, 0.5, 2, 4}};
  const auto f = [](double a, double b, double c) { return 1 + 2 * a - b + 3 * a * c + a * b * c; };
  std::vector<double> values;
  for (double a : x.points)
    for (double b : y.points)
      for (double c : z.points)
        values.push_back(f(a, b, c));
  const Table<3>        table({x, y, z}, values);
  std::array<double, 3> gradient;
  EXPECT_NEAR(table.value({0.7, 0.1, 1.3}, gradient), f(0.7, 0.1, 1.3), 1e-14);
  EXPECT_NEAR(gradient[0], 2 + 3 * 1.3 + 0.1 * 1.3, 1e-13);
  EXPECT_NEAR(gradient[1], -1 + 0.7 * 1.3, 1e-13);
  EXPECT_NEAR(gradient[2], 3 * 0.7 + 0.7 * 0.1, 1e-13);
  EXPECT_NEAR(table.value({3, 2, 4}), f(3, 2, 4), 1e-13);
  EXPECT_FALSE(table.outside({3, 2, 4}));
}

TEST(Table, LogarithmicAxisIsExactForLogarithms)
{
  const Axis     p{{0.1, 1, 100}, AxisScale::logarithmic};
  const Table<1> table({p}, {std::log(0.1), 0., std::log(100.)});
  std::array<double, 1> gradient;
  EXPECT_NEAR(table.value({7.}, gradient), std::log(7.), 1e-14);
  EXPECT_NEAR(gradient[0], 1. / 7., 1e-14);
}

TEST(Table, ClampsAndReportsOutside)
{
  const Table<1>        table({Axis{{0, 1}}}, {2, 5});
  std::array<double, 1> gradient;
  EXPECT_EQ(table.value({-1}, gradient), 2);
  EXPECT_EQ(gradient[0], 0);
  EXPECT_EQ(table.value({9}), 5);
  EXPECT_TRUE(table.outside({9}));
  const Table<2> one_line({Axis{{3}}, Axis{{0, 1}}}, {2, 5});
  EXPECT_EQ(one_line.value({77, 0.5}), 3.5);
}

TEST(Table, BadAxesAreNamed)
{
  EXPECT_THROW((Axis{{0, 0}}).check("p"), InputError);
  EXPECT_THROW((Axis{{0, NAN}}).check("p"), InputError);
  EXPECT_THROW((Axis{{0, 1}, AxisScale::logarithmic}).check("p"), InputError);
  EXPECT_THROW((Axis{}).check("p"), InputError);
  EXPECT_THROW((Table<1>({Axis{{0, 1}}}, {1})), InputError);
}
