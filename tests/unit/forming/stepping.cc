// Increments whose solution is far away: a sheet that snaps from one tool to another, a free sheet that swings.
#include "unit/forming/coarse_cup.h"
#include "unit/forming/steel.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tribodraw;

namespace
{
  /// A strip of 100 mm between grips, which are moved as @p grips says. While they come together again a lifter bulges
  /// the strip upwards; then a pusher comes from above and presses it through.
  Parameters
  pressed_through(const std::string &grips)
  {
    return Parameters::from_text(isotropic_steel + R"(
subsection Blank
  set Length = 100 mm
  set Width = 5 mm
  set Thickness = 0.3 mm
  set Element size = 2.5 mm
  subsection Edges
    set Edge x = pulled
    set Edge y = plane of symmetry
    set Edge x motion = )" + grips + R"(
  end
end
subsection Tools
  set Without = Die, Punch, Blank holder
  set More tools = Lifter, Pusher
  subsection Lifter
    set Model = cylinder
    set Side = below
    set Control = motion
    set Direction = 0, 0, 1
    set Motion = 0 s, 0 mm, 1 s, 0 mm, 2 s, 6 mm, 3 s, -20 mm, 6 s, -20 mm
    subsection Cylinder
      set Facing = up
      set Diameter = 10 mm
      set Axis angle = 90 deg
    end
  end
  subsection Pusher
    set Model = cylinder
    set Side = above
    set Control = motion
    set Direction = 0, 0, 1
    set Place = 0, 0, 15 mm
    set Motion = 0 s, 0 mm, 3 s, 0 mm, 6 s, -25 mm
    subsection Cylinder
      set Facing = down
      set Diameter = 10 mm
      set Axis angle = 90 deg
    end
  end
end
subsection Process
  set Duration = 6 s
end
)",
                                 "strip");
  }

  double
  height_of_the_middle(const Shell &shell)
  {
    for (unsigned i = 0; i < shell.n_nodes(); ++i)
      if (shell.mesh().nodes[i].head<2>().norm() < 1e-9)
        return shell.committed().position[i][2];
    return 0;
  }
} // namespace

// The grips stretch the strip by 8 % and come back by 1 mm each, so that it bulges. Pressed down it leaves the pusher
// and jumps to the other side: no increment is small enough for that, only the viscosity leads through. What it takes
// is the elastic energy that the jump sets free, here some 0.3 % of all work, and it is reported; afterwards it is
// gone.
TEST(Stepping, SheetThatSnapsIsSlowedDown)
{
  FormingRun run(pressed_through("0 s, 0 mm, 1 s, 4 mm, 2 s, 3 mm, 6 s, 3 mm"));
  run.simulation->run();
  ASSERT_TRUE(run.records->converged);
  const auto &all = run.records->all;
  EXPECT_NEAR(run.last().time, 6, 1e-9);
  EXPECT_GT(run.last().stabilisation_work, 0);
  EXPECT_LT(run.last().stabilisation_work, 0.01 * run.last().external_work);
  EXPECT_LT(height_of_the_middle(run.simulation->shell()), -5);
  EXPECT_LT(std::abs(run.last().energy_error()), 0.03); // steps of 1 mm in the elastic beginning of the stretching

  // Through the snap, in steps of at most eight times the first one, the balance is closed by the viscosity's work.
  const auto first = std::find_if(all.begin(), all.end(), [](const auto &r) { return r.stabilisation_work > 0; });
  const auto after = std::find_if(all.begin(), all.end(),
                                  [&](const auto &r) { return r.stabilisation_work == run.last().stabilisation_work; });
  ASSERT_NE(first, all.begin());
  const auto unaccounted = [](const IncrementRecord &r) {
    return r.external_work - r.elastic_energy - r.plastic_work - r.friction_work - r.contact_energy;
  };
  EXPECT_NEAR(unaccounted(*after) - unaccounted(*(first - 1)), after->stabilisation_work,
              0.1 * after->stabilisation_work);
}

// Without the stretching the same jump sets free more than 1 % of the work done till then: that is no result.
TEST(Stepping, SnapThatTakesTooMuchWorkEndsTheRun)
{
  FormingRun run(pressed_through("0 s, 0 mm, 1 s, 0 mm, 2 s, -1 mm, 6 s, -1 mm"));
  try
    {
      run.simulation->run();
      FAIL() << "it ended with " << run.last().stabilisation_work << " of " << run.last().external_work << " N mm";
    }
  catch (const ConvergenceError &e)
    {
      EXPECT_NE(std::string(e.what()).find("more than 1 % of the work"), std::string::npos) << e.what();
    }
}

// A U-bend let go: its flanges swing while the walls open. A correction of a free sheet is limited in rotation only:
// the 2 mm at most that keep a sheet from passing through a tool would cut this into 7 steps (and prm/u_bend.prm as it
// is into 23, with six times the iterations).
TEST(Stepping, FreeSheetMaySwing)
{
  const std::string text = read_file(TRIBODRAW_SOURCE_DIR "/prm/u_bend.prm");
  const auto        from = text.find("subsection Blank"), to = text.find("subsection Coupling");
  FormingRun        run(Parameters::from_text(text.substr(from, to - from), "u_bend",
                                              { "Blank/Element size = 2.5 mm", "Blank/Width = 5 mm", "Blank/Length = 250 mm",
                                                "Process/Punch travel = 40 mm", "Process/Blank holder force = 0.35 kN" }),
                        std::make_unique<ConstantFriction>(0.144));
  run.simulation->run();
  ASSERT_TRUE(run.records->converged);
  unsigned steps = 0, iterations = 0;
  for (const auto &r : run.records->all)
    if (r.unloaded > 0)
      {
        ++steps;
        iterations += r.newton_iterations;
      }
  EXPECT_GT(steps, 0u);
  EXPECT_LE(steps, 4u);
  EXPECT_LE(iterations, 80u);
}
