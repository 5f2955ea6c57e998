#include <tribodraw/base/csv.h>
#include <tribodraw/base/files.h>
#include <tribodraw/output/report.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

namespace tribodraw
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr const char *style = R"(
:root{color-scheme:light dark;--page:#fff;--text:#1b1f24;--soft:#59636e;--line:#d1d9e0;--card:#f6f8fa;--accent:#0b6ea8;--warn:#9a6700}
@media(prefers-color-scheme:dark){:root{--page:#12161b;--text:#e6edf3;--soft:#9aa4ae;--line:#343b44;--card:#1a2027;--accent:#58b0e6;--warn:#d4a72c}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:70rem;padding:1.5rem;background:var(--page);color:var(--text);font:16px/1.5 system-ui,Helvetica,Arial,sans-serif;overflow-wrap:break-word}
h1{margin:0 0 .25rem;font-size:1.8rem}h2{margin:2rem 0 .75rem;font-size:1.25rem;border-bottom:1px solid var(--line);padding-bottom:.25rem}
.sub{color:var(--soft);margin:0}
table{border-collapse:collapse;width:100%}td,th{padding:.3rem .75rem .3rem 0;border-bottom:1px solid var(--line);text-align:left;vertical-align:top}
td.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.scroll{overflow-x:auto}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,30rem),1fr));gap:1rem}
figure{margin:0;padding:.75rem;background:var(--card);border:1px solid var(--line);border-radius:.5rem;break-inside:avoid}
figure svg{width:100%;height:auto;color:var(--text)}figcaption{color:var(--soft);font-size:.9rem}
pre{margin:0;padding:.75rem;background:var(--card);border:1px solid var(--line);border-radius:.5rem;overflow-x:auto;font:13px/1.45 ui-monospace,monospace}
.warnings li{color:var(--warn)}
a{color:var(--accent)}
@media print{body{max-width:none;padding:0;font-size:11pt}figure,pre{background:none}pre{white-space:pre-wrap;font-size:8pt}.figures{grid-template-columns:1fr 1fr}}
)";

    std::string
    escape(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        switch (c)
          {
          case '<':
            result += "&lt;";
            break;
          case '>':
            result += "&gt;";
            break;
          case '&':
            result += "&amp;";
            break;
          case '"':
            result += "&quot;";
            break;
          default:
            result += c;
          }
      return result;
    }

    std::string
    read_if_present(const fs::path &file)
    {
      return fs::exists(file) ? read_file(file) : std::string();
    }

    /// Four significant digits: what one reads, not what one computes with.
    std::string
    readable(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", value);
      return text;
    }

    std::string
    readable(const std::string &text)
    {
      char        *after = nullptr;
      const double value = std::strtod(text.c_str(), &after);
      return after != text.c_str() && *after == '\0' ? readable(value) : text;
    }

    struct Figure
    {
      const char *stem, *caption;
    };

    /// Known figures in the order of the page. Others follow under their file name.
    constexpr std::array known_figures{
      Figure{ "force_travel", "Force of punch and blank holder over punch travel, of the full part." },
      Figure{ "draw_in", "Draw-in of the blank's edge along the axes and the diagonal." },
      Figure{ "outline", "Outline of the drawn part from above, and of the blank (dashed)." },
      Figure{ "thickness_cuts", "Thickness along cuts through the part, over the distance on the undeformed blank." },
      Figure{ "mean_friction", "Friction coefficient, mean over the contact area." },
      Figure{ "peak_lubricant_pressure", "Greatest lubricant pressure in the contact." },
      Figure{ "fld", "Strains of all elements in the final state and the forming limit curve, if one was given." },
      Figure{ "friction_coefficient_die_blank", "Friction coefficient on the die side. Grey: not in contact." },
      Figure{ "friction_coefficient_punch_blank", "Friction coefficient on the punch side. Grey: not in contact." },
      Figure{ "lubricant_pressure_die_blank", "Lubricant pressure on the die side. Grey: not in contact." },
      Figure{ "lubricant_pressure_punch_blank", "Lubricant pressure on the punch side. Grey: not in contact." },
      Figure{ "lubrication_regime_die_blank",
              "Lubrication regime on the die side: 1 boundary, 2 mixed, 3 full film. Grey: not in contact." },
      Figure{ "lubrication_regime_punch_blank",
              "Lubrication regime on the punch side: 1 boundary, 2 mixed, 3 full film. Grey: not in contact." },
      Figure{ "friction_coefficient_die", "Friction coefficient on the die side, deformed sheet from above." },
      Figure{ "friction_coefficient_punch", "Friction coefficient on the punch side, deformed sheet from above." },
      Figure{ "lubricant_pressure_die", "Lubricant pressure on the die side, deformed sheet from above." },
      Figure{ "lubricant_pressure_punch", "Lubricant pressure on the punch side, deformed sheet from above." },
      Figure{ "phi_p_die_blank", "Pressure flow factor on the die side, half the trace of the tensor: what the "
                                 "asperities leave of the flow." },
      Figure{ "phi_s_die_blank", "Shear flow factor on the die side, half the trace of the tensor." },
      Figure{ "contact_fraction_die_blank", "Real contact area on the die side." },
      Figure{ "major_strain_blank", "Major logarithmic strain of the middle surface, on the undeformed blank." },
      Figure{ "minor_strain_blank", "Minor logarithmic strain of the middle surface, on the undeformed blank." },
      Figure{ "thickness_blank", "Thickness of the drawn sheet, shown on the undeformed blank." },
      Figure{ "thickness", "Thickness of the drawn sheet from above." },
      Figure{ "lubricant_pressure", "Lubricant pressure." },
      Figure{ "surface_map", "Heights of the surface after processing; colours without the outermost thousandths." },
      Figure{ "height_distribution", "Distribution of the heights." },
      Figure{ "abbott_curve", "Abbott curve: the area above each height; the line bounds the core (Sk)." },
      Figure{ "closed_voids", "Volume of all and of closed voids under a flat surface over the contact area." },
      Figure{ "phi_p", "Pressure flow factors over the mean gap." },
      Figure{ "phi_s", "Shear flow factors over the mean gap." },
      Figure{ "table_contact_fraction", "Real contact fraction over solid pressure." },
      Figure{ "table_film_thickness", "Mean film thickness in the gap over solid pressure." },
      Figure{ "table_solid_shear", "Shear stress of the solid contacts over solid pressure." },
      Figure{ "table_friction_coefficient", "Friction coefficient of the boundary regime over solid pressure." },
      Figure{ "table_phi_p", "Pressure flow factor of the flattened surface over solid pressure." },
      Figure{ "table_phi_s", "Shear flow factor of the flattened surface over solid pressure." },
      Figure{ "sweep_speed",
              "Stribeck curve: friction, the asperities' part of it and the share of the load on the lubricant." },
      Figure{ "sweep_pressure", "Friction over the nominal pressure." },
      Figure{ "sweep_strain", "Friction over the plastic strain of the strip." },
      Figure{ "sweep_amount", "Friction over the amount of lubricant." },
      Figure{ "sweep_viscosity", "Friction over the viscosity." },
      Figure{ "strip_pressure", "Pressures along the contact; the strip moves along x." },
      Figure{ "strip_gap", "Mean gap and lubricant in it along the contact." }
    };

    /// The SVG element of a file, made fit for a page with others: its ids are unique and black follows the text
    /// colour.
    std::string
    inline_svg(const std::string &svg, const std::string &stem)
    {
      const auto begin = svg.find("<svg");
      if (begin == std::string::npos)
        return {};
      std::string       text   = svg.substr(begin);
      const std::string prefix = stem + "-";
      text                     = std::regex_replace(text, std::regex("(\\sid=['\"])"), "$1" + prefix);
      text                     = std::regex_replace(text, std::regex("(href=['\"]#)"), "$1" + prefix);
      text                     = std::regex_replace(text, std::regex("(url\\(#)"), "$1" + prefix);
      text = std::regex_replace(text, std::regex("(stroke|fill|color)=(['\"])black\\2"), "$1=$2currentColor$2");
      // Titles would show as tool tips with gnuplot's internal names.
      return std::regex_replace(text, std::regex("<title>[^<]*</title>"), "");
    }

    std::string
    figure(const fs::path &file, const std::string &caption)
    {
      const std::string stem = file.stem().string();
      return "<figure id=\"" + escape(stem) + "\">" + inline_svg(read_file(file), stem) + "<figcaption>"
             + escape(caption) + "</figcaption></figure>\n";
    }

    std::string
    figures(const fs::path &folder)
    {
      std::string           html;
      std::vector<fs::path> rest;
      for (const auto &entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".svg")
          rest.push_back(entry.path());
      std::sort(rest.begin(), rest.end());
      for (const Figure &known : known_figures)
        if (const auto at = std::find(rest.begin(), rest.end(), folder / (std::string(known.stem) + ".svg"));
            at != rest.end())
          {
            html += figure(*at, known.caption);
            rest.erase(at);
          }
      for (const auto &file : rest)
        {
          std::string caption = file.stem().string();
          std::replace(caption.begin(), caption.end(), '_', ' ');
          html += figure(file, caption);
        }
      return html.empty() ? "" : "<h2>Figures</h2>\n<div class=\"figures\">\n" + html + "</div>\n";
    }

    std::string
    row(const std::string &quantity, const std::string &value, const std::string &unit)
    {
      return "<tr><td>" + escape(quantity) + "</td><td class=\"number\">" + escape(value) + "</td><td>"
             + escape(unit == "1" ? "" : unit) + "</td></tr>\n";
    }

    /// A name of a file's column as one reads it: `draw_in_x` -> "Draw in x".
    std::string
    spoken(std::string name)
    {
      std::replace(name.begin(), name.end(), '_', ' ');
      if (!name.empty())
        name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
      return name;
    }

    /// Rows of a file `quantity,value,unit` (surface.csv, results.csv) but those that stand on the page already.
    std::string
    rows_of_list(const fs::path &file, const std::set<std::string> &shown = {})
    {
      std::string html;
      if (!fs::exists(file))
        return html;
      for (const auto &cells : read_csv(file).rows)
        if (cells.size() >= 3 && shown.count(cells[0]) == 0)
          html += row(spoken(cells[0]), readable(cells[1]), cells[2]);
      return html;
    }

    double
    largest(const std::vector<double> &values)
    {
      double result = -INFINITY;
      for (const double v : values)
        if (std::isfinite(v))
          result = std::max(result, v);
      return result;
    }

    std::string
    rows_of_history(const fs::path &file)
    {
      std::string html;
      if (!fs::exists(file))
        return html;
      const CsvData history = read_csv(file);
      if (history.rows.empty())
        return html;
      const auto last = [&](const char *column, const char *quantity, const char *unit, const double factor = 1) {
        if (history.has(column))
          html += row(quantity, readable(factor * history.numbers(column).back()), unit);
      };
      const auto greatest = [&](const char *column, const char *quantity, const char *unit, const double factor = 1) {
        if (history.has(column) && std::isfinite(largest(history.numbers(column))))
          html += row(quantity, readable(factor * largest(history.numbers(column))), unit);
      };
      last("punch_travel_mm", "Punch travel reached", "mm");
      greatest("punch_force_n", "Greatest punch force", "kN", 1e-3);
      last("draw_in_x_mm", "Draw-in in rolling direction", "mm");
      last("draw_in_y_mm", "Draw-in across the rolling direction", "mm");
      last("draw_in_diagonal_mm", "Draw-in along the diagonal", "mm");
      last("min_thickness_mm", "Least thickness", "mm");
      last("max_eps_p", "Greatest equivalent plastic strain", "");
      greatest("max_lubricant_pressure_die_mpa", "Greatest lubricant pressure, die side", "MPa");
      greatest("max_lubricant_pressure_punch_mpa", "Greatest lubricant pressure, punch side", "MPa");
      last("mean_mu_die", "Mean friction coefficient at the end, die side", "");
      last("mean_mu_punch", "Mean friction coefficient at the end, punch side", "");
      last("starved_area_fraction", "Starved share of the contact area at the end", "");
      greatest("lubricant_volume_error", "Greatest error of the lubricant volume", "");
      html += row("Steps", std::to_string(history.rows.size()), "");
      return html;
    }

    /// Least and greatest value of a few columns of a table.
    std::string
    rows_of_ranges(const fs::path &file, const std::vector<std::array<const char *, 3>> &columns)
    {
      std::string html;
      if (!fs::exists(file))
        return html;
      const CsvData data = read_csv(file);
      for (const auto &[column, quantity, unit] : columns)
        if (data.has(column))
          {
            std::vector<double> values;
            for (const double v : data.numbers(column))
              if (std::isfinite(v))
                values.push_back(v);
            if (values.empty())
              continue;
            const auto [low, high] = std::minmax_element(values.begin(), values.end());
            html += row(quantity, readable(*low) + " to " + readable(*high), unit);
          }
      return html;
    }

    std::string
    key_figures(const fs::path &folder)
    {
      const std::set<std::string> shown_from_history = fs::exists(folder / "history.csv")
                                                           ? std::set<std::string>{ "punch_travel",
                                                                                    "largest_punch_force",
                                                                                    "draw_in_x",
                                                                                    "draw_in_y",
                                                                                    "draw_in_diagonal",
                                                                                    "least_thickness_of_an_element",
                                                                                    "largest_plastic_strain" }
                                                           : std::set<std::string>{};
      const std::string           rows
          = rows_of_history(folder / "history.csv") + rows_of_list(folder / "results.csv", shown_from_history)
            + rows_of_list(folder / "surface.csv")
            + rows_of_ranges(folder / "flow_factors.csv", { { "h_avg_over_sq", "Mean gap / Sq", "" },
                                                            { "contact_fraction", "Real contact fraction", "" },
                                                            { "phi_p_xx", "Pressure flow factor xx", "" },
                                                            { "phi_p_yy", "Pressure flow factor yy", "" },
                                                            { "phi_s_xx", "Shear flow factor xx", "" },
                                                            { "phi_s_yy", "Shear flow factor yy", "" } })
            + rows_of_ranges(folder / "friction_table.csv",
                             { { "p_solid_mpa", "Table: solid pressure", "MPa" },
                               { "eps_p", "Table: plastic strain", "" },
                               { "contact_fraction", "Table: real contact fraction", "" },
                               { "h_avg_um", "Table: mean film thickness", "µm" },
                               { "tau_solid_mpa", "Table: shear stress of the solid contacts", "MPa" },
                               { "mu_boundary", "Table: boundary friction coefficient", "" } });
      return rows.empty()
                 ? ""
                 : "<h2>Key figures</h2>\n<div class=\"scroll\"><table><thead><tr><th>Quantity</th><th>Value</th>"
                   "<th>Unit</th></tr></thead><tbody>\n"
                       + rows + "</tbody></table></div>\n";
    }

    std::string
    warnings(const fs::path &folder)
    {
      std::istringstream log(read_if_present(folder / "log.txt"));
      std::string        items;
      for (std::string line; std::getline(log, line);)
        if (line.rfind("Warning: ", 0) == 0)
          items += "<li>" + escape(line.substr(9)) + "</li>\n";
      return "<h2>Warnings</h2>\n"
             + (items.empty() ? "<p>None.</p>\n" : "<ul class=\"warnings\">\n" + items + "</ul>\n");
    }

    std::string
    text_section(const std::string &title, const fs::path &file)
    {
      const std::string text = read_if_present(file);
      return text.empty() ? "" : "<h2>" + title + "</h2>\n<pre>" + escape(text) + "</pre>\n";
    }
  } // namespace

  void
  write_report(const std::filesystem::path &folder)
  {
    const std::string name = fs::weakly_canonical(folder).filename().string();
    write_file(
        folder / "report.html",
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>"
            + escape(name) + " – tribodraw</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" + escape(name)
            + "</h1>\n<p class=\"sub\">Report of a tribodraw run: friction in lubricated sheet-metal forming.</p>\n"
            + key_figures(folder) + warnings(folder) + figures(folder)
            + text_section("Parameters in effect", folder / "effective.prm")
            + text_section("Versions and provenance", folder / "run_info.txt")
            + text_section("How to cite", folder / "citations.txt") + "</body>\n</html>\n");
  }
} // namespace tribodraw
