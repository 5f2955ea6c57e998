// What every yield locus, hardening law and forming limit curve promises, for every registered one. A new law needs an
// example here: parameters with which it is tested.
#include "unit/material/paper_material.h"

#include <tribodraw/material/forming_limit.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

using namespace tribodraw;

namespace
{
  using Examples = std::map<std::string, std::string>;

  const Examples locus_examples = {
    { "Hill 1948", paper::hill }, { "Vegter", paper::vegter }, { "Yld2000-2d", paper::aluminium }, { "von Mises", "" }
  };

  const Examples hardening_examples
      = { { "Bergstroem-van Liempt", paper::bergstroem_van_liempt },
          { "Swift", paper::swift },
          { "Swift-Voce", paper::swift_voce },
          { "Voce", paper::voce },
          { "tabulated", "set Source = list\nset Plastic strains = 0, 0.015, 0.05, 0.15, 0.3, 0.6\n"
                         "set Flow stresses = 150, 190, 240, 310, 360, 410 MPa\n" } };

  const Examples limit_examples
      = { { "Abspoel-Scholting", "set R value = 2.21\nset Elongation A80 = 40 %\n"
                                 "set Smallest elongation A80 = 40 %\nset Thickness = 0.82 mm\n" },
          { "Keeler-Brazier", "set Hardening exponent = 0.2\nset Thickness = 0.82 mm\n" } };

  template <class Interface>
  std::vector<std::pair<std::string, std::unique_ptr<Interface>>>
  all_laws(const Examples &examples)
  {
    std::vector<std::pair<std::string, std::unique_ptr<Interface>>> laws;
    for (const auto &entry : Registry<Interface>::entries())
      {
        const std::string &name = entry.first;
        EXPECT_EQ(examples.count(name), 1u) << "The " << Interface::kind() << " '" << name << "' has no example here.";
        EXPECT_FALSE(entry.second.info.description.empty()) << name;
        EXPECT_FALSE(entry.second.info.citation.empty()) << name;
        if (examples.count(name))
          laws.emplace_back(name, paper::make<Interface>(name, examples.at(name)));
      }
    EXPECT_FALSE(laws.empty());
    return laws;
  }

  /// File name without ending that the law of this name has to have: `von Mises` -> `von_mises`.
  std::string
  file_stem(std::string name)
  {
    for (char &c : name)
      c = std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                                                      : '_';
    return name;
  }
} // namespace

TEST(YieldLocusContract, homogeneous_and_symmetric)
{
  for (const auto &[name, locus] : all_laws<YieldLocus>(locus_examples))
    {
      std::mt19937 generator(1);
      EXPECT_EQ(locus->equivalent_stress(Vector3::Zero()), 0.) << name;
      // Equal to the uniaxial flow stress in rolling direction.
      EXPECT_NEAR(locus->equivalent_stress({ 1, 0, 0 }), 1, 1e-14) << name;
      for (int i = 0; i < 2000; ++i)
        {
          const Vector3 s = paper::random_direction(generator);
          Vector3       n, n_scaled;
          Matrix3       H, H_scaled;
          const double  e = locus->evaluate(s, n, H), e_scaled = locus->evaluate(700 * s, n_scaled, H_scaled);
          ASSERT_GT(e, 0.) << name;
          ASSERT_NEAR(locus->equivalent_stress(s), e, 1e-13) << name;
          ASSERT_NEAR(e_scaled, 700 * e, 1e-10) << name;
          ASSERT_LT((n_scaled - n).norm(), 1e-10) << name;
          ASSERT_LT((700 * H_scaled - H).norm(), 1e-8 * H.norm()) << name;
          ASSERT_NEAR(n.dot(s), e, 1e-12) << name;             // Euler
          ASSERT_LT((H * s).norm(), 1e-12 * H.norm()) << name; // Euler for the gradient
          ASSERT_LT((H - H.transpose()).norm(), 1e-15 * H.norm()) << name;
        }
    }
}

TEST(YieldLocusContract, gradient_and_hessian_are_derivatives)
{
  for (const auto &[name, locus] : all_laws<YieldLocus>(locus_examples))
    {
      std::mt19937 generator(2);
      int          n_joints = 0;
      for (int i = 0; i < 2000; ++i)
        {
          const Vector3 s = paper::random_direction(generator);
          Vector3       n, up, down;
          Matrix3       H, unused;
          locus->evaluate(s, n, H);
          const double h = 1e-5;
          for (int j = 0; j < 3; ++j)
            {
              const double e_up   = locus->evaluate(s + h * Vector3::Unit(j), up, unused);
              const double e_down = locus->evaluate(s - h * Vector3::Unit(j), down, unused);
              ASSERT_NEAR((e_up - e_down) / (2 * h), n[j], 1e-6) << name << " " << s.transpose();
              n_joints += ((up - down) / (2 * h) - H.col(j)).norm() > 1e-6;
            }
        }
      EXPECT_LE(n_joints, 6) << name; // piecewise curves may have jumps of the second derivative
    }
}

TEST(YieldLocusContract, convex)
{
  for (const auto &[name, locus] : all_laws<YieldLocus>(locus_examples))
    {
      std::mt19937 generator(3);
      for (int i = 0; i < 20000; ++i)
        {
          const Vector3 s = paper::random_direction(generator);
          const Vector3 t
              = i % 2 ? paper::random_direction(generator) : Vector3(s + 0.1 * paper::random_direction(generator));
          ASSERT_LE(locus->equivalent_stress(0.5 * (s + t)),
                    0.5 * (locus->equivalent_stress(s) + locus->equivalent_stress(t)) + 1e-15)
              << name;
          Vector3 n;
          Matrix3 H;
          locus->evaluate(s, n, H);
          ASSERT_GT(Eigen::SelfAdjointEigenSolver<Matrix3>(H, Eigen::EigenvaluesOnly).eigenvalues()[0], -1e-6) << name;
        }
    }
}

