#include "hand_made_table.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/lubrication/strip_contact.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tribodraw;
using Regime = StripContact::Result::Regime;

namespace
{
  constexpr auto solid_plus_lubricant = LubricationSettings::BoundaryLayerPressure::solid_plus_lubricant;

  StripContact::Geometry
  wide_tool()
  {
    StripContact::Geometry g;
    g.length      = 20;
    g.width       = 40;
    g.edge_radius = 5;
    g.n_along     = 120;
    return g;
  }

  StripContact::Conditions
  paper_conditions()
  {
    return { 4., 60., 0., 2.232e-3 }; // 2.0 g/m^2 of an oil of 0.896 g/cm^3
  }

  class Oil : public ViscosityLaw
  {
  public:
    explicit Oil(const double value) { reference = value; }
    Value
    viscosity(double, double) const override
    {
      return { reference, 0. };
    }
  };

  StripContact
  contact(const StripContact::Geometry &geometry, const double viscosity = test::eta)
  {
    return StripContact(geometry, test::hand_made_table(), std::make_shared<Oil>(viscosity), solid_plus_lubricant,
                        1e-3);
  }
} // namespace

// Without lubricant, and with lubricant that stands still, the asperities carry all: mu is that of the table at the
// nominal pressure. The short sharp edges carry next to nothing.
TEST(StripContact, dry_limit_is_boundary_friction)
{
  auto geometry        = wide_tool();
  geometry.edge_radius = 0.05;
  const auto   table   = test::hand_made_table();
  const double s       = table->cut_height_monotone.value({ 4., 0. });
  const double alpha   = table->film(s).contact_fraction;
  const double mu      = table->solid_shear(s, 4., 4. / alpha, 0.) / 4.;
  for (const double film : { 0., 2.232e-3 })
    {
      auto c            = paper_conditions();
      c.supplied_film   = film;
      c.speed           = film > 0 ? 0. : 60.;
      const auto result = contact(geometry).solve(c);
      EXPECT_NEAR(result.friction_coefficient, mu, 1e-3 * mu);
      EXPECT_EQ(result.regime, Regime::boundary);
      EXPECT_EQ(result.lubricant_share, 0.);
      EXPECT_LT(result.load_error, 1e-9);
    }
}

// Far above the asperities an inclined tool is a slider bearing, K = 1: W* = 0.1588831, F* = 4 ln 2 - 2 (exact,
// infinitely wide). The load below makes the gap at the end 50 um; asperities of 1.6 um and the short edges change it
// by some 0.1 %.
TEST(StripContact, thick_film_limit_is_a_slider_bearing)
{
  auto geometry               = wide_tool();
  geometry.edge_radius        = 0.02;
  geometry.inclination        = 0.05;
  const double             h0 = 0.05, u = 1e5;
  StripContact::Conditions c{ 0.1588831 * test::eta * u * geometry.length / (h0 * h0), u, 0., 1. };
  const auto               result = contact(geometry).solve(c);
  EXPECT_EQ(result.regime, Regime::full_film);
  EXPECT_NEAR(result.tool_height, h0, 3e-3 * h0);
  EXPECT_NEAR(result.friction_coefficient, (4. * std::log(2.) - 2.) / 0.1588831 * h0 / geometry.length,
              3e-3 * result.friction_coefficient);
  EXPECT_NEAR(result.flow_out, u * h0 * 2. / 3. * geometry.width, 3e-3 * result.flow_out);
  EXPECT_GT(result.rejected, 0.);
  EXPECT_LT(result.flow_error, 1e-12);
}

