#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/lubrication_settings.h>
#include <tribodraw/lubrication/prescribed_film.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  // eta 32 mPa s, U 60 mm/s, L 10 mm, h0 2 um.
  constexpr double pressure_unit = 3.2e-8 * 60 * 10 / (2e-3 * 2e-3); // eta U L / h0^2
  constexpr double shear_unit    = 3.2e-8 * 60 * 10 / 2e-3;          // eta U L / h0 per width

  struct Case
  {
    std::string model = "inclined slider", inlet = "4 um", sides = "no flow", gap, lubricant;
    int         along = 240, across = 4;
    std::string width = "1 mm", step = "5 mm";

    PrescribedFilm::Result
    solve() const
    {
      const std::string shape
          = "set Inlet film = " + inlet + "\nset Outlet film = 2 um\nset Length = 10 mm\nset Width = " + width + "\n";
      const std::string text
          = "set Task = film\nsubsection Gap\nset Model = " + model + "\nset Sides = " + sides
            + "\nset Elements along = " + std::to_string(along) + "\nset Elements across = " + std::to_string(across)
            + "\n" + gap
            + (model == "step" ? "subsection Step\n" + shape + "set Step position = " + step + "\nend\n"
                               : "subsection Inclined slider\n" + shape + "end\n")
            + "end\nsubsection Process\nset Sheet speed = 60 mm/s\nend\nsubsection Lubricant\nset Viscosity = 32 mPa "
              "s\n"
            + lubricant + "end\n";
      Parameters parameters = Parameters::from_text(text);
      parameters.choice("Task", { "film" }, "");
      const PrescribedFilm film(parameters);
      parameters.finish();
      return film.solve();
    }
  };
} // namespace

TEST(PrescribedFilm, InclinedSliderOfInfiniteWidth)
{
  // benchmarks.md 7.1: K, W*, p*max, x/L, q/(U h0), F* on the moving flat surface.
  const double rows[][6] = { { .5, .1311626, .2, .6, .6, .8437209 },
                             { 1, .1588831, .25, .6667, .6667, .7725887 },
                             { 2, .1479184, .25, .75, .75, .697225 },
                             { 3, .1241962, .225, .8, .8, .648392 } };
  for (const auto &row : rows)
    {
      Case c;
      c.inlet      = std::to_string(2 * (1 + row[0])) + " um";
      const auto r = c.solve();
      EXPECT_NEAR(r.load / (10 * pressure_unit), row[1], 2e-4 * row[1]);
      EXPECT_NEAR(r.max_pressure / pressure_unit, row[2], 2e-4 * row[2]);
      EXPECT_NEAR(r.x_max / 10, row[3], 1. / 240);
      EXPECT_NEAR(r.flow_out / (60 * 2e-3), row[4], 3e-4);
      EXPECT_NEAR(r.friction_sheet / shear_unit, row[5], 2e-4 * row[5]);
      // Balance of moments of the wedge: drag on sheet minus tool = int h dp/dx = -int p dh/dx = load times slope.
      EXPECT_NEAR((r.friction_sheet - r.friction_tool) / r.load, 2e-3 * row[0] / 10, 2e-6);
      EXPECT_NEAR(r.flow_in, r.flow_out, 1e-12);
      EXPECT_LT(r.flux_imbalance, 1e-12);
    }
}

TEST(PrescribedFilm, RayleighStep)
{
  // benchmarks.md 7.3: n = 0.5, H = 2: p_m* = 1/3, W* = 1/6; optimum n = .71823, H = 1.86603: W* = .2062674. Linear
  // elements are exact for the piecewise linear pressure; what is left is the width of the jump, 1e-7.
  Case c;
  c.model      = "step";
  const auto r = c.solve();
  EXPECT_NEAR(r.max_pressure / pressure_unit, 1. / 3, 1e-6);
  EXPECT_NEAR(r.load / (10 * pressure_unit), 1. / 6, 1e-6);
  EXPECT_NEAR(r.x_max, 5, 1e-5);
  c.inlet = "3.73206 um";
  c.step  = "7.1823 mm";
  EXPECT_NEAR(c.solve().load / (10 * pressure_unit), .2062674, 1e-6);
  c.step = "12 mm";
  EXPECT_THROW(c.solve(), InputError);
}

TEST(PrescribedFilm, SquareSliderOfFiniteWidth)
{
  // benchmarks.md 7.2, B/L = 1: h1/h0 = 2: W* = .0692765; 2.2: .0705220 (Richardson from two meshes).
  const double rows[][2] = { { 4, .0692765 }, { 4.4, .0705220 } };
  for (const auto &row : rows)
    {
      Case c;
      c.sides = "pressure zero";
      c.inlet = std::to_string(row[0]) + " um";
      c.width = "10 mm";
      c.along = c.across  = 40;
      const double coarse = c.solve().load;
      c.along = c.across = 80;
      const auto fine    = c.solve();
      EXPECT_NEAR((fine.load + (fine.load - coarse) / 3) / (100 * pressure_unit), row[1], 4e-6);
      EXPECT_NEAR(fine.flow_in, fine.flow_out + fine.flow_sides, 1e-12);
    }
}

