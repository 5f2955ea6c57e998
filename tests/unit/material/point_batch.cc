#include "paper_material.h"

#include <tribodraw/material/pack.h>
#include <tribodraw/material/point_batch.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tribodraw;

namespace
{
  const char *const loci[] = { "von Mises", "Hill 1948", "Vegter", "Yld2000-2d" };
  const char *const laws[] = { "Swift", "Bergstroem-van Liempt", "Voce" };

  /// C = exp(2 E) for the strain (E11, E22, 2 E12).
  Vector3
  cauchy_green(const Vector3 &strain)
  {
    const double mean = 0.5 * (strain[0] + strain[1]), d = 0.5 * (strain[0] - strain[1]), y = 0.5 * strain[2];
    const double r = std::hypot(d, y), sinh = r > 0 ? std::sinh(2 * r) / r : 2., cosh = std::cosh(2 * r);
    return std::exp(2 * mean) * Vector3(cosh + sinh * d, cosh - sinh * d, sinh * y);
  }

  /// Points between elastic and 30 % strain with a history.
  void
  random_points(std::mt19937 &generator, const unsigned n, PointBatch &batch, std::vector<PlasticState> &old_states)
  {
    std::uniform_real_distribution<double> u(0, 1);
    batch.n = n;
    old_states.assign(n, {});
    for (unsigned i = 0; i < n; ++i)
      {
        if (u(generator) < 0.7)
          {
            old_states[i].eps_p          = 0.3 * u(generator);
            old_states[i].plastic_strain = old_states[i].eps_p * paper::random_direction(generator);
          }
        const Vector3 strain = old_states[i].plastic_strain
                               + 1e-4 * std::pow(10., 3 * u(generator)) * paper::random_direction(generator);
        const Vector3 C = cauchy_green(strain);
        for (unsigned k = 0; k < 3; ++k)
          batch.C[k][i] = C[k];
      }
  }

  Matrix3
  tangent(const PointBatch &batch, const unsigned i)
  {
    Matrix3 T;
    T << batch.tangent[0][i], batch.tangent[3][i], batch.tangent[4][i], //
        batch.tangent[3][i], batch.tangent[1][i], batch.tangent[5][i],  //
        batch.tangent[4][i], batch.tangent[5][i], batch.tangent[2][i];
    return T;
  }
} // namespace

// Against the C library. The arguments cover what the laws need: any size for exp, near and far from one for log.
TEST(Pack, exponential_and_logarithm)
{
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 100000; ++i)
    {
      Pack x, y;
      for (unsigned k = 0; k < 4; ++k)
        {
          x[k] = u(generator) * (i % 3 == 0 ? 1e-3 : i % 3 == 1 ? 1 : 600);
          y[k] = i % 2 ? 1 + 0.3 * u(generator) : std::exp(600 * u(generator));
        }
      Pack e, l, r;
      pack::vectorised([&]() TRIBODRAW_INLINE {
        e = pack::exp(x);
        l = pack::log(y);
        r = pack::sqrt(y);
      });
      for (unsigned k = 0; k < 4; ++k)
        {
          ASSERT_NEAR(e[k] / std::exp(x[k]), 1, 5e-16);
          ASSERT_NEAR(l[k], std::log(y[k]), 7e-16 * std::abs(std::log(y[k])));
          ASSERT_EQ(r[k], std::sqrt(y[k]));
        }
    }
}

