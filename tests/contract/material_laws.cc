// What every yield locus, hardening law and forming limit curve promises, for every registered one. A new law needs an
// example here: parameters with which it is tested.
#include "unit/material/paper_material.h"

#include <tribodraw/material/forming_limit.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
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

// The vectorised form is the same function.
TEST(YieldLocusContract, pack_equals_single)
{
  for (const auto &[name, locus] : all_laws<YieldLocus>(locus_examples))
    {
      std::mt19937 generator(5);
      for (int i = 0; i < 2000; ++i)
        {
          MohrStress<Pack> s;
          for (unsigned k = 0; k < pack::lanes; ++k)
            {
              const Vector3 one = std::pow(10., i % 5 - 1) * paper::random_direction(generator);
              s.m[k]            = 0.5 * (one[0] + one[1]);
              s.a[k]            = 0.5 * (one[0] - one[1]);
              s.b[k]            = one[2];
            }
          LocusDerivatives<Pack> r;
          locus->evaluate_pack(s, r);
          for (unsigned k = 0; k < pack::lanes; ++k)
            {
              const Vector3 one(s.m[k] + s.a[k], s.m[k] - s.a[k], s.b[k]);
              Vector3       n;
              Matrix3       H;
              const double  e = locus->evaluate(one, n, H);
              const auto    d = from_cartesian(e, n, H);
              ASSERT_NEAR(r.e[k] / e, 1, 1e-13) << name;
              ASSERT_LT(Vector3(r.m[k] - d.m, r.a[k] - d.a, r.b[k] - d.b).norm(), 1e-11) << name;
              // Near the corner of a locus round-off is divided by the distance from it.
              ASSERT_LT(Vector3(r.mm[k] - d.mm, r.aa[k] - d.aa, r.bb[k] - d.bb).norm(), 1e-8 / one.norm()) << name;
              ASSERT_LT(Vector3(r.ma[k] - d.ma, r.mb[k] - d.mb, r.ab[k] - d.ab).norm(), 1e-8 / one.norm()) << name;
            }
        }
    }
}

// Every locus with every hardening law returns from every admissible trial state: 10^4 random ones from the yield
// surface to 100 times it, in all directions and close to the equibiaxial and uniaxial joints, slow and fast, without
// cutting the increment. The result satisfies both equations, evaluated here.
TEST(YieldLocusContract, stress_update_converges_from_every_trial_state)
{
  for (const auto &[name, shared] : all_laws<YieldLocus>(locus_examples))
    for (auto &[law_name, law] : all_laws<HardeningLaw>(hardening_examples))
      {
        const std::shared_ptr<const YieldLocus> locus(paper::make<YieldLocus>(name, locus_examples.at(name)));
        const SheetMaterial                     sheet(210e3, 0.3, locus, std::move(law));
        const Matrix3                           compliance = sheet.elasticity().inverse();
        std::mt19937                            generator(4);
        std::uniform_real_distribution<double>  u(0, 1);
        for (int i = 0; i < 10000; ++i)
          {
            Vector3 d = paper::random_direction(generator);
            if (i % 5 < 2)
              d = Vector3(1, i % 5, 0) + std::pow(10, -10 * u(generator)) * d;
            PlasticState old_state, state;
            old_state.eps_p = 0.1 * (i % 3);
            const double dt = std::pow(10, -6 + 10 * u(generator));
            const double over
                = i % 7 == 0 ? 1 + std::pow(10, -10 * u(generator)) : std::pow(10, 1e-6 + 2 * u(generator));
            const double  sigma  = sheet.hardening().flow_stress(old_state.eps_p, 0).value;
            const Vector3 strain = compliance * d * (over * sigma / locus->equivalent_stress(d));
            const auto    r      = sheet.update(strain, old_state, dt, state);
            ASSERT_TRUE(r.converged && r.plastic) << name << ", " << law_name << " " << over << " " << d.transpose();
            ASSERT_EQ(r.sub_steps, 0u) << name << ", " << law_name;
            Vector3      n;
            Matrix3      H;
            const double e = locus->evaluate(r.stress, n, H), flow = state.eps_p - old_state.eps_p;
            ASSERT_NEAR(e / sheet.hardening().flow_stress(state.eps_p, flow / dt).value, 1, 1e-8) << name << law_name;
            ASSERT_LT((sheet.elasticity() * (strain - flow * n) - r.stress).norm(), 1e-8 * e * std::max(1., over))
                << name;
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

TEST(HardeningLawContract, pack_equals_single)
{
  for (const auto &[name, law] : all_laws<HardeningLaw>(hardening_examples))
    for (double strain : { 0., 0.001, 0.02, 0.7 })
      {
        Pack e, rate;
        for (unsigned k = 0; k < pack::lanes; ++k)
          {
            e[k]    = strain * (1 + 0.3 * k);
            rate[k] = k == 0 ? 0. : std::pow(10., 3. * k - 8);
          }
        HardeningLaw::FlowStressOf<Pack> f;
        law->flow_stress_pack(e, rate, f);
        for (unsigned k = 0; k < pack::lanes; ++k)
          {
            const auto one = law->flow_stress(e[k], rate[k]);
            EXPECT_NEAR(f.value[k], one.value, 1e-13 * one.value) << name;
            EXPECT_NEAR(f.strain_slope[k], one.strain_slope, 1e-12 * one.strain_slope) << name;
            EXPECT_NEAR(f.rate_slope[k], one.rate_slope, 1e-12 * one.rate_slope) << name;
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
