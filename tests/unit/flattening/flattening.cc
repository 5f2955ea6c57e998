#include "gaussian_map.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/flattening.h>
#include <tribodraw/material/hardening_law.h>

#include "claims.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;
using test::gaussian_map;
using test::normal_distribution;

namespace
{
  std::shared_ptr<const AsperityModel>
  make_model(const std::string &name, const std::string &entries = "")
  {
    const std::string section = name == "ideal plastic" ? "Ideal plastic" : name;
    Parameters        parameters
        = Parameters::from_text("set Model = " + name + "\nsubsection " + section + "\n" + entries + "\nend\n");
    std::shared_ptr<const AsperityModel> model = parameters.model<AsperityModel>("Model", "");
    parameters.finish();
    return model;
  }

  std::shared_ptr<const BulkStrainLaw>
  westeneng()
  {
    Parameters parameters = Parameters::from_text("");
    return Registry<BulkStrainLaw>::entries().at("Westeneng").create(parameters);
  }

  /// Flattening by load and strain with l = 25 um.
  Flattening
  with_strain(const std::shared_ptr<const AsperityModel> &model)
  {
    return Flattening(model, 25e-3, 0.1, westeneng());
  }

  struct ConstantHardening : HardeningLaw
  {
    explicit ConstantHardening(const double stress) : stress(stress) {}
    FlowStress
    flow_stress(double, double) const override
    {
      return { stress, 0., 0. };
    }
    const double stress;
  };

  /// Steep at the start, like annealed steel.
  struct PowerHardening : HardeningLaw
  {
    FlowStress
    flow_stress(const double strain, double) const override
    {
      return { 500. * std::pow(strain + 0.005, 0.22), 0., 0. };
    }
  };

  const double um = 1e-3;
} // namespace

// P/k of model.md 1.2 (C) and (B); (A) is linear with 5.142.
TEST(AsperityModels, NormalLoads)
{
  const auto   wilson_sheu = make_model("Wilson-Sheu");
  const double ratio       = 5.142 / std::sqrt(3.); // hardness over flow stress that gives H = 5.142 k
  const auto   linear      = make_model("ideal plastic", "set Hardness over flow stress = " + std::to_string(ratio));
  const auto   pullen = make_model("Pullen-Williamson", "set Hardness over flow stress = " + std::to_string(ratio));
  const double expected[][4]
      = { { .05, .2571, .2706, .2524 }, { .1, .5142, .5713, .4963 }, { .2, 1.028, 1.286, .966 },
          { .3, 1.543, 2.204, 1.427 },  { .5, 2.571, 5.142, 2.418 }, { .7, 3.599, 12.00, 3.799 } };
  for (const auto &[alpha, a, b, c] : expected)
    {
      EXPECT_NEAR(linear->normal_load(alpha, 1.), a, 6e-4);
      EXPECT_NEAR(pullen->normal_load(alpha, 1.), b, 1e-3 * b);
      EXPECT_TRUE(claims::agrees(claims::with("Wilson-Sheu, load over shear strength at contact fraction", alpha),
                                 "Wilson and Sheu 1988, evaluated independently", wilson_sheu->normal_load(alpha, 1.),
                                 c, 6e-4));
      EXPECT_NEAR(wilson_sheu->normal_load(alpha, 115.), 115. * wilson_sheu->normal_load(alpha, 1.), 1e-10);
    }
  // Pullen and Williamson 1972: the load H brings half the area into contact.
  EXPECT_NEAR(pullen->normal_load(0.5, 1.), ratio * std::sqrt(3.), 1e-5);
}

// f1 and f2 of model.md 1.3, recovered from E = (2 A k/P - f2)/f1 at two loads.
TEST(BulkStrain, WilsonSheuFunctions)
{
  const auto       model      = make_model("Wilson-Sheu");
  const double     l          = 25 * um;
  const Flattening flattening = with_strain(model);
  const double     expected[][3]
      = { { .1, .54090, .40298 }, { .3, .54110, .42052 }, { .5, .47250, .41364 }, { .9, .12890, .26714 } };
  for (const auto &[alpha, f1, f2] : expected)
    {
      const double e1 = l * flattening.strain_per_descent(alpha, 2. * alpha, 1.),
                   e2 = l * flattening.strain_per_descent(alpha, alpha, 1.);
      EXPECT_NEAR(1. / (e2 - e1), f1, 1e-5); // 2 A k/P = 1 and 2
      EXPECT_NEAR(1. - e1 / (e2 - e1), f2, 1e-5);
    }
  EXPECT_TRUE(std::isinf(flattening.strain_per_descent(1., 1., 1.)));
  EXPECT_LT(flattening.strain_per_descent(0.1, 10., 1.), 0.); // the load alone still flattens
}

