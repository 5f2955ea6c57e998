#include "paper_material.h"

#include <tribodraw/material/forming_limit.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  std::unique_ptr<FormingLimitCurve>
  abspoel_scholting(const int A80)
  {
    const std::string a = std::to_string(A80) + " %\n";
    return paper::make<FormingLimitCurve>("Abspoel-Scholting",
                                          "set R value = 2.21\nset Thickness = 0.82 mm\nset Elongation A80 = " + a
                                              + "set Smallest elongation A80 = " + a);
  }
} // namespace

// DC04, 0.82 mm, R90 = 2.21: points (minor, major) of an independent evaluation of the published formulas, four digits.
TEST(AbspoelScholting, points_of_dc04)
{
  const int    A80[]   = { 38, 40, 42, 44 };
  const double te[][2] = { { -.3955, .6800 }, { -.4079, .7015 }, { -.4202, .7226 }, { -.4322, .7432 } };
  const double ps[]    = { .3076, .3238, .3399, .3561 };
  const double im[][2] = { { .2978, .3971 }, { .3064, .4086 }, { .3150, .4200 }, { .3236, .4314 } };
  const double bi[]    = { .4205, .4295, .4385, .4474 };
  for (int i = 0; i < 4; ++i)
    {
      const auto curve = abspoel_scholting(A80[i]);
      // The minor strain of the reference is rounded too (slope of the curve up to one).
      EXPECT_NEAR(curve->limit(te[i][0]), te[i][1], 1e-4);
      EXPECT_NEAR(curve->limit(0), ps[i], 5.1e-5);
      EXPECT_NEAR(curve->limit(im[i][0]), im[i][1], 1e-4);
      EXPECT_NEAR(curve->limit(bi[i]), bi[i], 1e-4);
      EXPECT_NEAR(curve->limit(0.9), bi[i], 5.1e-5); // constant beyond
    }
}

TEST(AbspoelScholting, straight_between_the_points_and_beyond_uniaxial_tension)
{
  const auto   curve = abspoel_scholting(40);
  const double slope = (curve->limit(-.2) - curve->limit(0)) / -.2;
  EXPECT_NEAR(curve->limit(-.1), 0.5 * (curve->limit(0) + curve->limit(-.2)), 1e-14);
  EXPECT_NEAR(curve->limit(-1.), curve->limit(0) - slope, 1e-13);
  EXPECT_NEAR(forming_limit_margin(*curve, 0.5 * curve->limit(-.1), -.1), 0.5, 1e-15);
}

TEST(KeelerBrazier, plane_strain_and_left_side)
{
  const auto curve
      = paper::make<FormingLimitCurve>("Keeler-Brazier", "set Hardening exponent = 0.21\nset Thickness = 1 mm\n");
  EXPECT_NEAR(curve->limit(0), std::log(1.3743), 1e-14); // n = 0.21, t = 1 mm: ln(1 + 0.233 + 0.1413)
  EXPECT_NEAR(curve->limit(-.15), std::log(1.3743) + .15, 1e-14);
  EXPECT_NEAR(curve->limit(.15), std::log(1.3743), 1e-14);
}
