#include "film_mesh.h"
#include "hand_made_table.h"

#include <tribodraw/base/archive.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/lubrication/lubricated_face.h>

#include <gtest/gtest.h>

using namespace tribodraw;
using Regime = LubricatedFace::Regime;

namespace
{
  using test::ConstantOil;
  using test::eta;
  using test::hand_made_table;

  // mu of boundary friction (paper 2.2): c0 P0^0.75 alpha / P + ploughing.
  double
  boundary_friction(const double alpha, const double p0, const double p_solid, const double p_nominal)
  {
    return (alpha * 0.35418 * std::pow(p0, 0.75) + 0.02 * p_solid) / p_nominal;
  }

  /// A flat strip 20 x 8 mm that slides with 60 mm/s along +x under a tool at rest.
  struct Strip
  {
    FilmMesh                             mesh{ 20, 8, 20., 8. };
    std::shared_ptr<FrictionTable>       table = hand_made_table();
    LubricationSettings                  settings;
    std::vector<LubricatedFace::Contact> contacts{ mesh.nodes.size() };
    LubricatedFace::Increment            increment{ 1. / 60, 1., false }; // 1 mm

    Strip()
    {
      for (auto &c : contacts)
        {
          c.table            = 0;
          c.nominal_pressure = 10;
          c.sheet_velocity   = { 60, 0, 0 };
        }
    }
    LubricatedFace
    face(const double supplied_film) const
    {
      return LubricatedFace(mesh.nodes, mesh.triangles, std::vector<bool>(mesh.nodes.size(), false), { table },
                            std::make_shared<ConstantOil>(), std::vector<double>(mesh.nodes.size(), supplied_film), settings);
    }
    /// Pressure that rises along the sliding: the film narrows, a wedge.
    void
    wedge(const double p_inlet, const double p_outlet)
    {
      for (unsigned n = 0; n < contacts.size(); ++n)
        contacts[n].nominal_pressure = p_inlet + (p_outlet - p_inlet) * mesh.nodes[n][0] / 20.;
    }
  };
} // namespace

TEST(LubricatedFace, StarvedContactHasBoundaryFrictionOnly)
{
  // 0.6 g/m^2 at 0.896 g/cm^3 = 0.67 um (model.md 8) < h_avg(1.5 um) = 1.6 um. 10 MPa: alpha 0.25, P0 = 40 MPa.
  Strip strip;
  auto  face = strip.face(0.67e-3);
  EXPECT_TRUE(face.update(strip.mesh.nodes, strip.contacts, strip.increment));
  for (const auto &node : face.nodes())
    {
      EXPECT_EQ(node.regime, Regime::boundary);
      EXPECT_EQ(node.lubricant_pressure, 0.);
      EXPECT_NEAR(node.cut_height, 1.5e-3, 1e-12);
      EXPECT_NEAR(node.film_thickness, 1.6e-3, 1e-12);
      EXPECT_NEAR(node.friction_coefficient, boundary_friction(0.25, 40, 10, 10), 1e-9);
    }
  EXPECT_DOUBLE_EQ(face.statistics().starved_area_fraction, 1.);
  EXPECT_DOUBLE_EQ(face.statistics().load_share, 0.);
  EXPECT_NEAR(face.statistics().contact_area, 160., 1e-10);
  EXPECT_NEAR(face.statistics().mean_friction, boundary_friction(0.25, 40, 10, 10), 1e-9);
}

TEST(LubricatedFace, SupplyDecidesNodeByNode)
{
  // 1 to 100 MPa along the strip: h_avg 2.02 to 1.0 um. 1.45 um of oil fills the valleys where h_avg <= 1.45 um.
  Strip strip;
  strip.wedge(1, 100);
  auto face = strip.face(1.45e-3);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  double   starved = 0;
  unsigned mixed   = 0;
  for (const auto &node : face.nodes())
    {
      EXPECT_EQ(node.regime == Regime::boundary, node.film_thickness > 1.45e-3);
      if (node.regime == Regime::boundary)
        {
          EXPECT_EQ(node.lubricant_pressure, 0.);
          EXPECT_NEAR(node.friction_coefficient,
                      boundary_friction(node.contact_fraction, node.nominal_pressure / node.contact_fraction,
                                        node.nominal_pressure, node.nominal_pressure),
                      1e-9);
        }
      else
        mixed += node.lubricant_pressure > 0;
    }
  for (std::size_t i = 0; i < face.nodes().size(); ++i)
    starved += face.nodes()[i].regime == Regime::boundary;
  EXPECT_GT(starved, 20);
  EXPECT_GT(mixed, 20u);
  EXPECT_GT(face.statistics().starved_area_fraction, 0.1);
  EXPECT_LT(face.statistics().starved_area_fraction, 0.9);
  EXPECT_GT(face.statistics().max_lubricant_pressure, 0.);
  EXPECT_EQ(face.nodes()[face.statistics().max_node].lubricant_pressure, face.statistics().max_lubricant_pressure);
}

