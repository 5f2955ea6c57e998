// What every registered pressure friction law must hold, so that the contact can rely on it.
#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/pressure_friction.h>

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

using namespace tribodraw;

namespace
{
  const std::vector<double> pressures{0, 1e-6, 0.1, 1, 10, 50, 100, 200, 500}; // MPa

  class AnyPressureFrictionLaw : public ::testing::TestWithParam<std::string>
  {
  protected:
    void SetUp() override
    {
      // Every entry then has its smallest usual value.
      Parameters parameters = Parameters::for_documentation();
      law                   = Registry<PressureFrictionLaw>::entries().at(GetParam()).create(parameters);
      ASSERT_TRUE(law);
    }
    std::unique_ptr<PressureFrictionLaw> law;
  };

  std::vector<std::string> names()
  {
    std::vector<std::string> result;
    for (const auto &[name, entry] : Registry<PressureFrictionLaw>::entries())
      result.push_back(name);
    return result;
  }
} // namespace

TEST_P(AnyPressureFrictionLaw, IsFiniteAndNotNegative)
{
  for (const double p : pressures)
    {
      EXPECT_TRUE(std::isfinite(law->coefficient(p)));
      EXPECT_GE(law->coefficient(p), 0);
    }
}

// The same pressure gives the same coefficient, whatever was asked before: trial states must not leave a trace.
TEST_P(AnyPressureFrictionLaw, HasNoMemory)
{
  const double before = law->coefficient(20);
  law->coefficient(300);
  EXPECT_EQ(law->coefficient(20), before);
}

INSTANTIATE_TEST_SUITE_P(Registered, AnyPressureFrictionLaw, ::testing::ValuesIn(names()), [](const auto &test) {
  std::string name = test.param;
  for (char &c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)))
      c = '_';
  return name;
});

TEST(PressureFrictionLaws, TheShippedOnesAreRegistered)
{
  for (const char *name : {"power law", "table"})
    EXPECT_TRUE(Registry<PressureFrictionLaw>::entries().count(name)) << name;
}
