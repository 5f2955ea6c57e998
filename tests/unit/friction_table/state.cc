#include "sample_pair.h"

#include "claims.h"

#include <tribodraw/base/log.h>

#include <gtest/gtest.h>

using namespace tribodraw;

namespace
{
  const double um = 1e-3;

  const FrictionTable &
  sample_table()
  {
    static const FrictionTable table = build_friction_table(test::sample_pair(128));
    return table;
  }

  /// Strain at constant pressure from the undeformed state in steps of @p step.
  double
  load_and_strain(const FrictionTable &table, const double p, const double eps, const double step)
  {
    double     s = table.initial_cut_height;
    const auto n = static_cast<unsigned int>(std::ceil(eps / step));
    if (n == 0)
      return table.advance(s, p, 0., 0.);
    for (unsigned int i = 0; i < n; ++i)
      s = table.advance(s, p, eps * i / n, eps * (i + 1) / n);
    return s;
  }

  bool
  inside(const FrictionTable &table)
  {
    return table.beyond_pressures().n == 0 && table.beyond_strains().n == 0 && table.n_beyond_cut_heights() == 0;
  }
} // namespace

// The increments reproduce the monotone look-up, which is integrated on the map itself, in steps of any size: with 256
// points of the curves within 0.2 % of Sq at the points of the axes and 0.3 % between them, the error falling with the
// square of the points (until it meets the steps of the map's distribution, one of 16384 pixels).
TEST(FrictionTableState, IncrementsReproduceTheMonotoneLookUp)
{
  PairDescription           pair = test::sample_pair(128);
  const HeightDistribution  heights(pair.sheet);
  const std::vector<double> strains{ 0., 0.01, 0.035, 0.15, 0.37, 0.8 };
  double                    previous = 0;
  for (const unsigned int n_points : { 64, 128, 256 })
    {
      pair.axes.n_curve_points      = n_points;
      const FrictionTable table     = build_friction_table(pair);
      double              at_points = 0, between = 0;
      for (const double step : { 0.001, 0.01, 0.1 })
        for (const double p : table.cut_height_monotone.axes()[0].points)
          for (const double eps : table.cut_height_monotone.axes()[1].points)
            at_points = std::max(at_points, std::abs(load_and_strain(table, p, eps, step)
                                                     - table.cut_height_monotone.value({ p, eps })));
      for (const double p : { 0.7, 1.4, 5.3, 15., 27., 80. })
        {
          const auto s = pair.flattening->monotone_cut_heights(heights, *pair.hardening, p, strains);
          for (std::size_t i = 0; i < strains.size(); ++i)
            between = std::max(between, std::abs(load_and_strain(table, p, strains[i], 0.004) - s[i]));
        }
      std::cout << n_points << " points: interpolation error of the cut height " << at_points / um
                << " um at the points of the axes, " << between / um << " um between them\n";
      EXPECT_TRUE(inside(table));
      if (previous > 0)
        {
          EXPECT_LT(at_points, previous / 3.) << n_points;
        }
      previous = at_points;
      if (n_points == 256)
        {
          EXPECT_TRUE(claims::below("cut height of incremental flattening at the points of the table, over Sq",
                                    "monotone look-up", at_points / table.sq, 2e-3));
          EXPECT_TRUE(claims::below("the same between the points, over Sq", "integration on the map",
                                    between / table.sq, 3e-3));
        }
    }
}

TEST(FrictionTableState, FlatteningIsNeverUndone)
{
  const FrictionTable &table = sample_table();
  const double         s     = table.advance(table.initial_cut_height, 20., 0., 0.1);
  EXPECT_EQ(table.advance(s, 20., 0.1, 0.1), s); // the same state again
  EXPECT_EQ(table.advance(s, 5., 0.1, 0.1), s);  // unloading
  EXPECT_EQ(table.advance(s, 0., 0.1, 0.2), s);  // no contact while straining
  EXPECT_EQ(table.advance(s, -1., 0.1, 0.2), s);
  EXPECT_LT(table.advance(s, 5., 0.1, 0.2), s); // straining under less load still flattens
  EXPECT_GT(table.advance(s, 5., 0.1, 0.2), table.advance(s, 20., 0.1, 0.2));
  // Load alone: twice the load flattens a sheet that was loaded only, not one that was strained as well.
  const double loaded = table.advance(table.initial_cut_height, 20., 0., 0.);
  EXPECT_LT(table.advance(loaded, 40., 0., 0.), loaded);
  EXPECT_EQ(table.advance(s, 40., 0.1, 0.1), s);
  // In small steps as in one.
  double small = s;
  for (unsigned int i = 0; i < 100; ++i)
    small = table.advance(small, 20., 0.1 + 0.001 * i, 0.101 + 0.001 * i);
  EXPECT_NEAR(small, table.advance(s, 20., 0.1, 0.2), 1e-4 * um);
}

