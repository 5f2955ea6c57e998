#include <tribodraw/base/files.h>

#include "report_parts.h"

#include <algorithm>
#include <regex>
#include <vector>

namespace tribodraw::report
{
  namespace
  {
    namespace fs = std::filesystem;

    struct Figure
    {
      const char *stem, *caption;
    };
    struct Group
    {
      const char         *title;
      std::vector<Figure> figures;
    };

    /// Known figures in the order of the page. Others follow under their file name.
    const std::vector<Group> &
    known_groups()
    {
      static const std::vector<Group> groups{
        { "Force and draw-in",
          { { "force_travel", "Force of punch and blank holder over punch travel, of the full part." },
            { "draw_in", "Draw-in of the blank's edge along the axes and the diagonal." },
            { "outline", "Outline of the drawn part from above, and of the blank (dashed)." },
            { "load_displacement",
              "Load factor over displacement, with published points where the case has them." } } },
        { "Sheet",
          { { "fld", "Strains of all elements in the final state, and the forming limit curve." },
            { "thinning_cuts", "Thinning along cuts through the part, over the distance on the undeformed blank." },
            { "thickness", "Thickness of the drawn sheet from above." },
            { "thickness_blank", "Thickness of the drawn sheet, shown on the undeformed blank." },
            { "flc_margin_blank", "Major strain over its forming limit; at 1 the sheet necks." },
            { "major_strain_blank", "Major logarithmic strain of the middle surface, on the undeformed blank." },
            { "minor_strain_blank", "Minor logarithmic strain of the middle surface, on the undeformed blank." },
            { "eps_p_blank", "Equivalent plastic strain, mean through the thickness, on the undeformed blank." } } },
        { "Friction and lubrication",
          { { "mean_friction", "Friction coefficient, mean over the contact area." },
            { "peak_lubricant_pressure", "Greatest lubricant pressure in the contact." },
            { "lubricant_pressure", "Lubricant pressure." },
            { "film_thickness", "Film thickness." },
            { "film_fraction", "Share of the gap that is filled with lubricant." } } },
        { "Die side, on the undeformed blank",
          { { "friction_coefficient_die_blank", "Friction coefficient. Grey: not in contact." },
            { "lubricant_pressure_die_blank", "Lubricant pressure. Grey: not in contact." },
            { "contact_pressure_die_blank", "Nominal contact pressure." },
            { "lubrication_regime_die_blank", "Lubrication regime. Grey: not in contact." },
            { "film_thickness_die_blank", "Mean gap between the surfaces. Grey: not in contact." },
            { "contact_fraction_die_blank", "Real contact area, share of the nominal one." },
            { "phi_p_die_blank", "Pressure flow factor, half the trace: what the asperities leave of the flow." },
            { "phi_s_die_blank", "Shear flow factor, half the trace of the tensor." } } },
        { "Punch side, on the undeformed blank",
          { { "friction_coefficient_punch_blank", "Friction coefficient. Grey: not in contact." },
            { "lubricant_pressure_punch_blank", "Lubricant pressure. Grey: not in contact." },
            { "contact_pressure_punch_blank", "Nominal contact pressure." },
            { "lubrication_regime_punch_blank", "Lubrication regime. Grey: not in contact." },
            { "film_thickness_punch_blank", "Mean gap between the surfaces. Grey: not in contact." } } },
        { "Both faces on the deformed sheet",
          { { "friction_coefficient_die", "Friction coefficient on the die side, from above." },
            { "friction_coefficient_punch", "Friction coefficient on the punch side, from above." },
            { "lubricant_pressure_die", "Lubricant pressure on the die side, from above." },
            { "lubricant_pressure_punch", "Lubricant pressure on the punch side, from above." } } },
        { "Virtual tribometer",
          { { "sweep_speed", "Stribeck curve: friction and the asperities' part of it." },
            { "sweep_speed_share", "Share of the load that the lubricant carries, over the speed." },
            { "sweep_pressure", "Friction over the nominal pressure." },
            { "sweep_pressure_share", "Share of the load that the lubricant carries, over the pressure." },
            { "sweep_strain", "Friction over the plastic strain of the strip." },
            { "sweep_strain_share", "Share of the load that the lubricant carries, over the strain." },
            { "sweep_amount", "Friction over the amount of lubricant." },
            { "sweep_amount_share", "Share of the load that the lubricant carries, over the amount of lubricant." },
            { "sweep_viscosity", "Friction over the viscosity." },
            { "sweep_viscosity_share", "Share of the load that the lubricant carries, over the viscosity." },
            { "strip_pressure", "Pressures along the contact; the strip moves along x." },
            { "strip_gap", "Mean gap and lubricant in it along the contact." } } },
        { "Surface",
          { { "surface_map", "Heights of the surface after processing; colours without the outermost thousandths." },
            { "sheet_surface_map", "A section of the sheet's surface; colours without the outermost thousandths." },
            { "tool_surface_map", "A section of the tool's surface; colours without the outermost thousandths." },
            { "height_distribution", "Distribution of the heights." },
            { "abbott_curve", "Abbott curve: the area above each height; the line bounds the core (Sk)." },
            { "closed_voids", "Volume of all and of closed voids under a flat surface over the contact area." } } },
        { "Flow factors",
          { { "phi_p", "Pressure flow factors over the mean gap." },
            { "phi_s", "Shear flow factors over the mean gap." } } },
        { "Friction table",
          { { "table_contact_fraction", "Real contact fraction over solid pressure." },
            { "table_film_thickness", "Mean film thickness in the gap over solid pressure." },
            { "table_solid_shear", "Shear stress of the solid contacts over solid pressure." },
            { "table_friction_coefficient", "Friction coefficient of the boundary regime over solid pressure." },
            { "table_phi_p", "Pressure flow factor of the flattened surface over solid pressure." },
            { "table_phi_s", "Shear flow factor of the flattened surface over solid pressure." },
            { "scatter_contact_fraction",
              "Scatter between the maps of the sheet: real contact fraction at the least and the greatest strain." },
            { "scatter_film_thickness", "Scatter between the maps of the sheet: mean film thickness in the gap." },
            { "scatter_friction_coefficient",
              "Scatter between the maps of the sheet: friction coefficient of the boundary regime." } } },
      };
      return groups;
    }
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