// The vectorised update against evaluate_in_cauchy_green(), which computes point by point with another iteration.
TEST(PointBatch, equals_the_single_point)
{
  for (const char *locus : loci)
    for (const char *law : laws)
      {
        const auto   sheet = paper::sheet(locus, law);
        std::mt19937 generator(1);
        PointOptions options;
        options.time_increment = 0.02;
        unsigned n_plastic = 0, n_elastic = 0;
        for (int round = 0; round < 40; ++round)
          {
            PointBatch                batch;
            std::vector<PlasticState> old_states;
            random_points(generator, 1 + round % 33, batch, old_states);
            std::vector<PlasticState> new_states(batch.n);
            options.loading_tangent = round % 4 == 3;
            options.elastic_blend   = round % 5 == 4 ? 0.3 : 0.;
            ASSERT_TRUE(evaluate(sheet, batch, old_states.data(), new_states.data(), options)) << locus << law;
            for (unsigned i = 0; i < batch.n; ++i)
              {
                PlasticState  state;
                const Vector3 C(batch.C[0][i], batch.C[1][i], batch.C[2][i]);
                auto one = evaluate_in_cauchy_green(sheet, C, old_states[i], 0.02, state, options.loading_tangent);
                ASSERT_TRUE(one.update.converged);
                if (options.elastic_blend > 0 && (one.update.plastic || options.loading_tangent))
                  {
                    const Matrix3 P = LogarithmicStrain(C).derivative();
                    one.tangent
                        += options.elastic_blend * P.transpose() * (sheet.elasticity() - one.update.tangent) * P;
                  }
                (one.update.plastic ? n_plastic : n_elastic) += 1;
                const Vector3 stress(batch.stress[0][i], batch.stress[1][i], batch.stress[2][i]);
                // Both solve to 1e-11 of the flow stress of some 300 MPa.
                ASSERT_LT((stress - one.stress).norm(), 2e-8) << locus << law;
                ASSERT_LT((tangent(batch, i) - one.tangent).norm(), 1e-6 * one.tangent.norm()) << locus << law;
                ASSERT_NEAR(new_states[i].eps_p, state.eps_p, 1e-12);
                ASSERT_LT((new_states[i].plastic_strain - state.plastic_strain).norm(), 1e-12);
                ASSERT_NEAR(batch.elastic_energy[i], one.update.elastic_energy, 1e-9);
                ASSERT_NEAR(batch.plastic_work[i], one.update.plastic_work, 1e-5 * one.update.plastic_work + 1e-9);
                ASSERT_NEAR(batch.thickness_strain[i], sheet.thickness_strain(one.strain, state), 1e-12);
                ASSERT_NEAR(batch.logarithmic_stress[0][i], one.update.stress[0], 1e-8);
              }
          }
        EXPECT_GT(n_plastic, 100u);
        EXPECT_GT(n_elastic, 30u);
      }
}

// Exact tangent at 1e-6 against central differences; at joints of a piecewise locus one side must fit.
TEST(PointBatch, tangent_is_the_derivative)
{
  for (const char *locus : loci)
    {
      const auto   sheet = paper::sheet(locus, "Bergstroem-van Liempt");
      std::mt19937 generator(2);
      PointOptions options;
      options.time_increment = 0.02;
      unsigned n_joints = 0, n = 0;
      for (int round = 0; round < 15; ++round)
        {
          PointBatch                batch;
          std::vector<PlasticState> old_states;
          random_points(generator, 33, batch, old_states);
          std::vector<PlasticState> new_states(batch.n);
          ASSERT_TRUE(evaluate(sheet, batch, old_states.data(), new_states.data(), options));
          const double h = 1e-7;
          for (unsigned j = 0; j < 3; ++j)
            {
              PointBatch up = batch, down = batch;
              for (unsigned i = 0; i < batch.n; ++i)
                {
                  up.C[j][i] += h;
                  down.C[j][i] -= h;
                }
              ASSERT_TRUE(evaluate(sheet, up, old_states.data(), new_states.data(), options));
              ASSERT_TRUE(evaluate(sheet, down, old_states.data(), new_states.data(), options));
              for (unsigned i = 0; i < batch.n; ++i, ++n)
                {
                  const Matrix3 T = tangent(batch, i);
                  Vector3       difference;
                  for (unsigned k = 0; k < 3; ++k)
                    difference[k] = (up.stress[k][i] - down.stress[k][i]) / (2 * h);
                  n_joints += (difference - T.col(j)).norm() > 1e-6 * T.norm();
                }
            }
        }
      // Steps across a joint or the onset of flow: a few in 1485.
      EXPECT_LE(n_joints, 6u) << locus << " of " << n;
    }
}

// The stress of a point is the same bits whatever stands beside it.
TEST(PointBatch, neighbours_do_not_matter)
{
  const auto                sheet = paper::sheet("Vegter", "Bergstroem-van Liempt");
  std::mt19937              generator(3);
  PointBatch                batch;
  std::vector<PlasticState> old_states;
  random_points(generator, 33, batch, old_states);
  std::vector<PlasticState> new_states(batch.n);
  PointOptions              options;
  ASSERT_TRUE(evaluate(sheet, batch, old_states.data(), new_states.data(), options));
  for (unsigned i = 0; i < batch.n; ++i)
    {
      PointBatch   single;
      PlasticState state;
      single.n = 1;
      for (unsigned k = 0; k < 3; ++k)
        single.C[k][0] = batch.C[k][i];
      ASSERT_TRUE(evaluate(sheet, single, &old_states[i], &state, options));
      for (unsigned k = 0; k < 3; ++k)
        ASSERT_EQ(single.stress[k][0], batch.stress[k][i]);
      ASSERT_EQ(state.eps_p, new_states[i].eps_p);
    }
}

