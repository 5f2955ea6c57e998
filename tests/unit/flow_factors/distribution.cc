// The registered model: the same numbers on any number of ranks and threads.
#include "maps.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/flow_factors/quarter_maps.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  std::unique_ptr<FlowFactorModel>
  model(const std::string &text)
  {
    Parameters parameters = Parameters::from_text(text);
    auto       result     = read_flow_factors(parameters);
    parameters.finish();
    return result;
  }
}

TEST(CellProblem, the_same_on_every_number_of_ranks)
{
  HeightMap map = gaussian_map(64, 5, 21);
  for (double &z : map.z)
    z *= 1e-3;
  const std::vector<double>      cuts{ 3e-3, 2e-3, 1e-3, .5e-3, .2e-3, -.5e-3, 1.2e-3 };
  double                         last_progress = 0;
  const std::vector<FlowFactors> all
      = model("")->compute(map, {}, 1e-3, cuts, [&last_progress](const double fraction) { last_progress = fraction; });
  ASSERT_EQ(all.size(), cuts.size());
  EXPECT_EQ(last_progress, 1);
  for (std::size_t i = 0; i < cuts.size(); ++i)
    {
      const FlowFactors alone = solve(map, cuts[i], 1e-3, periodic(), {}, 3e-4); // this rank, one thread
      EXPECT_EQ(all[i].cut_height, cuts[i]);
      EXPECT_EQ(all[i].h_avg, alone.h_avg);
      EXPECT_EQ(all[i].contact_fraction, alone.contact_fraction);
      for (const std::size_t k : { 0, 1, 2, 3 })
        {
          EXPECT_NEAR(all[i].phi_p[k], alone.phi_p[k], 1e-10);
          EXPECT_NEAR(all[i].phi_s[k], alone.phi_s[k], 1e-10);
          // the same bits on all ranks
          EXPECT_EQ(parallel::min(all[i].phi_p[k]), parallel::max(all[i].phi_p[k]));
        }
      EXPECT_LT(all[i].residual, 1e-12);
    }
}

TEST(CellProblem, checks_are_the_same_on_every_number_of_ranks)
{
  HeightMap  map = gaussian_map(48, 4, 23);
  const auto m   = model("");
  m->use_checks({ true, true });
  const std::vector<double> cuts{ 3, 1, .4, -.8 };
  const auto                all = m->compute(map, {}, 1, cuts, {});
  for (std::size_t i = 0; i < cuts.size(); ++i)
    {
      CellSettings settings = periodic();
      settings.error_bounds = true;
      FlowFactors alone     = solve(map, cuts[i], 1, settings, {}, 3e-4);
      add_quarter_maps(alone, map, {}, settings, 3e-4, 1);
      EXPECT_TRUE(all[i].bounded);
      EXPECT_TRUE(all[i].quartered);
      const auto a = all[i].numbers(), b = alone.numbers();
      for (std::size_t k = 1; k < a.size(); ++k) // the first is the cut height, which the cell does not know
        EXPECT_NEAR(a[k], b[k], 1e-10) << k;
    }
}

TEST(CellProblem, settings_take_effect)
{
  HeightMap map      = gaussian_map(40, 5, 22);
  map.periodic       = false;
  const auto run     = [&map](const std::string &text) { return model(text)->compute(map, {}, 1, { 1. }, {})[0]; };
  const auto same_as = [&map](const FlowFactors &f, const CellSettings &settings, const double closed_gap) {
    const FlowFactors g = solve(map, 1, 1, settings, {}, closed_gap);
    return f.phi_p == g.phi_p && f.phi_s == g.phi_s;
  };
  using BC = CellBoundaryConditions;
  using D  = CellDiscretisation;
  EXPECT_TRUE(same_as(run(""), { BC::periodic, D::mean_gap }, 3e-4));
  EXPECT_TRUE(same_as(run("set Boundary conditions = paper\n"), { BC::paper, D::mean_gap }, 3e-4));
  EXPECT_TRUE(same_as(run("set Discretisation = paper\n"), { BC::periodic, D::paper }, 3e-4));
  EXPECT_TRUE(
      same_as(run("subsection Cell problem\n set Closed gap = 0.05\nend\n"), { BC::periodic, D::mean_gap }, .05));
  EXPECT_FALSE(same_as(run(""), { BC::paper, D::mean_gap }, 3e-4));
  EXPECT_FALSE(same_as(run(""), { BC::periodic, D::paper }, 3e-4));
  EXPECT_NE(model("")->fingerprint(), model("set Discretisation = paper\n")->fingerprint());
  EXPECT_NE(model("")->fingerprint(), model("set Boundary conditions = paper\n")->fingerprint());
}

TEST(CellProblem, impossible_maps)
{
  const HeightMap sheet = gaussian_map(16, 2, 1), tool = gaussian_map(20, 2, 1);
  const auto      message = [&](const std::string &text, const HeightMap &a, const HeightMap &b) {
    try
      {
        model(text)->compute(a, b, 1, { 1. }, {});
      }
    catch (const InputError &e)
      {
        return std::string(e.what());
      }
    return std::string();
  };
  EXPECT_NE(message("", sheet, tool).find("different grids"), std::string::npos);
  const HeightMap small = map_of_gap(8, 8, [](double, double) { return 1.; });
  EXPECT_NE(message("set Boundary conditions = paper\n", small, {}).find("at least 10 x 10"), std::string::npos);
  const HeightMap line = map_of_gap(2, 8, [](double, double) { return 1.; });
  EXPECT_NE(message("", line, {}).find("at least 3 x 3"), std::string::npos);
}