    /// The figures of @p group that are there, which are taken off @p files.
    std::string
    group_of_figures(const fs::path &folder, const Group &group, std::vector<fs::path> &files)
    {
      std::string html;
      for (const Figure &known : group.figures)
        if (const auto at = std::find(files.begin(), files.end(), folder / (std::string(known.stem) + ".svg"));
            at != files.end())
          {
            html += figure(*at, known.caption);
            files.erase(at);
          }
      return html.empty() ? "" : "<h3>" + escape(group.title) + "</h3>\n<div class=\"figures\">\n" + html + "</div>\n";
    }
  } // namespace

  std::string
  figures(const fs::path &folder)
  {
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".svg" && entry.path().stem().string().rfind("compare_", 0) != 0)
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::string html;
    for (const Group &group : known_groups())
      html += group_of_figures(folder, group, files);
    std::string rest;
    for (const auto &file : files)
      {
        std::string caption = file.stem().string();
        std::replace(caption.begin(), caption.end(), '_', ' ');
        rest += figure(file, caption);
      }
    if (!rest.empty())
      html += "<h3>More</h3>\n<div class=\"figures\">\n" + rest + "</div>\n";
    return html.empty() ? "" : heading("Figures") + html;
  }

  std::string
  figure_of_comparison(const fs::path &file)
  {
    return fs::exists(file) ? figure(file, "Measured points over the computed curve.") : "";
  }
} // namespace tribodraw::report
