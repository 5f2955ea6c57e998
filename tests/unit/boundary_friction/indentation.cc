// Indentation of a rough tool into plateaus: patches, balance of forces, full contact.
#include <tribodraw/base/parameters.h>
#include <tribodraw/boundary_friction/ploughing.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

using namespace tribodraw;

namespace
{
  const double pi = 3.14159265358979323846;

  std::shared_ptr<const PloughingLaw>
  make_law(const std::string &name, const std::string &text = "")
  {
    Parameters                          parameters = Parameters::from_text(text);
    std::shared_ptr<const PloughingLaw> law        = Registry<PloughingLaw>::entries().at(name).create(parameters);
    parameters.finish();
    return law;
  }

  PloughingBalance
  balance(const HeightMap &sheet, const HeightMap &tool, const double cut_height, const double p,
          const PloughingStrength &strength, const std::string &law = "paraboloid", const std::string &text = "",
          const unsigned int n_directions = 4)
  {
    const ToolSurface surface(tool, n_directions);
    return balance_ploughing(PlateauContact(sheet, surface, cut_height), *make_law(law, text), p, strength);
  }

  HeightMap
  map_of(const std::size_t n, const double dx, const std::function<double(double, double)> &height)
  {
    HeightMap map;
    map.nx = map.ny = n;
    map.dx = map.dy = dx;
    for (std::size_t iy = 0; iy < n; ++iy)
      for (std::size_t ix = 0; ix < n; ++ix)
        map.z.push_back(height((ix + 0.5) * dx, (iy + 0.5) * dx));
    return map;
  }

  /// Smooth random tool of 0.3 um made of waves.
  HeightMap
  wavy_tool(const std::size_t n)
  {
    std::mt19937_64                    engine(3);
    std::normal_distribution<double>   normal;
    std::vector<std::array<double, 4>> waves;
    for (unsigned int i = 0; i < 40; ++i)
      waves.push_back({ normal(engine) * 200., normal(engine) * 200., 6.28 * normal(engine), normal(engine) });
    return map_of(n, 3e-3, [&](double x, double y) {
      double t = 0;
      for (const auto &[kx, ky, phase, amplitude] : waves)
        t += 0.3e-3 / std::sqrt(20.) * amplitude * std::cos(kx * x + ky * y + phase);
      return t;
    });
  }

  HeightMap
  wavy_sheet(const std::size_t n)
  {
    return map_of(n, 3e-3, [](double x, double y) { return std::sin(30. * x) * std::sin(25. * y); });
  }

  /// Every registered law that ploughs.
  std::vector<std::string>
  ploughing_laws()
  {
    std::vector<std::string> names;
    for (const auto &[name, entry] : Registry<PloughingLaw>::entries())
      if (name != "none")
        names.push_back(name);
    return names;
  }
} // namespace

// One spherical summit pressed into a flat plateau: the leading half of the patch carries at the hardness, so that
// its area is 2 P A/H (a little more with shear); the coefficient is that of the paraboloid cap. The error falls with
// the pixels, for the fit by slopes, by volume, and for the sum over pixels.
TEST(Ploughing, OneSummitConverges)
{
  const double height = 0.01, radius = 0.4, p = 10.,
               hardness = 200.; // paraboloid of height 0.01 over radius 0.4 in 1 x 1
  const double area = 2. * p / hardness, a = std::sqrt(area / pi), w = height * (a / radius) * (a / radius);
  const double exact = 8. * w / (3. * pi * a);
  for (const auto &[law, text] : { std::pair<std::string, std::string>{ "paraboloid", "set Depth of patches = slopes" },
                                   { "paraboloid", "set Depth of patches = volume" },
                                   { "pixels", "" } })
    {
      double previous = 0;
      for (const std::size_t n : { 64, 256 })
        {
          const HeightMap sheet  = map_of(n, 1. / n, [](double, double) { return 0.; });
          const HeightMap tool   = map_of(n, 1. / n, [&](double x, double y) {
            return height * (1. - (std::pow(x - 0.5, 2) + std::pow(y - 0.5, 2)) / (radius * radius));
          });
          const auto      result = balance(sheet, tool, 0., p, { hardness, 115., 0. }, law, text, 2);
          EXPECT_NEAR(result.support, p, 1e-10 * p);
          EXPECT_NEAR(result.patch_fraction, area, 1e-10);
          EXPECT_FALSE(result.full_contact);
          const double error = std::abs(result.coefficient - exact) / exact;
          if (n == 64)
            previous = error;
          else
            {
              EXPECT_LT(error, 0.3 * previous) << law << " " << text; // at least first order: 4 times the pixels
            }
          EXPECT_LT(error, n == 64 ? 0.04 : 0.01) << law << " " << text;
        }
    }
}

