#include <tribodraw/base/csv.h>
#include <tribodraw/base/files.h>
#include <tribodraw/output/comparison.h>

#include "report_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>
#include <vector>

namespace tribodraw::report
{
  namespace
  {
    namespace fs = std::filesystem;

    struct Value
    {
      std::string quantity, value, unit;
    };

    /// Four significant digits: what one reads, not what one computes with.
    std::string
    readable(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", value);
      return text;
    }

    std::optional<double>
    number_in(const std::string &text)
    {
      char        *after = nullptr;
      const double value = std::strtod(text.c_str(), &after);
      return after != text.c_str() && *after == '\0' ? std::optional<double>(value) : std::nullopt;
    }

    /// A unit of our files as one writes it.
    std::string
    written(std::string unit)
    {
      if (unit == "1" || unit == "-")
        return "";
      for (const auto &[plain, sign] :
           { std::pair<std::string, std::string>{ "um", "µm" }, { "^2", "²" }, { "^3", "³" } })
        for (auto at = unit.find(plain); at != std::string::npos; at = unit.find(plain, at + sign.size()))
          unit.replace(at, plain.size(), sign);
      return unit;
    }

    Value
    readable(const std::string &quantity, const double value, const std::string &unit)
    {
      if (unit == "N" && std::abs(value) >= 1e3)
        return { quantity, readable(1e-3 * value), "kN" };
      return { quantity, readable(value), written(unit) };
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

    bool
    ends_with(const std::string &text, const std::string &end)
    {
      return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
    }

    std::vector<double>
    finite(const CsvData &data, const std::string &column)
    {
      std::vector<double> result;
      if (data.has(column))
        for (const double v : data.numbers(column))
          if (std::isfinite(v))
            result.push_back(v);
      return result;
    }

    std::optional<CsvData>
    read_rows(const fs::path &file)
    {
      if (!fs::exists(file))
        return {};
      CsvData data = read_csv(file);
      return data.rows.empty() ? std::nullopt : std::optional<CsvData>(std::move(data));
    }

    /// Value of a row of a list `quantity,value,unit`.
    std::optional<double>
    value_of(const fs::path &file, const std::string &quantity)
    {
      if (const auto data = read_rows(file))
        for (const auto &cells : data->rows)
          if (cells.size() >= 2 && cells[0] == quantity)
            return number_in(cells[1]);
      return {};
    }

    /// Rows of a file `quantity,value,unit` (surface.csv, results.csv) but those that stand on the page already.
    void
    add_list(std::vector<Value> &values, const fs::path &file, const std::vector<std::string> &shown)
    {
      const auto data = read_rows(file);
      if (!data)
        return;
      const auto &rows = data->rows;
      for (std::size_t i = 0; i < rows.size(); ++i)
        {
          if (rows[i].size() < 3 || std::find(shown.begin(), shown.end(), rows[i][0]) != shown.end())
            continue;
          const std::string &name  = rows[i][0];
          const auto         value = number_in(rows[i][1]);
          if (name == "necked" || name == "converged")
            values.push_back({ spoken(name), value == 0. ? "no" : "yes", "" });
          else if (!value)
            values.push_back({ spoken(name), rows[i][1], written(rows[i][2]) });
          else if (ends_with(name, "_x") && i + 1 < rows.size() && rows[i + 1].size() >= 3 && number_in(rows[i + 1][1])
                   && rows[i + 1][0] == name.substr(0, name.size() - 1) + "y")
            {
              // two coordinates in one row
              values.push_back({ spoken(name.substr(0, name.size() - 2)) + " x, y",
                                 readable(*value) + ", " + readable(*number_in(rows[i + 1][1])), written(rows[i][2]) });
              ++i;
            }
          else
            values.push_back(readable(spoken(name), *value, rows[i][2]));
        }
    }

    enum class Shown
    {
      last,
      greatest,
      range
    };

    struct ColumnValue
    {
      const char *column, *quantity, *unit;
      Shown       shown = Shown::last;
    };

    /// Those of the columns that @p data has, with a finite value.
    void
    add_columns(std::vector<Value> &values, const CsvData &data, const std::vector<ColumnValue> &columns)
    {
      for (const ColumnValue &c : columns)
        if (const auto all = finite(data, c.column); !all.empty())
          {
            const auto [low, high] = std::minmax_element(all.begin(), all.end());
            if (c.shown == Shown::range)
              values.push_back({ c.quantity, readable(*low) + " to " + readable(*high), written(c.unit) });
            else
              values.push_back(readable(c.quantity, c.shown == Shown::greatest ? *high : all.back(), c.unit));
          }
    }

    void
    add_history(std::vector<Value> &values, const CsvData &history)
    {
      add_columns(
          values, history,
          { { "punch_travel_mm", "Punch travel reached", "mm" },
            { "punch_force_n", "Greatest punch force", "N", Shown::greatest },
            { "draw_in_x_mm", "Draw-in in rolling direction", "mm" },
            { "draw_in_y_mm", "Draw-in across the rolling direction", "mm" },
            { "min_thickness_mm", "Least thickness", "mm" },
            { "max_eps_p", "Greatest equivalent plastic strain", "" },
            { "max_lubricant_pressure_die_mpa", "Greatest lubricant pressure, die side", "MPa", Shown::greatest },
            { "max_lubricant_pressure_punch_mpa", "Greatest lubricant pressure, punch side", "MPa", Shown::greatest },
            { "mean_mu_die", "Mean friction coefficient at the end, die side", "" },
            { "mean_mu_punch", "Mean friction coefficient at the end, punch side", "" },
            { "draw_in_diagonal_mm", "Draw-in along the diagonal", "mm" },
            { "starved_area_fraction", "Starved share of the contact area at the end", "" } });
      values.push_back({ "Steps", std::to_string(history.rows.size()), "" });
    }

    void
    add_ranges_of_tables(std::vector<Value> &values, const fs::path &folder)
    {
      if (const auto factors = read_rows(folder / "flow_factors.csv"))
        add_columns(values, *factors,
                    { { "h_avg_over_sq", "Mean gap / Sq", "", Shown::range },
                      { "contact_fraction", "Real contact fraction", "", Shown::range },
                      { "phi_p_xx", "Pressure flow factor xx", "", Shown::range },
                      { "phi_p_yy", "Pressure flow factor yy", "", Shown::range },
                      { "phi_s_xx", "Shear flow factor xx", "", Shown::range },
                      { "phi_s_yy", "Shear flow factor yy", "", Shown::range } });
      if (const auto table = read_rows(folder / "friction_table.csv"))
        add_columns(values, *table,
                    { { "p_solid_mpa", "Table: solid pressure", "MPa", Shown::range },
                      { "eps_p", "Table: plastic strain", "", Shown::range },
                      { "contact_fraction", "Table: real contact fraction", "", Shown::range },
                      { "h_avg_um", "Table: mean film thickness", "um", Shown::range },
                      { "tau_solid_mpa", "Table: shear stress of the solid contacts", "MPa", Shown::range },
                      { "mu_boundary", "Table: boundary friction coefficient", "", Shown::range } });
    }

    using Cells = std::vector<std::string>;

    std::string
    table(const Cells &head, const std::vector<Cells> &rows, const std::vector<bool> &is_number)
    {
      const auto cell = [&](const char *tag, const std::size_t column, const std::string &text) {
        const bool number = column < is_number.size() && is_number[column];
        return std::string("<") + tag + (number ? " class=\"number\">" : ">") + escape(text) + "</" + tag + ">";
      };
      std::string html = "<div class=\"scroll\"><table><thead><tr>";
      for (std::size_t i = 0; i < head.size(); ++i)
        html += cell("th", i, head[i]);
      html += "</tr></thead><tbody>\n";
      for (const Cells &row : rows)
        {
          html += "<tr>";
          for (std::size_t i = 0; i < row.size(); ++i)
            html += cell("td", i, row[i]);
          html += "</tr>\n";
        }
      return html + "</tbody></table></div>\n";
    }

    struct Audit
    {
      std::string           quantity;
      double                reached;
      std::string           unit;
      std::optional<double> limit; ///< by magnitude
      std::string           remark;
    };

    /// Entry of a top-level section of effective.prm as written; empty if it is not there.
    std::string
    parameter(const fs::path &folder, const std::string &section, const std::string &entry)
    {
      if (!fs::exists(folder / "effective.prm"))
        return {};
      std::istringstream text(read_file(folder / "effective.prm"));
      bool               inside = false;
      for (std::string line; std::getline(text, line);)
        {
          if (line == "subsection " + section)
            inside = true;
          else if (line == "end")
            inside = false;
          else if (const auto equals = line.find('='); inside && equals != std::string::npos)
            {
              std::string name = line.substr(0, equals);
              name.erase(name.find_last_not_of(' ') + 1);
              if (name == "  set " + entry)
                return line.substr(std::min(line.size(), equals + 2));
            }
        }
      return {};
    }

    /// What a drawing must balance.
    void
    add_drawing_audits(std::vector<Audit> &audits, const fs::path &folder)
    {
      const fs::path results = folder / "results.csv";
      if (const auto error = value_of(results, "energy_error"))
        audits.push_back({ "Energy: (external - elastic - plastic - friction - contact work) / external work", *error,
                           "", 0.01, "trapezoidal rules and lagged areas" });
      const auto external = value_of(results, "external_work"), stabilisation = value_of(results, "stabilisation_work");
      if (external && stabilisation && *external > 0)
        audits.push_back({ "Work of the viscosity for a sheet that snaps / external work", *stabilisation / *external,
                           "", 0.01, "0: it was not needed" });
      if (const auto energy = read_rows(folder / "energy.csv"))
        if (const auto all = finite(*energy, "force_imbalance"); !all.empty())
          audits.push_back(
              { "Forces at the end: |punch + holder - die| / sum of magnitudes", all.back(), "", 0.01, "" });
      const auto penetration = value_of(results, "largest_penetration");
      const auto thickness   = std::strtod(parameter(folder, "Blank", "Thickness").c_str(), nullptr); // mm by its unit
      if (penetration && thickness > 0 && ends_with(parameter(folder, "Blank", "Thickness"), " mm"))
        audits.push_back({ "Largest penetration of a tool / thickness", *penetration / thickness, "", 0.03,
                           "of all increments; the contact stiffness follows it" });
      if (const auto history = read_rows(folder / "history.csv"))
        if (const auto all = finite(*history, "lubricant_volume_error"); !all.empty())
          audits.push_back({ "Lubricant volume: largest error of an increment / volume",
                             *std::max_element(all.begin(), all.end()), "", 1e-9, "conserved to round-off" });
    }

    void
    add_film_audits(std::vector<Audit> &audits, const fs::path &folder)
    {
      for (const auto &[name, text] : { std::pair{ "flux_imbalance", "Flow of the film: inflow against outflow" },
                                        { "volume_error", "Lubricant volume of the film" } })
        if (const auto value = value_of(folder / "results.csv", name))
          audits.push_back({ text, *value, "", 1e-8, "conserved to round-off" });
    }

    constexpr std::size_t n_tiles = 8;

    /// In the order of importance.
    std::vector<Value>
    all_results(const fs::path &folder)
    {
      std::vector<Value>       values;
      std::vector<std::string> shown{ "energy_error", "stabilisation_work", "largest_penetration", "flux_imbalance",
                                      "volume_error" };
      if (const auto history = read_rows(folder / "history.csv"))
        {
          add_history(values, *history);
          for (const char *name : { "punch_travel", "largest_punch_force", "draw_in_x", "draw_in_y", "draw_in_diagonal",
                                    "least_thickness_of_an_element", "largest_plastic_strain" })
            shown.emplace_back(name);
        }
      add_list(values, folder / "results.csv", shown);
      add_list(values, folder / "surface.csv", {});
      add_ranges_of_tables(values, folder);
      return values;
    }
  } // namespace

