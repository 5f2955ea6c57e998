#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/lubricant.h>

#include "claims.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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
  EXPECT_TRUE(claims::agrees("film of 2.0 g/m2 at 0.896 g/cm3, mm", "amount over density", read(oil).supplied_film(),
                             2.2321e-3, 5e-8));
  EXPECT_NEAR(read(oil, { "Lubricant/Amount = 1.0 g/m^2" }).supplied_film(), 1.1161e-3, 5e-8);
  EXPECT_TRUE(claims::agrees("film of 0.6 g/m2, mm", "amount over density",
                             read(oil, { "Lubricant/Amount = 0.6 g/m^2" }).supplied_film(), 0.6696e-3, 5e-8));
}

TEST(Lubricant, AmountOfEachFace)
{
  const Lubricant two = read(oil, { "Lubricant/Amount = 1.792 g/m^2, 0.896 g/m^2" });
  EXPECT_NEAR(two.supplied_film(0, 3, 4), 2e-3, 1e-12); // 1.792/0.896 um on the punch side
  EXPECT_NEAR(two.supplied_film(1, 3, 4), 1e-3, 1e-12);
  EXPECT_NE(message(oil, { "Lubricant/Amount = 1 g/m^2, 1 g/m^2, 1 g/m^2" }).find("two faces"), std::string::npos);
}

namespace
{
  std::string
  write(const std::string &name, const std::string &text)
  {
    const auto    file = std::filesystem::temp_directory_path() / ("tribodraw_" + name + ".csv");
    std::ofstream(file) << text;
    return file.string();
  }
} // namespace

TEST(Lubricant, MapAndTraverse)
{
  // Bilinear between the points of a grid given in any order; amounts at density 0.896 g/cm^3.
  const auto map = AmountMap::read(write("map", "x_mm,y_mm,amount_g_per_m2\n0,0,1\n10,0,2\n10,20,4\n0,20,3\n"));
  EXPECT_NEAR(map.at(0, 5, 5), 2e-12, 1e-20); // 1 + 0.5 + 0.5 g/m^2 = 2e-12 t/mm^2
  EXPECT_NEAR(map.at(1, 10, 20), 4e-12, 1e-20);
  EXPECT_EQ(map.asymmetry(), 0.); // a quarter
  EXPECT_THROW(map.at(0, 11, 5), InputError);

  const std::string text = oil.substr(0, oil.find("  set Amount")) + "  set Amount file = "
                           + write("traverse", "y_mm,amount_punch_g_per_m2,amount_die_g_per_m2\n-10,1,2\n0,2,2\n10,1,0\n")
                           + "\nend\n";
  const Lubricant lubricant = read(text);
  EXPECT_NEAR(lubricant.supplied_film(0, 123, 5), 1.5e-3 / 0.896, 1e-12); // whatever x
  EXPECT_NEAR(lubricant.supplied_film(1, -7, 5), 1e-3 / 0.896, 1e-12);
  EXPECT_NEAR(lubricant.map->asymmetry(), 1., 1e-12); // 2 at -10, 0 at 10, of 2
}

TEST(Lubricant, WrongMapsAreRefused)
{
  const auto refused = [](const std::string &text) {
    EXPECT_THROW(AmountMap::read(write("wrong", text)), InputError) << text;
  };
  refused("x_mm,y_mm,amount_g_per_m2\n0,0,1\n1,0,1\n0,1,1\n");                 // no grid
  refused("x_mm,y_mm,amount_g_per_m2\n0,0,1\n1,0,1\n0,1,1\n0,0,1\n");          // twice
  refused("x_mm,amount_g_per_m2\n0,-1\n1,0\n");                                // negative
  refused("x_mm,amount_g_per_m2\n0,1000\n1,0\n");                              // mg taken for g
  refused("x_mm,amount_punch_g_per_m2\n0,1\n1,1\n");                            // one face
  refused("amount_g_per_m2\n1\n");                                             // no coordinate
  refused("x_mm,amount_g_per_m2\n");                                           // no row
  refused("x_mm,amount_g_per_m2\n0,one\n");                                    // no number
  const std::string text = oil.substr(0, oil.find("  set Amount")) + "  set Amount file = "
                           + write("wrong", "amount_g_per_m2\n1\n") + "\nend\n";
  EXPECT_NE(message(text).find("Amount file"), std::string::npos);
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