TEST(FrictionTableState, SmallPressuresLeadToTheUndeformedSheet)
{
  const FrictionTable &table = sample_table();
  const double         top = table.initial_cut_height, p_min = table.cut_height_normal.axes()[0].points.front();
  double               previous = table.advance(top, p_min, 0., 0.);
  for (const double p : { 0.5 * p_min, 0.1 * p_min, 1e-3 * p_min, 1e-9 * p_min })
    {
      const double s = table.advance(top, p, 0., 0.);
      EXPECT_GE(s, previous);
      previous = s;
      // d eps/d(-s) grows as 1/p: hardly any flattening by strain either
      EXPECT_LE(table.advance(top, p, 0., 0.1), s);
    }
  EXPECT_NEAR(previous, top, 1e-6 * um);
  EXPECT_NEAR(table.advance(top, 1e-9 * p_min, 0., 0.1), top, 1e-6 * um);
  EXPECT_TRUE(inside(table));
}

// More load and strain than the table knows: clamped, finite, and counted for each axis with the largest value.
TEST(FrictionTableState, CountsWhatIsOutside)
{
  FrictionTable table = sample_table();
  EXPECT_TRUE(inside(table));
  const double bottom = table.curves.cut_height.front(), top = table.initial_cut_height;
  EXPECT_EQ(table.advance(top, 100., 0.2, 0.3), table.advance(top, 1000., 0.2, 0.3));
  EXPECT_EQ(table.beyond_pressures().n, 1u);
  EXPECT_EQ(table.beyond_pressures().largest, 1000.);
  EXPECT_EQ(table.beyond_strains().n, 0u);
  EXPECT_GE(table.advance(top, 900., 0., 50.), bottom);
  EXPECT_EQ(table.beyond_pressures().n, 2u);
  EXPECT_EQ(table.beyond_pressures().largest, 1000.); // not the last
  EXPECT_EQ(table.beyond_strains().n, 1u);
  EXPECT_EQ(table.beyond_strains().largest, 50.);
  const FrictionTable copy = table;
  EXPECT_EQ(copy.beyond_pressures().largest, 1000.);
  EXPECT_EQ(table.n_beyond_cut_heights(), 0u);
  const unsigned warnings = log::n_warnings();
  table.warn_of_look_ups_beyond();
  EXPECT_EQ(log::n_warnings(), warnings + 2); // one for each of these axes
  EXPECT_EQ(table.advance(bottom, 100., 0., 0.1), bottom);
  EXPECT_EQ(table.advance(bottom - 1., 100., 0., 0.1), bottom - 1.);
  const auto film = table.film(bottom - 1.);
  EXPECT_EQ(film.contact_fraction, table.max_contact_fraction());
  EXPECT_EQ(table.film(top + 1.).h_avg, table.film(top).h_avg);
}

// Pressures that press the sheet flat end on a contact fraction of 0.98 and change nothing below.
TEST(FrictionTableState, EndsOnTheFlatSheet)
{
  auto       pair      = test::sample_pair(64);
  const auto below     = build_friction_table(pair);
  const auto n_strains = below.cut_height_monotone.axes()[1].points.size();
  const auto n_values  = below.cut_height_monotone.values().size();
  pair.axes.pressures.insert(pair.axes.pressures.end(), { 1000, 5000 });
  const auto flat = build_friction_table(pair);
  for (std::size_t i = 0; i < n_values; ++i)
    EXPECT_EQ(flat.cut_height_monotone.values()[i], below.cut_height_monotone.values()[i]);
  for (std::size_t i = 0; i < n_strains; ++i)
    {
      const double s = flat.cut_height_monotone.values()[n_values + n_strains + i];
      EXPECT_NEAR(HeightDistribution(pair.sheet).contact_fraction(s), 0.98, 1e-3); // one of 4096 pixels
    }
  EXPECT_NO_THROW(flat.check("flat"));
  EXPECT_LT(flat.max_contact_fraction(), 0.995);
}

// A model without flattening by strain: only the load matters.
TEST(FrictionTableState, LoadAloneModels)
{
  PairDescription pair       = test::sample_pair(64);
  Parameters      parameters = Parameters::from_text(
           "set Model = Pullen-Williamson\nsubsection Pullen-Williamson\nset Hardness over flow stress = 2.8\nend\n");
  pair.flattening           = Flattening(parameters.model<AsperityModel>("Model", ""), 25 * um, 0.1);
  const FrictionTable table = build_friction_table(pair);
  const double        s     = table.advance(table.initial_cut_height, 20., 0., 0.);
  EXPECT_LT(s, table.initial_cut_height);
  EXPECT_NEAR(table.advance(s, 20., 0., 0.5), s, 1e-9 * um);
  EXPECT_LT(table.advance(s, 40., 0., 0.), s);
}
