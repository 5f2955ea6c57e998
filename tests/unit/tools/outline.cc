#include <tribodraw/base/errors.h>
#include <tribodraw/tools/outline.h>

#include <gtest/gtest.h>

#include <random>

using namespace tribodraw;
using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace
{
  const CircleOutline           circle(30);
  const RoundedRectangleOutline rectangle(35, 20, 10);
  // The outline of prm/cross_die.prm. Half width + fillet equals reach - corner: the limit case.
  const CrossOutline cross(80, 35, 20, 25);
  // Longer arms: the straight sides between fillet and corner exist.
  const CrossOutline long_cross(100, 30, 12, 15);

  const std::vector<const Outline *> outlines{ &circle, &rectangle, &cross, &long_cross };
} // namespace

TEST(Outline, DistancesOfPointsReadOffTheDrawing)
{
  EXPECT_NEAR(circle.distance({ 0, 42 }).distance, 12, 1e-13);
  EXPECT_NEAR(rectangle.distance({ -40, 0 }).distance, 5, 1e-13);
  EXPECT_NEAR(rectangle.distance({ 0, 18 }).distance, -2, 1e-13);
  // Corner centre (25, 10); point 3-4-5 away from it, radius 10: 5 - 10.
  EXPECT_NEAR(rectangle.distance({ 28, 14 }).distance, -5, 1e-13);
  EXPECT_NEAR(cross.distance({ 83, 5 }).distance, 3, 1e-13);
  EXPECT_NEAR(cross.distance({ -5, -78 }).distance, -2, 1e-13);
  // Corner arc about (60, 15), radius 20; point at (60, 15) + (18, 24), 30 away.
  EXPECT_NEAR(cross.distance({ 78, 39 }).distance, 10, 1e-13);
  // Fillet arc about (60, 60), radius 25; point at (60, 60) - (6, 8) is 10 away from the centre, outside the cross.
  EXPECT_NEAR(cross.distance({ 54, 52 }).distance, 15, 1e-13);
  // The centre of the cross: to the fillets sqrt(2) 60 - 25 = 59.85, nearer than the tips at 80.
  EXPECT_NEAR(cross.distance({ 0, 0 }).distance, 25 - std::sqrt(2.) * 60, 1e-13);
  EXPECT_NEAR(long_cross.distance({ 60, 33 }).distance, 3, 1e-13);
}

TEST(Outline, GradientAndHessianAreTheDerivatives)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> coordinate(-130, 130);
  const double                           h = 1e-5;
  for (const Outline *outline : outlines)
    {
      int checked = 0;
      for (int i = 0; i < 20000; ++i)
        {
          const Vector2d     x(coordinate(random), coordinate(random));
          const PlanDistance d = outline->distance(x);
          EXPECT_NEAR(d.gradient.norm(), 1, 1e-13);
          // Near the curve, half a radius from the medial axis, where the contact search works.
          if (std::abs(d.distance)
              > 0.5 * std::min(outline->smallest_convex_radius(), outline->smallest_concave_radius()))
            continue;
          Vector2d gradient;
          Matrix2d hessian, change;
          for (int k = 0; k < 2; ++k)
            {
              const Vector2d     e = h * Vector2d::Unit(k);
              const PlanDistance a = outline->distance(x - e), b = outline->distance(x + e);
              gradient[k]    = (b.distance - a.distance) / (2 * h);
              hessian.col(k) = (b.gradient - a.gradient) / (2 * h);
              change.col(k)  = (b.hessian - a.hessian).col(k);
            }
          // Central differences: error h^2/6 times the third derivative (< 1/mm^2) plus rounding 1e-14/h.
          EXPECT_LT((gradient - d.gradient).norm(), 1e-8);
          // The curvature jumps where line and arc meet.
          if (change.norm() < 1e-4)
            {
              EXPECT_LT((hessian - d.hessian).norm(), 1e-6);
              ++checked;
            }
        }
      EXPECT_GT(checked, 200) << outline->describe();
    }
}

TEST(Outline, IsSymmetric)
{
  std::mt19937                           random(2);
  std::uniform_real_distribution<double> coordinate(0, 130);
  for (const Outline *outline : outlines)
    for (int i = 0; i < 500; ++i)
      {
        const Vector2d     x(coordinate(random), coordinate(random));
        const PlanDistance d = outline->distance(x);
        for (const Vector2d &sign : { Vector2d(-1, 1), Vector2d(1, -1), Vector2d(-1, -1) })
          {
            const PlanDistance m = outline->distance(sign.cwiseProduct(x));
            const Matrix2d     s = sign.asDiagonal();
            EXPECT_EQ(m.distance, d.distance);
            EXPECT_EQ(m.gradient, s * d.gradient);
            EXPECT_EQ(m.hessian, s * d.hessian * s);
          }
      }
}

TEST(Outline, OffsetIsTheParallelCurve)
{
  // Distance to the parallel curve at clearance c is the distance less c, outside the medial axis of the smaller one.
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> coordinate(-110, 110);
  const double                           clearance = 1.5;
  for (const Outline *outline : outlines)
    {
      const auto wider = outline->offset(clearance);
      for (int i = 0; i < 2000; ++i)
        {
          const Vector2d x(coordinate(random), coordinate(random));
          EXPECT_NEAR(wider->distance(x).distance, outline->distance(x).distance - clearance, 1e-12)
              << outline->describe() << " at " << x.transpose();
        }
      EXPECT_DOUBLE_EQ(wider->smallest_convex_radius(), outline->smallest_convex_radius() + clearance);
    }
  // Re-entrant corners become sharper.
  EXPECT_DOUBLE_EQ(cross.offset(clearance)->smallest_concave_radius(), 23.5);
}

TEST(Outline, ImpossibleOutlinesAreRefusedWithTheNumbers)
{
  const auto message = [](const auto &make) -> std::string {
    try
      {
        make();
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "no error";
  };
  // 35 + 26 = 61 > 80 - 20 = 60: the fillet runs into the corner.
  const std::string overlap = message([] { CrossOutline(80, 35, 20, 26); });
  EXPECT_NE(overlap.find("arms are too short"), std::string::npos) << overlap;
  EXPECT_NE(overlap.find("61 mm"), std::string::npos) << overlap;
  EXPECT_NE(overlap.find("60 mm"), std::string::npos) << overlap;
  EXPECT_NE(message([] { CrossOutline(80, 18, 20, 10); }).find("0 to 18 mm"), std::string::npos);
  EXPECT_NE(message([] { cross.offset(25); }).find("fillet radius"), std::string::npos);
  EXPECT_NE(message([] { RoundedRectangleOutline(35, 8, 10); }).find("0 to 8 mm"), std::string::npos);
  EXPECT_NE(message([] { CircleOutline(0); }).find("radius must be positive"), std::string::npos);
}

TEST(Outline, EqualityInTheConditionsSurvivesRounding)
{
  // The limit case of the cross, moved by clearances that are not exact in binary.
  for (const double clearance : { 0.1, 0.3, 0.7, 1.1, 1.3 })
    EXPECT_NO_THROW(cross.offset(clearance));
}
