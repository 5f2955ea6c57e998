#include "temporary_folder.h"

#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/plot.h>
#include <tribodraw/surface/height_map.h>
#include <tribodraw/surface/surface_writer.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  /// Width and height in the header of a PNG file (PNG specification: bytes 16 to 23, big endian).
  std::pair<unsigned, unsigned>
  png_size(const std::filesystem::path &file)
  {
    const std::string content = read_file(file);
    const auto        number  = [&](const std::size_t at) {
      unsigned n = 0;
      for (std::size_t i = at; i < at + 4; ++i)
        n = 256 * n + static_cast<unsigned char>(content.at(i));
      return n;
    };
    EXPECT_EQ(content.substr(1, 3), "PNG");
    return { number(16), number(20) };
  }

  void
  expect_figures(const TemporaryFolder &folder, const std::vector<std::string> &stems)
  {
    std::vector<std::filesystem::path> files;
    for (const auto &stem : stems)
      {
        files.push_back(folder / (stem + ".svg"));
        ASSERT_TRUE(std::filesystem::exists(files.back())) << stem;
        EXPECT_EQ(png_size(folder / (stem + ".png")).first, 960u); // twice the 480 points of the SVG
      }
    EXPECT_EQ(TemporaryFolder::parse_xml(files), 0);
  }
} // namespace

TEST(Plot, line_chart_with_quotes_gaps_and_logarithmic_axes)
{
  ASSERT_TRUE(plot::available()) << "the tests need gnuplot (Debian: gnuplot-nox)";
  const TemporaryFolder folder;
  plot::LineChart       chart{ "It's a \"title\" with _underscore_, $x & <tags>", "Pressure / MPa", "µ" };
  chart.logarithmic_x = true;
  chart.series        = { { "first", { 0, 1, 2, 3 }, { 1, 2, NAN, 4 }, plot::Series::Style::line_with_points },
                          { "it's", { 1, 10 }, { 1, 2 }, plot::Series::Style::dashed_line } };
  ASSERT_TRUE(plot::draw(chart, folder / "chart"));
  expect_figures(folder, { "chart" });
  // Texts are shown as they were given.
  const std::string svg = read_file(folder / "chart.svg");
  EXPECT_NE(svg.find("with _underscore_, $x &amp; &lt;tags"), std::string::npos);
}

TEST(Plot, a_chart_without_any_point_is_not_drawn)
{
  const TemporaryFolder folder;
  plot::LineChart       chart{ "", "x", "y" };
  chart.series = { { "nothing", { 1., 2. }, { NAN, NAN }, plot::Series::Style::line } };
  EXPECT_FALSE(plot::draw(chart, folder / "chart"));
  EXPECT_FALSE(std::filesystem::exists(folder / "chart.svg"));
}

TEST(Plot, map_of_a_triangle_field_gives_the_same_bytes_twice)
{
  const TemporaryFolder folder;
  const plot::PlanMesh  mesh{ { { { 0, 0 } }, { { 100, 0 } }, { { 100, 60 } }, { { 0, 60 } } },
                             { { { 0, 1, 2 } }, { { 0, 2, 3 } } } };
  plot::MapChart        chart;
  chart.title       = "Field";
  chart.value_label = "µ";
  chart.raster      = plot::rasterise_nodal(mesh, { 0, 1, NAN, 3 }, 200);
  chart.lines       = mesh.outline();
  ASSERT_TRUE(plot::draw(chart, folder / "map"));
  expect_figures(folder, { "map" });
  const std::string svg = read_file(folder / "map.svg"), png = read_file(folder / "map.png");
  ASSERT_TRUE(plot::draw(chart, folder / "map"));
  EXPECT_EQ(read_file(folder / "map.svg"), svg);
  EXPECT_EQ(read_file(folder / "map.png"), png);
}

TEST(Figures, surface_folder)
{
  const TemporaryFolder folder;
  HeightMap             map;
  map.nx = map.ny = 32;
  map.dx = map.dy = 3e-3;
  for (std::size_t i = 0; i < map.nx * map.ny; ++i)
    map.z.push_back(1e-3 * std::sin(0.2 * static_cast<double>(i)));
  write_gsf(map, folder / "surface.gsf");
  write_file(folder / "height_distribution.csv", "height_um,density_per_um\n-1,0.2\n0,0.5\n1,0.2\n");
  write_file(folder / "abbott_curve.csv", "material_ratio,height_um\n0,1\n0.5,0\n1,-1\n");
  write_file(folder / "surface.csv", "parameter,value,unit\nSq,0.7,um\nSk,1.2,um\nSmr1,5,%\n");
  write_file(folder / "closed_voids.csv",
             "contact_fraction,height_um,void_volume_um,closed_void_volume_um,closed_void_area_fraction\n"
             "0.2,0.6,0.7,0,0\n0.8,-0.6,0.05,0.04,0.1\n");
  figures::draw_all(folder.path());
  expect_figures(folder, { "surface_map", "height_distribution", "abbott_curve", "closed_voids" });
}

