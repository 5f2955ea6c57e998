#include <tribodraw/base/csv.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/plot.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace tribodraw::figures
{
  namespace
  {
    using Style = plot::Series::Style;

    /// Values of @p keys without repetition, at most @p n of them, evenly chosen with first and last.
    std::vector<double>
    choose_levels(const std::vector<double> &keys, const std::size_t n)
    {
      const std::set<double>    all(keys.begin(), keys.end());
      const std::vector<double> sorted(all.begin(), all.end());
      if (sorted.size() <= n)
        return sorted;
      std::vector<double> chosen;
      for (std::size_t i = 0; i < n; ++i)
        chosen.push_back(sorted[i * (sorted.size() - 1) / (n - 1)]);
      return chosen;
    }

    std::string
    short_number(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.3g", value);
      return text;
    }
  } // namespace

  void
  draw_flow_factors(const std::filesystem::path &folder)
  {
    const auto file = folder / "flow_factors.csv";
    if (!std::filesystem::exists(file))
      return;
    const CsvData data       = read_csv(file);
    const auto    separation = data.numbers("h_avg_over_sq");
    const auto    chart      = [&](const std::string &title, const std::string &symbol, const std::string &column) {
      plot::LineChart c{ title, "Mean gap / Sq", "Flow factor" };
      for (const char *component : { "xx", "yy", "xy", "yx" })
        {
          const bool diagonal = component[0] == component[1];
          const auto values   = data.numbers(column + component);
          // Off-diagonal components that a method does not give are zero throughout.
          if (diagonal || std::any_of(values.begin(), values.end(), [](const double v) { return v != 0; }))
            c.series.push_back(
                        { symbol + component, separation, values, diagonal ? Style::line_with_points : Style::dashed_line });
        }
      return c;
    };
    plot::draw(chart("Pressure flow factor", "ΦP ", "phi_p_"), folder / "phi_p");
    plot::draw(chart("Shear flow factor", "ΦS ", "phi_s_"), folder / "phi_s");
  }

  namespace
  {
    /// The rows of a friction table with one strain, over the solid pressure.
    plot::Series
    over_pressure(const CsvData &data, const std::string &column, const double level)
    {
      plot::Series series;
      const auto pressure = data.numbers("p_solid_mpa"), strain = data.numbers("eps_p"), values = data.numbers(column);
      for (std::size_t i = 0; i < values.size(); ++i)
        if (strain[i] == level)
          {
            series.x.push_back(pressure[i]);
            series.y.push_back(values[i]);
          }
      return series;
    }

    plot::LineChart
    chart_over_pressure(const std::string &title, const std::string &label)
    {
      plot::LineChart chart{ title, "Solid pressure / MPa", label };
      chart.logarithmic_x = true;
      chart.y_from_zero   = true;
      return chart;
    }

    /// @param of which tool, empty for the first or only one
    void
    draw_one_table(const std::filesystem::path &file, const std::string &of)
    {
      const std::string tool   = of.empty() ? "" : ", " + of;
      const std::string suffix = of.empty() ? "" : "_of_" + of;
      const auto        stem   = [&](const char *name) { return file.parent_path() / (name + suffix); };
      const CsvData     data   = read_csv(file);
      const auto        family = [&](const std::string &title, const std::string &label, const std::string &column) {
        plot::LineChart c = chart_over_pressure(title + tool, label);
        for (const double level : choose_levels(data.numbers("eps_p"), 6))
          {
            c.series.push_back(over_pressure(data, column, level));
            c.series.back().label = "strain " + short_number(level);
          }
        return c;
      };
      plot::draw(family("Real contact fraction", "Contact fraction", "contact_fraction"),
                 stem("table_contact_fraction"));
      plot::draw(family("Mean film in the gap", "Film thickness / µm", "h_avg_um"), stem("table_film_thickness"));
      plot::draw(family("Shear stress of the solid contacts", "Shear stress / MPa", "tau_solid_mpa"),
                 stem("table_solid_shear"));
      plot::draw(family("Boundary friction coefficient", "Friction coefficient", "mu_boundary"),
                 stem("table_friction_coefficient"));
      plot::draw(family("Pressure flow factor ΦP xx", "Flow factor", "phi_p_xx"), stem("table_phi_p"));
      plot::draw(family("Shear flow factor ΦS xx", "Flow factor", "phi_s_xx"), stem("table_phi_s"));
    }

    /// What differs between the maps of a sheet, at the least and the greatest strain.
    void
    draw_scatter(const std::filesystem::path &file)
    {
      const CsvData data  = read_csv(file);
      const auto    chart = [&](const std::string &title, const std::string &label, const std::string &quantity) {
        plot::LineChart c = chart_over_pressure(title + " of several maps", label);
        for (const double level : choose_levels(data.numbers("eps_p"), 2))
          {
            const std::string strain = "strain " + short_number(level);
            plot::Series      mean   = over_pressure(data, quantity + "_mean", level);
            mean.label               = strain + ": mean";
            mean.style               = Style::line_with_points;
            // Both ends of the band in one colour: one curve with a gap between them.
            plot::Series       band     = over_pressure(data, quantity + "_min", level);
            const plot::Series greatest = over_pressure(data, quantity + "_max", level);
            band.x.push_back(NAN);
            band.y.push_back(NAN);
            band.x.insert(band.x.end(), greatest.x.begin(), greatest.x.end());
            band.y.insert(band.y.end(), greatest.y.begin(), greatest.y.end());
            band.label = strain + ": least and greatest";
            band.style = Style::dashed_line;
            c.series.push_back(mean);
            c.series.push_back(band);
          }
        return c;
      };
      const auto folder = file.parent_path();
      plot::draw(chart("Contact fraction", "Contact fraction", "contact_fraction"),
                 folder / "scatter_contact_fraction");
      plot::draw(chart("Mean film", "Film thickness / µm", "h_avg_um"), folder / "scatter_film_thickness");
      plot::draw(chart("Friction coefficient", "Friction coefficient", "mu_boundary"),
                 folder / "scatter_friction_coefficient");
    }
  } // namespace

  void
  draw_friction_table(const std::filesystem::path &folder)
  {
    if (const auto file = folder / "friction_table.csv"; std::filesystem::exists(file))
      draw_one_table(file, "");
    const std::string start = "friction_table_of_";
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      if (const std::string name = entry.path().stem().string();
          entry.path().extension() == ".csv" && name.rfind(start, 0) == 0)
        draw_one_table(entry.path(), name.substr(start.size()));
    if (const auto file = folder / "scatter.csv"; std::filesystem::exists(file))
      draw_scatter(file);
  }

  void
  draw_forming(const std::filesystem::path &folder)
  {
    draw_history(folder);
    draw_maps(folder);
    draw_forming_limits(folder);
    draw_cuts(folder);
  }

  void
  draw_all(const std::filesystem::path &folder)
  {
    draw_surface(folder);
    draw_flow_factors(folder);
    draw_friction_table(folder);
    draw_strip(folder);
    draw_forming(folder);
  }
} // namespace tribodraw::figures