TEST(LubricatedFace, FilmPressureIsThatOfTheReynoldsEquation)
{
  // First update: everything has just come into contact, so s follows from the full pressure. Put together by hand:
  Strip strip;
  strip.wedge(2, 30);
  auto face = strip.face(2.23e-3);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);

  std::vector<AverageReynolds::NodeData> data(strip.mesh.nodes.size());
  for (unsigned n = 0; n < data.size(); ++n)
    {
      const double p         = face.nodes()[n].nominal_pressure; // smoothed
      const double s         = strip.table->advance(2.5e-3, p, 0, 0);
      const auto   film      = strip.table->film(s);
      data[n].fixed          = film.h_avg > 2.23e-3;
      data[n].film           = film.h_avg;
      data[n].viscosity      = eta;
      data[n].phi_p          = film.phi_p;
      data[n].sq_phi_s       = 1.6e-3 * film.phi_s;
      data[n].sheet_velocity = { 60, 0, 0 };
      data[n].p_limit        = p;
      EXPECT_FALSE(data[n].fixed); // 2.0 g/m^2: mixed at every contacting node
    }
  // No node is fixed, so the pressure level is decided by the bounds: the strip is closed.
  const AverageReynolds reynolds(strip.mesh.nodes, strip.mesh.triangles);
  const auto            result = reynolds.solve(strip.mesh.nodes, data);
  double                load = 0, nominal = 0;
  for (unsigned n = 0; n < data.size(); ++n)
    {
      EXPECT_NEAR(face.nodes()[n].lubricant_pressure, result.pressure[n], 1e-9);
      EXPECT_NEAR(face.nodes()[n].solid_pressure + face.nodes()[n].lubricant_pressure, face.nodes()[n].nominal_pressure,
                  1e-12);
      EXPECT_LE(face.nodes()[n].lubricant_pressure, face.nodes()[n].nominal_pressure);
      EXPECT_EQ(face.nodes()[n].regime == Regime::full, result.pressure[n] >= data[n].p_limit * (1 - 1e-12));
    }
  std::vector<double> p_nominal;
  for (const auto &node : face.nodes())
    p_nominal.push_back(node.nominal_pressure);
  load    = reynolds.load(strip.mesh.nodes, result.pressure);
  nominal = reynolds.load(strip.mesh.nodes, p_nominal);
  EXPECT_NEAR(face.statistics().load_share, load / nominal, 1e-10);
  EXPECT_GT(face.statistics().load_share, 0.01);
  EXPECT_GT(face.statistics().capped_area_fraction, 0.);
  double opening = 0;
  for (unsigned n = 0; n < data.size(); ++n)
    opening += std::max(0., face.nodes()[n].regime == Regime::full ? result.outflow[n] : 0.);
  EXPECT_NEAR(face.statistics().opening_volume, opening / 60., 1e-9 * opening);
}

TEST(LubricatedFace, AsperitiesDoNotRiseAgain)
{
  Strip strip;
  auto  face = strip.face(0.67e-3);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  for (auto &c : strip.contacts)
    c.nominal_pressure = 2;
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  for (const auto &node : face.nodes())
    {
      EXPECT_NEAR(node.cut_height, 1.5e-3, 1e-12);
      EXPECT_NEAR(node.friction_coefficient, boundary_friction(0.25, 8, 2, 2), 1e-9);
    }
  // Out of contact and back: still flat. Strain without contact does not flatten, strain in contact does.
  for (auto &c : strip.contacts)
    {
      c.nominal_pressure = 0;
      c.eps_p            = 0.2;
    }
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  EXPECT_EQ(face.nodes()[0].regime, Regime::no_contact);
  EXPECT_NEAR(face.nodes()[0].cut_height, 1.5e-3, 1e-12);
  for (auto &c : strip.contacts)
    {
      c.nominal_pressure = 10;
      c.eps_p            = 0.3;
    }
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  // 10 MPa, strain 0.1. p d eps = 1000/mm (p_n - 10 MPa) d(-s) with p_n = 10 MPa + (1.5 um - s) 90/0.7 MPa/um:
  // 10 MPa * 0.1 = 1000/mm * (90/0.7) MPa/um * d^2/2  ->  d = sqrt(2 * 1 * 0.7 / 90) * 1 um.
  EXPECT_NEAR(face.nodes()[0].cut_height, 1.5e-3 - std::sqrt(1.4 / 90) * 1e-3, 1e-9);
}

