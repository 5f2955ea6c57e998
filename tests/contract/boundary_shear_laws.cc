// What every boundary shear law promises, for every registered one. A new law needs an example here: parameters with which
// it is tested.
#include <tribodraw/base/parameters.h>
#include <tribodraw/boundary_friction/shear_law.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace tribodraw;

namespace
{
  const std::map<std::string, std::string> examples = { { "power law", "set c0 = 11.2 Pa^0.25\nset m = 0.75\n" } };
}

TEST(BoundaryShearLawContract, ZeroAtZeroIncreasingAndBelowThePressure)
{
  EXPECT_EQ(Registry<ShearLaw>::entries().size(), examples.size());
  for (const auto &[name, entry] : Registry<ShearLaw>::entries())
    {
      ASSERT_EQ(examples.count(name), 1u) << "The boundary shear law '" << name << "' has no example here.";
      EXPECT_FALSE(entry.info.description.empty()) << name;
      EXPECT_FALSE(entry.info.citation.empty()) << name;
      Parameters parameters = Parameters::from_text(examples.at(name));
      const auto law        = entry.create(parameters);
      parameters.finish();
      EXPECT_EQ(law->shear_stress(0.), 0.) << name;
      double previous = 0;
      for (double p = 1e-3; p < 2e3; p *= 1.3)
        {
          const double tau = law->shear_stress(p);
          EXPECT_TRUE(std::isfinite(tau)) << name;
          EXPECT_GE(tau, previous) << name;
          if (p > 10.)
            {
              EXPECT_LT(tau, p) << name << ": a boundary layer with a friction coefficient above 1";
            }
          previous = tau;
        }
    }
}