// Load alone is the branch E = 0 of every asperity model: straining starts without a jump.
TEST(BulkStrain, StartsWhereTheLoadEnds)
{
  for (const char *name : { "Wilson-Sheu", "ideal plastic", "Pullen-Williamson" })
    {
      const auto       model      = make_model(name, name[0] == 'W' ? "" : "set Hardness over flow stress = 2.8");
      const Flattening flattening = with_strain(model);
      for (const double alpha : { 0.01, 0.3, 0.8 })
        {
          const double p = model->normal_load(alpha, 115.);
          EXPECT_NEAR(flattening.strain_per_descent(alpha, p, 115.), 0., 1e-10) << name;
          EXPECT_GT(flattening.strain_per_descent(alpha, 0.9 * p, 115.), 0.) << name;
        }
    }
}

TEST(Flattening, IsolatedPlateausHaveThePrandtlHardness)
{
  const Flattening flattening = with_strain(make_model("Wilson-Sheu"));
  EXPECT_TRUE(claims::agrees("hardness of an isolated plateau over shear strength",
                             "Prandtl: 2 + pi, rounded in the fit", flattening.hardness(1.), 5.142,
                             1e-6)); // 2 * 2.571: 2 + pi of the slip-line field, rounded in the fit
  EXPECT_NEAR(flattening.shear_strength(ConstantHardening(200.), 0.), 115.470054, 1e-6); // 200/sqrt(3)
}

TEST(Flattening, LoadIsInvertedExactly)
{
  for (const char *name : { "Wilson-Sheu", "Pullen-Williamson" })
    {
      const auto       model = make_model(name, name[0] == 'P' ? "set Hardness over flow stress = 2.8" : "");
      const Flattening flattening(model, 25 * um, 0.1);
      for (const double p : { 1e-3, 1., 20., 200., 600. })
        EXPECT_NEAR(model->normal_load(flattening.contact_fraction_under_load(p, 115.), 115.), p, 1e-11 * p);
      EXPECT_EQ(flattening.contact_fraction_under_load(0., 115.), 0.);
    }
}

// Sample of model.md 1.3: Gaussian Sq 1.6 um, sigma_y = 200 MPa, l = 25 um. Values as printed there.
TEST(Flattening, SampleOfNormalLoadAndStrain)
{
  const HeightDistribution heights(gaussian_map(700, 1.6 * um));
  const ConstantHardening  hardening(200.);
  const Flattening         flattening = with_strain(make_model("Wilson-Sheu"));
  const auto               contact    = [&](const double p) {
    std::vector<double> alpha;
    for (const double s : flattening.monotone_cut_heights(heights, hardening, p, { 0., .05, .1, .2 }))
      alpha.push_back(heights.contact_fraction(s));
    return alpha;
  };
  const auto compare
      = [](const std::vector<double> &found, const std::vector<double> &expected, const double tolerance) {
          for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(found[i], expected[i], tolerance) << i;
        };
  compare(contact(5.), { .0084, .043, .064, .102 }, 6e-4);
  const double with_strain_10[] = { .0170, .080, .119, .184 }, strain_10[] = { 0., .05, .1, .2 };
  const auto   contact_10 = contact(10.);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_TRUE(claims::agrees(claims::with("contact fraction of a Gaussian sheet at 10 MPa and strain", strain_10[i]),
                               "independent integration (printed digits)", contact_10[i], with_strain_10[i], 6e-4));
  compare(contact(20.), { .0341, .149, .216, .321 }, 6e-4);

  const auto s = flattening.monotone_cut_heights(heights, hardening, 5., { 0., .05, .1, .2 });
  // um, as printed there; the first value, printed as 4.0, does not belong to its contact fraction 0.0084: the Gaussian
  // closed form gives S = 2.391, 1.6 um * (S Phi(S) + phi(S)) = 3.83 um.
  const double d[] = { 3.83, 2.78, 2.48, 2.11 };
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_NEAR(heights.mean_gap(s[i]) / um, d[i], 0.006);
  EXPECT_NEAR(heights.mean_gap(flattening.monotone_cut_heights(heights, hardening, 10., { .2 })[0]) / um, 1.60, 6e-3);
  EXPECT_NEAR(heights.mean_gap(flattening.monotone_cut_heights(heights, hardening, 20., { .2 })[0]) / um, 1.08, 6e-3);
}