TEST(LubricatedFace, FlatteningSeesTheSolidPressure)
{
  // Second update: the solid pressure is P_nom minus the last lubricant pressure; s was set by the full load, so it
  // stays until the load exceeds the first one by more than the lubricant carries.
  Strip strip;
  strip.wedge(2, 30);
  auto face = strip.face(2.23e-3);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  const auto first = face.nodes();
  for (auto &c : strip.contacts)
    c.nominal_pressure *= 1.5;
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  unsigned kept = 0, lower = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    {
      const auto  &now = face.nodes()[i];
      const double expected
          = strip.table->advance(first[i].cut_height, now.nominal_pressure - first[i].lubricant_pressure, 0, 0);
      EXPECT_DOUBLE_EQ(now.cut_height, expected);
      (now.cut_height == first[i].cut_height ? kept : lower) += 1;
    }
  EXPECT_GT(kept, 10u);
  EXPECT_GT(lower, 10u);
}

TEST(LubricatedFace, FrictionCoefficientHasLimitsAndCountsThem)
{
  Strip strip;
  auto  face = strip.face(0.67e-3);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  EXPECT_EQ(face.statistics().n_clamped_friction, 0u);
  // alpha frozen at 0.25, pressure down to 0.1 MPa: c0 alpha^.25 P^-.25 + .02 = .465 > 0.3.
  EXPECT_GT(boundary_friction(0.25, 0.4, 0.1, 0.1), 0.3);
  for (auto &c : strip.contacts)
    c.nominal_pressure = 0.1;
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  EXPECT_EQ(face.statistics().n_clamped_friction, face.nodes().size());
  EXPECT_DOUBLE_EQ(face.nodes()[3].friction_coefficient, 0.3);

  // Full film: solids carry nothing, viscous shear is some kPa: lower limit.
  strip.wedge(2, 30);
  auto wet = strip.face(2.23e-3);
  wet.update(strip.mesh.nodes, strip.contacts, strip.increment);
  unsigned full = 0;
  for (const auto &node : wet.nodes())
    if (node.regime == Regime::full)
      {
        EXPECT_GE(node.friction_coefficient, 0.005);
        EXPECT_LT(node.friction_coefficient, 0.01);
        ++full;
      }
  EXPECT_GT(full, 0u);
}

TEST(LubricatedFace, PressureInTheBoundaryLayer)
{
  for (const auto law : { LubricationSettings::BoundaryLayerPressure::solid_plus_lubricant,
                          LubricationSettings::BoundaryLayerPressure::nominal })
    {
      Strip strip;
      strip.settings.boundary_layer_pressure = law;
      strip.wedge(2, 30);
      auto face = strip.face(2.23e-3);
      face.update(strip.mesh.nodes, strip.contacts, strip.increment);
      unsigned checked = 0;
      for (const auto &node : face.nodes())
        if (node.regime == Regime::mixed && node.lubricant_pressure > 0.1)
          {
            // model.md T12. The viscous part is below 1 kPa + h/2 |grad p| < 0.02 MPa here.
            const double a     = node.contact_fraction;
            const double p0    = law == LubricationSettings::BoundaryLayerPressure::nominal
                                     ? node.nominal_pressure / a
                                     : node.solid_pressure / a + node.lubricant_pressure;
            const double solid = boundary_friction(a, p0, node.solid_pressure, node.nominal_pressure);
            EXPECT_NEAR(node.friction_coefficient, solid, 0.02 / node.nominal_pressure);
            ++checked;
          }
      EXPECT_GT(checked, 5u);
    }
}

