#include "paper_material.h"

#include <tribodraw/material/return_mapping.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  struct Problem
  {
    SheetMaterial sheet;
    Matrix3       compliance;
    ReturnMapping mapping;

    Problem(const std::string &locus, const std::string &hardening)
        : sheet(paper::sheet(locus, hardening)), compliance(sheet.elasticity().inverse()),
          mapping(sheet.elasticity(), compliance, sheet.locus(), sheet.hardening())
    {
    }

    /// Residuals of both equations relative to the flow stress, evaluated apart from the solver.
    double
    error(const ReturnMapping::Input &input, const ReturnMapping::Result &r) const
    {
      Vector3       n;
      Matrix3       H;
      const double  e        = sheet.locus().evaluate(r.stress, n, H);
      const double  flow     = sheet.hardening().flow_stress(input.eps_p + r.flow, r.flow / input.time_increment).value;
      const Vector3 residual = sheet.elasticity() * (input.elastic_trial_strain - r.flow * n) - r.stress;
      return std::max(std::abs(e - flow), residual.norm()) / flow;
    }
  };

  const char *const loci[] = { "von Mises", "Hill 1948", "Vegter" };
  const char *const laws[] = { "Swift", "Bergstroem-van Liempt" };
} // namespace

// From the yield surface to strains no forming step would make, slow and fast.
TEST(ReturnMapping, solves_every_trial_state)
{
  for (const char *locus : loci)
    for (const char *law : laws)
      {
        const Problem problem(locus, law);
        std::mt19937  generator(1);
        double        evaluations = 0;
        int           n           = 0;
        for (double overstress : { 1. + 1e-12, 1. + 1e-6, 1.001, 1.1, 2., 10., 100., 1000. })
          for (double time_increment : { 1e-6, 0.02, 1e4 })
            for (double eps_p : { 0., 0.3 })
              for (int i = 0; i < 40; ++i)
                {
                  const Vector3 trial   = paper::random_direction(generator);
                  const double  sigma_y = problem.sheet.hardening().flow_stress(eps_p, 0).value;
                  const Vector3 strain  = problem.compliance * trial
                                         * (overstress * sigma_y / problem.sheet.locus().equivalent_stress(trial));
                  const ReturnMapping::Input input{ strain, eps_p, time_increment };
                  const auto                 r = problem.mapping.solve(input);
                  ASSERT_TRUE(r.converged)
                      << locus << " " << law << " " << overstress << " " << time_increment << " " << trial.transpose();
                  ASSERT_LT(problem.error(input, r), 2e-10) << locus << " " << law << " " << overstress;
                  ASSERT_GE(r.flow, 0.);
                  evaluations += r.n_evaluations;
                  ++n;
                }
        // What a plastic point costs; counted when written: 4.5 to 6.2.
        EXPECT_LT(evaluations / n, 7.) << locus << " " << law;
      }
}

// The slow way must find the same state: it is what saves a step when Newton fails.
TEST(ReturnMapping, robust_solution_equals_newton)
{
  for (const char *locus : loci)
    for (const char *law : laws)
      {
        const Problem problem(locus, law);
        std::mt19937  generator(2);
        for (double overstress : { 1.001, 1.1, 3., 100. })
          for (double time_increment : { 1e-4, 0.02, 1e4 })
            for (int i = 0; i < 20; ++i)
              {
                const Vector3 trial  = paper::random_direction(generator);
                const Vector3 strain = problem.compliance * trial
                                       * (overstress * problem.sheet.hardening().flow_stress(.05, 0).value
                                          / problem.sheet.locus().equivalent_stress(trial));
                const ReturnMapping::Input input{ strain, .05, time_increment };
                const auto                 fast = problem.mapping.solve(input), slow = problem.mapping.robust(input);
                ASSERT_TRUE(slow.converged) << locus << " " << law << " " << overstress << " " << trial.transpose();
                ASSERT_LT(problem.error(input, slow), 2e-10);
                ASSERT_LT((slow.stress - fast.stress).norm(), 1e-8 * fast.stress.norm());
                ASSERT_NEAR(slow.flow, fast.flow, 1e-8 * fast.flow + 1e-13);
              }
      }
}

// Trial states whose stress ends in the equibiaxial point and at the joints of the Bezier curves.
TEST(ReturnMapping, special_points_of_the_vegter_locus)
{
  const Problem problem("Vegter", "Bergstroem-van Liempt");
  for (const Vector3 &stress : { Vector3(1, 1, 0), Vector3(1, 0, 0), Vector3(0, -1, 0), Vector3(1, -1, 0),
                                 Vector3(.543471, -.5398, 0), Vector3(1.248, .75204668, 0), Vector3(0, 0, 1) })
    for (double flow : { 1e-6, 1e-3, 0.1 })
      {
        Vector3      n;
        Matrix3      H;
        const double e       = problem.sheet.locus().evaluate(stress, n, H);
        const double sigma_y = problem.sheet.hardening().flow_stress(.1 + flow, flow / 0.02).value;
        // The trial strain of which (stress sigma_y/e, flow) is the solution.
        const ReturnMapping::Input input{ problem.compliance * stress * (sigma_y / e) + flow * n, .1, .02 };
        const auto                 r = problem.mapping.solve(input);
        ASSERT_TRUE(r.converged);
        EXPECT_NEAR(r.flow, flow, 1e-9 * flow + 1e-13);
        EXPECT_LT((r.stress - stress * (sigma_y / e)).norm(), 1e-7 * sigma_y) << stress.transpose();
      }
}