// At constant hardness the strain is a plain integral over s; for a map (piecewise constant contact fraction) it is the
// sum over the sorted heights, without any quadrature error.
TEST(Flattening, StrainIsTheIntegralOverTheHeights)
{
  const HeightMap           map = gaussian_map(200, 1.6 * um);
  const HeightDistribution  heights(map);
  const Flattening          flattening = with_strain(make_model("Wilson-Sheu"));
  const double              p = 8., k = 200. / std::sqrt(3.);
  const std::vector<double> strains{ 0.01, 0.05, 0.1, 0.3 };
  const auto                cut = flattening.monotone_cut_heights(heights, ConstantHardening(200.), p, strains);
  for (std::size_t i = 0; i < strains.size(); ++i)
    {
      double       eps = 0;
      const double n   = static_cast<double>(map.size());
      for (std::size_t j = map.size() - 1; j > 0; --j) // between heights j-1 and j the fraction is (n - j)/n
        {
          const double upper = map.z[j], lower = std::max(map.z[j - 1], cut[i]);
          if (lower >= upper)
            break;
          const double e = flattening.strain_per_descent((n - static_cast<double>(j)) / n, p, k);
          eps += std::max(0., e) * (upper - lower);
        }
      EXPECT_NEAR(eps, strains[i], 1e-4 * strains[i]);
    }
}

