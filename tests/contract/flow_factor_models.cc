// What every registered flow factor model must hold, so that friction tables and the film equation can rely on it.
#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/flow_factors/flow_factors.h>

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

using namespace tribodraw;

namespace
{
  constexpr std::size_t n  = 48;
  constexpr double      um = 1e-3;

  // Waves of random direction and phase between 5 and 12 per map: nearly Gaussian, isotropic; Sq = 1 um.
  HeightMap
  rough_map(const unsigned seed)
  {
    HeightMap map;
    map.nx = map.ny = n;
    map.dx = map.dy = 3 * um;
    map.periodic    = true;
    map.z.assign(n * n, 0.);
    std::mt19937 random(seed);
    double       square = 0;
    for (int wave = 0; wave < 60; ++wave)
      {
        int kx, ky;
        do
          {
            kx = static_cast<int>(random() % 25) - 12;
            ky = static_cast<int>(random() % 25) - 12;
          }
        while (kx * kx + ky * ky < 25 || kx * kx + ky * ky > 144);
        const double phase = 1e-9 * static_cast<double>(random());
        for (std::size_t i = 0; i < n * n; ++i)
          map.z[i] += std::cos(6.283185307179586 / n * (kx * double(i % n) + ky * double(i / n)) + phase);
      }
    for (const double z : map.z)
      square += z * z / (n * n);
    for (double &z : map.z)
      z *= um / std::sqrt(square);
    return map;
  }

  class AnyFlowFactorModel : public ::testing::TestWithParam<std::string>
  {
  protected:
    HeightMap                        sheet = rough_map(1), tool = rough_map(2);
    std::unique_ptr<FlowFactorModel> model;

    void
    SetUp() override
    {
      // A model that reads a file gets one: factors of a rough surface at four separations.
      const auto file = std::filesystem::temp_directory_path()
                        / ("flow_factor_contract_" + std::to_string(parallel::rank()) + ".csv");
      std::ofstream(file) << "h_avg_over_sq,phi_p_xx,phi_p_xy,phi_p_yx,phi_p_yy,phi_s_xx,phi_s_xy,phi_s_yx,phi_s_yy\n"
                             "0.5,0.1,0,0,0.1,0.5,0,0,0.5\n1,0.45,0,0,0.45,0.75,0,0,0.75\n"
                             "2,0.74,0,0,0.74,0.7,0,0,0.7\n6,0.96,0,0,0.96,0.25,0,0,0.25\n";
      std::string section = GetParam();
      section[0]          = static_cast<char>(std::toupper(section[0]));
      std::string text    = "set Model = " + GetParam() + "\n";
      model               = make(text);
      if (!model)
        model = make(text + "subsection " + section + "\n set File = " + file.string() + "\nend\n");
      ASSERT_TRUE(model) << "this model needs entries that the contract does not know";
    }

    static std::unique_ptr<FlowFactorModel>
    make(const std::string &text)
    {
      try
        {
          Parameters parameters = Parameters::from_text(text);
          auto       result     = read_flow_factors(parameters);
          parameters.finish();
          return result;
        }
      catch (const InputError &)
        {
          return nullptr;
        }
    }

    std::vector<FlowFactors>
    compute(const HeightMap &counter, const std::vector<double> &separations, const double sq = um) const
    {
      return model->compute(sheet, counter, sq, cut_heights_for_separations(sheet, counter, sq, separations), {});
    }
  };

  std::vector<std::string>
  names()
  {
    std::vector<std::string> result;
    for (const auto &[name, entry] : Registry<FlowFactorModel>::entries())
      result.push_back(name);
    return result;
  }

  const std::vector<double> separations{ 20, 10, 6, 5, 4, 3, 2.5, 2, 1.5, 1, .8, .6, .4, .3, .1 };
} // namespace

