#include "temporary_folder.h"

#include <tribodraw/base/files.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/report.h>

#include <gtest/gtest.h>

#include <regex>
#include <set>

using namespace tribodraw;

namespace
{
  std::string
  make_report(const TemporaryFolder &folder)
  {
    write_file(
        folder / "history.csv",
        "time_s,punch_travel_mm,punch_force_n,min_thickness_mm\n0,0,0,0.82\n1,10,51234.5,0.8\n2,20,42000,0.7512\n");
    write_file(folder / "effective.prm",
               "set Task = forming # <not a tag> & more\nsubsection Blank\n  set Thickness = 0.8 mm\n"
               "  subsection Edges\n    set Outer edge = free\n  end\nend\n");
    write_file(folder / "results.csv",
               "quantity,value,unit\nconverged,1,\nlargest_penetration,0.04,mm\nenergy_error,-0.002,\n"
               "necked_at_x,12.5,mm\nnecked_at_y,3,mm\n");
    write_file(folder / "run_info.txt", "tribodraw 0.1.0\n");
    write_file(folder / "log.txt", "Step 1\nWarning: the mesh is <coarse>\nStep 2\n");
    write_file(folder / "citations.txt", "Shisode et al. 2021\n");
    figures::draw_history(folder.path());
    write_report(folder.path());
    return read_file(folder / "report.html");
  }
} // namespace

TEST(Report, is_well_formed_and_self_contained)
{
  const TemporaryFolder folder;
  const std::string     html = make_report(folder);
  EXPECT_EQ(TemporaryFolder::parse_xml({ folder / "report.html" }), 0);
  // Nothing is loaded: no script, no link, no image that is not inside the page.
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  EXPECT_FALSE(std::regex_search(html, std::regex("(src|href)=['\"](?!#|data:)")));
  EXPECT_NE(html.find("prefers-color-scheme:dark"), std::string::npos);
  EXPECT_NE(html.find("@media print"), std::string::npos);
}

TEST(Report, shows_figures_key_figures_warnings_and_inputs)
{
  const TemporaryFolder folder;
  const std::string     html = make_report(folder);
  EXPECT_NE(html.find("<figure id=\"force_travel\"><svg"), std::string::npos);
  EXPECT_NE(html.find("<b>51.23 <span>kN</span>"), std::string::npos);  // greatest punch force of history.csv, in kN with four digits
  EXPECT_NE(html.find("<b>0.7512 <span>mm</span>"), std::string::npos); // thickness in the last row
  EXPECT_NE(html.find("<li>the mesh is &lt;coarse&gt;</li>"), std::string::npos);
  EXPECT_NE(html.find("&lt;not a tag&gt; &amp; more"), std::string::npos);
  EXPECT_NE(html.find("Shisode et al. 2021"), std::string::npos);
  EXPECT_NE(html.find("<td>Thickness</td><td>0.8 mm</td>"), std::string::npos);
  EXPECT_NE(html.find("<th colspan=\"2\">Edges</th>"), std::string::npos);
  EXPECT_NE(html.find("<b>12.5, 3 <span>mm</span></b>Necked at x, y"), std::string::npos);
}

TEST(Report, says_what_is_conserved_and_what_is_above_the_usual)
{
  const TemporaryFolder folder;
  const std::string     html   = make_report(folder);
  const auto            row_of = [&](const char *text) {
    return html.substr(html.find(text), html.find("</tr>", html.find(text)) - html.find(text));
  };
  EXPECT_NE(row_of("Energy:").find("-0.002"), std::string::npos);
  EXPECT_NE(row_of("Energy:").find("✓"), std::string::npos);
  // 0.04 mm of 0.8 mm: 5 %, above 3 %
  EXPECT_NE(row_of("Largest penetration").find("0.05"), std::string::npos);
  EXPECT_NE(row_of("Largest penetration").find("above what is usual"), std::string::npos);
}