TEST(LubricatedFace, ViscousShearAddsAlongTheSliding)
{
  // Parallel film: no pressure, so mu P = solid + (1 - alpha) eta U/h (Eqs. 17-19); an oil of 100 Pa s makes it
  // visible.
  class Thick : public ViscosityLaw
  {
  public:
    Value
    viscosity(double, double) const override
    {
      return { 1e-4, 0. };
    }
  };
  Strip          strip;
  LubricatedFace face(strip.mesh.nodes, strip.mesh.triangles, std::vector<bool>(strip.mesh.nodes.size(), true),
                      { strip.table }, std::make_shared<Thick>(), std::vector<double>(strip.mesh.nodes.size(), 2.23e-3), strip.settings);
  strip.settings.max_friction = 1;
  for (auto &c : strip.contacts)
    c.sheet_velocity = { 6, 8, 0 };
  strip.increment.dt = 0.1;
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  const double solid = boundary_friction(0.25, 40, 10, 10);
  EXPECT_NEAR(face.nodes()[5].friction_coefficient, solid + 0.75 * 1e-4 * 10 / 1.6e-3 / 10, 1e-9);
}

TEST(LubricatedFace, SmallIncrementsAreGathered)
{
  Strip strip;
  strip.wedge(2, 30);
  strip.settings.smallest_travel = 0.2;
  auto stepwise = strip.face(2.23e-3), at_once = strip.face(2.23e-3);

  // 0.06 mm with elastic rebound, then 0.14 mm: the second call has the mean velocity over 0.2 mm.
  auto part = strip.contacts;
  for (auto &c : part)
    c.sheet_velocity = { -20, 0, 0 };
  const double mu = stepwise.nodes()[0].friction_coefficient;
  EXPECT_FALSE(stepwise.update(strip.mesh.nodes, part, { 0.001, 0.06, false }));
  EXPECT_EQ(stepwise.nodes()[0].friction_coefficient, mu);
  EXPECT_EQ(stepwise.nodes()[0].regime, Regime::no_contact);
  for (auto &c : part)
    c.sheet_velocity = { 60, 0, 0 };
  EXPECT_TRUE(stepwise.update(strip.mesh.nodes, part, { 0.003, 0.14, false }));

  for (auto &c : part)
    c.sheet_velocity = { 40, 0, 0 }; // (-20*1 + 60*3)/4
  EXPECT_TRUE(at_once.update(strip.mesh.nodes, part, { 0.004, 0.2, false }));
  for (std::size_t i = 0; i < part.size(); ++i)
    EXPECT_NEAR(stepwise.nodes()[i].lubricant_pressure, at_once.nodes()[i].lubricant_pressure, 1e-10);
}

TEST(LubricatedFace, ClosingOfTheHolderFlattensWithoutFilm)
{
  Strip strip;
  strip.wedge(2, 30);
  auto face = strip.face(2.23e-3);
  EXPECT_TRUE(face.update(strip.mesh.nodes, strip.contacts, { 0., 0., true }));
  for (const auto &node : face.nodes())
    {
      EXPECT_EQ(node.lubricant_pressure, 0.);
      EXPECT_EQ(node.regime, Regime::mixed); // enough oil, nothing slides
      EXPECT_DOUBLE_EQ(node.cut_height, strip.table->advance(2.5e-3, node.nominal_pressure, 0, 0));
      EXPECT_GT(node.friction_coefficient, 0.05);
    }
}

TEST(LubricatedFace, OnlyTheVelocityAgainstTheToolCounts)
{
  Strip strip;
  strip.wedge(2, 30);
  auto here = strip.face(2.23e-3), there = strip.face(2.23e-3);
  here.update(strip.mesh.nodes, strip.contacts, strip.increment);
  for (auto &c : strip.contacts)
    {
      c.sheet_velocity += Eigen::Vector3d(-60, 25, -40);
      c.tool_velocity += Eigen::Vector3d(-60, 25, -40);
    }
  there.update(strip.mesh.nodes, strip.contacts, strip.increment);
  for (std::size_t i = 0; i < strip.contacts.size(); ++i)
    {
      EXPECT_NEAR(here.nodes()[i].lubricant_pressure, there.nodes()[i].lubricant_pressure, 1e-10);
      EXPECT_NEAR(here.nodes()[i].friction_coefficient, there.nodes()[i].friction_coefficient, 1e-12);
    }
}

