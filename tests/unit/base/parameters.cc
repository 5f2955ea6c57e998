#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>

#include <gtest/gtest.h>

#include <functional>

using namespace tribodraw;

namespace
{
  struct Shape
  {
    virtual ~Shape() = default;
    static const char *kind() { return "test shape"; }
    virtual double size() const = 0;
  };
  struct Ball : Shape
  {
    explicit Ball(Parameters &p)
      : radius(p.quantity("Radius", "mm", Range::positive().usual(0.1, 100), "Radius of the ball."))
    {}
    double size() const override { return radius; }
    double radius;
  };
  struct Box : Shape
  {
    explicit Box(Parameters &p)
      : edge(p.quantity("Edge", "mm", Range::positive(), "Edge of the box."))
    {
      if (edge > 10 && !p.documentation_mode())
        throw InputError("the box does not fit.");
    }
    double size() const override { return edge; }
    double edge;
  };
  TRIBODRAW_REGISTER(Shape, Ball, "ball", "A ball.", "test")
  TRIBODRAW_REGISTER(Shape, Box, "box", "A box.", "test")

  const std::string good = "set Task = demo\n"
                           "subsection Lubricant\n"
                           "  set Viscosity = 32 mPa s # at 40 C\n"
                           "  set Amounts = 0.6, 1, 2 g/m^2\n"
                           "  subsection Deep\n"
                           "    set Steps = 4\n"
                           "  end\n"
                           "end\n"
                           "subsection Part\n"
                           "  set Model = ball\n"
                           "  subsection Ball\n"
                           "    set Radius = 2 mm\n"
                           "  end\n"
                           "  subsection Box\n"
                           "    set Edge = 3 mm\n"
                           "  end\n"
                           "end\n";

  struct Values
  {
    double                 viscosity = 0, size = 0;
    std::vector<double>    amounts;
    long                   steps = 0;
    bool                   flag  = false;
    std::vector<std::string> warnings;
  };

  Values read(Parameters &p)
  {
    Values v;
    p.choice("Task", {"demo", "other"}, "What to do.");
    {
      const auto scope = p.section("Lubricant");
      v.viscosity      = p.quantity("Viscosity", "mPa s", Range::positive().usual(1, 1000), "Dynamic viscosity.");
      v.amounts        = p.quantity_list("Amounts", "g/m^2", Range::non_negative(), "Amounts per face.");
      v.flag           = p.flag("Cold", "Whether it is cold.", Default{"true", "it mostly is"});
      const auto deep  = p.section("Deep");
      v.steps          = p.integer("Steps", Range::between(1, 10), "Number of steps.");
    }
    const auto scope = p.section("Part");
    const auto shape = p.model<Shape>("Model", "Shape of the part.");
    v.size           = shape ? shape->size() : -1;
    v.warnings       = p.finish();
    return v;
  }

