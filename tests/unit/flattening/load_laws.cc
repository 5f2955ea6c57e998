// The energy of bars and tabulated hardness; the other laws are in flattening.cc.
#include "gaussian_map.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/flattening.h>
#include <tribodraw/material/hardening_law.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;
using test::gaussian_map;
using test::normal_density;
using test::normal_distribution;

namespace
{
  const double um = 1e-3;

  std::shared_ptr<const AsperityModel>
  make(const std::string &name, const std::string &text)
  {
    Parameters                           parameters = Parameters::from_text(text);
    std::shared_ptr<const AsperityModel> model      = Registry<AsperityModel>::entries().at(name).create(parameters);
    parameters.finish();
    return model;
  }

  std::shared_ptr<const AsperityModel>
  bars(const double persistence, const bool all_carry, const double bar_height = 0)
  {
    return make("energy of bars",
                "set Hardness over flow stress = 2.8\nset Persistence parameter = " + std::to_string(persistence)
                    + "\nset Load carried by = " + (all_carry ? "touching bars" : "crushed bars")
                    + "\nset Work hardening = "
                    + (bar_height > 0 ? "true\nset Bar height = " + std::to_string(bar_height) + " um" : "false"));
  }

  /// Linear hardening: work of displacement has a closed form.
  struct Linear : HardeningLaw
  {
    FlowStress
    flow_stress(const double strain, double) const override
    {
      return { 200. + 400. * strain, 0., 0. };
    }
  };

  struct Power : HardeningLaw
  {
    FlowStress
    flow_stress(const double strain, double) const override
    {
      return { 500. * std::pow(strain + 0.005, 0.22), 0., 0. };
    }
  };