  std::string
  key_figures(const fs::path &folder)
  {
    const auto  values = all_results(folder);
    std::string tiles;
    for (std::size_t i = 0; i < std::min(values.size(), n_tiles); ++i)
      tiles += "<div class=\"tile\"><b>" + escape(values[i].value)
               + (values[i].unit.empty() ? "" : " <span>" + escape(values[i].unit) + "</span>") + "</b>"
               + escape(values[i].quantity) + "</div>\n";
    return tiles.empty() ? "" : heading("Key figures") + "<div class=\"tiles\">\n" + tiles + "</div>\n";
  }

  std::string
  more_results(const fs::path &folder)
  {
    const auto         values = all_results(folder);
    std::vector<Cells> rows;
    for (std::size_t i = n_tiles; i < values.size(); ++i)
      rows.push_back({ values[i].quantity, values[i].value, values[i].unit });
    return rows.empty() ? "" : heading("More results") + table({ "Quantity", "Value", "Unit" }, rows, { false, true });
  }

  std::string
  audits(const fs::path &folder)
  {
    std::vector<Audit> all;
    add_drawing_audits(all, folder);
    add_film_audits(all, folder);
    std::vector<Cells> rows;
    for (const Audit &a : all)
      {
        const bool good = !a.limit || std::abs(a.reached) <= *a.limit;
        rows.push_back({ a.quantity, readable(a.reached) + (a.unit.empty() ? "" : " " + a.unit),
                         a.limit ? readable(*a.limit) : "", good ? "✓" : "above what is usual", a.remark });
      }
    return rows.empty() ? ""
                        : heading("Conservation and accuracy")
                              + table({ "Quantity", "Reached", "Usual below", "", "" }, rows, { false, true, true });
  }

