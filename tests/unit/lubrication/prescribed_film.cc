#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/lubrication_settings.h>
#include <tribodraw/lubrication/prescribed_film.h>

#include "claims.h"

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
    solve(const PrescribedFilm::Watcher &watcher = {}) const
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
      return film.solve(watcher);
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
      EXPECT_TRUE(claims::agrees(claims::with("inclined slider, load, inlet over outlet - 1 =", row[0]),
                                 "closed form (Reynolds)", r.load / (10 * pressure_unit), row[1], 2e-4 * row[1]));
      EXPECT_NEAR(r.max_pressure / pressure_unit, row[2], 2e-4 * row[2]);
      EXPECT_NEAR(r.x_max / 10, row[3], 1. / 240);
      EXPECT_NEAR(r.flow_out / (60 * 2e-3), row[4], 3e-4);
      EXPECT_TRUE(claims::agrees(claims::with("inclined slider, friction, inlet over outlet - 1 =", row[0]),
                                 "closed form (Reynolds)", r.friction_sheet / shear_unit, row[5], 2e-4 * row[5]));
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
  EXPECT_TRUE(claims::agrees("Rayleigh step, load", "closed form: 1/6", r.load / (10 * pressure_unit), 1. / 6, 1e-6));
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
      EXPECT_TRUE(claims::agrees(claims::with("square slider of finite width, load, inlet um", row[0]),
                                 "Richardson extrapolation of an independent solver",
                                 (fine.load + (fine.load - coarse) / 3) / (100 * pressure_unit), row[1], 4e-6));
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

