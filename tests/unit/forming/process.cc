// Stages and loads beyond the plain drawing process: further tools, gap and force control, edges, fluid pressure, unloading,
// parts of the blank; and what is found wrong before the run.
#include "unit/forming/coarse_cup.h"
#include "unit/forming/steel.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/forming/pressure_friction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tribodraw;
using Eigen::Vector3d;

namespace
{
  /// A sheet of 1 mm of the isotropic steel without tools, with what @p blank and @p process say.
  Parameters sheet_alone(const std::string &blank, const std::string &process)
  {
    return Parameters::from_text(isotropic_steel + "subsection Blank\n set Thickness = 1 mm\n" + blank +
                                   "end\nsubsection Process\n" + process +
                                   "end\nsubsection Tools\n set Without = Die, Punch, Blank holder\nend\n",
                                 "file");
  }

  /// A strip of 100 x 20 x 1 mm pulled along x: @p pulling as in `Edge x force` or `motion`.
  Parameters pulled_strip(const std::string &pulling, const std::string &duration)
  {
    return sheet_alone(R"(
  set Length = 100 mm
  set Width = 20 mm
  set Element size = 5 mm
  subsection Edges
    set Edge x = pulled
    set Edge x )" + pulling + R"(
  end
)",
                       "set Duration = " + duration + "\n");
  }

  void expect_piece(const std::string &text, const std::string &piece)
  {
    EXPECT_NE(text.find(piece), std::string::npos) << "'" << piece << "' is not in: " << text;
  }
} // namespace

// A strip of 100 x 20 x 1 mm pulled with F along x, free to contract: F = A0 exp(-e) K (e0 + e)^n with e the logarithmic
// strain (volume kept; the elastic strain of 0.2 % of it is neglected, which is the tolerance).
TEST(Process, StripPulledByAForce)
{
  FormingRun run(pulled_strip("force = 0 s, 0 kN, 1 s, 6 kN", "1 s"));
  run.simulation->run();
  const double strain = std::log((50 - run.last().draw_in_x) / 50);
  EXPECT_GT(strain, 0.03);
  EXPECT_NEAR(20 * std::exp(-strain) * 565.32 * std::pow(0.007117 + strain - 300. / 206000, 0.2589), 6000, 12);
  EXPECT_LT(std::abs(run.last().energy_error()), 0.01);
}

// The same strip between grips that move: the work of the grips is what the sheet takes up. Unloading lets the elastic part
// go, but for what the grips hold.
TEST(Process, StripPulledByAMotion)
{
  FormingRun run(pulled_strip("motion = 0 s, 0 mm, 2 s, 3 mm", "2 s"));
  run.simulation->run();
  EXPECT_NEAR(run.last().draw_in_x, -3, 1e-9);
  EXPECT_NEAR(run.last().path, 3, 1e-9);
  EXPECT_NEAR(run.last().time, 2, 1e-9);
  EXPECT_GT(run.last().plastic_work, 1e3);
  EXPECT_LT(std::abs(run.last().energy_error()), 0.01);
}

// Bulge of a clamped disc: thickness strain at the pole -(2 - n) ln(1 + h^2/a^2) with the hardening exponent n
// (J. Chakrabarty, J. M. Alexander, J. Strain Anal. 5 (1970) 155; a formula for moderate heights); the mesh is coarse: 5 %.
TEST(Process, HydraulicBulgeThinsAsASphere)
{
  FormingRun run(sheet_alone(R"(
  set Shape = circle
  set Diameter = 200 mm
  set Element size = 12 mm
  subsection Edges
    set Outer edge = clamped
  end
)",
                             "set Duration = 1 s\nset Fluid pressure = 0 s, 0 MPa, 1 s, 4 MPa\n"));
  run.simulation->run();
  const Shell &shell = run.simulation->shell();
  double       h = 0, thickness = 1;
  for (unsigned i = 0; i < shell.n_nodes(); ++i)
    if (shell.mesh().nodes[i].head<2>().norm() < 1e-9)
      {
        h         = shell.committed().position[i][2];
        thickness = shell.node_thickness()[i];
      }
  EXPECT_GT(h, 25);
  EXPECT_NEAR(std::log(thickness), -(2 - 0.2589) * std::log(1 + h * h / 1e4), 0.05 * std::abs(std::log(thickness)));
  EXPECT_LT(std::abs(run.last().energy_error()), 0.005);
}