TEST(Figures, flow_factors_and_friction_table_with_the_columns_of_the_files)
{
  const TemporaryFolder folder;
  write_file(
      folder / "flow_factors.csv",
      "cut_height_um,h_avg_um,h_avg_over_sq,contact_fraction,phi_p_xx,phi_p_xy,phi_p_yx,phi_p_yy,phi_s_xx,phi_s_xy,"
      "phi_s_yx,phi_s_yy,residual\n3,5,3,0,0.9,0,0,0.8,0.1,0,0,0.1,1e-9\n1,2,1,0.2,0.3,0,0,0.2,0.4,0,0,0.4,1e-9\n");
  write_file(
      folder / "friction_table.csv",
      "p_solid_mpa,eps_p,cut_height_um,contact_fraction,h_avg_um,tau_solid_mpa,mu_boundary,phi_p_xx,phi_p_yy,phi_s_xx,"
      "phi_s_yy\n1,0,3,0.01,2,0.1,0.1,1,1,0,0\n10,0,2,0.1,1,1,0.1,1,1,0,0\n1,0.1,3,0.02,2,0.1,0.1,1,1,0,0\n"
      "10,0.1,2,0.3,1,1.2,0.12,1,1,0,0\n");
  figures::draw_all(folder.path());
  expect_figures(folder, { "phi_p", "phi_s", "table_contact_fraction", "table_film_thickness", "table_solid_shear",
                           "table_friction_coefficient", "table_phi_p", "table_phi_s" });
}

TEST(Figures, strip_draw_folder)
{
  const TemporaryFolder folder;
  write_file(folder / "strip_profile.csv",
             "x_mm,gap_um,solid_pressure_mpa,lubricant_pressure_mpa,film_fraction,contact_fraction\n"
             "-0.1,4,0,0,0.5,0\n0,2,5,1,1,0.1\n10,2,6,0,1,0.1\n");
  for (const char *name : { "pressure", "speed", "strain", "amount", "viscosity" })
    write_file(folder / ("sweep_" + std::string(name) + ".csv"),
               "pressure_mpa,speed_mm_per_s,eps_p,amount_g_per_m2,viscosity_mpa_s,mu,solid_friction,lubricant_share,"
               "mu_lowest,mu_highest\n1,1,0,1,10,0.1,0.1,0.01,0.09,0.11\n2,10,0.1,2,30,0.08,0.08,0.2,0.07,0.1\n");
  figures::draw_all(folder.path());
  expect_figures(folder, { "strip_pressure", "strip_gap", "sweep_pressure", "sweep_speed", "sweep_strain",
                           "sweep_amount", "sweep_viscosity" });
}

TEST(Figures, forming_folder)
{
  const TemporaryFolder folder;
  write_file(folder / "history.csv",
             "time_s,punch_travel_mm,punch_force_n,blank_holder_force_n,draw_in_x_mm,draw_in_y_mm,draw_in_diagonal_mm,"
             "mean_mu_die,mean_mu_punch\n0,0,0,100000,0,0,0,nan,nan\n1,10,50000,100000,1,1.1,0.5,0.1,0.12\n");
  write_file(
      folder / "nodes_final.csv",
      "node,x_mm,y_mm,z_mm,x0_mm,y0_mm,friction_coefficient_die,lubricant_pressure_die_mpa,contact_pressure_die_mpa\n"
      "0,0,0,0,0,0,0.1,1,2\n1,9,0,-1,10,0,nan,nan,nan\n2,9,9,-1,10,10,0.2,2,3\n3,0,9,-1,0,10,0.15,0,1\n");
  write_file(folder / "elements_final.csv", "element,n1,n2,n3,major_strain,minor_strain,thickness_mm,eps_p,flc_margin\n"
                                            "0,0,1,2,0.1,-0.05,0.8,0.1,0.2\n1,0,2,3,0.12,-0.02,0.79,0.12,0.15\n");
  write_file(folder / "flc.csv", "minor_strain,major_strain\n-0.2,0.5\n0,0.3\n0.2,0.4\n");
  figures::draw_all(folder.path());
  expect_figures(folder, { "force_travel", "draw_in", "mean_friction", "fld", "friction_coefficient_die",
                           "friction_coefficient_die_blank", "lubricant_pressure_die", "lubricant_pressure_die_blank",
                           "contact_pressure_die_blank", "thickness", "thickness_blank", "outline" });
  // No such column in the files, so no such figure.
  EXPECT_FALSE(std::filesystem::exists(folder / "friction_coefficient_punch.svg"));
}

TEST(Figures, a_linear_field_along_a_cut)
{
  // 1 + x + 2 y on a grid of 3 x 3 points from -1 to 1, cut at 30 degrees and along a line of the mesh.
  plot::PlanMesh      mesh;
  std::vector<double> values;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      {
        mesh.points.push_back({ double(i), double(j) });
        values.push_back(1 + i + 2 * j);
      }
  for (unsigned j = 0; j < 2; ++j)
    for (unsigned i = 0; i < 2; ++i)
      {
        const unsigned a = 3 * j + i;
        mesh.triangles.push_back({ a, a + 1, a + 4 });
        mesh.triangles.push_back({ a, a + 4, a + 3 });
      }
  for (const double angle : { M_PI / 6, 0., M_PI / 4 })
    {
      const double c = std::cos(angle), s = std::sin(angle);
      const auto   line = figures::values_along(mesh, values, { c, s });
      ASSERT_GE(line.x.size(), 3u);
      EXPECT_NEAR(line.x.front(), -1 / c, 1e-12); // the border of the square
      EXPECT_NEAR(line.x.back(), 1 / c, 1e-12);
      for (std::size_t k = 0; k < line.x.size(); ++k)
        EXPECT_NEAR(line.y[k], 1 + line.x[k] * (c + 2 * s), 1e-12);
    }
}

TEST(Figures, a_triangle_with_an_unknown_node_is_named)
{
  const TemporaryFolder folder;
  write_file(folder / "nodes_final.csv", "node,x_mm,y_mm\n0,0,0\n1,1,0\n2,1,1\n");
  write_file(folder / "elements_final.csv", "element,n1,n2,n3,thickness_mm\n0,0,1,3,1\n");
  try
    {
      figures::draw_maps(folder.path());
      FAIL() << "no error";
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("n3"), std::string::npos) << error.what();
    }
}
