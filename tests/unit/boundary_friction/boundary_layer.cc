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
  EXPECT_NE(message("11.2 Pa^0.25", "1.75").find("Power law/m"), std::string::npos);
  EXPECT_EQ(message("11.2 Pa^0.25", "1.75").find("c0"), std::string::npos); // one mistake, one complaint
  EXPECT_NE(message("11.2 Pa^0.25", "-0.5").find("Power law/m"), std::string::npos);
  EXPECT_NE(message("-11.2 Pa^0.25", "0.75").find("c0"), std::string::npos);
}

// Which pressure is which (model.md 9, T12): with P_sol = P_nom - P_lub and P0 = P_sol/alpha + P_lub the forces on the
// nominal area balance, P_nom = alpha P0 + (1 - alpha) P_lub; neither P_nom/alpha nor P_sol/alpha does that.
TEST(BoundaryFrictionPressures, PlateausAndLubricantCarryTheNominalPressure)
{
  for (const double alpha : { 0.01, 0.3, 0.9 })
    for (const double p_nominal : { 1., 40. })
      for (const double share : { 0., 0.3, 0.95 })
        {
          const double p_lubricant = share * p_nominal, p_solid = p_nominal - p_lubricant;
          const double p0 = plateau_pressure(p_solid, alpha, p_lubricant);
          EXPECT_NEAR(alpha * p0 + (1. - alpha) * p_lubricant, p_nominal, 1e-12 * p_nominal);
          if (share > 0)
            {
              EXPECT_GT(std::abs(alpha * (p_nominal / alpha) + (1. - alpha) * p_lubricant - p_nominal), 1e-4);
              EXPECT_GT(std::abs(alpha * (p_solid / alpha) + (1. - alpha) * p_lubricant - p_nominal), 1e-4);
            }
        }
  EXPECT_EQ(plateau_pressure(5., 0.), 0.);
}

// T13: tau_BL is per real area and the sum per nominal area: the contact fraction is multiplied once. Ploughing is per
// nominal area from the start.
TEST(BoundaryFrictionPressures, ContactFractionEntersOnce)
{
  const BoundaryFriction friction = read("11.2 Pa^0.25", "0.75");
  const double           alpha = 0.2, p_solid = 12., p_lubricant = 3., k = 150.;
  const double           tau_real = friction.shear_law->shear_stress(12. / 0.2 + 3.);
  EXPECT_NEAR(friction.shear_per_nominal_area(alpha, p_solid, p_lubricant, k, 0.), 0.2 * tau_real, 1e-14);
  EXPECT_NEAR(friction.shear_per_nominal_area(alpha, p_solid, p_lubricant, k, 0.03), 0.2 * tau_real + 0.36, 1e-14);
  EXPECT_EQ(friction.shear_per_nominal_area(alpha, 0., p_lubricant, k, 0.03), 0.);
  // Capped per real area.
  EXPECT_NEAR(friction.shear_per_nominal_area(alpha, p_solid, p_lubricant, 1., 0.), 0.2, 1e-14);
}

// Smooth tool, dry: mu = tau / P_nom = c0 P0^(m-1), whatever the contact fraction at the same P0 (model.md 2.2).
TEST(BoundaryFrictionPressures, SmoothToolIsTheLayerAlone)
{
  const BoundaryFriction friction = read("11.2 Pa^0.25", "0.75");
  for (const double p0 : { 50., 300., 840. })
    for (const double alpha : { 0.01, 0.2, 0.7 })
      {
        const double p = alpha * p0;
        EXPECT_NEAR(friction.shear_per_nominal_area(alpha, p, 0., 1e9, 0.) / p, 11.2 * std::pow(p0 * 1e6, -0.25),
                    1e-14);
      }
}

TEST(BoundaryLayer, ReadsThePloughingLaw)
{
  const std::string layer = "set Model = power law\nsubsection Power law\nset c0 = 11.2 Pa^0.25\nset m = 0.75\nend\n";
  for (const auto &[name, entry] : Registry<PloughingLaw>::entries())
    {
      Parameters parameters = Parameters::from_text(layer + "set Ploughing = " + name + "\n");
      EXPECT_NE(BoundaryFriction::read(parameters).ploughing, nullptr) << name;
      EXPECT_NO_THROW(parameters.finish()) << name;
    }
  for (const char *wrong : { "set Ploughing = cone\n", "set Ploughing directions = 0\n",
                             "subsection Paraboloid\nset Depth of patches = area\nend\n" })
    {
      Parameters parameters = Parameters::from_text(layer + wrong);
      BoundaryFriction::read(parameters);
      EXPECT_THROW(parameters.finish(), InputError) << wrong;
    }
}
