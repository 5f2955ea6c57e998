// The forming loop on a small, coarse square cup: balances, symmetry, restart, and what happens without convergence.
#include "unit/forming/coarse_cup.h"

#include <tribodraw/base/errors.h>

#include "claims.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>

using namespace tribodraw;

namespace
{
  struct Drawing : FormingRun
  {
    explicit Drawing(const std::vector<std::string> &changes = {}, const double mu = 0.1)
      : FormingRun(coarse_cup(changes), std::make_unique<ConstantFriction>(mu))
    {}
  };
} // namespace

TEST(Forming, ForcesBalanceInEveryIncrementAndEnergyIsAccountedFor)
{
  Drawing run;
  run.simulation->run();
  ASSERT_TRUE(run.records->converged);
  const auto &all = run.records->all;
  ASSERT_GT(all.size(), 6u);
  for (const auto &r : all)
    {
      // punch + holder - die = sum of the vertical residuals; their norm is bounded by the Newton tolerance (1e-4 of the sum
      // of contact forces), the sum of n of them by sqrt(n) more; n = 81 nodes
      EXPECT_LT(r.force_imbalance, 1e-4 * 9) << r.punch_travel << " mm";
      EXPECT_LT(r.residual, 1e-4);
    }
  const auto &last = all.back();
  EXPECT_NEAR(last.punch_travel, 6., 1e-12);
  EXPECT_NEAR(last.blank_holder_force, 19600., 1e-3 * 19600);
  EXPECT_NEAR(last.time, 0.1 + 0.6, 1e-9); // closing time + travel / speed
  // the parts: none negative, and together the work of the tools but for the time discretisation
  EXPECT_GT(last.plastic_work, 0);
  EXPECT_GT(last.friction_work, 0);
  EXPECT_GT(last.elastic_energy, 0);
  EXPECT_TRUE(claims::below("square cup (coarse), energy error", "work of the tools", last.energy_error(), 0.01));
}

// At most 3 % of the thickness without a number from the user: the automatic
// stiffness starts at 2.5 % for usual pressures and is raised above 2.8 %.
TEST(Forming, PenetrationStaysBelowThreePercentOfTheThickness)
{
  Drawing run({"Process/Punch travel = 15 mm"});
  run.simulation->run();
  for (const auto &r : run.records->all)
    EXPECT_LT(r.max_penetration, 0.03 * 0.78) << r.punch_travel << " mm";
  EXPECT_GT(run.last().max_penetration, 0);
}

// Isotropic sheet, square tools: the quarter is symmetric about its diagonal, except for the diagonals of the mesh, which
// alternate. Draw-in in x and y must therefore agree closely.
TEST(Forming, IsotropicCupIsSymmetric)
{
  Drawing run;
  run.simulation->run();
  const auto &r = run.records->all.back();
  EXPECT_GT(r.draw_in_x, 0.3);
  EXPECT_NEAR(r.draw_in_x, r.draw_in_y, 0.02 * r.draw_in_x);
}

// More friction and more holder force need more punch force.
TEST(Forming, FrictionRaisesThePunchForce)
{
  Drawing smooth({}, 0.02), rough({}, 0.2);
  smooth.simulation->run();
  rough.simulation->run();
  EXPECT_GT(rough.records->all.back().punch_force, 1.02 * smooth.records->all.back().punch_force);
}

TEST(Forming, ResumedRunEndsInTheSameBits)
{
  const auto folder = std::filesystem::temp_directory_path() / ("forming" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  Drawing whole;
  whole.simulation->checkpoint_to(folder, 2., "Blank/Thickness = 0.78 mm\nBlank/Width = 150 mm\n");
  whole.simulation->run();
  Drawing second;
  second.simulation->checkpoint_to(folder, 0., "Blank/Thickness = 0.78 mm\nBlank/Width = 150 mm\n");
  ASSERT_TRUE(second.simulation->resume(folder));
  const double from = second.simulation->record().punch_travel;
  EXPECT_GT(from, 1.9);
  EXPECT_LT(from, 6.);
  second.simulation->run();
  const auto &a = whole.records->all.back(), &b = second.records->all.back();
  EXPECT_EQ(a.punch_force, b.punch_force);
  EXPECT_EQ(a.draw_in_diagonal, b.draw_in_diagonal);
  EXPECT_EQ(a.external_work, b.external_work);
  EXPECT_EQ(a.friction_work, b.friction_work);
  EXPECT_EQ(a.plastic_work, b.plastic_work);
  EXPECT_EQ(whole.simulation->shell().committed().position.back(), second.simulation->shell().committed().position.back());

  Drawing other({"Blank/Thickness = 0.8 mm"});
  other.simulation->checkpoint_to(folder, 0., "Blank/Thickness = 0.8 mm\nBlank/Width = 150 mm\n");
  try
    {
      other.simulation->resume(folder);
      FAIL() << "a checkpoint of another thickness must be refused";
    }
  catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find("Blank/Thickness"), std::string::npos) << e.what();
    }
  std::filesystem::remove_all(folder);
  Drawing none;
  EXPECT_FALSE(none.simulation->resume(folder));
}

TEST(Forming, WithoutConvergenceTheLastStateIsHandedOverAndExplained)
{
  Drawing run({"Solver/First increment = 4 mm", "Solver/Largest increment = 4 mm", "Solver/Smallest increment = 3 mm", "Solver/Maximal iterations = 5"});
  try
    {
      run.simulation->run();
      FAIL() << "increments of 4 mm within five iterations cannot work";
    }
  catch (const ConvergenceError &e)
    {
      const std::string text = e.what();
      for (const char *piece : {"does not converge", "Largest unbalanced forces", "node", "touching", "What the figures say", "Solver/Maximal iterations"})
        EXPECT_NE(text.find(piece), std::string::npos) << text;
    }
  EXPECT_TRUE(run.records->ended);
  EXPECT_FALSE(run.records->converged);
}

// What shows only when blank, tools and process are seen together. Numbers: the die is 74 mm wide with a clearance of 2 mm
// to the punch of 70 mm; smallest radius 5 mm (die edge).
TEST(Forming, InconsistentProcessIsExplained)
{
  const auto problem = [](const std::vector<std::string> &changes) { return problems_of(coarse_cup(changes)); };
  const auto has = [](const std::string &text, const std::string &piece) {
    EXPECT_NE(text.find(piece), std::string::npos) << "'" << piece << "' is not in: " << text;
  };
  const std::string fine = "Blank/Element size = 4 mm";
  EXPECT_EQ(problem({fine}), "");
  has(problem({}), "too coarse for the smallest radius of the tools, 5 mm");
  const std::string deep = "Process/Punch travel = 20 mm"; // the walls pass each other
  has(problem({fine, deep, "Tools/Die/Square die/Width in x = 71 mm"}), "the gap between punch and die is 0.5 mm, less than the sheet is thick");
  has(problem({fine, deep, "Tools/Die/Square die/Width in x = 68 mm"}), "overlap by 1 mm");
  has(problem({fine, "Blank/Width = 80 mm"}), "Blank/Width: the blank does not reach over the rounded edge");
}
