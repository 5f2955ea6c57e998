#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/tool_geometry.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;
using Eigen::Vector3d;

namespace
{
  const std::string die_entries = "subsection Cross die\n"
                                  "  set Arm reach = 80 mm\n"
                                  "  set Half arm width = 3.5 cm\n"
                                  "  set Convex corner radius = 20 mm\n"
                                  "  set Fillet radius = 25 mm\n"
                                  "  set Edge radius = 14 mm\n"
                                  "  set Clearance = 1.5 mm\n"
                                  "end\n";

  std::unique_ptr<ToolGeometry>
  read(const std::string &model, const std::string &entries, const std::vector<std::string> &overrides = {})
  {
    Parameters parameters = Parameters::from_text("set Model = " + model + "\n" + entries, "input", overrides);
    auto       tool       = parameters.model<ToolGeometry>("Model", "Shape of the tool.");
    parameters.finish();
    return tool;
  }

  std::string
  message(const std::string &model, const std::string &entries, const std::vector<std::string> &overrides = {})
  {
    try
      {
        read(model, entries, overrides);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "no error";
  }
} // namespace

TEST(ToolReading, DieOpeningIsThePunchOutlinePlusTheClearance)
{
  const auto die = read("cross die", die_entries);
  EXPECT_NEAR(die->distance({ 80, 0, -50 }).distance, 1.5, 1e-12);
  EXPECT_EQ(die->smallest_radius(), 14);
  EXPECT_NE(die->describe().find("reach 81.5 mm"), std::string::npos) << die->describe();
}

TEST(ToolReading, SquareCupTools)
{
  // NUMISHEET'93: the die 74 x 74 with corner radius 12 is the punch 70 x 70 with 10, moved out by 2 mm.
  const std::string outline = "set Width in x = 70 mm\nset Width in y = 70 mm\nset Corner radius = 10 mm\n";
  const auto        die
      = read("square die", "subsection Square die\n" + outline + "set Edge radius = 5 mm\nset Clearance = 2 mm\nend\n");
  EXPECT_NE(die->describe().find("74 x 74 mm, corner radius 12 mm"), std::string::npos) << die->describe();
  const auto punch = read("square punch", "subsection Square punch\n" + outline + "set Edge radius = 8 mm\nend\n");
  EXPECT_NEAR(punch->distance({ 36, 0, 20 }).distance, 1, 1e-12);
}

TEST(ToolReading, CylindricalTools)
{
  const auto punch = read("cylindrical punch",
                          "subsection Cylindrical punch\nset Diameter = 100 mm\nset Edge radius = 9.5 mm\nend\n");
  EXPECT_NEAR(punch->distance({ 30, 40, 20 }).distance, 0, 1e-12); // 3-4-5: on the wall
}

TEST(ToolReading, PlateFacesTheSheet)
{
  const std::string entries = "set Width in x = 40 mm\nset Width in y = 30 mm\nset Edge radius = 3 mm\nend\n";
  const auto        lower   = read("plate", "subsection Plate\nset Facing = up\n" + entries);
  EXPECT_NEAR(lower->distance({ 16, 11, 2 }).distance, 2, 1e-12);
  EXPECT_NEAR(lower->distance({ 0, 17, -8 }).distance, 2, 1e-12); // beside it: half width 15
  // Over the corner: torus of no ring, a sphere about (17, 12, -3).
  const Vector3d outwards = Vector3d(1, 1, 1).normalized();
  EXPECT_LT((lower->distance(Vector3d(17, 12, -3) + 4 * outwards).normal - outwards).norm(), 1e-12);
  const auto upper = read("plate", "subsection Plate\nset Facing = down\n" + entries);
  EXPECT_NEAR(upper->distance({ 16, 11, 2 }).distance, -2, 1e-12);
  const std::string text
      = message("plate", "subsection Plate\nset Facing = up\n" + entries, { "Plate/Edge radius = 16 mm" });
  EXPECT_NE(text.find("at most half of the smaller width, 15 mm"), std::string::npos) << text;
}

TEST(ToolReading, CylinderAndSphereTouchInTheOrigin)
{
  const auto pin = read("cylinder", "subsection Cylinder\nset Facing = up\nset Diameter = 20 mm\n"
                                    "set Axis angle = 90 deg\nend\n");
  EXPECT_NEAR(pin->distance({ 0, 55, 1.5 }).distance, 1.5, 1e-12);
  EXPECT_NEAR(pin->distance({ 8, -3, -4 }).distance, 0, 1e-12); // 6-8-10 from the axis at z = -10
  const auto skew = read("cylinder", "subsection Cylinder\nset Facing = down\nset Diameter = 20 mm\n"
                                     "set Axis angle = 45 deg\nend\n");
  EXPECT_NEAR(skew->distance({ 30, 30, 0 }).distance, 0, 1e-12); // along the axis
  EXPECT_NEAR(skew->distance({ 10, -10, 10 }).distance, std::sqrt(200.) - 10, 1e-12);
  const auto ball = read("sphere", "subsection Sphere\nset Facing = down\nset Diameter = 20 mm\nend\n");
  EXPECT_NEAR(ball->distance({ 3, 4, 10 }).distance, -5, 1e-12);
  EXPECT_NEAR(ball->distance({ 0, 0, -1 }).distance, 1, 1e-12);
}

TEST(ToolReading, HemisphericalPunchHasTheCurvatureOfItsPole)
{
  const auto punch = read("hemispherical punch", "subsection Hemispherical punch\nset Diameter = 101.6 mm\nend\n");
  const ToolDistance pole = punch->distance({ 0, 0, 0 }); // where the middle node of a blank touches
  EXPECT_NEAR(pole.distance, 0, 1e-12);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected(0, 0) = expected(1, 1) = 1 / 50.8;
  EXPECT_LT((pole.curvature - expected).norm(), 1e-12);
  EXPECT_NEAR(punch->distance({ 30.48, 40.64, 90 }).distance, 0, 1e-12); // 3-4-5 on the wall
}

TEST(ToolReading, UBendToolsAreEndlessInY)
{
  // NUMISHEET'93 2-D draw bending: punch 50, radius 5; opening 52 as the punch with 1 mm on each side; radius 5.
  const auto die   = read("U-bend die", "subsection U-bend die\nset Width = 50 mm\nset Edge radius = 5 mm\n"
                                          "set Clearance = 1 mm\nend\n");
  const auto punch = read("U-bend punch", "subsection U-bend punch\nset Width = 50 mm\nset Edge radius = 5 mm\nend\n");
  EXPECT_NEAR(die->distance({ 25, 300, -30 }).distance, 1, 1e-12);
  EXPECT_NEAR(punch->distance({ -26, -300, 30 }).distance, 1, 1e-12);
  // Centre of the die's edge at x = 31, z = -5.
  const double s = std::sqrt(0.5);
  EXPECT_LT((die->distance({ 31 - 5 * s, 7, -5 + 5 * s }).normal - Vector3d(-s, 0, s)).norm(), 1e-12);
}

TEST(ToolReading, BeadAndGrooveAlongAnOutline)
{
  const std::string line = "set Outline = Rectangle\nsubsection Rectangle\nset Width in x = 120 mm\n"
                           "set Width in y = 100 mm\nset Corner radius = 25 mm\nend\n";
  const auto        bead = read("draw bead", "subsection Draw bead\n" + line + "set Bead radius = 4 mm\nend\n");
  EXPECT_NEAR(bead->distance({ 60, 3, 1 }).distance, 1, 1e-12);
  EXPECT_NEAR(bead->distance({ 63, 0, 0 }).distance, 1, 1e-12); // 3-4-5 from the centre line at z = -4
  const auto groove = read("bead groove", "subsection Bead groove\n" + line
                                              + "set Groove width = 10 mm\nset Edge radius = 3 mm\nend\n");
  EXPECT_NEAR(groove->distance({ 80, 0, 2 }).distance, 2, 1e-12);
  EXPECT_NEAR(groove->distance({ 40, 0, 2 }).distance, 2, 1e-12);
  EXPECT_NEAR(groove->distance({ 62, 0, -20 }).distance, 3, 1e-12); // walls 5 mm from the line
  EXPECT_NEAR(groove->distance({ 57, 0, -20 }).distance, 2, 1e-12);
  // The bead of 4 mm and a sheet of 0.8 mm in the groove of 10 mm: 0.2 mm are left on each side.
  const std::string sharp = message("draw bead", "subsection Draw bead\n" + line + "set Bead radius = 26 mm\nend\n");
  EXPECT_NE(sharp.find("at most 25 mm"), std::string::npos) << sharp;
  const std::string wide = message("bead groove", "subsection Bead groove\n" + line
                                                      + "set Groove width = 46 mm\nset Edge radius = 3 mm\nend\n");
  EXPECT_NE(wide.find("at most 2 mm"), std::string::npos) << wide;
}

TEST(ToolReading, InvalidOutlineNamesSectionAndNumbers)
{
  const std::string text = message("cross die", die_entries, { "Cross die/Arm reach = 70 mm" });
  EXPECT_NE(text.find("Cross die"), std::string::npos) << text;
  EXPECT_NE(text.find("60 mm"), std::string::npos) << text; // half width + fillet
  EXPECT_NE(text.find("50 mm"), std::string::npos) << text; // reach - corner
  const std::string edge = message("cross die", die_entries, { "Cross die/Edge radius = 24 mm" });
  EXPECT_NE(edge.find("at most 23.5 mm"), std::string::npos) << edge;
}

TEST(ToolReading, AMissingOrWrongEntryIsOneProblem)
{
  // No second message about the outline made with a stand-in value.
  std::string without = die_entries;
  without.erase(without.find("  set Fillet radius"), std::string("  set Fillet radius = 25 mm\n").size());
  const std::string missing = message("cross die", without);
  EXPECT_NE(missing.find("One problem"), std::string::npos) << missing;
  EXPECT_NE(missing.find("Cross die/Fillet radius"), std::string::npos) << missing;
  const std::string unit = message("cross die", die_entries, { "Cross die/Arm reach = 80" });
  EXPECT_NE(unit.find("One problem"), std::string::npos) << unit;
  EXPECT_NE(unit.find("Cross die/Arm reach"), std::string::npos) << unit;
}

TEST(ToolReading, LengthsInTheWrongUnitAreUnusual)
{
  const std::string metres = message("cross die", die_entries, { "Cross die/Arm reach = 80 m" });
  EXPECT_NE(metres.find("unusual"), std::string::npos) << metres;
}