TEST(LubricatedFace, StretchThinsTheSupplyAndKeepsTheVolume)
{
  Strip strip;
  auto  face = strip.face(1.7e-3); // above h_avg = 1.6 um
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  EXPECT_EQ(face.nodes()[10].regime, Regime::mixed);
  // Uneven stretch along x: x -> x + x^2/100 (0 to 40 %), bent out of the plane.
  auto positions = strip.mesh.nodes;
  for (auto &x : positions)
    {
      x[2] = 0.3 * std::sin(x[1]);
      x[0] += x[0] * x[0] / 100;
    }
  face.update(positions, strip.contacts, strip.increment);
  EXPECT_LT(std::abs(face.statistics().volume_error), 1e-14);
  EXPECT_NEAR(face.statistics().supplied_volume, 1.7e-3 * 160, 1e-12);
  unsigned starved = 0, mixed = 0;
  for (const auto &node : face.nodes())
    {
      EXPECT_LT(node.supplied_film, 1.7e-3);
      (node.regime == Regime::boundary ? starved : mixed) += 1;
      EXPECT_EQ(node.regime == Regime::boundary, node.supplied_film < node.film_thickness);
    }
  EXPECT_GT(starved, 20u);
  // Inverse to the area around each node, which grows to the outlet.
  SurfacePatch before(positions.size(), strip.mesh.triangles), after = before;
  before.move_to(strip.mesh.nodes);
  after.move_to(positions);
  for (std::size_t i = 0; i < positions.size(); ++i)
    EXPECT_NEAR(face.nodes()[i].supplied_film * after.nodal_area()[i], 1.7e-3 * before.nodal_area()[i], 1e-15);
  EXPECT_LT(face.nodes()[20].supplied_film, face.nodes()[0].supplied_film * 0.8);
}

TEST(LubricatedFace, OpenNodesAndEdges)
{
  // Contact in the middle third only; table -1 counts as open whatever the pressure.
  Strip strip;
  strip.wedge(2, 30);
  std::vector<bool> edge(strip.mesh.nodes.size(), false);
  for (unsigned n = 0; n < edge.size(); ++n)
    {
      edge[n] = strip.mesh.at_side(n);
      if (strip.mesh.nodes[n][0] < 6.5)
        strip.contacts[n].nominal_pressure = 0;
      if (strip.mesh.nodes[n][0] > 13.5)
        strip.contacts[n].table = -1;
    }
  LubricatedFace face(strip.mesh.nodes, strip.mesh.triangles, edge, { strip.table }, std::make_shared<ConstantOil>(),
                      std::vector<double>(strip.mesh.nodes.size(), 2.23e-3), strip.settings);
  // Before the first update: boundary friction of a fresh contact at 3 MPa.
  const double s     = strip.table->advance(2.5e-3, 3, 0, 0);
  const double alpha = strip.table->film(s).contact_fraction;
  EXPECT_NEAR(face.nodes()[0].friction_coefficient, boundary_friction(alpha, 3 / alpha, 3, 3), 1e-9);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  unsigned pressurised = 0;
  for (unsigned n = 0; n < edge.size(); ++n)
    {
      const auto  &node = face.nodes()[n];
      const double x    = strip.mesh.nodes[n][0];
      // One smoothing pass spreads contact by one node.
      EXPECT_EQ(node.in_contact(), x > 5.5 && x < 13.5) << x;
      if (edge[n] || !node.in_contact())
        {
          EXPECT_EQ(node.lubricant_pressure, 0.);
        }
      if (!node.in_contact())
        {
          EXPECT_NEAR(node.friction_coefficient, boundary_friction(alpha, 3 / alpha, 3, 3), 1e-9);
          EXPECT_EQ(node.cut_height, 2.5e-3);
        }
      pressurised += node.lubricant_pressure > 0;
    }
  EXPECT_GT(pressurised, 10u);
}

TEST(LubricatedFace, OpenNodesBringNoFalseVelocityIntoTheFilm)
{
  // A caller knows no sliding where nothing touches: zero or the true velocity there must give the same film.
  Strip strip;
  strip.wedge(2, 30);
  for (unsigned n = 0; n < strip.contacts.size(); ++n)
    if (strip.mesh.nodes[n][0] < 5.5 || strip.mesh.nodes[n][0] > 14.5)
      {
        strip.contacts[n].nominal_pressure = 0;
        strip.contacts[n].table            = -1;
      }
  auto with = strip.face(2.23e-3), without = strip.face(2.23e-3);
  with.update(strip.mesh.nodes, strip.contacts, strip.increment);
  for (auto &c : strip.contacts)
    if (c.table < 0)
      c.sheet_velocity.setZero();
  without.update(strip.mesh.nodes, strip.contacts, strip.increment);
  EXPECT_GT(with.statistics().load_share, 0.01);
  for (std::size_t i = 0; i < strip.contacts.size(); ++i)
    EXPECT_EQ(with.nodes()[i].lubricant_pressure, without.nodes()[i].lubricant_pressure);
}