TEST(PrescribedFilm, FlowFactors)
{
  Case       c;
  const auto smooth = c.solve();
  c.gap             = "set Pressure factor = 0.5, 0.5\nset Shear factor times Sq = 0.4 um\n";
  const auto rough  = c.solve();
  // Pressure scales with 1/PhiP_xx; a constant shear term carries flow but makes no pressure: q grows by Sq PhiS U/2.
  EXPECT_NEAR(rough.load, 2 * smooth.load, 1e-9 * smooth.load);
  EXPECT_NEAR(rough.flow_out - smooth.flow_out, 0.4e-3 * 60 / 2 * 1., 1e-12);
}

TEST(PrescribedFilm, PressureRaisesTheViscosity)
{
  // Barus' law makes the 1-D equation linear in the reduced pressure q = (1 - exp(-a p))/a, the solution of the
  // isoviscous case. a = 60/GPa and q_max = 1.2 MPa: p_max = -ln(1 - a q)/a = 1.24540 MPa.
  Case c;
  c.lubricant  = "set Viscosity law = Barus\nsubsection Barus\nset Pressure coefficient = 60 1/GPa\nend\n";
  const auto r = c.solve();
  EXPECT_NEAR(r.max_pressure, -std::log(1 - 0.06 * 1.2) / 0.06, 5e-4);
  EXPECT_GT(r.viscosity_iterations, 3u);
}

TEST(PrescribedFilm, NegativePressureIsNotCarried)
{
  Case c;
  c.model      = "inclined slider";
  c.inlet      = "1 um"; // opens along the sliding: suction only
  const auto r = c.solve();
  EXPECT_EQ(r.load, 0.);
  EXPECT_EQ(r.cavitated_fraction, 1.);
}

TEST(PrescribedFilm, ShippedFileGivesTheResultItPromises)
{
  Parameters parameters = Parameters::from_file(TRIBODRAW_SOURCE_DIR "/prm/slider_bearing.prm");
  parameters.choice("Task", { "film" }, "");
  const PrescribedFilm film(parameters);
  parameters.finish();
  const auto result = film.solve();
  EXPECT_NEAR(result.max_pressure, 1.2, 1e-3);
  EXPECT_NEAR(result.x_max, 20. / 3, 1e-9);
  EXPECT_NEAR(result.load / 10, 7.626388, 3e-3);
  EXPECT_NEAR(result.flow_out / 10, 0.08, 1e-4);
  const std::string text = film.table(result).text();
  EXPECT_EQ(text.substr(0, 20), "quantity,value,unit\n");
  EXPECT_NE(text.find("\nmax_pressure,"), std::string::npos);
}

TEST(LubricationSettings, DefaultsAndWrongValues)
{
  Parameters empty    = Parameters::from_text("");
  const auto settings = LubricationSettings::read(empty);
  empty.finish();
  EXPECT_EQ(settings.supply, LubricationSettings::Supply::film_transport);
  EXPECT_EQ(settings.film_iterations, 30u);
  EXPECT_TRUE(settings.squeeze);
  EXPECT_TRUE(settings.memory);
  EXPECT_DOUBLE_EQ(settings.contact_threshold, 0.05);
  EXPECT_EQ(settings.boundary_layer_pressure, LubricationSettings::BoundaryLayerPressure::solid_plus_lubricant);

  Parameters nominal = Parameters::from_text(
      "subsection Coupling\nset Boundary layer pressure = nominal\nset Film iterations = 4\nset Squeeze term = kept\n"
      "set Asperities = follow the table\nset Smoothing passes = 2\nend\n"
      "subsection Lubricant\nset Supply = paper rule\nset Thinning = no\nend\n");
  const auto other = LubricationSettings::read(nominal);
  nominal.finish();
  EXPECT_EQ(other.boundary_layer_pressure, LubricationSettings::BoundaryLayerPressure::nominal);
  EXPECT_EQ(other.film_iterations, 4u);
  EXPECT_EQ(other.supply, LubricationSettings::Supply::paper_rule);
  EXPECT_TRUE(other.squeeze);
  EXPECT_FALSE(other.memory);
  EXPECT_FALSE(other.thinning);
  EXPECT_EQ(other.smoothing, 2u);

  Parameters wrong = Parameters::from_text("subsection Coupling\nset Smallest friction coefficient = "
                                           "0.4\nend\nsubsection Lubricant\nset Supply = well\nend\n");
  LubricationSettings::read(wrong);
  try
    {
      wrong.finish();
      FAIL();
    }
  catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find("Smallest friction coefficient"), std::string::npos);
      EXPECT_NE(std::string(e.what()).find("Supply"), std::string::npos);
    }
}
