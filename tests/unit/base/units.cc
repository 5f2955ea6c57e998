#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>

#include "claims.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace tribodraw;

namespace
{
  std::string
  message(const std::string &text, const std::string &unit)
  {
    try
      {
        units::parse_quantity(text, unit);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
} // namespace

// Expected values: definitions of the SI units, by hand.
TEST(Units, ConvertToMmNMPaS)
{
  EXPECT_DOUBLE_EQ(units::parse_quantity("32 mPa s", "Pa s"), 3.2e-8); // 32e-3 Pa s = 32e-9 MPa s
  EXPECT_DOUBLE_EQ(units::parse_quantity("0.82 mm", "mm"), 0.82);
  EXPECT_DOUBLE_EQ(units::parse_quantity("2 um", "mm"), 2e-3);
  EXPECT_NEAR(units::parse_quantity("0.6 g/m^2", "g/m^2"), 6e-13, 1e-27); // 0.6e-6 t / 1e6 mm^2
  EXPECT_NEAR(units::parse_quantity("0.896 g/cm^3", "kg/m^3"), 0.896e-9, 1e-24);
  EXPECT_DOUBLE_EQ(units::parse_quantity("100 kN", "N"), 1e5);
  EXPECT_DOUBLE_EQ(units::parse_quantity("210 GPa", "MPa"), 2.1e5);
  EXPECT_DOUBLE_EQ(units::parse_quantity("20 %", ""), 0.2);
  EXPECT_DOUBLE_EQ(units::parse_quantity("1e8 1/s", "1/s"), 1e8);
  EXPECT_DOUBLE_EQ(units::parse_quantity("3 m/min", "mm/s"), 50.);
  EXPECT_NEAR(units::parse_quantity("180 deg", "rad"), 3.141592653589793, 1e-15);
}

TEST(Units, FractionalExponents)
{
  // c0 = 11.2 Pa^0.25 = 0.35418 MPa^0.25 (factor 10^-1.5)
  EXPECT_TRUE(claims::agrees("11.2 Pa^0.25 in MPa^0.25", "definitions of the SI",
                             units::parse_quantity("11.2 Pa^0.25", "MPa^0.25"), 11.2 * std::pow(10., -1.5), 1e-15));
}

TEST(Units, BoltzmannOverActivationEnergyIsDimensionlessPerKelvin)
{
  // k T / dG0 of the paper's Table 3: 8.617e-5 * 300 / 0.8
  const double k = units::parse_quantity("8.617e-5 eV/K", "J/K"), g = units::parse_quantity("0.8 eV", "J");
  EXPECT_TRUE(claims::agrees("k T over 0.8 eV at 300 K", "8.617e-5 eV/K times 300 K over 0.8 eV", k * 300. / g,
                             0.03231375, 1e-15));
}

TEST(Units, MessagesNameTheMistake)
{
  EXPECT_NE(message("32", "mPa s").find("has no unit"), std::string::npos);
  EXPECT_NE(message("32", "mPa s").find("1 mPa s"), std::string::npos);
  EXPECT_NE(message("32 mm", "mPa s").find("wrong kind"), std::string::npos);
  EXPECT_NE(message("32 furlong", "mm").find("unknown unit 'furlong'"), std::string::npos);
  EXPECT_NE(message("abc", "mm").find("does not start with a number"), std::string::npos);
  EXPECT_NE(message("", "mm").find("empty"), std::string::npos);
  EXPECT_NE(message("nan mm", "mm").find("not a finite number"), std::string::npos);
  EXPECT_NE(message("1e999 mm", "mm").find("not a finite number"), std::string::npos);
  EXPECT_NE(message("5 mm", "").find("wrong kind"), std::string::npos);
  EXPECT_NE(message("5 mm^999", "mm").find("unknown unit"), std::string::npos);
  EXPECT_NE(message("5 mm//s", "mm").find("unknown unit"), std::string::npos);
}

TEST(Units, FormatReadsBack)
{
  EXPECT_EQ(units::format(0.82, "mm"), "0.82 mm");
  EXPECT_EQ(units::format(3.2e-8, "mPa s"), "32 mPa s");
  EXPECT_EQ(units::number(0.1), "0.1");
  EXPECT_EQ(std::stod(units::number(1. / 3.)), 1. / 3.);
}