TEST(LubricatedFace, AHoleInTheContactIsBridged)
{
  Strip strip;
  strip.wedge(2, 30);
  const unsigned hole                   = 4 * 21 + 12;
  strip.contacts[hole].nominal_pressure = 0;
  strip.contacts[hole].table            = -1;
  strip.contacts[hole].sheet_velocity.setZero();
  auto face = strip.face(2.23e-3);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  EXPECT_NE(face.nodes()[hole].regime, Regime::no_contact);
  EXPECT_GT(face.nodes()[hole].nominal_pressure, 5.);
  EXPECT_GT(face.nodes()[hole].lubricant_pressure, 0.);
}

TEST(LubricatedFace, TablesOfSeveralTools)
{
  // The second table has twice the ploughing; nodes with x > 10 touch its tool.
  Strip strip;
  auto  rough                  = std::make_shared<FrictionTable>(*strip.table);
  rough->ploughing_coefficient = Table<2>(rough->ploughing_coefficient.axes(), std::vector<double>(8, 0.04));
  for (unsigned n = 0; n < strip.contacts.size(); ++n)
    strip.contacts[n].table = strip.mesh.nodes[n][0] > 10;
  LubricatedFace face(strip.mesh.nodes, strip.mesh.triangles, std::vector<bool>(strip.mesh.nodes.size(), false),
                      { strip.table, rough }, std::make_shared<ConstantOil>(), std::vector<double>(strip.mesh.nodes.size(), 0.67e-3), strip.settings);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  EXPECT_NEAR(face.nodes()[20].friction_coefficient - face.nodes()[0].friction_coefficient, 0.02, 1e-12);
  strip.contacts[0].table = 2;
  EXPECT_THROW(face.update(strip.mesh.nodes, strip.contacts, strip.increment), InputError);
}

TEST(LubricatedFace, FilmIterationsConverge)
{
  Strip strip;
  strip.wedge(2, 30);
  strip.settings.film_iterations = 50;
  auto face                      = strip.face(2.23e-3);
  for (int step = 0; step < 5; ++step)
    {
      for (auto &c : strip.contacts)
        {
          c.nominal_pressure *= 1.2;
          c.eps_p += 0.03;
        }
      face.update(strip.mesh.nodes, strip.contacts, strip.increment);
      EXPECT_LT(face.statistics().film_change, 1e-3);
      EXPECT_LT(face.statistics().film_iterations, 50u);
      EXPECT_TRUE(face.statistics().converged);
    }
  EXPECT_LT(face.statistics().oscillation, 1.);
}

// Lubricant that is conserved: through pressure, stretch, sliding, contact that comes and goes and the edge of the blank.
TEST(LubricatedFace, TransportConservesTheLubricant)
{
  Strip strip;
  strip.settings.supply          = LubricationSettings::Supply::film_transport;
  strip.settings.film_iterations = 30;
  std::vector<bool> edge(strip.mesh.nodes.size());
  std::vector<double> film(edge.size());
  for (unsigned n = 0; n < edge.size(); ++n)
    {
      edge[n] = strip.mesh.at_side(n);
      film[n] = (1. + 0.25 * strip.mesh.nodes[n][1]) * 1e-3; // 1 to 3 um
    }
  LubricatedFace face(strip.mesh.nodes, strip.mesh.triangles, edge, { strip.table }, std::make_shared<ConstantOil>(),
                      film, strip.settings);
  auto           positions = strip.mesh.nodes;
  unsigned       met[4]    = { 0, 0, 0, 0 };
  for (unsigned step = 0; step < 12; ++step)
    {
      for (unsigned n = 0; n < edge.size(); ++n)
        {
          auto        &c = strip.contacts[n];
          const double x = strip.mesh.nodes[n][0];
          c.table        = x > 4 + 0.7 * step && x < 15 + 0.3 * step ? 0 : -1;
          // The load rises and falls.
          c.nominal_pressure = c.table < 0 ? 0. : 2 + 1.5 * std::abs(std::sin(0.3 * x + 0.5 * step)) * (2 + step % 5);
          c.eps_p += 0.004 * (1 + std::cos(x));
          positions[n][0] = x * (1 + 0.01 * step + 0.0005 * step * x);
        }
      strip.increment.at_rest = step == 0;
      strip.increment.dt      = 1e-3; // little time to leave by the sides
      face.update(positions, strip.contacts, strip.increment);
      const auto &figures = face.statistics();
      EXPECT_LT(std::abs(figures.volume_error), 1e-13);
      EXPECT_TRUE(figures.converged) << step << " " << figures.film_change;
      for (unsigned n = 0; n < edge.size(); ++n)
        {
          const auto &node = face.nodes()[n];
          ++met[static_cast<int>(node.regime)];
          EXPECT_GE(node.lubricant_pressure, 0);
          EXPECT_LE(node.lubricant_pressure, node.nominal_pressure * (1 + 1e-9));
          const double fill = node.supplied_film / node.film_thickness;
          if (node.regime == Regime::full)
            {
              EXPECT_DOUBLE_EQ(node.lubricant_pressure, node.nominal_pressure);
              EXPECT_NEAR(fill, 1., 1e-12); // the gap has opened as far as the lubricant fills it
              EXPECT_GE(node.lift, 0.);
              EXPECT_EQ(node.contact_fraction, 0.);
            }
          else if (node.regime == Regime::mixed)
            EXPECT_NEAR(fill, 1., 1e-6);
          else if (node.regime == Regime::boundary && !edge[n])
            {
              EXPECT_EQ(node.lubricant_pressure, 0.);
              EXPECT_LT(fill, 1.);
            }
        }
    }
  for (const unsigned n : met)
    EXPECT_GT(n, 20u); // all regimes have been met
  EXPECT_GT(face.statistics().left_volume, 1e-4 * face.statistics().supplied_volume);
}

