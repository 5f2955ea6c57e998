#include "sample_pair.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/friction_table/scatter.h>

#include <gtest/gtest.h>

using namespace tribodraw;

namespace
{
  FrictionTable
  table_of_map(const unsigned seed, const bool other_axes = false)
  {
    PairDescription pair = test::sample_pair(128);
    pair.sheet           = test::make_surface(test::bimodal_sheet(128, seed));
    if (other_axes)
      pair.axes.pressures = { 0.8, 3, 12, 40, 90 };
    return build_friction_table(pair);
  }
} // namespace

// The mean of equal tables is that table, at all its points and between them.
TEST(FrictionTableScatter, MeanOfEqualTablesIsTheTable)
{
  const FrictionTable one  = table_of_map(1);
  const FrictionTable mean = mean_friction_table({ one, one, one });
  EXPECT_NEAR(mean.sq, one.sq, 1e-18);
  EXPECT_NEAR(mean.initial_cut_height, one.initial_cut_height, 1e-18);
  for (const double p : { 0.5, 3., 12., 80. })
    for (const double e : { 0., 0.07, 0.3 })
      {
        const double s = one.cut_height_monotone.value({ p, e });
        EXPECT_NEAR(mean.cut_height_monotone.value({ p, e }), s, 1e-15);
        EXPECT_NEAR(mean.film(s).h_avg, one.film(s).h_avg, 1e-9);
        EXPECT_NEAR(mean.film(s).contact_fraction, one.film(s).contact_fraction, 1e-9);
        EXPECT_NEAR((mean.film(s).phi_s - one.film(s).phi_s).norm(), 0., 1e-6);
        const double from_top = mean.advance(mean.initial_cut_height, p, 0., e);
        EXPECT_NEAR(from_top, one.advance(one.initial_cut_height, p, 0., e), 2e-6);
      }
  const CsvTable csv = friction_table_scatter({ one, one });
  for (const auto &row : csv.rows())
    {
      EXPECT_NEAR(std::get<double>(row[3]), 0., 1e-15);              // sd of the contact fraction
      EXPECT_EQ(std::get<double>(row[4]), std::get<double>(row[5])); // least and greatest
    }
}

// Maps of one texture with other seeds, and tables with other axes: the mean is a valid table between its members, and
// the standard deviation is that of three numbers by its definition.
TEST(FrictionTableScatter, MeanAndDeviationOfDifferentMaps)
{
  const std::vector<FrictionTable> tables{ table_of_map(1), table_of_map(2), table_of_map(3, true) };
  const FrictionTable              mean = mean_friction_table(tables);
  EXPECT_EQ(mean.cut_height_monotone.axes()[0].points.front(), 0.8); // the common range
  EXPECT_EQ(mean.cut_height_monotone.axes()[0].points.back(), 90.);
  const CsvTable csv = friction_table_scatter(tables);
  EXPECT_EQ(csv.rows().size(), mean.cut_height_monotone.values().size());
  double greatest = 0;
  for (const auto &row : csv.rows())
    {
      const double p = std::get<double>(row[0]), e = std::get<double>(row[1]);
      double       sum = 0, square = 0;
      for (const auto &t : tables)
        {
          const double alpha = t.film(t.cut_height_monotone.value({ p, e })).contact_fraction;
          sum += alpha;
          square += alpha * alpha;
        }
      EXPECT_NEAR(std::get<double>(row[2]), sum / 3., 1e-14);
      EXPECT_NEAR(std::pow(std::get<double>(row[3]), 2), (square - sum * sum / 3.) / 2., 1e-14);
      greatest = std::max(greatest, std::get<double>(row[3]));
      // States are matched by contact fraction: the mean table has about the mean contact fraction.
      const double alpha = mean.film(mean.cut_height_monotone.value({ p, e })).contact_fraction;
      EXPECT_NEAR(alpha, sum / 3., 0.01);
    }
  EXPECT_GT(greatest, 1e-3); // the maps do differ
}

TEST(FrictionTableScatter, NothingInCommonIsRefused)
{
  PairDescription low = test::sample_pair(64), high = test::sample_pair(64);
  low.axes.pressures  = { 1, 2 };
  high.axes.pressures = { 3, 4 };
  EXPECT_THROW(mean_friction_table({ build_friction_table(low), build_friction_table(high) }), InputError);
  EXPECT_THROW(mean_friction_table({}), InputError);
}
