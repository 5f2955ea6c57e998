#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/lubricant.h>

#include <gtest/gtest.h>

using namespace tribodraw;

namespace
{
  const std::string oil = "subsection Lubricant\n"
                          "  set Viscosity = 32 mPa s\n"
                          "  set Density = 0.896 g/cm^3\n"
                          "  set Amount = 2.0 g/m^2\n"
                          "end\n";

  Lubricant
  read(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    Parameters parameters = Parameters::from_text(text, "input", overrides);
    Lubricant  lubricant;
    {
      const auto scope = parameters.section("Lubricant");
      lubricant        = Lubricant::read(parameters);
    }
    parameters.finish();
    return lubricant;
  }

  std::string
  message(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    try
      {
        read(text, overrides);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "no error";
  }
} // namespace

TEST(Lubricant, SuppliedFilmOfThePaper)
{
  // Amount over density: 2.0, 1.0, 0.6 g/m^2 at 0.896 g/cm^3 are 2.2321, 1.1161, 0.6696 um.
  EXPECT_NEAR(read(oil).supplied_film(), 2.2321e-3, 5e-8);
  EXPECT_NEAR(read(oil, { "Lubricant/Amount = 1.0 g/m^2" }).supplied_film(), 1.1161e-3, 5e-8);
  EXPECT_NEAR(read(oil, { "Lubricant/Amount = 0.6 g/m^2" }).supplied_film(), 0.6696e-3, 5e-8);
}

TEST(Lubricant, ViscosityIsTheOneOfTheSection)
{
  // 32 mPa s = 3.2e-8 MPa s, whichever law is chosen, at ambient pressure and at rest.
  EXPECT_NEAR(read(oil).viscosity_law->viscosity(100, 0).viscosity, 3.2e-8, 1e-20);
  for (const char *law : { "Barus", "Roelands" })
    {
      const Lubricant lubricant = read(oil, { std::string("Lubricant/Viscosity law = ") + law,
                                              std::string("Lubricant/") + law + "/Pressure coefficient = 20 1/GPa" });
      EXPECT_NEAR(lubricant.viscosity_law->viscosity(0, 0).viscosity, 3.2e-8, 1e-20);
      EXPECT_GT(lubricant.viscosity_law->viscosity(100, 0).viscosity, 1.9 * 3.2e-8); // exp(2) less some
    }
}

TEST(Lubricant, PhysicalConstantsHaveNoDefault)
{
  const std::string text = message("subsection Lubricant\nend\n");
  for (const char *entry : { "Lubricant/Viscosity", "Lubricant/Density", "Lubricant/Amount" })
    EXPECT_NE(text.find(entry), std::string::npos) << text;
  const std::string law = message(oil, { "Lubricant/Viscosity law = Barus" });
  EXPECT_NE(law.find("Lubricant/Barus/Pressure coefficient"), std::string::npos) << law;
}

TEST(Lubricant, WrongUnitsAndValuesAreNamed)
{
  EXPECT_NE(message(oil, { "Lubricant/Viscosity = 32" }).find("Lubricant/Viscosity"), std::string::npos);
  EXPECT_NE(message(oil, { "Lubricant/Viscosity = 32 Pa s" }).find("unusual"), std::string::npos);
  EXPECT_NE(message(oil, { "Lubricant/Amount = -1 g/m^2" }).find("out of range"), std::string::npos);
  EXPECT_NE(message(oil, { "Lubricant/Density = 896 g/m^2" }).find("Lubricant/Density"), std::string::npos);
}