// Ellipse fit against direct integration over the pixels, for summits of any orientation, with shear: both are
// independent ways to the forces on the same tool. 150 x 60 pixels: pixels count the area of the ellipse to 1e-3.
TEST(Ploughing, EllipseFitAgreesWithPixels)
{
  for (const double psi : { 0., 0.5, 1.2, 2.3 })
    for (const double tau : { 0., 15. })
      {
        const std::size_t       n    = 300;
        const HeightMap         flat = map_of(n, 1. / n, [](double, double) { return 0.; });
        const HeightMap         tool = map_of(n, 1. / n, [&](double x, double y) {
          const double u = ((x - .5) * std::cos(psi) + (y - .5) * std::sin(psi)) / 0.45;
          const double v = ((y - .5) * std::cos(psi) - (x - .5) * std::sin(psi)) / 0.18;
          return 0.02 * (1. - u * u - v * v);
        });
        const PloughingStrength strength{ 200., 115., tau };
        const auto              exact  = balance(flat, tool, 0., 8., strength, "pixels");
        const auto              slopes = balance(flat, tool, 0., 8., strength);
        const auto volume = balance(flat, tool, 0., 8., strength, "paraboloid", "set Depth of patches = volume");
        EXPECT_EQ(slopes.n_patches, 1u);
        EXPECT_NEAR(slopes.coefficient, exact.coefficient, 0.01 * exact.coefficient) << psi << " " << tau;
        EXPECT_NEAR(volume.coefficient, exact.coefficient, 0.01 * exact.coefficient) << psi << " " << tau;
        EXPECT_NEAR(slopes.patch_fraction, exact.patch_fraction, 1e-3 * exact.patch_fraction);
      }
}

// Support equals load over many patches, whatever the load; pixels alone would miss it by up to one pixel's force.
TEST(Ploughing, ForcesBalanceOverPatches)
{
  const HeightMap      tool = wavy_tool(120), sheet = wavy_sheet(120);
  const ToolSurface    surface(tool, 4);
  const PlateauContact contact(sheet, surface, 0.3);
  const double         plateau = static_cast<double>(contact.n_plateau_pixels()) / static_cast<double>(tool.size());
  for (const std::string &name : ploughing_laws())
    {
      const auto  law  = make_law(name);
      std::size_t most = 0;
      for (const double p : { 0.001, 0.1, 1., 7.3, 20., 60. })
        for (const double tau : { 0., 25. })
          {
            const double hardness = 600.;
            const auto   result   = balance_ploughing(contact, *law, p, { hardness, 600. / 5.142, tau });
            EXPECT_NEAR(result.support, p, 1e-10 * p) << name;
            EXPECT_FALSE(result.full_contact) << name << ": " << p << " of at most " << 0.5 * hardness * plateau;
            EXPECT_GT(result.coefficient, 0.) << name;
            EXPECT_LT(result.coefficient, 0.2) << name; // slopes of this tool are about 0.3e-3 * 200 = 0.06
            EXPECT_NEAR(result.patch_pressure, hardness, 0.35 * hardness) << name;
            EXPECT_EQ(result.back_pressure, 0.);
            most = std::max(most, result.n_patches);
          }
      EXPECT_TRUE(most > 20u || name == "pixels") << name;
    }
}

