// What every asperity model and every bulk strain law promises, for every registered one. A new model needs an example
// here: parameters with which it is tested.
#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/flattening.h>
#include <tribodraw/material/hardening_law.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace tribodraw;

namespace
{
  const std::map<std::string, std::string> examples
      = { { "Wilson-Sheu", "" },
          { "ideal plastic", "set Hardness over flow stress = 2.8\n" },
          { "Pullen-Williamson", "set Hardness over flow stress = 2.8\n" },
          { "tabulated hardness",
            "set Contact fractions = 0.01, 0.2, 0.6, 0.9\nset Hardness over flow stress = 2.9, 2.7, 2.8, 3.5\n" },
          { "energy of bars",
            "set Hardness over flow stress = 2.8\nset Persistence parameter = 0.3\n"
            "set Load carried by = crushed bars\nset Work hardening = true\nset Bar height = 10 um\n" } };

  template <class Interface>
  std::shared_ptr<const Interface>
  create(const std::string &name, const std::string &text)
  {
    Parameters                       parameters = Parameters::from_text(text);
    std::shared_ptr<const Interface> model      = Registry<Interface>::entries().at(name).create(parameters);
    parameters.finish();
    return model;
  }

  std::map<std::string, std::shared_ptr<const AsperityModel>>
  all_models()
  {
    std::map<std::string, std::shared_ptr<const AsperityModel>> models;
    for (const auto &[name, entry] : Registry<AsperityModel>::entries())
      {
        EXPECT_EQ(examples.count(name), 1u) << "The asperity model '" << name << "' has no example here.";
        EXPECT_FALSE(entry.info.description.empty()) << name;
        EXPECT_FALSE(entry.info.citation.empty()) << name;
        if (examples.count(name))
          models[name] = create<AsperityModel>(name, examples.at(name));
      }
    EXPECT_EQ(models.size(), examples.size());
    return models;
  }

  struct Steel : HardeningLaw
  {
    explicit Steel(const double stress) : scale(stress) {}
    FlowStress
    flow_stress(const double strain, double) const override
    {
      return { scale * std::pow(strain + 0.005, 0.22), 0., 0. };
    }
    const double scale;
  };

  /// Heights of an asymmetric, smooth distribution, all different.
  const HeightDistribution &
  heights()
  {
    static const HeightDistribution result = [] {
      HeightMap map;
      map.nx = map.ny = 200;
      map.dx = map.dy = 3e-3;
      for (std::size_t i = 0; i < map.size(); ++i)
        map.z.push_back(2e-3 * std::tanh(4. * (static_cast<double>(i) / map.size() - 0.3)));
      return HeightDistribution(map);
    }();
    return result;
  }

  PlateauState
  state(const double contact_fraction)
  {
    return { heights(), heights().cut_height_for_contact_fraction(contact_fraction) };
  }

  const double fractions[] = { 1e-4, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97 };
} // namespace

TEST(AsperityModelContract, LoadIncreasesFromZero)
{
  const Steel steel(500.);
  for (const auto &[name, model] : all_models())
    {
      EXPECT_EQ(model->normal_load(PlateauState(heights(), heights().highest() + 1.), { steel, 0.1, 1. }), 0.) << name;
      double previous = 0;
      for (const double alpha : fractions)
        {
          const double load = model->normal_load(state(alpha), { steel, 0.1, 1. });
          EXPECT_GT(load, previous) << name << " at " << alpha;
          EXPECT_TRUE(std::isfinite(load)) << name << " at " << alpha;
          previous = load;
        }
    }
}

// The load of isolated plateaus is the hardness times their area.
TEST(AsperityModelContract, HardnessIsTheLimitOfSmallContact)
{
  const Steel steel(500.);
  for (const auto &[name, model] : all_models())
    {
      const SheetStrength strength(steel, 0.1, 1.);
      const PlateauState  one_pixel(heights(), heights().highest());
      EXPECT_NEAR(model->normal_load(one_pixel, strength) / one_pixel.contact_fraction, model->hardness(strength),
                  1e-4 * model->hardness(strength))
          << name;
    }
}

// Everything plastic scales with the strength of the sheet.
TEST(AsperityModelContract, LoadIsProportionalToTheStrength)
{
  const Steel soft(200.), hard(500.);
  for (const auto &[name, model] : all_models())
    for (const double alpha : fractions)
      {
        const double load = model->normal_load(state(alpha), { soft, 0.1, 1. });
        EXPECT_NEAR(model->normal_load(state(alpha), { hard, 0.1, 1. }), 2.5 * load, 1e-12 * load) << name;
      }
}