TEST(Report, shows_measured_curves_and_surfaces)
{
  const TemporaryFolder folder;
  write_file(folder / "compare.csv", "quantity,over,points,from,to,rms,relative_rms,mean,largest,largest_at,measured_"
                                     "peak,computed_peak,measured_area,computed_area\n"
                                     "punch_force_n,punch_travel_mm,5,1,10,1200,0.0125,-300,2000,8,96000,95000,1,1\n");
  write_file(folder / "surfaces.csv",
             "surface,description,sa_um,sq_um\nsheet,measured; form removed,1.25,1.61\nDie,ideally smooth,nan,nan\n");
  write_report(folder.path());
  const std::string html = read_file(folder / "report.html");
  EXPECT_EQ(TemporaryFolder::parse_xml({ folder / "report.html" }), 0);
  EXPECT_NE(html.find("Punch force / N"), std::string::npos);
  EXPECT_NE(html.find(">1.25 %<"), std::string::npos); // rms over the measured peak
  EXPECT_NE(html.find("2000 at 8"), std::string::npos);
  EXPECT_NE(html.find("measured; form removed</td><td class=\"number\">1.25<"), std::string::npos);
  EXPECT_NE(html.find("ideally smooth</td><td class=\"number\"><"), std::string::npos); // no value, no number
}

TEST(Report, ids_are_unique_although_figures_share_theirs)
{
  const TemporaryFolder folder;
  write_file(folder / "flow_factors.csv",
             "h_avg_over_sq,phi_p_xx,phi_p_xy,phi_p_yx,phi_p_yy,phi_s_xx,phi_s_xy,phi_s_yx,phi_s_yy\n"
             "1,1,0,0,1,0,0,0,0\n2,1,0,0,1,0.1,0,0,0.1\n");
  figures::draw_flow_factors(folder.path());
  write_report(folder.path());
  const std::string     html = read_file(folder / "report.html");
  const std::regex      id("\\sid=['\"]([^'\"]*)");
  std::set<std::string> seen;
  for (std::sregex_iterator it(html.begin(), html.end(), id), end; it != end; ++it)
    EXPECT_TRUE(seen.insert((*it)[1]).second) << (*it)[1];
  EXPECT_GT(seen.size(), 10u); // gnuplot's symbols of both figures
}

TEST(Report, shows_the_scatter_of_a_friction_table)
{
  const TemporaryFolder folder;
  std::string           head = "p_solid_mpa,eps_p";
  for (const std::string quantity : { "contact_fraction", "h_avg_um", "mu_boundary" })
    for (const char *end : { "_mean", "_sd", "_min", "_max" })
      head += "," + quantity + end;
  write_file(folder / "scatter.csv", head
                                         + "\n1,0,0.1,0.01,0.09,0.11,2,0.2,1.8,2.2,0.1,0.01,0.09,0.11\n"
                                           "10,0,0.3,0.01,0.29,0.31,1,0.2,0.8,1.2,0.12,0.01,0.11,0.13\n"
                                           "1,0.2,0.2,0.01,0.19,0.21,2,0.2,1.8,2.2,0.1,0.01,0.09,0.11\n"
                                           "10,0.2,0.5,0.01,0.49,0.51,1,0.2,0.8,1.2,0.12,0.01,0.11,0.13\n");
  figures::draw_all(folder.path());
  write_report(folder.path());
  EXPECT_EQ(TemporaryFolder::parse_xml({ folder / "report.html" }), 0);
  const std::string html = read_file(folder / "report.html");
  for (const std::string stem :
       { "scatter_contact_fraction", "scatter_film_thickness", "scatter_friction_coefficient" })
    EXPECT_NE(html.find("<figure id=\"" + stem + "\"><svg"), std::string::npos) << stem;
  EXPECT_NE(html.find("<h3>Friction table</h3>"), std::string::npos);
  EXPECT_EQ(html.find("<h3>More</h3>"), std::string::npos); // each has its caption
  for (const char *label : { "strain 0: mean", "strain 0.2: least and greatest" })
    EXPECT_NE(html.find(label), std::string::npos) << label;
}

TEST(Report, an_empty_folder_gives_a_page)
{
  const TemporaryFolder folder;
  write_report(folder.path());
  EXPECT_EQ(TemporaryFolder::parse_xml({ folder / "report.html" }), 0);
}
