#include <tribodraw/base/errors.h>
#include <tribodraw/tools/motion.h>

#include <gtest/gtest.h>

#include <limits>

using namespace tribodraw;

TEST(Motion, ConstantSpeedReachesItsTravel)
{
  // 58 mm at 60 mm/s take 58/60 s.
  const Motion motion = Motion::constant_speed(60, -58);
  EXPECT_DOUBLE_EQ(motion.end_time(), 58. / 60);
  EXPECT_EQ(motion.position(-1), 0);
  EXPECT_DOUBLE_EQ(motion.position(0.5), -30);
  EXPECT_EQ(motion.position(10), -58);
  EXPECT_DOUBLE_EQ(motion.velocity(0.2), -60);
  EXPECT_EQ(motion.velocity(motion.end_time()), 0);
  EXPECT_EQ(motion.velocity(-0.1), 0);
}

TEST(Motion, TableIsPiecewiseLinear)
{
  const Motion motion({ 0, 1, 3, 4 }, { 0, 10, 10, -2 });
  EXPECT_DOUBLE_EQ(motion.position(0.25), 2.5);
  EXPECT_DOUBLE_EQ(motion.position(2), 10);
  EXPECT_DOUBLE_EQ(motion.position(3.5), 4);
  EXPECT_DOUBLE_EQ(motion.velocity(0), 10); // right-sided at the points
  EXPECT_DOUBLE_EQ(motion.velocity(1), 0);
  EXPECT_DOUBLE_EQ(motion.velocity(3), -12);
  EXPECT_EQ(motion.breakpoints(), (std::vector<double>{ 0, 1, 3, 4 }));
}

TEST(Motion, VelocityIsTheDerivativeOfThePosition)
{
  const Motion motion({ 0, 0.5, 1.5, 2 }, { 0, 3, -1, 5 });
  for (const double t : { 0.1, 0.4, 0.7, 1.2, 1.6, 1.9 })
    EXPECT_NEAR((motion.position(t + 1e-6) - motion.position(t - 1e-6)) / 2e-6, motion.velocity(t), 1e-8);
}

TEST(Motion, WrongTablesAreRefused)
{
  EXPECT_THROW(Motion({ 0 }, { 0 }), InputError);
  EXPECT_THROW(Motion({ 0, 1 }, { 0, 1, 2 }), InputError);
  EXPECT_THROW(Motion({ 0, 1, 1 }, { 0, 1, 2 }), InputError);
  EXPECT_THROW(Motion({ 0, std::numeric_limits<double>::quiet_NaN() }, { 0, 1 }), InputError);
  EXPECT_THROW(Motion::constant_speed(0, 58), InputError);
  EXPECT_THROW(Motion::constant_speed(60, 0), InputError);
}
