#include "paper_material.h"

#include <tribodraw/base/errors.h>

#include "claims.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace tribodraw;

namespace
{
  void
  expect_slopes(const HardeningLaw &law, const std::vector<double> &rates)
  {
    for (double strain : { 0., 0.001, 0.02, 0.3, 1.5 })
      for (double rate : rates)
        {
          const auto   f = law.flow_stress(strain + 1e-3, rate);
          const double h = 1e-6, k = 1e-5 * rate;
          EXPECT_NEAR((law.flow_stress(strain + 1e-3 + h, rate).value - law.flow_stress(strain + 1e-3 - h, rate).value)
                          / (2 * h),
                      f.strain_slope, 1e-7 * (1 + std::abs(f.strain_slope)) + 1e-6 * 200);
          if (rate > 0)
            {
              EXPECT_NEAR(
                  (law.flow_stress(strain + 1e-3, rate + k).value - law.flow_stress(strain + 1e-3, rate - k).value)
                      / (2 * k),
                  f.rate_slope, 1e-6 * (1 + std::abs(f.rate_slope)));
            }
        }
  }
} // namespace

// Static part: reference values of an independent script with Table 3 of Shisode et al. (2021), MPa.
TEST(BergstroemVanLiempt, static_part)
{
  const auto   law      = paper::hardening("Bergstroem-van Liempt");
  const double strain[] = { 0, .01, .05, .1, .2, .3, .5 },
               value[]  = { 137.377, 164.991, 234.479, 286.213, 341.376, 368.188, 393.600 };
  for (int i = 0; i < 7; ++i)
    EXPECT_TRUE(claims::agrees(claims::with("Bergstroem-van Liempt, static flow stress in MPa at strain", strain[i]),
                               "independent script with Table 3 of Shisode et al. 2021",
                               law->flow_stress(strain[i], 0).value, value[i], 5e-4)); // printed digits
  EXPECT_NEAR(law->flow_stress(0, 0).strain_slope, 3335, 0.5);                         // finite thanks to eps0
}

TEST(BergstroemVanLiempt, dynamic_part)
{
  const auto   law    = paper::hardening("Bergstroem-van Liempt");
  const double rate[] = { 1e-3, 1e-2, .1, 1, 10 }, value[] = { 14.0575, 29.9286, 52.4693, 82.0319, 118.909 };
  for (int i = 0; i < 5; ++i)
    EXPECT_TRUE(claims::agrees(
        claims::with("Bergstroem-van Liempt, dynamic part in MPa at rate", rate[i]), "independent script with Table 3",
        law->flow_stress(.1, rate[i]).value - law->flow_stress(.1, 0).value, value[i], i < 4 ? 5e-5 : 5e-4));
  // Below rate0 exp(-dG0/kT) = 3.63e-6 1/s nothing is left, and the bracket must not become negative.
  EXPECT_EQ(law->flow_stress(.1, 3.62e-6).value, law->flow_stress(.1, 0).value);
  EXPECT_GT(law->flow_stress(.1, 3.70e-6).value, law->flow_stress(.1, 0).value);
  EXPECT_EQ(law->flow_stress(.1, 3.62e-6).rate_slope, 0.);
  EXPECT_EQ(law->flow_stress(.1, 0.).rate_slope, 0.);
  // At the limit rate the full dynamic stress acts.
  EXPECT_NEAR(law->flow_stress(.1, 1e8).value - law->flow_stress(.1, 0).value, 600, 1e-9);
}

// Table of flow stresses over strain and rate (two printed digits) from an independent calculation.
TEST(BergstroemVanLiempt, table)
{
  const auto   law          = paper::hardening("Bergstroem-van Liempt");
  const double strain[]     = { 0, .002, .01, .02, .05, .10, .15, .20, .30, .50 };
  const double rate[]       = { 1e-4, 1e-3, 1e-2, .1, 1, 10 };
  const double value[6][10] = { { 141.78, 148.13, 169.40, 190.91, 238.89, 290.62, 323.59, 345.78, 372.59, 398.01 },
                                { 151.43, 157.78, 179.05, 200.56, 248.54, 300.27, 333.24, 355.43, 382.25, 407.66 },
                                { 167.31, 173.65, 194.92, 216.44, 264.41, 316.14, 349.11, 371.30, 398.12, 423.53 },
                                { 189.85, 196.19, 217.46, 238.98, 286.95, 338.68, 371.65, 393.85, 420.66, 446.07 },
                                { 219.41, 225.75, 247.02, 268.54, 316.51, 368.25, 401.21, 423.41, 450.22, 475.63 },
                                { 256.29, 262.63, 283.90, 305.42, 353.39, 405.12, 438.09, 460.29, 487.10, 512.51 } };
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 10; ++j)
      EXPECT_NEAR(law->flow_stress(strain[j], rate[i]).value, value[i][j], 0.00501) << rate[i] << " " << strain[j];
}

