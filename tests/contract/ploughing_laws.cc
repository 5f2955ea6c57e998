// What every ploughing law promises, for every registered one, with its default entries.
#include <tribodraw/base/parameters.h>
#include <tribodraw/boundary_friction/ploughing.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  const std::size_t pixels = 96;

  HeightMap
  waves(const double amplitude, const double turned)
  {
    HeightMap map;
    map.nx = map.ny = pixels;
    map.dx = map.dy = 3e-3;
    map.periodic    = true;
    for (std::size_t iy = 0; iy < pixels; ++iy)
      for (std::size_t ix = 0; ix < pixels; ++ix)
        {
          const double x = 6.283185307 * ix / pixels, y = 6.283185307 * iy / pixels;
          const double a = turned > 0 ? y : x, b = turned > 0 ? x : y;
          map.z.push_back(amplitude
                          * (std::cos(7. * a + 0.3) + 0.6 * std::sin(5. * b + 2. * a) + 0.3 * std::cos(4. * b - 1.)));
        }
    return map;
  }

  PloughingBalance
  run(const std::string &law_name, const HeightMap &tool, const double p, const double tau)
  {
    Parameters        parameters = Parameters::from_text("");
    const auto        law        = Registry<PloughingLaw>::entries().at(law_name).create(parameters);
    const HeightMap   sheet      = waves(1e-3, 0.);
    const ToolSurface surface(tool, 4);
    return balance_ploughing(PlateauContact(sheet, surface, 0.2e-3), *law, p, { 600., 600. / 5.142, tau });
  }
} // namespace

TEST(PloughingLawContract, DescribesItself)
{
  EXPECT_GE(Registry<PloughingLaw>::entries().size(), 2u);
  for (const auto &[name, entry] : Registry<PloughingLaw>::entries())
    {
      EXPECT_FALSE(entry.info.description.empty()) << name;
      EXPECT_FALSE(entry.info.citation.empty()) << name;
      Parameters parameters = Parameters::from_text("");
      entry.create(parameters);
      EXPECT_NO_THROW(parameters.finish()) << name << " has entries without default";
    }
}

// A smooth tool does not plough; a rough one never pushes; the load is carried; everything is finite.
TEST(PloughingLawContract, BalancesAndIsNotNegative)
{
  for (const auto &[name, entry] : Registry<PloughingLaw>::entries())
    for (const double p : { 0.01, 1., 20., 100., 400. })
      for (const double tau : { 0., 30., 116. })
        {
          EXPECT_NEAR(run(name, waves(0., 0.), p, tau).coefficient, 0., 1e-12) << name;
          const PloughingBalance rough = run(name, waves(0.2e-3, 1.), p, tau);
          EXPECT_TRUE(std::isfinite(rough.coefficient)) << name;
          EXPECT_GE(rough.coefficient, -1e-12) << name << " at " << p;
          if (rough.patch_fraction > 0)
            {
              EXPECT_NEAR(rough.support, p, 1e-10 * p) << name;
            }
        }
}

// A steeper tool ploughs more, and half the slopes plough half as much (small slopes, no shear).
TEST(PloughingLawContract, GrowsWithTheSlopesOfTheTool)
{
  for (const auto &[name, entry] : Registry<PloughingLaw>::entries())
    {
      const double full = run(name, waves(0.02e-3, 1.), 20., 0.).coefficient,
                   half = run(name, waves(0.01e-3, 1.), 20., 0.).coefficient;
      EXPECT_NEAR(half, 0.5 * full, 0.01 * full) << name;
    }
}

// Everything is proportional to the strength: twice hardness, shear and load leave the coefficient.
TEST(PloughingLawContract, ScalesWithTheStrength)
{
  const HeightMap   sheet = waves(1e-3, 0.), tool = waves(0.2e-3, 1.);
  const ToolSurface surface(tool, 4);
  for (const auto &[name, entry] : Registry<PloughingLaw>::entries())
    {
      Parameters           parameters = Parameters::from_text("");
      const auto           law        = entry.create(parameters);
      const PlateauContact contact(sheet, surface, 0.2e-3);
      for (const double p : { 5., 200. })
        EXPECT_NEAR(balance_ploughing(contact, *law, 2. * p, { 1000., 200., 60. }).coefficient,
                    balance_ploughing(contact, *law, p, { 500., 100., 30. }).coefficient, 1e-12)
            << name;
    }
}