// More load than the leading sides of all plateaus carry: the rest is a back pressure on all of the plateau, which adds
// to the load and not to the drag.
TEST(Ploughing, FullContactCarriesByBackPressure)
{
  const HeightMap      tool = wavy_tool(120), sheet = wavy_sheet(120);
  const ToolSurface    surface(tool, 4);
  const PlateauContact contact(sheet, surface, 0.3);
  const double         plateau  = static_cast<double>(contact.n_plateau_pixels()) / static_cast<double>(tool.size());
  const double         hardness = 600.;
  for (const std::string &name : ploughing_laws())
    for (const double tau : { 0., 25. })
      {
        const auto              law = make_law(name);
        const PloughingStrength strength{ hardness, hardness / 5.142, tau };
        const double            drag = 0.7 * hardness * plateau
                            * balance_ploughing(contact, *law, 0.7 * hardness * plateau, strength).coefficient;
        for (const double part : { 0.7, 1., 2., 10. })
          {
            const double p      = part * hardness * plateau;
            const auto   result = balance_ploughing(contact, *law, p, strength);
            EXPECT_TRUE(result.full_contact) << name;
            EXPECT_NEAR(result.support, p, 1e-10 * p) << name;
            EXPECT_NEAR(result.patch_fraction, plateau, 1e-14) << name;
            EXPECT_NEAR(result.coefficient * p, drag, 1e-10 * drag) << name;
            // mean of leading and trailing pressure, per plateau area
            EXPECT_NEAR(0.5 * (result.patch_pressure + result.back_pressure) * plateau, p, 1e-10 * p) << name;
            if (name != "Challen-Oxley") // there the pressure of the leading sides depends on slope and shear
              {
                EXPECT_NEAR(result.patch_pressure - result.back_pressure, hardness, 1e-10 * hardness) << name;
              }
          }
      }
}

// The drag is a continuous function of the load, also where the plateaus touch everywhere and the trailing sides begin
// to carry: no step larger than the steps of the load.
TEST(Ploughing, DragIsContinuousAtFullContact)
{
  const HeightMap      tool = wavy_tool(120), sheet = wavy_sheet(120);
  const ToolSurface    surface(tool, 4);
  const PlateauContact contact(sheet, surface, 0.3);
  const double         plateau  = static_cast<double>(contact.n_plateau_pixels()) / static_cast<double>(tool.size());
  const double         hardness = 600.;
  for (const std::string &name : ploughing_laws())
    {
      const auto law      = make_law(name);
      double     previous = 0;
      bool       before = false, after = false;
      for (double part = 0.36; part < 0.64; part += 0.002)
        {
          const double p      = part * hardness * plateau;
          const auto   result = balance_ploughing(contact, *law, p, { hardness, hardness / 5.142, 60. });
          const double drag   = result.coefficient * p;
          (result.full_contact ? after : before) = true;
          if (previous > 0)
            {
              EXPECT_NEAR(drag, previous, 0.02 * previous) << name << " at " << part; // the load steps by 0.004
            }
          previous = drag;
        }
      EXPECT_TRUE(before && after) << name;
    }
}

// A flat tool does not plough, whatever the shear: its friction is that of the boundary layer alone.
TEST(Ploughing, FlatToolDoesNotPlough)
{
  const auto flat = map_of(32, 1e-3, [](double, double) { return 0.; });
  for (const auto &[name, entry] : Registry<PloughingLaw>::entries())
    for (const double tau : { 0., 20. })
      {
        const auto result = balance(flat, flat, 0., 5., { 600., 600. / 5.142, tau }, name);
        EXPECT_NEAR(result.coefficient, 0., 1e-14) << name;
        if (name != "none")
          {
            EXPECT_NEAR(result.support, 5., 1e-12) << name;
          }
      }
}

TEST(Ploughing, NoneDoesNotPlough)
{
  EXPECT_EQ(balance(wavy_sheet(32), wavy_tool(32), 0., 5., { 600., 115., 20. }, "none").coefficient, 0.);
}

TEST(Ploughing, NoLoadNoFriction)
{
  const auto flat = map_of(8, 1e-3, [](double, double) { return 0.; });
  EXPECT_EQ(balance(flat, flat, 0., 0., { 600., 115., 20. }).coefficient, 0.);
}