// Too little lubricant to fill the valleys anywhere gives the friction of the paper's rule.
TEST(LubricatedFace, TransportOfLittleLubricantIsBoundaryFriction)
{
  Strip strip;
  strip.settings.supply          = LubricationSettings::Supply::film_transport;
  strip.settings.film_iterations = 30;
  auto face                      = strip.face(0.67e-3);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  for (const auto &node : face.nodes())
    {
      EXPECT_EQ(node.regime, Regime::boundary);
      EXPECT_NEAR(node.friction_coefficient, boundary_friction(0.25, 40, 10, 10), 1e-9);
    }
}

// Holder on a flooded sheet at rest, sealed all around: the lubricant cannot leave and carries what the asperities do
// not. Film 1.8 um: on the table between s = 1.5 um (1.6 um, 10 MPa) and 2.0 um (2.02 um, 1 MPa).
TEST(LubricatedFace, TrappedLubricantSharesTheLoadOfTheClosingHolder)
{
  Strip strip;
  strip.settings.supply          = LubricationSettings::Supply::film_transport;
  strip.settings.film_iterations = 30;
  auto face                      = strip.face(1.8e-3);
  face.update(strip.mesh.nodes, strip.contacts, { 0.5, 0., true });
  const double s     = 1.5e-3 + 0.5e-3 * (1.8 - 1.6) / (2.02 - 1.6); // h_avg linear in s
  const double solid = 10. - 9. * (s - 1.5e-3) / 0.5e-3;             // the table's law is linear in s between points
  for (const auto &node : face.nodes())
    {
      EXPECT_NEAR(node.cut_height, s, 1e-9);
      EXPECT_NEAR(node.film_thickness, 1.8e-3, 1e-12);
      EXPECT_NEAR(node.solid_pressure, solid, 1e-3 * solid);
      EXPECT_EQ(node.regime, Regime::mixed);
    }
}

// Squeeze term of the paper's rule: a load that rises on a flooded film at rest relative to the tool raises the
// pressure; without the term it has none, as nothing slides.
TEST(LubricatedFace, SqueezeTermIsSwitchable)
{
  for (const bool kept : { false, true })
    {
      Strip strip;
      strip.settings.squeeze         = kept;
      strip.settings.film_iterations = 20;
      auto face                      = strip.face(2.23e-3);
      for (auto &c : strip.contacts)
        {
          c.sheet_velocity   = { 0, 0, 0 };
          c.nominal_pressure = 3;
        }
      face.update(strip.mesh.nodes, strip.contacts, strip.increment);
      EXPECT_EQ(face.statistics().load_share, 0.);
      for (auto &c : strip.contacts)
        c.nominal_pressure = 9;
      face.update(strip.mesh.nodes, strip.contacts, strip.increment);
      if (kept)
        EXPECT_GT(face.statistics().load_share, 0.3);
      else
        EXPECT_EQ(face.statistics().load_share, 0.);
    }
}