TEST_P(AnyFlowFactorModel, GivesFiniteFactorsAtTheSeparationsAskedFor)
{
  double     done    = 0;
  const auto cuts    = cut_heights_for_separations(sheet, {}, um, separations);
  const auto factors = model->compute(sheet, {}, um, cuts, [&done](const double fraction) { done = fraction; });
  EXPECT_EQ(done, 1);
  ASSERT_EQ(factors.size(), separations.size());
  for (std::size_t i = 0; i < factors.size(); ++i)
    {
      const FlowFactors &f = factors[i];
      EXPECT_EQ(f.cut_height, cuts[i]);
      EXPECT_NEAR(f.h_avg, separations[i] * um, 1e-12);
      EXPECT_GE(f.contact_fraction, 0);
      EXPECT_LE(f.contact_fraction, 1);
      for (const std::size_t k : { 0, 1, 2, 3 })
        {
          EXPECT_TRUE(std::isfinite(f.phi_p[k]));
          EXPECT_TRUE(std::isfinite(f.phi_s[k]));
        }
      for (const std::size_t k : { 0, 3 })
        {
          // no flow against the pressure; not more than all lubricant moves with the sheet
          EXPECT_GE(f.phi_p[k], 0) << separations[i];
          EXPECT_GE(f.phi_s[k], 0) << separations[i];
          EXPECT_LE(f.phi_s[k], separations[i] * (1 + 1e-9)) << separations[i];
        }
    }
}

TEST_P(AnyFlowFactorModel, HasTheLimitsOfASmoothGapAndOfNoGap)
{
  // second-order perturbation: 1 - PhiP = 1.5/H^2, PhiS = 1.5/H for an isotropic surface; 6/H^2, 3/H at most
  const FlowFactors wide = compute({}, { 200 })[0], closed = compute({}, { 0.02 })[0];
  for (const std::size_t k : { 0, 3 })
    {
      EXPECT_NEAR(wide.phi_p[k], 1, 6. / (200 * 200));
      EXPECT_LE(wide.phi_s[k], 3. / 200);
      EXPECT_LE(closed.phi_s[k], 0.02 * (1 + 1e-9));
    }
}

TEST_P(AnyFlowFactorModel, PressureFlowGrowsWithTheGap)
{
  const auto factors = compute({}, separations);
  for (std::size_t i = 1; i < factors.size(); ++i)
    for (const std::size_t k : { 0, 3 })
      EXPECT_LE(factors[i].phi_p[k] * std::pow(factors[i].h_avg, 3),
                factors[i - 1].phi_p[k] * std::pow(factors[i - 1].h_avg, 3) * (1 + 1e-9))
          << separations[i];
}

TEST_P(AnyFlowFactorModel, DoesNotDependOnTheUnitOfHeight)
{
  const auto factors = compute({}, { 3, 1 });
  for (double &z : sheet.z)
    z *= 7;
  const auto larger = compute({}, { 3, 1 }, 7 * um);
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (const std::size_t k : { 0, 1, 2, 3 })
      {
        EXPECT_NEAR(larger[i].phi_p[k], factors[i].phi_p[k], 1e-10);
        EXPECT_NEAR(larger[i].phi_s[k], factors[i].phi_s[k], 1e-10);
      }
}

TEST_P(AnyFlowFactorModel, FingerprintIsStable)
{
  EXPECT_FALSE(model->fingerprint().empty());
  EXPECT_EQ(model->fingerprint(), model->fingerprint());
}

INSTANTIATE_TEST_SUITE_P(AllRegistered, AnyFlowFactorModel, ::testing::ValuesIn(names()), [](const auto &test) {
  std::string name = test.param;
  for (char &c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)))
      c = '_';
  return name;
});

TEST(FlowFactorModels, TheShippedOnesAreRegistered)
{
  for (const char *name : { "cell problem", "Patir-Cheng", "Tripp", "Wilson-Marsault", "table" })
    EXPECT_TRUE(Registry<FlowFactorModel>::entries().count(name)) << name;
}