TEST(Process, PartsOfTheBlankAgree)
{
  // The pattern of diagonals is not the same in the parts, so that they agree as meshes of the same size do.
  FormingRun quarter(coarse_cup({"Process/Punch travel = 3 mm"}));
  quarter.simulation->run();
  for (const char *part : {"half x", "half y", "whole"})
    {
      FormingRun run(coarse_cup({"Process/Punch travel = 3 mm", std::string("Blank/Symmetry = ") + part}));
      run.simulation->run();
      EXPECT_NEAR(run.last().punch_force, quarter.last().punch_force, 0.02 * quarter.last().punch_force) << part;
      EXPECT_NEAR(run.last().plastic_work, quarter.last().plastic_work, 0.02 * quarter.last().plastic_work) << part;
      EXPECT_NEAR(run.last().blank_holder_force, 19600, 20) << part;
    }
}

TEST(Process, HolderFollowsItsForcesOrItsGap)
{
  FormingRun forces(coarse_cup({"Process/Blank holder force = 20, 30 kN", "Process/Blank holder travels = 0, 6 mm"}));
  forces.simulation->run();
  for (const auto &r : forces.records->all)
    {
      EXPECT_NEAR(r.blank_holder_force, r.path > 0 ? 20000 + 10000 * r.path / 6 : r.blank_holder_force, 30) << r.path;
    }

  // Faces 0.9 mm apart: the frames of die and holder lie in their faces.
  FormingRun gap(coarse_cup({"Process/Blank holder control = gap", "Process/Blank holder gap = 0.9 mm", "Process/Blank holder force = 1 kN",
                             "Solver/Contact stiffness = 1000 MPa/mm", "Solver/Contact transition = 0.02 mm"}));
  gap.simulation->run();
  const auto &tools = gap.simulation->contact().tools();
  EXPECT_NEAR(tools[2].place[2] - tools[0].place[2], 0.9, 1e-6);
  EXPECT_GT(gap.last().punch_force, 5000);
}

// A pad pushes the bottom against the punch with 2 kN: a rigid body that moves down with the punch, against its force.
TEST(Process, FurtherToolUnderForce)
{
  const std::string pad = R"(
subsection Tools
  set More tools = Pad
  subsection Pad
    set Model = plate
    set Side = below
    set Control = force
    set Direction = 0, 0, 1
    set Force = 0 s, 2 kN, 10 s, 2 kN
    subsection Plate
      set Facing = up
      set Width in x = 50 mm
      set Width in y = 50 mm
      set Edge radius = 6 mm
    end
  end
end
)";
  FormingRun run(Parameters::from_text(square_cup + pad, "cup", {"Blank/Element size = 9.375 mm", "Sheet material/Yield locus = von Mises", "Process/Punch travel = 6 mm"}));
  FormingRun without(coarse_cup());
  run.simulation->run();
  without.simulation->run();
  const auto &contact = run.simulation->contact();
  ASSERT_EQ(contact.tools().size(), 4u);
  EXPECT_NEAR(4 * contact.tool_forces()[3][2], -2000, 5);    // the sheet pushes it down
  EXPECT_NEAR(contact.tools()[3].place[2], -0.39 - 6, 0.15); // it has gone down with the punch
  EXPECT_NEAR(run.last().punch_force, without.last().punch_force + 2000, 0.04 * without.last().punch_force);
  EXPECT_LT(run.last().force_imbalance, 1e-3);
  EXPECT_LT(std::abs(run.last().energy_error()), 0.015);
}

// Without tools the part is held so that nothing constrains it: no force is left, elastic energy is given back, and the
// balance of energies still closes.
TEST(Process, UnloadingLeavesASelfStressedPart)
{
  for (const char *part : {"quarter", "half x"})
    {
      FormingRun run(coarse_cup({"Process/Punch travel = 3 mm", "Process/Unloading = tools removed", std::string("Blank/Symmetry = ") + part}));
      run.simulation->run();
      EXPECT_TRUE(run.simulation->tools_away());
      const auto &all  = run.records->all;
      const auto  held = std::find_if(all.rbegin(), all.rend(), [](const auto &r) { return r.unloaded == 0; });
      const auto &free = all.back();
      EXPECT_EQ(free.unloaded, 1);
      EXPECT_EQ(free.punch_force, 0);
      EXPECT_EQ(free.path, held->path);
      EXPECT_GT(free.time, held->time);
      EXPECT_LT(free.elastic_energy, 0.8 * held->elastic_energy) << part;
      EXPECT_GT(free.elastic_energy, 0) << part;
      EXPECT_LT(std::abs(free.energy_error()), 0.01) << part;
    }
}