// Asperities that follow the table stand up again when the load falls.
TEST(LubricatedFace, MemoryOfTheAsperitiesIsAnOption)
{
  for (const bool memory : { true, false })
    {
      Strip strip;
      strip.settings.memory = memory;
      auto face             = strip.face(0.67e-3);
      face.update(strip.mesh.nodes, strip.contacts, strip.increment);
      for (auto &c : strip.contacts)
        c.nominal_pressure = 1;
      face.update(strip.mesh.nodes, strip.contacts, strip.increment);
      EXPECT_NEAR(face.nodes()[7].cut_height, memory ? 1.5e-3 : 2.0e-3, 1e-12); // 10 and 1 MPa
    }
}

TEST(LubricatedFace, TransportGoesOnFromAnArchive)
{
  Strip strip;
  strip.settings.supply          = LubricationSettings::Supply::film_transport;
  strip.settings.film_iterations = 30;
  strip.wedge(2, 30);
  auto face = strip.face(2.23e-3), resumed = strip.face(1e-3);
  face.update(strip.mesh.nodes, strip.contacts, strip.increment);
  Archive archive;
  face.save(archive, "film");
  resumed.load(archive, "film");
  for (auto *f : { &face, &resumed })
    for (int step = 0; step < 2; ++step)
      f->update(strip.mesh.nodes, strip.contacts, strip.increment);
  EXPECT_EQ(face.report(), resumed.report());
  for (std::size_t i = 0; i < strip.contacts.size(); ++i)
    {
      EXPECT_EQ(face.nodes()[i].lubricant_pressure, resumed.nodes()[i].lubricant_pressure);
      EXPECT_EQ(face.nodes()[i].supplied_film, resumed.nodes()[i].supplied_film);
    }
}

TEST(LubricatedFace, GoesOnFromAnArchiveAsIfNothingHadHappened)
{
  Strip strip;
  strip.wedge(2, 30);
  auto       face = strip.face(2.23e-3);
  const auto step = [&strip](LubricatedFace &f, const double factor, const double travel) {
    for (auto &c : strip.contacts)
      {
        c.nominal_pressure *= factor;
        c.eps_p += 0.02;
      }
    f.update(strip.mesh.nodes, strip.contacts, { travel / 60, travel, false });
  };
  step(face, 1, 1);
  step(face, 1.2, 1);
  step(face, 1.1, 1);
  step(face, 1, 0.1); // motion is pending
  Archive archive;
  face.save(archive, "film/die");
  auto resumed = strip.face(1e-3);
  resumed.load(archive, "film/die");
  EXPECT_EQ(resumed.report(), face.report());
  const auto contacts = strip.contacts;
  step(face, 1.1, 0.15);
  strip.contacts = contacts;
  step(resumed, 1.1, 0.15);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    {
      EXPECT_EQ(face.nodes()[i].lubricant_pressure, resumed.nodes()[i].lubricant_pressure);
      EXPECT_EQ(face.nodes()[i].friction_coefficient, resumed.nodes()[i].friction_coefficient);
      EXPECT_EQ(face.nodes()[i].cut_height, resumed.nodes()[i].cut_height);
    }
  EXPECT_EQ(resumed.statistics().oscillation, face.statistics().oscillation);
  EXPECT_EQ(resumed.statistics().opening_volume, face.statistics().opening_volume);
  EXPECT_EQ(resumed.statistics().volume_error, face.statistics().volume_error);
  auto other = Strip();
  other.mesh = FilmMesh(4, 4, 1., 1.);
  auto small = other.face(1e-3);
  EXPECT_THROW(small.load(archive, "film/die"), InputError);
}

TEST(SurfacePatch, SmoothingKeepsTheIntegralAndConstants)
{
  const FilmMesh mesh(7, 5, 3., 2., 0.3);
  auto           positions = mesh.nodes;
  for (auto &x : positions)
    x[2] = 0.4 * x[0] * x[1];
  SurfacePatch patch(positions.size(), mesh.triangles);
  patch.move_to(positions);
  std::vector<double> values(positions.size()), ones(positions.size(), 1.);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = i % 5;
  EXPECT_NEAR(patch.integral(patch.smooth(values)), patch.integral(values), 1e-13);
  for (const double x : patch.smooth(ones))
    EXPECT_NEAR(x, 1., 1e-14);
  patch.move_to(mesh.nodes);
  EXPECT_NEAR(patch.integral(ones), 6., 1e-13);
  EXPECT_NEAR(patch.normal()[0][2], 1., 1e-15);
}
