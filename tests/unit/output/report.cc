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
    write_file(folder / "effective.prm", "set Task = forming # <not a tag> & more\n");
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
  EXPECT_NE(html.find(">51.23<"), std::string::npos);  // greatest punch force of history.csv, in kN with four digits
  EXPECT_NE(html.find(">0.7512<"), std::string::npos); // thickness in the last row
  EXPECT_NE(html.find("<li>the mesh is &lt;coarse&gt;</li>"), std::string::npos);
  EXPECT_NE(html.find("&lt;not a tag&gt; &amp; more"), std::string::npos);
  EXPECT_NE(html.find("Shisode et al. 2021"), std::string::npos);
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

TEST(Report, an_empty_folder_gives_a_page)
{
  const TemporaryFolder folder;
  write_report(folder.path());
  EXPECT_EQ(TemporaryFolder::parse_xml({ folder / "report.html" }), 0);
}