TEST(PrescribedFilm, EveryPassIsSeen)
{
  Case c;
  c.along     = 20;
  c.lubricant = "set Viscosity law = Barus\nsubsection Barus\nset Pressure coefficient = 60 1/GPa\nend\n";
  std::vector<PrescribedFilm::Pass> passes;
  std::vector<double>               last;
  const auto                        r = c.solve([&](const auto &pass, const auto &state) {
    passes.push_back(pass);
    last = state.pressure;
  });
  ASSERT_EQ(passes.size(), r.viscosity_iterations);
  ASSERT_GT(passes.size(), 2u);
  for (std::size_t i = 0; i < passes.size(); ++i)
    {
      EXPECT_EQ(passes[i].number, i + 1);
      EXPECT_EQ(passes[i].n_gaps, 1u);
      EXPECT_EQ(passes[i].settled, i + 1 == passes.size());
      EXPECT_NEAR(passes[i].least_gap, 2e-3, 1e-12);                  // the outlet film
      EXPECT_TRUE(i == 0 || passes[i].change < passes[i - 1].change); // a contraction
    }
  EXPECT_EQ(last, r.pressure); // what an interrupted run shows is the result
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

namespace
{
  PrescribedFilm::Result
  solve(const std::string &gap, const std::string &process, const std::string &viscosity = "10 mPa s")
  {
    const std::string text = "set Task = film\nsubsection Gap\n" + gap + "end\nsubsection Process\n" + process
                             + "end\nsubsection Lubricant\nset Viscosity = " + viscosity + "\nend\n";
    Parameters parameters = Parameters::from_text(text);
    parameters.choice("Task", { "film" }, "");
    const PrescribedFilm film(parameters);
    parameters.finish();
    return film.solve();
  }

  /// Radius 10 mm, clearance 10 um, 1 mm wide, 1 m/s, 10 mPa s: units of load eta U R^2/c^2 per width, of pressure
  /// eta U R/c^2.
  PrescribedFilm::Result
  journal(const double eccentricity, const std::string &cavitation, const int along)
  {
    return solve("set Model = journal\nset Sides = no flow\nset Elements across = 1\nset Elements along = "
                     + std::to_string(along)
                     + "\nsubsection Journal\nset Radius = 10 mm\nset Clearance = 10 um\nset Eccentricity = "
                     + std::to_string(eccentricity) + "\nset Width = 1 mm\nend\n",
                 "set Sheet speed = 1000 mm/s\nset Cavitation = " + cavitation + "\n");
  }
  constexpr double journal_load     = 1e-8 * 1000 * 100 / (1e-2 * 1e-2),
                   journal_pressure = 1e-8 * 1000 * 10 / (1e-2 * 1e-2);
} // namespace

// Infinitely long journal bearing. Full Sommerfeld: W* = 12 pi e/((2 + e^2) sqrt(1 - e^2)), attitude 90 degrees. Half
// Sommerfeld and Reynolds: quadrature of the closed form of the pressure, with the rupture angle from p = p' = 0.
TEST(PrescribedFilm, JournalBearing)
{
  struct Exact
  {
    double e, full, half, reynolds, rupture, attitude, pressure;
  };
  for (const Exact &x : { Exact{ 0.2, 3.772205, 1.901961, 2.572560, 241.326, 66.900, 1.58168 },
                          Exact{ 0.5, 9.673597, 5.153165, 6.455556, 219.694, 58.296, 4.47499 },
                          Exact{ 0.8, 19.039955, 12.487171, 15.083281, 200.174, 42.181, 15.13426 } })
    {
      const int  n    = 720;
      const auto full = journal(x.e, "none", n), half = journal(x.e, "cut off", n), film = journal(x.e, "Reynolds", n),
                 jfo = journal(x.e, "mass conserving", n);
      EXPECT_TRUE(claims::agrees(claims::with("journal bearing, load, Sommerfeld, eccentricity", x.e), "closed form",
                                 full.load / journal_load, x.full, 3e-4 * x.full));
      EXPECT_NEAR(full.attitude * 180 / M_PI, 90., 0.02);
      EXPECT_NEAR(half.load / journal_load, x.half, 3e-4 * x.half);
      EXPECT_TRUE(claims::agrees(claims::with("journal bearing, load, Reynolds (Swift-Stieber), eccentricity", x.e),
                                 "closed form with the root of the rupture", film.load / journal_load, x.reynolds,
                                 3e-4 * x.reynolds));
      EXPECT_TRUE(claims::agrees(claims::with("journal bearing, attitude in degrees, Reynolds, eccentricity", x.e),
                                 "closed form with the root of the rupture", film.attitude * 180 / M_PI, x.attitude,
                                 0.03));
      EXPECT_NEAR(film.max_pressure / journal_pressure, x.pressure, 3e-4 * x.pressure);
      EXPECT_NEAR(film.rupture_x / 10 * 180 / M_PI, x.rupture, 360. / n);
      // With a flooded inlet at the widest gap the pressure of the mass-conserving film is Reynolds'; here the flow
      // is conserved as well.
      EXPECT_NEAR(jfo.load, film.load, 2e-3 * film.load);
      EXPECT_NEAR(jfo.flow_in, jfo.flow_out, 1e-12 * jfo.flow_in);
      EXPECT_LT(jfo.volume_error, 1e-12);
      EXPECT_GT(film.flow_out, 1.1 * film.flow_in); // Reynolds' condition makes lubricant where the film forms again
    }
  // Order two in the element size.
  const double exact  = 12 * M_PI * 0.5 / (2.25 * std::sqrt(0.75));
  const double coarse = journal(0.5, "none", 90).load / journal_load - exact,
               fine   = journal(0.5, "none", 180).load / journal_load - exact;
  EXPECT_TRUE(
      claims::agrees("journal bearing, order in the element size", "closed form", std::log2(coarse / fine), 2., 0.1));
}

// Parallel pocket: exact piecewise solution, see test FilmTransport.parallel_pocket_with_jump_of_the_gap.
TEST(PrescribedFilm, ParallelPocket)
{
  const auto r
      = solve("set Model = pocket\nset Sides = no flow\nset Elements across = 1\nset Elements along = 400\n"
              "set Smallest element at jumps = 0.01\nsubsection Pocket\nset Land film = 1 um\nset Pocket film = "
              "1.4 um\nset Length = 20 mm\nset Width = 1 mm\nset Pocket start = 4 mm\nset Pocket end = 10 mm\n"
              "end\n",
              "set Sheet speed = 1000 mm/s\nset Ambient pressure = 0.1 MPa\nset Cavitation = mass conserving\n");
  EXPECT_TRUE(claims::agrees("parallel pocket with mass-conserving cavitation, load in N", "exact piecewise solution",
                             r.load, 2.45701, 1e-3 * 2.45701)); // N for 1 mm
  EXPECT_NEAR(r.max_pressure, 0.35, 0.01 * 0.35);
  EXPECT_NEAR(r.x_max, 10., 1e-4);
  EXPECT_NEAR(r.flow_in, 0.500208333, 1e-7);
  EXPECT_NEAR(r.flow_out, r.flow_in, 1e-12);
  EXPECT_LT(r.volume_error, 1e-12);
  double fraction = 0;
  for (std::size_t i = 0; i < r.nodes.size(); ++i)
    if (std::abs(r.nodes[i][0] - 7) < 0.03)
      fraction = r.fill[i];
  EXPECT_TRUE(claims::agrees("parallel pocket, film fraction in the cavity", "exact piecewise solution", fraction,
                             0.714583, 1e-5));
}

// Squeeze films (Stefan): strip of length B W = eta V B^3/h^3 per width; disc W = 3 pi eta V R^4/(2 h^3), and the time
// of fall under a load 3 pi eta R^4/(4 W) (1/h2^2 - 1/h1^2).
TEST(PrescribedFilm, SqueezeFilms)
{
  const std::string press = "set Sheet speed = 0 mm/s\nset Approach speed = 1 mm/s\n";
  const auto        strip = [&](const int n) {
    return solve("set Model = parallel\nset Sides = no flow\nset Elements across = 2\nset Elements along = "
                            + std::to_string(n)
                            + "\nsubsection Parallel\nset Film = 20 um\nset Length = 8 mm\nset Width = 1 mm\nend\n",
                        press)
               .load
           / (1e-8 * 512 / 8e-6); // eta V B^3/h^3
  };
  EXPECT_TRUE(claims::agrees("squeeze of a strip, load over eta V B^3/h^3", "Stefan", strip(64), 1., 1e-3));
  EXPECT_NEAR(std::log2((1 - strip(64)) / (1 - strip(128))), 2., 0.1);

  const auto disc = [&](const int n, const std::string &more) {
    return solve("set Model = disc\nset Elements along = " + std::to_string(n)
                     + "\nset Sides = pressure zero\nsubsection Disc\nset Film = 20 um\nset Radius = 5 mm\nend\n",
                 press + more);
  };
  const double load = 1.5 * M_PI * 1e-8 * 625 / 8e-6;
  EXPECT_NEAR(disc(60, "").load, load, 5e-3 * load);
  EXPECT_TRUE(claims::agrees("squeeze of a disc, load in N", "Stefan: 3 pi eta V R^4/(2 h^3)", disc(120, "").load, load,
                             1.3e-3 * load));
  const double time = 0.75 * M_PI * 1e-8 * 625 / 2. * (1. / 25e-6 - 1. / 400e-6); // 2 N, 20 to 5 um
  EXPECT_TRUE(claims::agrees("fall of a disc, time in s", "Stefan",
                             disc(120, "set Load = 2 N\nset Final gap = 5 um\n").fall_time, time, 1.3e-3 * time));
}

TEST(PrescribedFilm, ShippedFilesOfPublishedCases)
{
  for (const char *name : { "journal_bearing", "pocket_bearing", "squeeze_film" })
    {
      Parameters parameters = Parameters::from_file(TRIBODRAW_SOURCE_DIR "/prm/" + std::string(name) + ".prm");
      parameters.choice("Task", { "film" }, "");
      const PrescribedFilm film(parameters);
      parameters.finish();
      const auto r = film.solve();
      if (name == std::string("journal_bearing"))
        {
          EXPECT_NEAR(r.load / r.nodes.back()[1] / journal_load, 6.455556, 2e-3 * 6.455556);
          EXPECT_NEAR(r.attitude * 180 / M_PI, 58.296, 0.1);
        }
      else if (name == std::string("pocket_bearing"))
        EXPECT_NEAR(r.load / r.nodes.back()[1], 2.45701, 1e-3 * 2.45701);
      else
        EXPECT_NEAR(r.fall_time, 0.75 * M_PI * 1e-8 * 625 / 2. * (1. / 25e-6 - 1. / 400e-6), 2e-3 * r.fall_time);
    }
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