  std::string replaced(std::string text, const std::string &from, const std::string &to)
  {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  std::string problems(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    try
      {
        Parameters p = Parameters::from_text(text, "case.prm", overrides);
        read(p);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }

  void expect_problem(const std::string &text, const std::vector<std::string> &pieces, const std::vector<std::string> &overrides = {})
  {
    const std::string message = problems(text, overrides);
    for (const auto &piece : pieces)
      EXPECT_NE(message.find(piece), std::string::npos) << "'" << piece << "' is not in:\n" << message;
  }
} // namespace

TEST(Parameters, ReadsValuesInInternalUnits)
{
  Parameters   p = Parameters::from_text(good);
  const Values v = read(p);
  EXPECT_DOUBLE_EQ(v.viscosity, 3.2e-8);
  ASSERT_EQ(v.amounts.size(), 3u);
  EXPECT_NEAR(v.amounts[2], 2e-12, 1e-26);
  EXPECT_EQ(v.steps, 4);
  EXPECT_TRUE(v.flag);
  EXPECT_DOUBLE_EQ(v.size, 2.);
}

TEST(Parameters, EntriesOfAnUnselectedModelOnlyWarn)
{
  Parameters   p = Parameters::from_text(good);
  const Values v = read(p);
  ASSERT_EQ(v.warnings.size(), 1u);
  EXPECT_NE(v.warnings[0].find("Part/Box"), std::string::npos);
}

// A file takes the place of what else stands in its section; the section itself is then not without effect.
TEST(Parameters, WarningNamesTheIdleEntriesOfASectionInUse)
{
  Parameters p = Parameters::from_text("subsection Table\n set File = given.json\n set Points = 4\n"
                                       " subsection Axis\n  set Step = 1\n end\nend\n"
                                       "subsection Tables\n set File = x\nend\n",
                                       "case.prm");
  {
    const auto scope = p.section("Table");
    EXPECT_EQ(p.text("File", "The table."), "given.json");
    p.mark_unselected("");
  }
  p.mark_unselected("Tables"); // its name begins like that of the section in use
  EXPECT_EQ(p.finish(), (std::vector<std::string>{
                            "case.prm:5: 'Table/Axis/Step' has no effect with the choices made in this file.",
                            "case.prm:3: 'Table/Points' has no effect with the choices made in this file.",
                            "case.prm:9: 'Tables' has no effect with the choices made in this file." }));
}

TEST(Parameters, OverridesReplaceAndSwitchModels)
{
  Parameters   p = Parameters::from_text(good, "case.prm", {"Part/Model = box", "Lubricant/Deep/Steps=7"});
  const Values v = read(p);
  EXPECT_DOUBLE_EQ(v.size, 3.);
  EXPECT_EQ(v.steps, 7);
}

TEST(Parameters, UnknownEntryNamesLineAndNearest)
{
  expect_problem(replaced(good, "Viscosity", "Viscositty"), {"case.prm:3", "Lubricant/Viscositty", "unknown entry", "Did you mean 'Viscosity'", "is missing"});
}

TEST(Parameters, UnknownSection)
{
  expect_problem(good + "subsection Lubrication\n set Viscosity = 1 mPa s\nend\n", {"case.prm:19", "unknown section 'Lubrication'", "Did you mean 'Lubricant/Viscosity'"});
}

TEST(Parameters, DuplicateNamesBothLines)
{
  expect_problem(replaced(good, "  set Amounts", "  set Viscosity = 3 mPa s\n  set Amounts"), {"case.prm:4", "set twice", "case.prm:3"});
}

TEST(Parameters, MissingUnitOutOfRangeUnusual)
{
  expect_problem(replaced(good, "32 mPa s", "32"), {"case.prm:3", "has no unit", "1 mPa s"});
  expect_problem(replaced(good, "32 mPa s", "-32 mPa s"), {"out of range", "more than 0 mPa s"});
  expect_problem(replaced(good, "32 mPa s", "32 Pa s"), {"physically unusual", "usually 1 to 1000 mPa s", "set Accept unusual values = Lubricant/Viscosity"});
  EXPECT_EQ(problems("set Accept unusual values = Lubricant/Viscosity\n" + replaced(good, "32 mPa s", "32 Pa s")), "");
  expect_problem(replaced(good, "Steps = 4", "Steps = 4.5"), {"whole number", "4.5"});
  expect_problem(replaced(good, "Steps = 4", "Steps = 11"), {"out of range", "1 to 10"});
}

TEST(Parameters, AllProblemsAtOnce)
{
  const std::string text = replaced(replaced(replaced(good, "32 mPa s", "32"), "Steps = 4", "Steps = 99"), "ball", "bal");
  expect_problem(text, {"3 problems", "has no unit", "out of range", "Did you mean 'ball'", "ball | box"});
}

TEST(Parameters, SyntaxMistakes)
{
  expect_problem(good + "end\n", {"case.prm:18", "'end' without a subsection"});
  expect_problem(good + "subsection Open\n", {"case.prm:18", "has no 'end'"});
  expect_problem(good + "Viscosity: 3\n", {"case.prm:18", "cannot read"});
  expect_problem(good, {"expected 'Section/Entry = value'"}, {"nonsense"});
}

TEST(Parameters, ExceptionOfAModelIsAProblemOfItsSection)
{
  expect_problem(good, {"Part/Box", "does not fit"}, {"Part/Model = box", "Part/Box/Edge = 20 mm"});
}

TEST(Parameters, EffectiveFileReadsBackTheSame)
{
  Parameters   p = Parameters::from_text(good);
  const Values v = read(p);
  Parameters   again = Parameters::from_text(p.effective());
  const Values w     = read(again);
  EXPECT_EQ(v.viscosity, w.viscosity);
  EXPECT_EQ(v.amounts, w.amounts);
  EXPECT_EQ(v.size, w.size);
  EXPECT_NE(p.effective().find("Cold"), std::string::npos) << "defaults are part of the effective file";
}

TEST(Parameters, DocumentationVisitsAllModels)
{
  Parameters p = Parameters::for_documentation();
  read(p);
  unsigned found = 0;
  for (const auto &e : p.entries())
    {
      EXPECT_FALSE(e.documentation.empty()) << e.path;
      found += e.path == "Part/Ball/Radius" || e.path == "Part/Box/Edge" || e.path == "Lubricant/Deep/Steps";
    }
  EXPECT_EQ(found, 3u);
}

TEST(Parameters, a_nested_section_can_read_one_of_the_top_level)
{
  auto p = Parameters::from_text("subsection A\n set x = 1\n subsection B\n  set y = 2\n  set z = 3\n end\nend\n"
                                 "subsection C\n set w = 4\nend\n");
  const auto a = p.section("A");
  const auto b = p.section("B");
  EXPECT_EQ(p.integer("y", Range::any(), "y"), 2);
  {
    const auto c = p.top_section("C");
    EXPECT_EQ(p.path(), "C");
    EXPECT_EQ(p.integer("w", Range::any(), "w"), 4);
  }
  EXPECT_EQ(p.path(), "A/B");
  EXPECT_EQ(p.integer("z", Range::any(), "z"), 3); // back where we were
}

TEST(Parameters, a_list_may_be_empty_if_its_default_is)
{
  Parameters p = Parameters::from_text("set Given = 1, 2 mm\nset Emptied =\n");
  EXPECT_EQ(p.quantity_list("Given", "mm", Range::positive(), "text", Default{ "", "none" }).size(), 2u);
  EXPECT_TRUE(p.quantity_list("Emptied", "mm", Range::positive(), "text", Default{ "", "none" }).empty());
  EXPECT_TRUE(p.quantity_list("Missing", "mm", Range::positive(), "text", Default{ "", "none" }).empty());
  p.finish();
  Parameters wrong = Parameters::from_text("set List = -1 mm\n");
  wrong.quantity_list("List", "mm", Range::positive(), "text", Default{ "", "none" });
  EXPECT_THROW(wrong.finish(), InputError);
}