// Models that do not ask for the heights give the same for the contact fraction alone.
TEST(AsperityModelContract, ContactFractionIsEnoughUnlessHeightsAreNeeded)
{
  for (const auto &[name, model] : all_models())
    for (const double alpha : fractions)
      {
        if (model->needs_heights())
          continue;
        EXPECT_EQ(model->normal_load(state(alpha).contact_fraction, 115.), model->normal_load(state(alpha), 115.))
            << name;
      }
}

// The cut height found for a load carries it, and one pixel less does not.
TEST(AsperityModelContract, CutHeightCarriesTheLoad)
{
  const Steel         steel(500.);
  const SheetStrength strength(steel, 0.05, 1.);
  for (const auto &[name, model] : all_models())
    {
      const Flattening flattening(model, 25e-3, 1.);
      for (const double p : { 1., 20., 200. })
        {
          const double s = flattening.cut_height_under_load(heights(), p, strength);
          EXPECT_GE(model->normal_load({ heights(), s }, strength), p * (1. - 1e-12)) << name;
          const auto pixels = std::lround(heights().contact_fraction(s) * static_cast<double>(heights().size()));
          if (pixels > 1)
            {
              const double higher = heights().nth_highest(static_cast<std::size_t>(pixels) - 1);
              EXPECT_LT(model->normal_load({ heights(), higher }, strength), p) << name;
            }
        }
    }
}

// Every pair of asperity model and bulk strain law: strain starts where the load ends, and never undoes flattening.
TEST(BulkStrainLawContract, StrainContinuesTheLoad)
{
  const Steel steel(500.);
  for (const auto &[law_name, entry] : Registry<BulkStrainLaw>::entries())
    {
      EXPECT_FALSE(entry.info.description.empty()) << law_name;
      EXPECT_FALSE(entry.info.citation.empty()) << law_name;
      const auto law = create<BulkStrainLaw>(law_name, "");
      EXPECT_EQ(std::isinf(law->strain_rate_number(0.1, 4., 5.)), std::isinf(law->strain_rate_number(0.9, 1., 5.)));
      if (std::isfinite(law->strain_rate_number(0.3, 4., 5.)))
        {
          EXPECT_NEAR(law->strain_rate_number(0.3, 5., 5.), 0., 1e-14) << law_name;
          EXPECT_GT(law->strain_rate_number(0.3, 3., 5.), law->strain_rate_number(0.3, 4., 5.)) << law_name;
          EXPECT_GT(law->strain_rate_number(0.3, 4., 5.), 0.) << law_name;
          EXPECT_LT(law->strain_rate_number(0.3, 6., 5.), 0.) << law_name;
        }
      for (const auto &[name, model] : all_models())
        {
          const Flattening flattening(model, 25e-3, 1., law);
          const auto       s = flattening.monotone_cut_heights(heights(), steel, 10., { 0., 1e-6, 0.01, 0.1, 0.3 });
          EXPECT_EQ(s[0], flattening.cut_height_under_load(heights(), 10., flattening.strength(steel, 0.))) << name;
          EXPECT_NEAR(s[1], s[0], 0.02 * heights().sq()) << name << ": a jump at the start of straining";
          for (std::size_t i = 1; i < s.size(); ++i)
            EXPECT_LE(s[i], s[i - 1]) << name;
          // History: a lower load on a flattened sheet leaves it as it is, and strain only lowers it.
          EXPECT_EQ(flattening.advance(heights(), steel, s[3], 1., 0.1, 0.1), s[3]) << name;
          EXPECT_LE(flattening.advance(heights(), steel, s[3], 1., 0.1, 0.2), s[3]) << name;
          EXPECT_EQ(flattening.advance(heights(), steel, s[3], 0., 0.1, 0.2), s[3]) << name;
          // In increments as in one.
          double stepwise = heights().highest();
          for (unsigned int i = 0; i < 10; ++i)
            stepwise = flattening.advance(heights(), steel, stepwise, 10., 0.01 * i, 0.01 * (i + 1));
          EXPECT_NEAR(stepwise, s[3], 2e-3 * heights().sq()) << name << ", " << law_name;
        }
    }
}