  std::string
  complaint(const std::string &name, const std::string &text)
  {
    try
      {
        make(name, text);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
} // namespace

// Ideally plastic bars (model.md 1.2 D): P = (1 + eta) H alpha if all touching bars carry; if only crushed bars do,
// P = (1 + eta) H (1 - F(d)) with d = s + u, for a Gaussian Sq (S Phi(S) + phi(S)).
TEST(EnergyBars, IdealPlasticLimits)
{
  const double             sq = 1.6 * um, H = 2.8 * 200.;
  const HeightDistribution heights(gaussian_map(1000, sq));
  const SheetStrength      strength(200. / std::sqrt(3.));
  for (const double eta : { 0., 0.4, 1. })
    for (const double S : { 2.5, 1., 0., -0.5 })
      {
        const PlateauState state(heights, S * sq);
        const double       d = S * normal_distribution(S) + normal_density(S);
        EXPECT_NEAR(bars(eta, true)->normal_load(state, strength), (1. + eta) * H * normal_distribution(-S), 2e-6 * H);
        EXPECT_NEAR(bars(eta, false)->normal_load(state, strength), (1. + eta) * H * normal_distribution(-d), 3e-6 * H);
      }
}

// Work over displacement, summed bar by bar: with sigma = 200 + 400 eps a bar crushed by x takes
//   B [ 200 x + 400 lambda ( (1-q) ln(1-q) + q ) ],  q = x/lambda,   raised:  B [ 200 x + 400 lambda ( (1+q) ln(1+q) -
//   q ) ].
// 48 straight pieces: within 1e-4.
TEST(EnergyBars, WorkHardeningAgainstASumOverBars)
{
  const double             sq = 1.6 * um, lambda = 12 * um, B = 2.8, eta = 0.6;
  const HeightMap          map = gaussian_map(300, sq);
  const HeightDistribution heights(map);
  const Linear             hardening;
  const double             eps0 = 0.1, sigma0 = 200. + 400. * eps0;
  const auto               crush = [&](const double x) {
    const double q = x / lambda;
    return B * (sigma0 * x + 400. * lambda * ((1. - q) * std::log1p(-q) + q));
  };
  const auto raise = [&](const double x) {
    const double q = x / lambda;
    return B * (sigma0 * x + 400. * lambda * ((1. + q) * std::log1p(q) - q));
  };
  for (const double s : { 2. * sq, sq, 0., -0.8 * sq })
    {
      const double u = heights.uniform_rise(s), d = s + u;
      double       crushing = 0, raising = 0, indentation = 0;
      const double n = static_cast<double>(map.size());
      for (const double raw : map.z)
        {
          const double z = raw - heights.mean();
          if (z > d)
            {
              crushing += crush(z - d) / n;
              indentation += (z - d) / n;
            }
          else
            raising += raise(std::min(d - z, u)) / n;
        }
      const PlateauState state(heights, s);
      const double       expected = (crushing + eta * raising) * state.contact_fraction / indentation;
      const double       found    = bars(eta, true, 12.)->normal_load(state, { hardening, eps0, 1. });
      EXPECT_NEAR(found, expected, 1e-4 * expected) << s / sq;
      EXPECT_GT(found, (1. + eta) * B * sigma0 * state.contact_fraction); // hardening costs
    }
}

// Straight pieces: 3e-4 for a law that is steep at the start, against the same sum made with 400 midpoints for each
// bar.
TEST(EnergyBars, PiecesAreFineEnoughForSteel)
{
  const double             sq = 1.6 * um, lambda = 12 * um;
  const HeightMap          map = gaussian_map(100, sq);
  const HeightDistribution heights(map);
  const Power              hardening;
  for (const double s : { 1.5 * sq, 0., -0.8 * sq })
    {
      const double u = heights.uniform_rise(s), d = s + u;
      double       work = 0, indentation = 0;
      for (const double raw : map.z)
        {
          const double x = raw - heights.mean() - d;
          if (x <= 0)
            continue;
          indentation += x;
          const unsigned int m = 400;
          for (unsigned int i = 0; i < m; ++i)
            {
              const double a = x * i * i / (m * m), b = x * (i + 1) * (i + 1) / (m * m);
              work += 2.8 * hardening.flow_stress(-std::log1p(-0.5 * (a + b) / lambda), 1.).value * (b - a);
            }
        }
      const PlateauState state(heights, s);
      const double       expected = work / indentation * state.contact_fraction;
      EXPECT_NEAR(bars(0., true, 12.)->normal_load(state, { hardening, 0., 1. }), expected, 3e-4 * expected) << s / sq;
    }
}

TEST(EnergyBars, NamesImpossibleEntries)
{
  const std::string good = "set Hardness over flow stress = 2.8\nset Work hardening = false\n";
  EXPECT_NE(complaint("energy of bars", good + "set Persistence parameter = 1.5").find("Persistence"),
            std::string::npos);
  EXPECT_NE(complaint("energy of bars", good + "set Persistence parameter = -0.1").find("Persistence"),
            std::string::npos);
  EXPECT_NE(complaint("energy of bars", "set Hardness over flow stress = -2.8\nset Work hardening = false\n"
                                        "set Persistence parameter = 0")
                .find("Hardness"),
            std::string::npos);
  EXPECT_NE(complaint("energy of bars", "set Hardness over flow stress = 2.8\nset Work hardening = true\n"
                                        "set Persistence parameter = 0")
                .find("Bar height"),
            std::string::npos);
}

// Straight lines between the given points, constant outside; P = H alpha.
TEST(TabulatedHardness, Interpolates)
{
  const auto   model = make("tabulated hardness",
                            "set Contact fractions = 0.1, 0.3, 0.5\nset Hardness over flow stress = 3, 2.6, 3.2\n");
  const double k     = 100. / std::sqrt(3.); // flow stress 100 MPa
  for (const auto &[alpha, ratio] : { std::pair{ 0.05, 3. }, { 0.1, 3. }, { 0.2, 2.8 }, { 0.4, 2.9 }, { 0.8, 3.2 } })
    EXPECT_NEAR(model->normal_load(alpha, k), 100. * ratio * alpha, 1e-10) << alpha;
  EXPECT_NEAR(model->hardness(k), 300., 1e-10);
}

TEST(TabulatedHardness, NamesImpossibleTables)
{
  const auto text = [](const std::string &fractions, const std::string &ratios) {
    return complaint("tabulated hardness",
                     "set Contact fractions = " + fractions + "\nset Hardness over flow stress = " + ratios + "\n");
  };
  EXPECT_NE(text("0.1, 0.3", "3, 2, 1").find("one value for each"), std::string::npos);
  EXPECT_NE(text("0.3, 0.1", "3, 2").find("ascending"), std::string::npos);
  EXPECT_NE(text("0.1, 1.3", "3, 2").find("Contact fractions"), std::string::npos);
  EXPECT_NE(text("0.1, 0.3", "3, -2").find("Hardness"), std::string::npos);
  EXPECT_NE(text("0.1, 0.3", "3, 0.9").find("falls before"), std::string::npos); // load 0.3 -> 0.27
  EXPECT_EQ(text("0.1, 0.3", "3, 2.9"), "");
}