  std::string
  comparison(const fs::path &folder)
  {
    const auto data = read_rows(folder / "compare.csv");
    if (!data)
      return "";
    std::vector<Cells> rows;
    std::string        pictures;
    const auto         column = [&](const std::vector<std::string> &cells, const char *name) {
      const auto at = std::find(data->columns.begin(), data->columns.end(), name) - data->columns.begin();
      return static_cast<std::size_t>(at) < cells.size() ? cells[at] : std::string();
    };
    const auto number = [&](const std::vector<std::string> &cells, const char *name, const double factor = 1) {
      const auto value = number_in(column(cells, name));
      return value ? readable(factor * *value) : std::string();
    };
    for (const auto &cells : data->rows)
      rows.push_back({ spoken_column(column(cells, "quantity")), spoken_column(column(cells, "over")),
                       number(cells, "from") + " to " + number(cells, "to"), number(cells, "points"),
                       number(cells, "rms"), number(cells, "relative_rms", 100) + " %", number(cells, "mean"),
                       number(cells, "largest") + " at " + number(cells, "largest_at"), number(cells, "measured_peak"),
                       number(cells, "computed_peak") });
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".svg" && entry.path().stem().string().rfind("compare_", 0) == 0)
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto &file : files)
      pictures += figure_of_comparison(file);
    return heading("Measured and computed") + "<div class=\"figures\">\n" + pictures + "</div>\n"
           + table({ "Quantity", "Over", "Range", "Points", "rms", "rms / peak", "Mean", "Largest", "Peak measured",
                     "Peak computed" },
                   rows, { false, false, true, true, true, true, true, true, true, true })
           + "<p>rms, mean and largest are of computed less measured, at the measured points.</p>\n";
  }

  std::string
  surfaces(const fs::path &folder)
  {
    const auto data = read_rows(folder / "surfaces.csv");
    if (!data)
      return "";
    std::vector<Cells>       rows;
    std::vector<bool>        is_number;
    std::vector<std::string> head;
    for (const std::string &column : data->columns)
      {
        is_number.push_back(column != "surface" && column != "description");
        head.push_back(spoken(ends_with(column, "_um") ? column.substr(0, column.size() - 3) + " / µm" : column));
      }
    for (const auto &cells : data->rows)
      {
        std::vector<std::string> texts;
        for (const std::string &cell : cells)
          texts.push_back(number_in(cell) && std::isfinite(*number_in(cell)) ? readable(*number_in(cell))
                          : cell == "nan"                                    ? ""
                                                                             : cell);
        rows.push_back(texts);
      }
    return heading("Surfaces") + table(head, rows, is_number);
  }

  std::string
  inputs(const fs::path &folder)
  {
    if (!fs::exists(folder / "effective.prm"))
      return "";
    std::istringstream       text(read_file(folder / "effective.prm"));
    std::vector<std::string> path;
    std::string              top, rows, html;
    const auto               finish = [&] {
      if (!rows.empty())
        html += "<section><h3>" + escape(top.empty() ? "General" : top) + "</h3>\n<table><tbody>\n" + rows
                + "</tbody></table></section>\n";
      rows.clear();
    };
    for (std::string line; std::getline(text, line);)
      {
        line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
        if (line.rfind("subsection ", 0) == 0)
          {
            if (path.empty())
              {
                finish();
                top = line.substr(11);
              }
            path.push_back(line.substr(11));
            if (path.size() > 1)
              {
                std::string name;
                for (std::size_t i = 1; i < path.size(); ++i)
                  name += (i > 1 ? " / " : "") + path[i];
                rows += "<tr><th colspan=\"2\">" + escape(name) + "</th></tr>\n";
              }
          }
        else if (line == "end" && !path.empty())
          path.pop_back();
        else if (const auto equals = line.find('='); line.rfind("set ", 0) == 0 && equals != std::string::npos)
          {
            std::string name = line.substr(4, equals - 4), value = line.substr(equals + 1);
            name.erase(name.find_last_not_of(' ') + 1);
            value.erase(0, std::min(value.find_first_not_of(' '), value.size()));
            if (!value.empty())
              rows += "<tr><td>" + escape(name) + "</td><td>" + escape(value) + "</td></tr>\n";
          }
      }
    finish();
    return html.empty() ? "" : heading("Parameters in effect") + "<div class=\"inputs\">\n" + html + "</div>\n";
  }
} // namespace tribodraw::report