// More viscosity, speed or lubricant: the film carries more and friction falls, until the film is full.
TEST(StripContact, stribeck_curve_and_monotony)
{
  const auto geometry = wide_tool();
  double     share = -1, mu = 1;
  for (const double viscosity : { 1e-8, 3.2e-8, 9e-8, 2e-7, 5e-7 })
    {
      const auto result = contact(geometry, viscosity).solve(paper_conditions());
      EXPECT_GT(result.lubricant_share, share);
      EXPECT_LT(result.friction_coefficient, mu);
      EXPECT_LT(result.flow_error, 1e-12);
      EXPECT_LT(result.load_error, 1e-9);
      share = result.lubricant_share;
      mu    = result.friction_coefficient;
    }
  share = -1;
  mu    = 1;
  for (const double amount : { 0., 0.9e-3, 1.3e-3, 1.6e-3, 1.8e-3, 2.0e-3, 3e-3 })
    {
      auto c            = paper_conditions();
      c.speed           = 1000;
      c.supplied_film   = amount;
      const auto result = contact(geometry).solve(c);
      EXPECT_GE(result.lubricant_share, share);
      // The asperities' part never rises; streaks in the opening outlet drag a little on the strip (1e-4 here).
      EXPECT_LE(result.solid_friction, mu * (1 + 1e-9));
      EXPECT_LT(result.flow_error, 1e-12);
      share = result.lubricant_share;
      mu    = result.solid_friction;
    }
  EXPECT_GT(share, 0.001);
  // Stribeck: falls from boundary friction to a minimum and rises with viscous shear in the full film.
  std::vector<double> curve;
  for (const double speed : { 1., 1e2, 1e3, 1e4, 1e5, 1e6 })
    {
      auto c          = paper_conditions();
      c.speed         = speed;
      c.supplied_film = 20e-3;
      curve.push_back(contact(geometry).solve(c).friction_coefficient);
    }
  const auto lowest = std::min_element(curve.begin(), curve.end()) - curve.begin();
  EXPECT_GT(lowest, 1);
  EXPECT_LT(lowest, 5);
  EXPECT_LT(curve[lowest], 0.3 * curve[0]);
  EXPECT_GT(curve[5], 1.5 * curve[lowest]);
}

TEST(StripContact, mesh_convergence_and_side_leakage)
{
  std::vector<double> mu;
  for (const unsigned n : { 60u, 120u, 240u })
    {
      auto geometry    = wide_tool();
      geometry.n_along = n;
      auto c           = paper_conditions();
      c.speed          = 1000;
      c.supplied_film  = 20e-3;
      mu.push_back(contact(geometry).solve(c).friction_coefficient);
    }
  EXPECT_LT(std::abs(mu[2] - mu[1]), 0.6 * std::abs(mu[1] - mu[0]));
  EXPECT_LT(std::abs(mu[2] - mu[1]), 2e-3 * mu[2]);

  auto c            = paper_conditions();
  c.speed           = 1000;
  c.supplied_film   = 20e-3;
  auto open         = wide_tool();
  open.open_sides   = true;
  open.n_across     = 8;
  open.n_along      = 60;
  open.width        = 10;
  const auto narrow = contact(open).solve(c);
  auto       closed = open;
  closed.open_sides = false;
  const auto wide   = contact(closed).solve(c);
  EXPECT_GT(narrow.flow_sides, 0.);
  EXPECT_LT(narrow.flow_error, 1e-12);
  EXPECT_LT(narrow.lubricant_share, wide.lubricant_share);
  // Rows across change nothing if nothing leaves at the sides.
  closed.n_across = 1;
  EXPECT_NEAR(contact(closed).solve(c).friction_coefficient, wide.friction_coefficient,
              2e-3 * wide.friction_coefficient);
}

TEST(StripContact, lifted_film_tends_to_a_smooth_gap)
{
  const auto film = test::hand_made_table()->film(2.0e-3);
  const auto same = lifted_film(film, film.h_avg);
  EXPECT_EQ(same.phi_p, film.phi_p);
  const auto high = lifted_film(film, 100 * film.h_avg);
  EXPECT_NEAR((high.phi_p - Eigen::Matrix2d::Identity()).norm(), 0., 1e-4);
  EXPECT_NEAR(high.phi_s(0, 0), film.phi_s(0, 0) / 100., 1e-15);
  EXPECT_EQ(high.contact_fraction, 0.);
}

TEST(StripContact, impossible_conditions_are_refused)
{
  auto c     = paper_conditions();
  c.pressure = 250; // the table ends at 100 MPa
  EXPECT_THROW(contact(wide_tool()).solve(c), InputError);
  c        = paper_conditions();
  c.strain = 2; // it ends at 1
  EXPECT_THROW(contact(wide_tool()).solve(c), InputError);
  c       = paper_conditions();
  c.speed = -1;
  EXPECT_THROW(contact(wide_tool()).solve(c), InputError);
  c          = paper_conditions();
  c.pressure = 0;
  EXPECT_THROW(contact(wide_tool()).solve(c), InputError);
}