// With hardening: against the differential equation ds/d eps = -l/E(alpha(s), P, k(eps)) on the analytic Gaussian
// distribution, integrated over strain by classical Runge-Kutta steps. It is started at eps = 0.01 because ds/d eps is
// infinite at 0.
TEST(Flattening, QuadratureAgreesWithTheDifferentialEquation)
{
  const double             sq = 1.6 * um, l = 25 * um, p = 10.;
  const HeightDistribution heights(gaussian_map(1000, sq));
  const PowerHardening     hardening;
  const auto               model      = make_model("Wilson-Sheu");
  const Flattening         flattening = with_strain(model);
  std::vector<double>      strains{ 0.01 };
  for (int i = 1; i <= 10; ++i)
    strains.push_back(0.01 + 0.03 * i);
  const auto cut = flattening.monotone_cut_heights(heights, hardening, p, strains);

  const auto slope = [&](const double eps, const double s) {
    // f1 and f2 written out: independent of the code under test
    const double a = normal_distribution(-s / sq), k = hardening.flow_stress(eps, 0.).value / std::sqrt(3.);
    const double f1 = 0.515 + 0.345 * a - 0.860 * a * a, f2 = 1. / (2.571 - a - a * std::log(1. - a));
    return -l * f1 / (2. * a * k / p - f2);
  };
  double s = cut[0], eps = strains[0];
  for (std::size_t i = 1; i < strains.size(); ++i)
    {
      const unsigned int n = 300;
      const double       h = (strains[i] - strains[i - 1]) / n;
      for (unsigned int j = 0; j < n; ++j, eps += h)
        {
          const double k1 = slope(eps, s), k2 = slope(eps + h / 2, s + h / 2 * k1),
                       k3 = slope(eps + h / 2, s + h / 2 * k2), k4 = slope(eps + h, s + h * k3);
          s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
      EXPECT_NEAR(cut[i], s, 2e-5 * sq) << "strain " << strains[i]; // 1/n of the map is 1e-6
    }
}

TEST(Flattening, GrowsWithPressureAndStrain)
{
  const HeightDistribution  heights(gaussian_map(200, 1.6 * um));
  const Flattening          flattening = with_strain(make_model("Wilson-Sheu"));
  const std::vector<double> strains{ 0., 0.01, 0.1, 0.5 };
  std::vector<double>       previous(strains.size(), heights.highest());
  for (const double p : { 0.1, 1., 10., 50., 200. }) // 0.1 MPa: 8 of 40000 pixels
    {
      const auto s = flattening.monotone_cut_heights(heights, PowerHardening(), p, strains);
      for (std::size_t i = 0; i < strains.size(); ++i)
        {
          EXPECT_LT(s[i], previous[i]);
          if (i > 0)
            {
              EXPECT_LT(s[i], s[i - 1]);
            }
        }
      previous = s;
    }
  // No load, no flattening.
  for (const double s : flattening.monotone_cut_heights(heights, PowerHardening(), 0., strains))
    EXPECT_EQ(s, heights.highest());
}

TEST(Flattening, StrainDoesNothingWithoutABulkStrainLaw)
{
  const HeightDistribution heights(gaussian_map(100, 1.6 * um));
  const Flattening         flattening(make_model("ideal plastic", "set Hardness over flow stress = 2.8"), 25 * um, 0.1);
  const auto               s = flattening.monotone_cut_heights(heights, ConstantHardening(200.), 28., { 0., 0.1, 0.5 });
  EXPECT_NEAR(heights.contact_fraction(s[0]), 0.05, 1e-4); // 28 / (2.8 * 200), to one of 10000 pixels
  EXPECT_EQ(s[1], s[0]);
  EXPECT_EQ(s[2], s[0]);
}

TEST(Flattening, ReadsItsSection)
{
  Parameters       parameters = Parameters::from_text("set Model = Wilson-Sheu\n"
                                                            "set Asperity half spacing = 25 um\n"
                                                            "set Strain rate = 0.1 1/s\n");
  const Flattening flattening = Flattening::read(parameters);
  parameters.finish();
  EXPECT_NEAR(flattening.half_spacing(), 0.025, 1e-15);
  EXPECT_NEAR(flattening.strain_rate(), 0.1, 1e-15);
}

TEST(Flattening, TakesTheSpacingFromTheMap)
{
  Parameters       parameters = Parameters::from_text("set Model = Wilson-Sheu\n"
                                                            "set Asperity half spacing = from map\n"
                                                            "set Strain rate = 0.1 1/s\n");
  const Flattening flattening = Flattening::read(parameters);
  parameters.finish();
  EXPECT_TRUE(flattening.needs_spacing());
  EXPECT_THROW(flattening.half_spacing(), std::logic_error);
  // Smooth bumps of 10 x 10 pixels of 3 um.
  HeightMap map;
  map.nx = 60;
  map.ny = 40;
  map.dx = map.dy = 3 * um;
  map.periodic    = true;
  for (std::size_t iy = 0; iy < 40; ++iy)
    for (std::size_t ix = 0; ix < 60; ++ix)
      map.z.push_back(um * std::cos(0.62831853 * ix) * std::cos(0.62831853 * iy) + 1e-9 * ix);
  const Flattening counted = flattening.with_spacing_of(map);
  EXPECT_FALSE(counted.needs_spacing());
  // cos cos has two summits in each 10 x 10 pixels, (0,0) and (5,5): density 2/(30 um)^2
  EXPECT_NEAR(counted.half_spacing(), 0.5 * 30 * um / std::sqrt(2.), 1e-12);
  EXPECT_EQ(Flattening(nullptr, 25 * um, 0.).with_spacing_of(map).half_spacing(), 25 * um);
}

// Reported: what is wrong, by name, all at once.
TEST(Flattening, NamesImpossibleSpacings)
{
  for (const char *text : { "0 um", "-25 um", "25", "25 MPa", "from nowhere" })
    {
      Parameters parameters = Parameters::from_text(std::string("set Model = Wilson-Sheu\nset Strain rate = 0.1 1/s\n")
                                                    + "set Asperity half spacing = " + text + "\n");
      Flattening::read(parameters);
      EXPECT_THROW(parameters.finish(), InputError) << text;
    }
}

TEST(Flattening, NamesWrongEntries)
{
  Parameters parameters = Parameters::from_text("set Model = Ideal plastic\n"
                                                "set Asperity half spacing = -25 um\n"
                                                "set Strain rate = 0.1\n");
  Flattening::read(parameters);
  try
    {
      parameters.finish();
      FAIL() << "no error";
    }
  catch (const InputError &e)
    {
      const std::string text = e.what();
      EXPECT_NE(text.find("Model"), std::string::npos) << text;
      EXPECT_NE(text.find("Asperity half spacing"), std::string::npos) << text;
      EXPECT_NE(text.find("Strain rate"), std::string::npos) << text;
    }
}

// Root of a x + (b - a) x^2/(2 L) = amount, checked by inserting it.
TEST(Flattening, DistanceForAmount)
{
  for (const auto &[a, b] : { std::pair{ 0., 3. }, { 2., 2. }, { 3., 0. }, { 1., 1e6 } })
    for (const double part : { 1e-6, 0.3, 0.99 })
      {
        const double length = 0.7, amount = part * 0.5 * (a + b) * length;
        const double x = distance_for_amount(amount, a, b, length);
        EXPECT_NEAR(a * x + (b - a) * x * x / (2 * length), amount, 1e-13 * amount + 1e-15);
        EXPECT_LE(x, length);
      }
  EXPECT_EQ(distance_for_amount(0., 0., 1., 1.), 0.);
}
