#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/viscosity_law.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  /// Viscosities in Pa s, pressures in MPa.
  std::unique_ptr<ViscosityLaw>
  make(const std::string &name, const std::string &entries, const double reference)
  {
    Parameters parameters = Parameters::from_text(entries);
    auto       law        = Registry<ViscosityLaw>::entries().at(name).create(parameters);
    parameters.finish();
    law->set_reference_viscosity(reference * 1e-6);
    return law;
  }

  double
  pascal_seconds(const ViscosityLaw &law, const double pressure, const double rate = 0)
  {
    return law.viscosity(pressure, rate).viscosity * 1e6;
  }
} // namespace

TEST(Viscosity, ConstantIsConstant)
{
  const auto law = make("constant", "", 0.032);
  EXPECT_DOUBLE_EQ(pascal_seconds(*law, 300, 1e6), 0.032);
  EXPECT_EQ(law->viscosity(300, 1e6).pressure_slope, 0);
}

TEST(Viscosity, BarusReferenceValues)
{
  // 0.032 Pa s, 2e-8 1/Pa: 0.032 exp(0.2), exp(1), exp(4).
  const auto law = make("Barus", "set Pressure coefficient = 20 1/GPa", 0.032);
  EXPECT_NEAR(pascal_seconds(*law, 0), 0.032, 1e-16);
  EXPECT_NEAR(pascal_seconds(*law, 10), 0.03908489, 1e-8);
  EXPECT_NEAR(pascal_seconds(*law, 50), 0.08698502, 1e-8);
  EXPECT_NEAR(pascal_seconds(*law, 200), 1.7471408, 1e-7);
}

TEST(Viscosity, RoelandsReferenceValues)
{
  // Independent evaluation of the formula with eta_0 = 0.032 Pa s, a = 2e-8 1/Pa (z = 0.6301), to the digits printed:
  // 0.03901, 0.08338, 1.0277 Pa s at 10, 50, 200 MPa.
  const auto law = make("Roelands", "set Pressure coefficient = 2e-8 1/Pa", 0.032);
  EXPECT_NEAR(pascal_seconds(*law, 0), 0.032, 1e-16);
  EXPECT_NEAR(pascal_seconds(*law, 10), 0.03901, 5e-6);
  EXPECT_NEAR(pascal_seconds(*law, 50), 0.08338, 5e-6);
  EXPECT_NEAR(pascal_seconds(*law, 200), 1.0277, 5e-5);
  // The same slope as Barus at ambient pressure.
  EXPECT_NEAR(law->viscosity(0, 0).pressure_slope, 0.02 * 0.032e-6, 1e-20);
}

TEST(Viscosity, EyringLimits)
{
  const std::string entries = "set Pressure coefficient = 0 1/GPa\nset Eyring stress = 5 MPa";
  const auto        law     = make("Eyring", entries, 0.032);
  // Slow shear: Newtonian, with the series asinh(x)/x = 1 - x^2/6, x = 0.032e-6 * 1e6 / 5 = 0.0064.
  EXPECT_NEAR(pascal_seconds(*law, 0, 1e6) / 0.032, 1 - 0.0064 * 0.0064 / 6, 1e-9);
  // Fast shear: stress = tau_E asinh(x) = 5 MPa * ln(x + sqrt(x^2 + 1)) with x = 0.032e-6 * 1e10 / 5 = 64.
  EXPECT_NEAR(pascal_seconds(*law, 0, 1e10), 5. * std::log(64. + std::sqrt(64. * 64 + 1)) / 1e10 * 1e6, 1e-15);
  // No jump where the series takes over.
  const double rate = 1e-4 * 5 / 0.032e-6;
  EXPECT_NEAR(pascal_seconds(*law, 0, rate * (1 - 1e-12)), pascal_seconds(*law, 0, rate * (1 + 1e-12)), 1e-17);
}

TEST(Viscosity, EyringSlopeIsTheDerivative)
{
  // The contract test sees this law without growth by pressure (its smallest usual coefficient).
  const auto law = make("Eyring", "set Pressure coefficient = 20 1/GPa\nset Eyring stress = 5 MPa", 0.032);
  for (const double p : { 1., 50., 300. })
    for (const double rate : { 0., 1e6, 1e9 })
      {
        const double h     = 1e-3;
        const double slope = (law->viscosity(p + h, rate).viscosity - law->viscosity(p - h, rate).viscosity) / (2 * h);
        // Central difference of a function with a = 0.02 1/MPa: relative error (a h)^2/6 < 1e-10, rounding 1e-16/(a h).
        EXPECT_NEAR(law->viscosity(p, rate).pressure_slope, slope, 1e-9 * slope);
      }
}