// Uniform strain (Considere) at constant rate and tensile strength s exp(-e): independent calculation, printed digits.
TEST(BergstroemVanLiempt, uniform_strain)
{
  const auto   law    = paper::hardening("Bergstroem-van Liempt");
  const double rate[] = { 1e-3, 1e-2, 1 }, uniform[] = { .2040, .1986, .1826 }, strength[] = { 291.0, 304.0, 347.1 };
  for (int i = 0; i < 3; ++i)
    {
      double low = 0, high = 0.5;
      for (int k = 0; k < 60; ++k)
        {
          const double e                          = 0.5 * (low + high);
          const auto   f                          = law->flow_stress(e, rate[i]);
          (f.strain_slope > f.value ? low : high) = e;
        }
      EXPECT_NEAR(low, uniform[i], 5.1e-5);
      // Engineering stress at maximum load.
      EXPECT_NEAR(law->flow_stress(low, rate[i]).value * std::exp(-low), strength[i], 0.06);
    }
}

TEST(BergstroemVanLiempt, slopes)
{
  expect_slopes(*paper::hardening("Bergstroem-van Liempt"), { 0., 1e-6, 1e-5, 1e-3, 0.1, 10. });
}

TEST(BergstroemVanLiempt, activation_energy_in_joule_is_refused)
{
  std::string text = paper::bergstroem_van_liempt;
  text.replace(text.find("0.8 eV"), 6, "0.8 J");
  EXPECT_THROW(paper::make<HardeningLaw>("Bergstroem-van Liempt", text), std::exception);
}

TEST(Swift, values_and_slopes)
{
  const auto law = paper::hardening("Swift");
  // By hand: 565.32 * 0.107117^0.2589 = 565.32 * exp(0.2589 * ln 0.107117).
  EXPECT_NEAR(law->flow_stress(0.1, 1).value, 565.32 * std::exp(0.2589 * std::log(0.107117)), 1e-10);
  EXPECT_NEAR(law->flow_stress(1 - 0.007117, 5).value, 565.32, 1e-10); // K where strain + eps0 = 1
  expect_slopes(*law, { 0., 1. });
}

// AA6022-T4 of Tian et al. (2016): 436 - 222 exp(-6.75 eps).
TEST(Voce, values_and_slopes)
{
  const auto law = paper::make<HardeningLaw>(
      "Voce", "set Initial stress = 214 MPa\nset Saturation stress = 436 MPa\nset Saturation rate = 6.75\n");
  EXPECT_NEAR(law->flow_stress(0, 1).value, 214, 1e-12);
  EXPECT_NEAR(law->flow_stress(0.1, 1).value, 436 - 222 * std::exp(-0.675), 1e-12);
  EXPECT_NEAR(law->flow_stress(0, 1).strain_slope, 222 * 6.75, 1e-10);
  expect_slopes(*law, { 0., 1. });
  EXPECT_THROW(paper::make<HardeningLaw>("Voce", "set Initial stress = 500 MPa\nset Saturation stress = 436 MPa\n"
                                                 "set Saturation rate = 6.75\n"),
               InputError);
}

TEST(SwiftVoce, is_the_weighted_sum)
{
  const auto mixed = paper::hardening("Swift-Voce"), voce = paper::hardening("Voce");
  const auto swift
      = paper::make<HardeningLaw>("Swift", "set Strength coefficient = 498.8 MPa\nset Initial strain = 0.0089\n"
                                           "set Hardening exponent = 0.285\n");
  for (double strain : { 0., 0.01, 0.3, 1. })
    {
      const auto m = mixed->flow_stress(strain, 0), s = swift->flow_stress(strain, 0), v = voce->flow_stress(strain, 0);
      EXPECT_NEAR(m.value, 0.4 * s.value + 0.6 * v.value, 1e-11);
      EXPECT_NEAR(m.strain_slope, 0.4 * s.strain_slope + 0.6 * v.strain_slope, 1e-9);
    }
}

