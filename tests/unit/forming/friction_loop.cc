// Lubricated drawing: friction iterated within the increment against friction of the increment before.
#include "coarse_cup.h"

#include "unit/lubrication/hand_made_table.h"

#include <tribodraw/forming/lubricated_friction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace tribodraw;

namespace
{
  const std::vector<std::string> oil = {"Lubricant/Viscosity = 90 mPa s", "Lubricant/Density = 0.9 g/cm^3", "Lubricant/Amount = 2.0 g/m^2"};

  std::unique_ptr<LubricatedFriction>
  lubricated(const std::string &loop, const std::vector<std::string> &changes = {})
  {
    std::vector<std::string> entries = oil;
    entries.insert(entries.end(), changes.begin(), changes.end());
    entries.push_back("Coupling/Friction loop = " + loop);
    Parameters p = Parameters::from_text("", "oil", entries);
    const auto settings  = LubricationSettings::read(p);
    const auto lubricant = read_section(p, "Lubricant", [](Parameters &parameters) { return Lubricant::read(parameters); });
    p.finish();
    const auto table = std::make_shared<FrictionTable>(*test::hand_made_table());
    return std::make_unique<LubricatedFriction>(std::vector<std::shared_ptr<const FrictionTable>>(3, table), lubricant, settings);
  }

  FormingRun
  cup(const std::string &loop, const std::string &increment, const std::string &travel = "6 mm")
  {
    return FormingRun(coarse_cup({"Solver/Largest increment = " + increment, "Solver/First increment = 0.25 mm", "Process/Punch travel = " + travel}), lubricated(loop));
  }

  /// Mean over the travel of a figure, trapezoidal rule.
  template <class Figure>
  double
  mean(const Records &records, const Figure &figure)
  {
    double sum = 0, length = 0;
    for (std::size_t i = 1; i < records.all.size(); ++i)
      {
        const auto  &a = records.all[i - 1], &b = records.all[i];
        const double step = b.path - a.path;
        sum += 0.5 * step * (figure(a) + figure(b));
        length += step;
      }
    return sum / length;
  }

  double friction_of_the_die(const IncrementRecord &r) { return r.friction.mean_mu[static_cast<int>(Face::die_side)]; }
} // namespace

// The lag of the staggered scheme is one increment. Without it friction over the travel is nearer to that of small increments.
TEST(FrictionLoop, IteratedInLargeIncrementsIsNearerToSmallIncrements)
{
  auto small = cup("staggered", "0.25 mm"), large = cup("staggered", "1.5 mm"), iterated = cup("iterated", "1.5 mm");
  for (auto *run : {&small, &large, &iterated})
    run->simulation->run();
  const auto   force = [](const IncrementRecord &r) { return r.punch_force; };
  const double s = mean(*small.records, force), l = mean(*large.records, force), i = mean(*iterated.records, force);
  EXPECT_GT(std::abs(l - s), 3e-3 * s);                // 0.5 %
  EXPECT_LT(std::abs(i - s), 0.3 * std::abs(l - s)); // a tenth of it
  // Nothing is lost in attempts that are not accepted.
  for (const IncrementRecord &r : iterated.records->all)
    EXPECT_LT(r.friction.lubricant_volume_error, 1e-12);
}

// A run that goes on from a checkpoint sees nothing of attempts before it.
TEST(FrictionLoop, ResumedRunIsTheSame)
{
  const auto folder = std::filesystem::temp_directory_path() / "tribodraw_friction_loop";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  auto whole = cup("iterated", "1 mm", "4 mm"), first = cup("iterated", "1 mm", "4 mm"), rest = cup("iterated", "1 mm", "4 mm");
  whole.simulation->run();
  first.simulation->checkpoint_to(folder, 1.5, "cup");
  first.simulation->run();
  rest.simulation->checkpoint_to(folder, 100, "cup");
  ASSERT_TRUE(rest.simulation->resume(folder));
  rest.simulation->run();
  EXPECT_LT(rest.records->all.size(), whole.records->all.size());
  EXPECT_EQ(rest.last().punch_force, whole.last().punch_force);
  EXPECT_EQ(friction_of_the_die(rest.last()), friction_of_the_die(whole.last()));
  std::filesystem::remove_all(folder);
}

// Laws of viscosity reach the drawing: without effect of pressure and of shear each is the constant viscosity, with it the
// result changes. It changes by 0.2 % only, as what the trapped oil under this holder carries hardly depends on viscosity.
TEST(ViscosityLaws, InADrawing)
{
  const auto friction = [](const std::vector<std::string> &law) {
    FormingRun run(coarse_cup({"Solver/Largest increment = 1 mm", "Process/Punch travel = 3 mm"}), lubricated("staggered", law));
    run.simulation->run();
    EXPECT_LT(run.last().friction.lubricant_volume_error, 1e-12);
    return mean(*run.records, friction_of_the_die);
  };
  const auto law = [&](const std::string &name, const std::string &entry, const std::string &value) {
    std::vector<std::string> entries = {"Accept unusual values = Lubricant/" + name + "/" + entry, "Lubricant/Viscosity law = " + name,
                                        "Lubricant/" + name + "/" + entry + " = " + value};
    if (name == "Eyring")
      entries.push_back("Lubricant/Eyring/Pressure coefficient = 0 1/GPa");
    return friction(entries);
  };
  const double constant = friction({}), coefficient = 1e-12 * constant, visible = 1e-4 * constant;
  EXPECT_NEAR(law("Barus", "Pressure coefficient", "0 1/GPa"), constant, coefficient);
  EXPECT_NEAR(law("Roelands", "Pressure coefficient", "0 1/GPa"), constant, coefficient);
  EXPECT_NEAR(law("Eyring", "Eyring stress", "1e6 MPa"), constant, 1e-6 * constant);
  EXPECT_GT(std::abs(law("Barus", "Pressure coefficient", "300 1/GPa") - constant), visible);
  EXPECT_GT(std::abs(law("Roelands", "Pressure coefficient", "300 1/GPa") - constant), visible);
  EXPECT_GT(std::abs(law("Eyring", "Eyring stress", "1e-4 MPa") - constant), visible);
}
