#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/tool_geometry.h>

#include <gtest/gtest.h>

using namespace tribodraw;

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