TEST(PointBatch, special_states)
{
  const auto   sheet = paper::sheet("Vegter", "Bergstroem-van Liempt");
  PointBatch   batch;
  PlasticState old_states[3], new_states[3];
  PointOptions options;
  batch.n = 3;
  for (unsigned i = 0; i < 3; ++i) // no strain; equibiaxial, plastic; uniaxial, elastic
    {
      batch.C[0][i] = i == 1 ? 1.1 : i == 2 ? 1.0002 : 1.;
      batch.C[1][i] = i == 1 ? 1.1 : i == 2 ? 0.99994 : 1.;
      batch.C[2][i] = 0;
    }
  ASSERT_TRUE(evaluate(sheet, batch, old_states, new_states, options));
  for (unsigned k = 0; k < 3; ++k)
    EXPECT_EQ(batch.stress[k][0], 0.);
  EXPECT_EQ(new_states[0].eps_p, 0.);
  EXPECT_GT(new_states[1].eps_p, 0.05);
  EXPECT_EQ(new_states[2].eps_p, 0.);
  for (unsigned i = 0; i < 3; ++i)
    EXPECT_TRUE(tangent(batch, i).allFinite());
  // Unstrained: s = dW/dC with W the energy in 1/2 ln C, so the tangent is a quarter of the elasticity matrix.
  EXPECT_NEAR(tangent(batch, 0)(0, 0), 0.25 * sheet.elasticity()(0, 0), 1e-8);
  EXPECT_NEAR(tangent(batch, 0)(2, 2), sheet.elasticity()(2, 2), 1e-8);

  batch.C[2][1] = 1.2; // not positive definite
  EXPECT_FALSE(evaluate(sheet, batch, old_states, new_states, options));
  batch.C[2][1] = std::nan("");
  EXPECT_FALSE(evaluate(sheet, batch, old_states, new_states, options));
  batch.C[2][1]          = 0;
  options.time_increment = 0;
  EXPECT_FALSE(evaluate(sheet, batch, old_states, new_states, options));
}

#if defined(__x86_64__)
// The same points with AVX2 and with the instructions that every x86-64 has. They differ by fused multiply-adds only:
// round-off, enlarged where the update ends with an iteration more or less (its tolerance is 1e-11 of the flow stress).
TEST(PointBatch, both_instruction_sets_agree)
{
  if (!pack::use_avx2)
    GTEST_SKIP() << "no AVX2 here: all other tests run the SSE2 code";
  struct WithoutAvx2
  {
    WithoutAvx2() { pack::use_avx2 = false; }
    ~WithoutAvx2() { pack::use_avx2 = true; }
  };
  std::mt19937 generator(5);
  PointOptions options;
  options.tangent        = true;
  options.time_increment = 0.1;
  double   worst_stress = 0, worst_tangent = 0, worst_state = 0;
  unsigned n_different = 0;
  for (const char *locus : loci)
    for (const char *law : laws)
      {
        const auto sheet = paper::sheet(locus, law);
        for (unsigned repeat = 0; repeat < 200; ++repeat)
          {
            PointBatch                batch;
            std::vector<PlasticState> old_states;
            random_points(generator, 15, batch, old_states);
            PointBatch                plain = batch;
            std::vector<PlasticState> fast_states(old_states), plain_states(old_states);
            ASSERT_TRUE(evaluate(sheet, batch, old_states.data(), fast_states.data(), options));
            {
              const WithoutAvx2 guard;
              ASSERT_TRUE(evaluate(sheet, plain, old_states.data(), plain_states.data(), options));
            }
            for (unsigned i = 0; i < batch.n; ++i)
              {
                for (unsigned k = 0; k < 3; ++k)
                  {
                    worst_stress = std::max(worst_stress, std::abs(batch.stress[k][i] - plain.stress[k][i]));
                    worst_state  = std::max(
                         worst_state, std::abs(fast_states[i].plastic_strain[k] - plain_states[i].plastic_strain[k]));
                  }
                for (unsigned k = 0; k < 6; ++k)
                  {
                    worst_tangent = std::max(worst_tangent, std::abs(batch.tangent[k][i] - plain.tangent[k][i]));
                    n_different += batch.tangent[k][i] != plain.tangent[k][i];
                  }
              }
          }
      }
  EXPECT_LT(worst_stress, 1e-9);  // MPa, of some 500
  EXPECT_LT(worst_tangent, 1e-6); // MPa, of some 1e5
  EXPECT_LT(worst_state, 1e-14);
#  ifndef __clang__ // which fuses within one expression only, so that both give the same bits
  EXPECT_GT(n_different, 0u); // or the same code ran twice
#  endif
}
#endif