// A node has the coefficient of the tool it is nearest to: punch 0.3 in the middle, holder 0.05 outside, on the upper face.
TEST(Process, FrictionOfEachTool)
{
  FormingRun run(coarse_cup(), std::make_unique<ConstantFriction>(std::vector<double>{0.1, 0.3, 0.05}));
  run.simulation->run();
  const auto &mu    = run.simulation->contact().friction(Face::punch_side);
  const auto &nodes = run.simulation->shell().mesh().nodes;
  for (unsigned i = 0; i < nodes.size(); ++i)
    {
      const double far = nodes[i].head<2>().cwiseAbs().maxCoeff();
      EXPECT_EQ(mu[i], far < 20 ? 0.3 : far > 50 ? 0.05 : mu[i]);
    }
  for (const double m : run.simulation->contact().friction(Face::die_side))
    EXPECT_EQ(m, 0.1);
  EXPECT_NEAR(run.last().friction.mean_mu[1], 0.1, 1e-12);
}

// mu = 0.1 (p / 10 MPa)^-0.2, at most 0.2, at the pressures of the committed state.
TEST(Process, FrictionByPressure)
{
  Parameters p = Parameters::from_text(R"(
    set Reference coefficient = 0.1
    set Reference pressure = 10 MPa
    set Exponent = 0.8
    set Largest coefficient = 0.2
)");
  std::shared_ptr<const PressureFrictionLaw> law = Registry<PressureFrictionLaw>::entries().at("power law").create(p);
  p.finish();
  EXPECT_NEAR(law->coefficient(10), 0.1, 1e-15);
  EXPECT_NEAR(law->coefficient(100), 0.1 * std::pow(10, -0.2), 1e-15);
  EXPECT_EQ(law->coefficient(0), 0.2);
  FormingRun run(coarse_cup(), std::make_unique<PressureFriction>(law));
  run.simulation->run();
  const auto &face = run.simulation->contact().face(Face::die_side);
  for (unsigned i = 0; i < face.pressure.size(); ++i)
    EXPECT_EQ(run.simulation->contact().friction(Face::die_side)[i], law->coefficient(face.pressure[i]));
}

TEST(Process, WrongInputIsExplainedBeforeTheRun)
{
  const std::string fine = "Blank/Element size = 4 mm";
  EXPECT_EQ(problems_of(coarse_cup({fine})), "");
  expect_piece(problems_of(coarse_cup({fine, "Process/Blank holder force = 0 kN"})), "Blank holder force: the value is out of range");
  expect_piece(problems_of(coarse_cup({fine, "Process/Punch travel = -5 mm"})), "Punch travel: the value is out of range");
  expect_piece(problems_of(coarse_cup({fine, "Process/Blank holder control = gap", "Process/Blank holder gap = 0.7 mm"})), "the gap is smaller than the sheet is thick");
  expect_piece(problems_of(coarse_cup({fine, "Process/Blank holder force = 10, 20 kN"})), "more than one force needs as many travels");
  expect_piece(problems_of(coarse_cup({fine, "Tools/Without = Lid"})), "there is no such role of a tool");
  expect_piece(problems_of(coarse_cup({fine, "Tools/Without = Punch"})), "Process/Duration: this entry is missing");
  expect_piece(problems_of(coarse_cup({fine, "Blank/Thickness points = 5", "Blank/Thickness rule = halves"})), "an even number");
  expect_piece(problems_of(coarse_cup({fine, "Blank/Edges/Edge -x = clamped"})), "there is no such straight edge");
  expect_piece(problems_of(coarse_cup({fine, "Blank/Edges/Edge x = pulled"})), "either a motion or a force");
}

// A bar of 5 mm radius across the cup, 20 mm above it: nothing is wrong until it stands in the sheet, or runs into the die.
TEST(Process, ToolsInTheWayAreFound)
{
  const auto with_bar = [](const std::vector<std::string> &changes) {
    std::vector<std::string> all = {"Blank/Element size = 4 mm", "Process/Punch travel = 6 mm", "Tools/Without = Punch", "Process/Duration = 1 s", "Tools/More tools = Bar", "Tools/Bar/Model = cylinder",
                                    "Tools/Bar/Side = above", "Tools/Bar/Cylinder/Diameter = 10 mm", "Tools/Bar/Cylinder/Facing = down", "Tools/Bar/Cylinder/Axis angle = 90 deg"};
    all.insert(all.end(), changes.begin(), changes.end());
    return problems_of(Parameters::from_text(square_cup, "cup", all));
  };
  const std::string high = "Tools/Bar/Place = 0, 0, 20 mm";
  EXPECT_EQ(with_bar({high}), "");
  expect_piece(with_bar({"Tools/Bar/Place = 0, 0, 0 mm"}), "Tools/Bar: the tool stands in the sheet at the start");
  expect_piece(with_bar({high, "Tools/Bar/Control = motion", "Tools/Bar/Motion = 0 s, 0 mm, 1 s, 40 mm"}), "run into each other");
}
