// What every asperity model promises, for every registered one. A new model needs an example here: parameters with which
// it is tested.
#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/asperity_model.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace tribodraw;

namespace
{
  const std::map<std::string, std::string> examples = { { "Wilson-Sheu", "" },
                                                        { "ideal plastic", "set Hardness over flow stress = 2.8\n" },
                                                        { "Pullen-Williamson", "set Hardness over flow stress = 2.8\n" } };

  std::map<std::string, std::unique_ptr<AsperityModel>>
  all_models()
  {
    std::map<std::string, std::unique_ptr<AsperityModel>> models;
    for (const auto &[name, entry] : Registry<AsperityModel>::entries())
      {
        EXPECT_EQ(examples.count(name), 1u) << "The asperity model '" << name << "' has no example here.";
        EXPECT_FALSE(entry.info.description.empty()) << name;
        EXPECT_FALSE(entry.info.citation.empty()) << name;
        if (!examples.count(name))
          continue;
        Parameters parameters = Parameters::from_text(examples.at(name));
        models[name]          = entry.create(parameters);
        parameters.finish();
      }
    EXPECT_EQ(models.size(), examples.size());
    return models;
  }

  const double fractions[] = { 1e-6, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97 };
} // namespace

TEST(AsperityModelContract, LoadIncreasesFromZero)
{
  for (const auto &[name, model] : all_models())
    {
      EXPECT_EQ(model->normal_load(0., 115.), 0.) << name;
      double previous = 0;
      for (const double alpha : fractions)
        {
          const double load = model->normal_load(alpha, 115.);
          EXPECT_GT(load, previous) << name << " at " << alpha;
          EXPECT_TRUE(std::isfinite(load)) << name << " at " << alpha;
          previous = load;
        }
    }
}

// Everything plastic scales with the shear strength of the sheet.
TEST(AsperityModelContract, LoadIsProportionalToTheShearStrength)
{
  for (const auto &[name, model] : all_models())
    for (const double alpha : fractions)
      {
        const double load = model->normal_load(alpha, 100.), strain = model->strain_rate_number(alpha, 5., 100.);
        EXPECT_NEAR(model->normal_load(alpha, 250.), 2.5 * load, 1e-12 * load) << name;
        if (std::isfinite(strain))
          {
            EXPECT_NEAR(model->strain_rate_number(alpha, 12.5, 250.), strain, 1e-12 * std::abs(strain)) << name;
          }
      }
}

// Load and strain fit together: bulk strain is needed just where the load alone does not flatten any more.
TEST(AsperityModelContract, StrainStartsWhereTheLoadEnds)
{
  for (const auto &[name, model] : all_models())
    for (const double alpha : fractions)
      {
        const double p = model->normal_load(alpha, 115.);
        if (std::isinf(model->strain_rate_number(alpha, p, 115.)))
          continue; // strain does not flatten in this model
        EXPECT_NEAR(model->strain_rate_number(alpha, p, 115.), 0., 1e-12) << name << " at " << alpha;
        EXPECT_GT(model->strain_rate_number(alpha, 0.9 * p, 115.), 0.) << name << " at " << alpha;
        EXPECT_LT(model->strain_rate_number(alpha, 1.1 * p, 115.), 0.) << name << " at " << alpha;
        EXPECT_GT(model->strain_rate_number(1.01 * alpha, p, 115.), 0.) << name << " at " << alpha;
      }
}

// A model without flattening by strain is so at every state: the friction table relies on it.
TEST(AsperityModelContract, InfiniteStrainNumbersAreInfiniteEverywhere)
{
  for (const auto &[name, model] : all_models())
    {
      const bool infinite = std::isinf(model->strain_rate_number(0.1, 5., 115.));
      for (const double alpha : fractions)
        for (const double p : { 0.1, 10., 100. })
          EXPECT_EQ(std::isinf(model->strain_rate_number(alpha, p, 115.)), infinite) << name;
    }
}