namespace
{
  std::unique_ptr<HardeningLaw>
  from_table(const std::string &rows, const std::string &more = "")
  {
    const auto file = std::filesystem::temp_directory_path()
                      / ("tribodraw_flow_" + std::to_string(std::hash<std::string>()(rows)) + ".csv");
    std::ofstream(file) << rows;
    std::unique_ptr<HardeningLaw> law;
    std::string                   message;
    try
      {
        law = paper::make<HardeningLaw>("tabulated", "set Source = file\nset File = " + file.string() + "\n" + more);
      }
    catch (const InputError &e)
      {
        message = e.what();
      }
    std::filesystem::remove(file);
    if (!law)
      throw InputError(message);
    return law;
  }

  std::string
  table_message(const std::string &rows)
  {
    try
      {
        from_table(rows);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
} // namespace

TEST(Tabulated, goes_through_the_points_and_never_overshoots)
{
  const auto law = paper::make<HardeningLaw>("tabulated", "set Source = list\nset Plastic strains = 0, 0.1, 0.2, 0.5\n"
                                                          "set Flow stresses = 100, 200, 200, 230 MPa\n");
  const double strain[] = { 0, .1, .2, .5 }, stress[] = { 100, 200, 200, 230 };
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(law->flow_stress(strain[i], 0).value, stress[i], 1e-11);
  EXPECT_EQ(law->flow_stress(.15, 0).value, 200.); // flat between equal points
  double last = 0;
  for (double e = 0; e < 1; e += 1e-3)
    {
      EXPECT_GE(law->flow_stress(e, 0).value, last);
      last = law->flow_stress(e, 0).value;
    }
  // Beyond the last point straight on with the slope of the last interval: 30 MPa / 0.3.
  EXPECT_NEAR(law->flow_stress(1.5, 0).value, 230 + 100 * 1., 1e-10);
  // Between the points and between the joints of the pieces the slope is the derivative.
  for (double e : { 0.03, 0.12, 0.3, 0.7 })
    EXPECT_NEAR((law->flow_stress(e + 1e-6, 0).value - law->flow_stress(e - 1e-6, 0).value) / 2e-6,
                law->flow_stress(e, 0).strain_slope, 1e-4);
}

TEST(Tabulated, rates)
{
  const auto law = from_table("rate_1_per_s,plastic_strain,flow_stress_mpa\n0.01,0,100\n0.01,1,200\n"
                              "1,0,120\n1,1,240\n");
  EXPECT_NEAR(law->flow_stress(.5, 0.01).value, 150, 1e-11);
  EXPECT_NEAR(law->flow_stress(.5, 1).value, 180, 1e-11);
  EXPECT_NEAR(law->flow_stress(.5, 0.1).value, 165, 1e-11); // half-way in the logarithm
  EXPECT_NEAR(law->flow_stress(.5, 0.1).rate_slope, 30 / std::log(100.) / 0.1, 1e-10);
  EXPECT_NEAR(law->flow_stress(.5, 0).value, 150, 1e-11); // constant outside
  EXPECT_NEAR(law->flow_stress(.5, 50).value, 180, 1e-11);
  EXPECT_EQ(law->flow_stress(.5, 50).rate_slope, 0.);
}

TEST(Tabulated, wrong_tables_are_refused_with_the_line)
{
  const std::string head = "plastic_strain,flow_stress_mpa\n";
  EXPECT_NE(table_message(head + "0,100\n0.1,90\n").find(".csv:3: "), std::string::npos);
  EXPECT_NE(table_message(head + "0,100\n0.1,90\n").find("falls"), std::string::npos);
  EXPECT_NO_THROW(from_table(head + "0,100\n0.1,90\n", "set Falling stress = allowed\n"));
  EXPECT_NE(table_message(head + "0.1,100\n0.2,190\n").find("not 0"), std::string::npos);
  EXPECT_NE(table_message(head + "0,100\n0,190\n").find("does not rise"), std::string::npos);
  EXPECT_NE(table_message(head + "0,100\n").find("two points"), std::string::npos);
  EXPECT_NE(table_message(head + "0,-100\n1,100\n").find("not positive"), std::string::npos);
  EXPECT_NE(table_message(head + "0,inf\n1,100\n").find("not finite"), std::string::npos);
  EXPECT_NE(table_message("rate_1_per_s,plastic_strain,flow_stress_mpa\n1,0,100\n1,1,200\n9,0,90\n9,1,300\n")
                .find("lower strain rate"),
            std::string::npos);
}
