// What every registered viscosity law must hold, so that the film equation can rely on it.
#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/viscosity_law.h>

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

using namespace tribodraw;

namespace
{
  constexpr double reference = 3.2e-8; // [MPa s]
  // The range of lubricated forming: MPa and 1/s (10 mm/s over 1 um is 1e4, 1 m/s over 0.1 um is 1e7).
  const std::vector<double> pressures{ 0, 0.1, 1, 10, 50, 100, 200, 500 }, rates{ 0, 1, 1e4, 1e6, 1e7 };

  class AnyViscosityLaw : public ::testing::TestWithParam<std::string>
  {
  protected:
    void
    SetUp() override
    {
      // Every entry then has its smallest usual value.
      Parameters parameters = Parameters::for_documentation();
      law                   = Registry<ViscosityLaw>::entries().at(GetParam()).create(parameters);
      ASSERT_TRUE(law);
      law->set_reference_viscosity(reference);
    }
    std::unique_ptr<ViscosityLaw> law;
  };

  std::vector<std::string>
  names()
  {
    std::vector<std::string> result;
    for (const auto &[name, entry] : Registry<ViscosityLaw>::entries())
      result.push_back(name);
    return result;
  }
} // namespace

TEST_P(AnyViscosityLaw, IsPositiveAndFinite)
{
  for (const double p : pressures)
    for (const double rate : rates)
      {
        const auto v = law->viscosity(p, rate);
        EXPECT_GT(v.viscosity, 0);
        EXPECT_TRUE(std::isfinite(v.viscosity));
        EXPECT_TRUE(std::isfinite(v.pressure_slope));
      }
}

TEST_P(AnyViscosityLaw, IsTheReferenceAtAmbientPressureAndRest)
{
  EXPECT_NEAR(law->viscosity(0, 0).viscosity, reference, 1e-14 * reference);
}

TEST_P(AnyViscosityLaw, ScalesTheShearStressMonotonically)
{
  // More pressure never thins the oil, and a higher shear rate never lowers the shear stress.
  for (std::size_t i = 0; i < pressures.size(); ++i)
    for (std::size_t j = 0; j < rates.size(); ++j)
      {
        const double eta = law->viscosity(pressures[i], rates[j]).viscosity;
        if (i > 0)
          {
            EXPECT_GE(eta, law->viscosity(pressures[i - 1], rates[j]).viscosity);
          }
        if (j > 0)
          {
            EXPECT_GE(eta * rates[j], law->viscosity(pressures[i], rates[j - 1]).viscosity * rates[j - 1]);
          }
      }
}

TEST_P(AnyViscosityLaw, SlopeIsTheDerivative)
{
  for (const double p : { 0.5, 5., 50., 200., 500. })
    for (const double rate : rates)
      {
        const double h     = 1e-3 * std::sqrt(p);
        const double slope = (law->viscosity(p + h, rate).viscosity - law->viscosity(p - h, rate).viscosity) / (2 * h);
        const auto   v     = law->viscosity(p, rate);
        // Central differences of exp(a p), a < 0.06/MPa: relative error (a h)^2/6 < 1e-6, rounding 1e-16/(a h).
        EXPECT_NEAR(v.pressure_slope, slope, 1e-6 * std::abs(slope) + 1e-12 * v.viscosity) << p << " " << rate;
      }
}

INSTANTIATE_TEST_SUITE_P(AllRegistered, AnyViscosityLaw, ::testing::ValuesIn(names()), [](const auto &test) {
  std::string name = test.param;
  for (char &c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)))
      c = '_';
  return name;
});

TEST(ViscosityLaws, TheShippedOnesAreRegistered)
{
  for (const char *name : { "constant", "Barus", "Roelands", "Eyring" })
    EXPECT_TRUE(Registry<ViscosityLaw>::entries().count(name)) << name;
}
