#include <tribodraw/base/errors.h>
#include <tribodraw/tools/drawing_tools.h>
#include <tribodraw/tools/placement.h>
#include <tribodraw/tools/plane.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;
using Eigen::Vector3d;

namespace
{
  // NUMISHEET'93 square cup: punch 70 x 70, corner 10, edge 8; die 74 x 74, corner 12, edge 5.
  const DrawingPunch punch(std::make_shared<RoundedRectangleOutline>(35, 35, 10), 8);
  const DrawingDie   die(std::make_shared<RoundedRectangleOutline>(37, 37, 12), 5);
  const Plane        plate(Facing::up);

  const Vector3d up(0, 0, 1), down(0, 0, -1);

  double
  touching_height(const PlacedTool &tool, const Vector3d &direction, const std::vector<Vector3d> &nodes,
                  const double half_thickness)
  {
    const auto place = touching_place(tool, direction, nodes, half_thickness);
    return place ? (*place)[2] : std::nan("");
  }

  std::vector<Vector3d>
  quarter_blank(const double spacing)
  {
    std::vector<Vector3d> nodes;
    for (double x = 0; x <= 75; x += spacing)
      for (double y = 0; y <= 75; y += spacing)
        nodes.emplace_back(x, y, 0);
    return nodes;
  }
} // namespace

TEST(Placement, AMirroredToolIsItsReflection)
{
  const PlacedTool above{ &die, { 0, 0, 3 }, true }, below{ &die, { 0, 0, -3 }, false };
  for (const Vector3d &x : { Vector3d(39, 10, -1), Vector3d(41, 41, 4), Vector3d(60, 3, 2) })
    {
      const ToolDistance a = above.distance(x), b = below.distance({ x[0], x[1], -x[2] });
      const Vector3d     turn(1, 1, -1);
      EXPECT_EQ(a.distance, b.distance);
      EXPECT_EQ(a.normal, Vector3d(turn.cwiseProduct(b.normal)));
      EXPECT_EQ(a.curvature, Eigen::Matrix3d(turn.asDiagonal() * b.curvature * turn.asDiagonal()));
    }
}

TEST(Placement, FlatFacesTouchAtHalfTheThickness)
{
  const auto blank = quarter_blank(2.5);
  EXPECT_NEAR(touching_height({ &die, { 0, 0, 0 }, false }, up, blank, 0.39), -0.39, 1e-8);
  EXPECT_NEAR(touching_height({ &punch, { 0, 0, 0 }, false }, down, blank, 0.39), 0.39, 1e-8);
  EXPECT_NEAR(touching_height({ &die, { 0, 0, 0 }, true }, down, blank, 0.39), 0.39, 1e-8);
}

TEST(Placement, ARoundEdgeTouchesLaterThanItsLowestPoint)
{
  // Nodes from x = 30 on: the punch's face ends at 27, its edge has radius 8 about (27, z + 8). The node at x = 30 is
  // touched at half thickness t when hypot(3, z + 8) = 8 + t below the centre: z = sqrt((8 + t)^2 - 9) - 8.
  std::vector<Vector3d> nodes;
  for (double x = 30; x < 60; x += 1)
    nodes.emplace_back(x, 0, 0);
  const double t = 0.4;
  EXPECT_NEAR(touching_height({ &punch, { 0, 0, 0 }, false }, down, nodes, t), std::sqrt(8.4 * 8.4 - 9) - 8, 1e-8);
  // The opening of the die is 74 wide: nodes inside of it are never touched.
  EXPECT_FALSE(touching_place({ &die, { 0, 0, 0 }, false }, up, { Vector3d(0, 0, 0), Vector3d(20, 0, 0) }, t));
}

TEST(Placement, AToolMayComeAlongAnyDirection)
{
  // A punch beside the blank moves in x against its edge at x = 75: the wall at 35 mm from its axis, 1 mm before.
  const PlacedTool beside{ &punch, { 500, 0, -20 }, false };
  const auto       place = touching_place(beside, { -1, 0, 0 }, quarter_blank(2.5), 1);
  ASSERT_TRUE(place);
  EXPECT_LT((*place - Vector3d(111, 0, -20)).norm(), 1e-8);
}

TEST(Placement, AToolThatFacesTheOtherWayIsExplained)
{
  try
    {
      touching_place({ &plate, { 0, 0, 0 }, false }, down, quarter_blank(5), 0.4);
      FAIL() << "not noticed";
    }
  catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find("on the side of the blank"), std::string::npos) << e.what();
    }
}

TEST(Placement, PenetrationOfTheFlatBlank)
{
  const auto blank = quarter_blank(5);
  // Half the thickness 0.39 and 0.1 mm lower than in touch.
  EXPECT_NEAR(initial_penetration({ &punch, { 0, 0, 0.29 }, false }, blank, 0.39), 0.1, 1e-12);
  EXPECT_NEAR(initial_penetration({ &punch, { 0, 0, 1 }, false }, blank, 0.39), -0.61, 1e-12);
  // 0.2 mm higher than the lower face at -0.39.
  EXPECT_NEAR(initial_penetration({ &die, { 0, 0, 0.2 }, false }, blank, 0.39), 0.59, 1e-12);
}

TEST(Placement, SmallestClearanceOfTheCup)
{
  const Vector3d  low(0, 0, -60), high(80, 80, 20);
  const Clearance deep
      = smallest_clearance({ &die, { 0, 0, 0 }, false }, { &punch, { 0, 0, -40 }, false }, low, high, 1);
  EXPECT_NEAR(deep.gap, 2, 1e-6); // walls at 35 and 37
  // Punch still above: the face's edge at height 10 over the die's edge. Both are quarter circles: centres at
  // (42, -5) and (27, 18), distance less the radii 5 and 8.
  const Clearance above
      = smallest_clearance({ &die, { 0, 0, 0 }, false }, { &punch, { 0, 0, 10 }, false }, low, high, 1);
  EXPECT_NEAR(above.gap, std::hypot(15, 23) - 13, 1e-4);
  // A punch of 80 mm overlaps by 3 mm in plan.
  const DrawingPunch wide(std::make_shared<RoundedRectangleOutline>(40, 40, 15), 8);
  EXPECT_NEAR(smallest_clearance({ &die, { 0, 0, 0 }, false }, { &wide, { 0, 0, -40 }, false }, low, high, 1).gap, -3,
              1e-6);
  // Holder and die, flat on flat.
  EXPECT_NEAR(smallest_clearance({ &die, { 0, 0, 0 }, false }, { &die, { 0, 0, 0.78 }, true }, low, high, 1).gap, 0.78,
              1e-9);
}

TEST(Placement, SearchForTheGapOfLargeToolsIsBounded)
{
  // Flat on flat, where no cell is better than another: two tools of a press for panels and of one for ships.
  for (const double side : { 400., 40000. })
    {
      const Clearance gap = smallest_clearance({ &plate, { 0, 0, 0 }, false }, { &plate, { 0, 0, 0.78 }, true },
                                               Vector3d(0, 0, -50), Vector3d(side, side, 50), 0.5);
      EXPECT_NEAR(gap.gap, 0.78, 1e-9) << side;
      EXPECT_LT(gap.n_points, 1000000u) << side; // 0.5 mm everywhere would be 6.4e9 on the larger plate
    }
}

TEST(Placement, ElementsOnARadius)
{
  EXPECT_NEAR(elements_on_smallest_radius(die, 2.5), M_PI, 1e-12); // 5 mm pi/2 / 2.5 mm
  EXPECT_TRUE(std::isinf(elements_on_smallest_radius(plate, 2.5)));
}
