// Entries of section `Flow factors`, conversion of separations, the table.
#include "maps.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  std::string
  problems(const std::string &text)
  {
    Parameters parameters = Parameters::from_text(text);
    read_flow_factors(parameters);
    read_separations(parameters);
    try
      {
        parameters.finish();
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
}

TEST(ReadFlowFactors, separations_are_sorted_and_different)
{
  Parameters parameters = Parameters::from_text("set Separations = 1, 3, 0.5\n");
  EXPECT_EQ(read_separations(parameters), (std::vector<double>{ 3, 1, .5 }));
  EXPECT_NE(problems("set Separations = 1, 2, 1\n").find("given twice"), std::string::npos);
  EXPECT_NE(problems("set Separations = 1, -2\n"), "");
  EXPECT_EQ(problems(""), "");
}

TEST(ReadFlowFactors, wrong_choices_are_named)
{
  EXPECT_NE(problems("set Boundary conditions = periodical\n").find("Boundary conditions"), std::string::npos);
  EXPECT_NE(problems("set Discretisation = spectral\n").find("Discretisation"), std::string::npos);
  EXPECT_NE(problems("set Model = nonsense\n").find("cell problem"), std::string::npos);
}

TEST(ReadFlowFactors, documentation_lists_all_entries)
{
  Parameters parameters = Parameters::for_documentation();
  const auto model      = read_flow_factors(parameters);
  read_factor_checks(parameters, model.get());
  read_separations(parameters);
  std::string paths;
  for (const EntryInfo &entry : parameters.entries())
    paths += entry.path + "\n";
  for (const char *path : { "Model", "Boundary conditions", "Discretisation", "Separations", "Error bounds",
                            "Quarter maps", "Cell problem/Closed gap", "Patir-Cheng/Gap gamma", "Tripp/Anisotropy",
                            "Wilson-Marsault/Sheet gamma", "Table/File" })
    EXPECT_NE(paths.find(std::string(path) + "\n"), std::string::npos) << path;
}

TEST(Separations, mean_gap_of_the_pair)
{
  // The cut height must reproduce the mean of the clipped gap itself, rough tool included.
  const HeightMap sheet = gaussian_map(32, 3, 1);
  HeightMap       tool  = gaussian_map(32, 3, 2);
  for (double &t : tool.z)
    t *= .5;
  const double              sq = std::sqrt(1.25);
  const std::vector<double> separations{ 3, 1, .3 };
  for (const HeightMap &counter : { HeightMap(), tool })
    {
      const auto cuts = cut_heights_for_separations(sheet, counter, sq, separations);
      for (std::size_t i = 0; i < cuts.size(); ++i)
        EXPECT_NEAR(make_cell_gap(sheet, counter, cuts[i], 0).mean_gap, separations[i] * sq, 1e-10);
    }
}

TEST(FlowFactorsTable, columns)
{
  FlowFactors f;
  f.cut_height     = 2e-3;
  f.h_avg          = 3e-3;
  f.phi_p          = { { .5, .1, .2, .6 } };
  f.iterations     = 2;
  const auto table = flow_factors_table({ f }, 1.5e-3);
  // the first twelve columns are fixed by the description of the output folder
  EXPECT_EQ(
      table.text().substr(0, table.text().find('\n')),
      "cut_height_um,h_avg_um,h_avg_over_sq,contact_fraction,phi_p_xx,phi_p_xy,phi_p_yx,phi_p_yy,phi_s_xx,phi_s_xy,"
      "phi_s_yx,phi_s_yy,residual,flux_error,iterations");
  EXPECT_DOUBLE_EQ(std::get<double>(table.rows()[0][0]), 2);
  EXPECT_DOUBLE_EQ(std::get<double>(table.rows()[0][2]), 2);
  EXPECT_DOUBLE_EQ(std::get<double>(table.rows()[0][5]), .1);
  EXPECT_EQ(std::get<long>(table.rows()[0][14]), 2);
}

TEST(FlowFactorsTable, columns_of_checks)
{
  FlowFactors f;
  f.bounded           = true;
  f.quartered         = true;
  f.phi_p_lower       = { { .1, .2, .3, .4 } };
  f.phi_s_upper       = { { .5, .6, .7, .8 } };
  f.phi_s_quarter_sd  = { { .01, .02 } };
  const auto  table   = flow_factors_table({ f }, 1);
  const auto &columns = table.columns();
  const auto  at      = [&](const std::string &name) {
    const auto column = std::find(columns.begin(), columns.end(), name);
    EXPECT_NE(column, columns.end()) << name;
    return std::get<double>(table.rows()[0][static_cast<std::size_t>(column - columns.begin())]);
  };
  EXPECT_EQ(columns.size(), 15u + 16u + 8u);
  EXPECT_EQ(at("phi_p_xx_lower"), .1);
  EXPECT_EQ(at("phi_p_yx_lower"), .3);
  EXPECT_EQ(at("phi_s_xy_upper"), .6);
  EXPECT_EQ(at("phi_s_yy_upper"), .8);
  EXPECT_EQ(at("phi_s_yy_quarter_sd"), .02);
}

TEST(FlowFactors, numbers_survive_the_exchange)
{
  FlowFactors f;
  f.cut_height              = 1;
  f.phi_p_lower             = { { .1, .2, .3, .4 } };
  f.phi_s_upper             = { { .5, .6, .7, .8 } };
  f.phi_s_quarter_mean      = { { .9, 1 } };
  f.iterations              = 7;
  f.bounded                 = true;
  const auto        numbers = f.numbers();
  const FlowFactors g       = FlowFactors::from_numbers(numbers.data());
  EXPECT_EQ(numbers.size(), FlowFactors::n_numbers());
  EXPECT_EQ(g.numbers(), numbers);
  EXPECT_EQ(g.phi_p_lower, f.phi_p_lower);
  EXPECT_EQ(g.phi_s_quarter_mean, f.phi_s_quarter_mean);
  EXPECT_EQ(g.iterations, 7u);
  EXPECT_TRUE(g.bounded);
  EXPECT_FALSE(g.quartered);
}

TEST(ReadFlowFactors, checks_warn_where_there_is_nothing_to_check)
{
  Parameters parameters = Parameters::from_text("set Model = Tripp\nset Quarter maps = true\n");
  const auto model      = read_flow_factors(parameters);
  read_factor_checks(parameters, model.get());
  const auto warnings = parameters.finish();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("Quarter maps"), std::string::npos);
}
