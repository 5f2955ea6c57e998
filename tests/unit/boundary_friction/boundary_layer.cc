#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/boundary_friction/boundary_friction.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  BoundaryFriction
  read(const std::string &c0, const std::string &m)
  {
    Parameters       parameters = Parameters::from_text("set Model = power law\n"
                                                              "subsection Power law\n set c0 = "
                                                        + c0 + "\n set m = " + m + "\nend\n");
    BoundaryFriction result     = BoundaryFriction::read(parameters);
    parameters.finish();
    return result;
  }

  std::string
  message(const std::string &c0, const std::string &m)
  {
    try
      {
        read(c0, m);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
} // namespace

// model.md 2.2: c0 = 11.2 Pa^0.25, m = 0.75.
TEST(BoundaryLayer, PowerLawCarriesItsUnit)
{
  const BoundaryFriction friction = read("11.2 Pa^0.25", "0.75");
  EXPECT_NEAR(friction.shear_law->shear_stress(1.), 0.35418, 1e-5); // c0 in MPa^0.25
  EXPECT_NEAR(friction.shear_law->shear_stress(840.), 55.3, 0.05);
  EXPECT_NEAR(friction.shear_law->shear_stress(500.), 37.4, 0.06);
  EXPECT_NEAR(friction.shear_law->shear_stress(300.), 25.5, 0.06);
  EXPECT_NEAR(friction.shear_law->shear_stress(100.), 11.2, 0.01);
  EXPECT_EQ(friction.shear_law->shear_stress(0.), 0.);
  // The same law in other units.
  EXPECT_NEAR(read("0.3541751 MPa^0.25", "0.75").shear_law->shear_stress(840.), friction.shear_law->shear_stress(840.),
              1e-5);
}

TEST(BoundaryLayer, ExponentSetsTheUnit)
{
  EXPECT_NEAR(read("1.34 Pa^0.12", "0.88").shear_law->shear_stress(500.) * 1e6, 1.34 * std::pow(5e8, 0.88), 10.);
  EXPECT_NEAR(read("0.1", "1").shear_law->shear_stress(500.), 50., 1e-12); // m = 1: a friction coefficient
}

TEST(BoundaryLayer, ShearStrengthIsTheCap)
{
  const BoundaryFriction friction = read("11.2 Pa^0.25", "0.75");
  EXPECT_EQ(friction.layer_shear(840., 30.), 30.);
  EXPECT_EQ(friction.layer_shear(100., 30.), friction.shear_law->shear_stress(100.));
}

TEST(BoundaryLayer, RefusesWrongUnitsAndExponents)
{
  EXPECT_NE(message("11.2 Pa", "0.75").find("c0"), std::string::npos);
  EXPECT_NE(message("11.2 Pa", "0.75").find("Pa^0.25"), std::string::npos) << message("11.2 Pa", "0.75");
  EXPECT_NE(message("11.2", "0.75").find("c0"), std::string::npos);
  EXPECT_NE(message("11.2 Pa^0.25", "1.75").find("m"), std::string::npos);
  EXPECT_NE(message("-11.2 Pa^0.25", "0.75").find("c0"), std::string::npos);
}