// Every locus returns: an increment of the strip direction converges, with the exact tangent.
TEST(YieldLocusContract, works_in_the_stress_update)
{
  for (auto &[name, locus] : all_laws<YieldLocus>(locus_examples))
    {
      const SheetMaterial sheet(210e3, 0.3, std::move(locus), paper::hardening("Swift"));
      std::mt19937        generator(4);
      for (int i = 0; i < 500; ++i)
        {
          PlasticState  state;
          const Vector3 strain = 0.03 * paper::random_direction(generator);
          const auto    u      = sheet.update(strain, {}, 1, state);
          ASSERT_TRUE(u.converged && u.plastic) << name;
          ASSERT_NEAR(sheet.locus().equivalent_stress(u.stress) / sheet.hardening().flow_stress(state.eps_p, 0).value,
                      1, 1e-10);
        }
    }
}

TEST(HardeningLawContract, positive_and_never_falling)
{
  for (const auto &[name, law] : all_laws<HardeningLaw>(hardening_examples))
    {
      double last = 0;
      for (double strain = 0; strain < 2; strain += 0.01)
        {
          const double now = law->flow_stress(strain, 0.1).value;
          EXPECT_GT(now, 0.) << name;
          EXPECT_GE(now, last) << name;
          last             = now;
          double last_rate = law->flow_stress(strain, 0).value;
          for (double rate = 1e-7; rate < 1e4; rate *= 3)
            {
              const double with_rate = law->flow_stress(strain, rate).value;
              EXPECT_GE(with_rate, last_rate) << name << " " << rate;
              last_rate = with_rate;
            }
        }
    }
}

TEST(HardeningLawContract, slopes_are_derivatives)
{
  for (const auto &[name, law] : all_laws<HardeningLaw>(hardening_examples))
    for (double strain : { 0.001, 0.01, 0.2, 1. })
      for (double rate : { 0., 1e-5, 1e-3, 1., 100. })
        {
          const auto   f = law->flow_stress(strain, rate);
          const double h = 1e-5 * strain, k = 1e-5 * rate;
          EXPECT_TRUE(std::isfinite(f.strain_slope) && std::isfinite(f.rate_slope)) << name;
          EXPECT_NEAR((law->flow_stress(strain + h, rate).value - law->flow_stress(strain - h, rate).value) / (2 * h),
                      f.strain_slope, 1e-6 * std::max(f.strain_slope, f.value))
              << name;
          if (rate > 0)
            {
              EXPECT_NEAR((law->flow_stress(strain, rate + k).value - law->flow_stress(strain, rate - k).value)
                              / (2 * k),
                          f.rate_slope, 1e-6 * std::max(f.rate_slope, f.value))
                  << name;
            }
          else
            {
              EXPECT_EQ(f.rate_slope, 0.) << name; // nothing to differentiate at rest
            }
        }
}

// Uniaxial tension through the stress update gives back the law.
TEST(HardeningLawContract, uniaxial_path_reproduces_the_law)
{
  for (auto &[name, law] : all_laws<HardeningLaw>(hardening_examples))
    {
      const SheetMaterial sheet(210e3, 0.3, paper::locus("von Mises"), std::move(law));
      PlasticState        old_state, state;
      double              across = 0;
      for (int i = 1; i <= 10; ++i)
        {
          const double along = 0.01 * i;
          StressUpdate u;
          for (int k = 0; k < 50; ++k)
            {
              u = sheet.update({ along, across, 0 }, old_state, 0.1, state);
              if (std::abs(u.stress[1]) < 1e-9 * u.stress[0])
                break;
              across -= u.stress[1] / u.tangent(1, 1);
            }
          const double rate = (state.eps_p - old_state.eps_p) / 0.1;
          EXPECT_NEAR(u.stress[0] / sheet.hardening().flow_stress(state.eps_p, rate).value, 1, 1e-8) << name;
          old_state = state;
        }
    }
}

TEST(FormingLimitContract, positive_continuous_and_lowest_near_plane_strain)
{
  for (const auto &[name, curve] : all_laws<FormingLimitCurve>(limit_examples))
    {
      for (double e2 = -1; e2 < 1; e2 += 1e-3)
        {
          EXPECT_GT(curve->limit(e2), 0.) << name;
          EXPECT_NEAR(curve->limit(e2 + 1e-3), curve->limit(e2), 5e-3) << name;
        }
      EXPECT_GT(curve->limit(-.2), curve->limit(0)) << name;
      EXPECT_GE(curve->limit(.2), curve->limit(0)) << name;
    }
}

// One registered law per file, and the file has the name of the law.
TEST(MaterialLaws, files_are_named_like_the_laws)
{
  std::multiset<std::string> registered, files;
  for (const auto &e : Registry<YieldLocus>::entries())
    registered.insert(file_stem(e.first));
  for (const auto &e : Registry<HardeningLaw>::entries())
    registered.insert(file_stem(e.first));
  for (const auto &e : Registry<FormingLimitCurve>::entries())
    registered.insert(file_stem(e.first));
  for (const auto &file : std::filesystem::directory_iterator(TRIBODRAW_SOURCE_DIR "/source/material"))
    if (file.path().extension() == ".cc")
      {
        std::ifstream     in(file.path());
        const std::string text((std::istreambuf_iterator<char>(in)), {});
        for (std::size_t at = 0; (at = text.find("TRIBODRAW_REGISTER(", at)) != std::string::npos; ++at)
          files.insert(file.path().stem().string());
      }
  EXPECT_EQ(registered, files);
}
