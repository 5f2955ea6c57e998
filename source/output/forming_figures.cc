#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/plot.h>

#include <cmath>
#include <limits>
#include <optional>

namespace tribodraw::figures
{
  namespace
  {
    using Style = plot::Series::Style;

    /// A field that gets a map: name without unit, what the figure and its colour bar say, and whether it is drawn on
    /// the deformed sheet too.
    struct MapInfo
    {
      const char *name, *title, *quantity;
      bool        also_deformed;
    };

    constexpr MapInfo node_maps[] = {
      { "friction_coefficient_die", "Friction coefficient, die side", "Friction coefficient", true },
      { "friction_coefficient_punch", "Friction coefficient, punch side", "Friction coefficient", true },
      { "lubricant_pressure_die", "Lubricant pressure, die side", "Pressure", true },
      { "lubricant_pressure_punch", "Lubricant pressure, punch side", "Pressure", true },
      { "lubricant_pressure", "Lubricant pressure", "Pressure", true },
      { "film_thickness", "Film thickness", "Film thickness", true },
      { "film_fraction", "Filled part of the gap", "Lubricant / gap", true },
      { "contact_pressure_die", "Contact pressure, die side", "Pressure", false },
      { "contact_pressure_punch", "Contact pressure, punch side", "Pressure", false },
      { "film_thickness_die", "Film thickness, die side", "Film thickness", false },
      { "film_thickness_punch", "Film thickness, punch side", "Film thickness", false },
      { "contact_fraction_die", "Real contact area, die side", "Share of the area", false },
      { "phi_p_die", "Pressure flow factor, die side", "Pressure flow factor", false },
      { "phi_s_die", "Shear flow factor, die side", "Shear flow factor", false },
      { "lubrication_regime_die", "Lubrication regime, die side", "", false },
      { "lubrication_regime_punch", "Lubrication regime, punch side", "", false },
    };
    /// Not a quantity, but one of three classes.
    bool
    is_regime(const MapInfo &info)
    {
      return std::string(info.name).rfind("lubrication_regime", 0) == 0;
    }

    constexpr MapInfo cell_maps[] = {
      { "thickness", "Sheet thickness", "Thickness", true },
      { "eps_p", "Equivalent plastic strain", "Plastic strain", false },
      { "major_strain", "Major strain", "Logarithmic strain", false },
      { "minor_strain", "Minor strain", "Logarithmic strain", false },
      { "flc_margin", "Nearness to the forming limit", "Major strain / limit", false },
    };

    /// What a column name may end in, and how that is written.
    struct Unit
    {
      const char *suffix, *text;
    };
    constexpr Unit units[] = { { "", "" }, { "_mm", " / mm" }, { "_um", " / µm" }, { "_mpa", " / MPa" } };

    struct Column
    {
      std::string name, unit;
    };

    /// The column of a field, with or without its unit.
    std::optional<Column>
    find_column(const CsvData &data, const std::string &field)
    {
      for (const Unit &unit : units)
        if (data.has(field + unit.suffix))
          return Column{ field + unit.suffix, unit.text };
      return {};
    }

    struct FinalState
    {
      CsvData        nodes, elements;
      plot::PlanMesh deformed, undeformed;
      bool           moved = false;
    };

    std::vector<unsigned>
    indices(const CsvData &data, const std::string &column, const std::size_t n)
    {
      std::vector<unsigned> result;
      for (const double v : data.numbers(column))
        {
          if (!(v >= 0 && v < n && v == std::floor(v)))
            throw InputError(describe_error("A triangle has a node that does not exist.",
                                            data.file + ", column " + column, std::to_string(v),
                                            "0 to " + std::to_string(n - 1)));
          result.push_back(static_cast<unsigned>(v));
        }
      return result;
    }

    FinalState
    read_final_state(const std::filesystem::path &folder)
    {
      FinalState state;
      state.nodes    = read_csv(folder / "nodes_final.csv");
      state.elements = read_csv(folder / "elements_final.csv");
      const auto x = state.nodes.numbers("x_mm"), y = state.nodes.numbers("y_mm");
      const auto x0 = state.nodes.has("x0_mm") ? state.nodes.numbers("x0_mm") : x;
      const auto y0 = state.nodes.has("y0_mm") ? state.nodes.numbers("y0_mm") : y;
      for (std::size_t i = 0; i < x.size(); ++i)
        {
          state.deformed.points.push_back({ x[i], y[i] });
          state.undeformed.points.push_back({ x0[i], y0[i] });
          state.moved = state.moved || x[i] != x0[i] || y[i] != y0[i];
        }
      const auto a = indices(state.elements, "n1", x.size()), b = indices(state.elements, "n2", x.size()),
                 c = indices(state.elements, "n3", x.size());
      for (std::size_t t = 0; t < a.size(); ++t)
        state.deformed.triangles.push_back({ a[t], b[t], c[t] });
      state.undeformed.triangles = state.deformed.triangles;
      return state;
    }

    /// Draw a field on the plans it is wanted on. @p rasterise paints it on a mesh.
    template <class Rasterise>
    void
    draw_map(const FinalState &state, const MapInfo &info, const std::string &unit, const std::filesystem::path &folder,
             const Rasterise &rasterise)
    {
      const auto draw_on = [&](const plot::PlanMesh &mesh, const std::string &where, const std::string &name) {
        plot::MapChart chart;
        chart.title       = info.title + where;
        chart.x_label     = "x / mm";
        chart.y_label     = "y / mm";
        chart.value_label = info.quantity + unit;
        chart.raster      = rasterise(mesh);
        if (is_regime(info))
          chart.classes = { "boundary", "mixed", "full film" };
        chart.lines = mesh.outline();
        plot::draw(chart, folder / name);
      };
      if (state.moved)
        draw_on(state.undeformed, ", on the blank", std::string(info.name) + "_blank");
      if (!state.moved || info.also_deformed)
        draw_on(state.deformed, state.moved ? ", from above" : "", info.name);
    }

    /// A curve of history.csv over punch travel; nothing if the column is missing.
    void
    add_history(plot::LineChart &chart, const CsvData &history, const std::string &label, const std::string &column,
                const double factor = 1)
    {
      if (!history.has(column))
        return;
      auto y = history.numbers(column);
      for (double &v : y)
        v *= factor;
      chart.series.push_back({ label, history.numbers("punch_travel_mm"), y, Style::line });
    }
  } // namespace

  void
  draw_history(const std::filesystem::path &folder)
  {
    const auto file = folder / "history.csv";
    if (!std::filesystem::exists(file))
      return;
    const CsvData     history = read_csv(file);
    const std::string travel  = "Punch travel / mm";

    plot::LineChart force{ "Force over punch travel (full part)", travel, "Force / kN" };
    add_history(force, history, "punch", "punch_force_n", 1e-3);
    add_history(force, history, "blank holder", "blank_holder_force_n", 1e-3);
    plot::draw(force, folder / "force_travel");

    plot::LineChart draw_in{ "Draw-in of the blank's edge", travel, "Draw-in / mm" };
    add_history(draw_in, history, "x (rolling)", "draw_in_x_mm");
    add_history(draw_in, history, "y", "draw_in_y_mm");
    add_history(draw_in, history, "diagonal", "draw_in_diagonal_mm");
    plot::draw(draw_in, folder / "draw_in");

    plot::LineChart friction{ "Mean friction coefficient in contact", travel, "Friction coefficient" };
    friction.y_from_zero = true;
    add_history(friction, history, "die side", "mean_mu_die");
    add_history(friction, history, "punch side", "mean_mu_punch");
    plot::draw(friction, folder / "mean_friction");

    plot::LineChart pressure{ "Greatest lubricant pressure", travel, "Pressure / MPa" };
    pressure.y_from_zero = true;
    add_history(pressure, history, "die side", "max_lubricant_pressure_die_mpa");
    add_history(pressure, history, "punch side", "max_lubricant_pressure_punch_mpa");
    plot::draw(pressure, folder / "peak_lubricant_pressure");
  }

  void
  draw_maps(const std::filesystem::path &folder)
  {
    if (!std::filesystem::exists(folder / "nodes_final.csv") || !std::filesystem::exists(folder / "elements_final.csv"))
      return;
    const FinalState state = read_final_state(folder);
    for (const MapInfo &info : node_maps)
      if (const auto column = find_column(state.nodes, info.name))
        {
          const auto values = state.nodes.numbers(column->name);
          draw_map(state, info, column->unit, folder, [&](const plot::PlanMesh &mesh) {
            return is_regime(info) ? plot::rasterise_nearest(mesh, values) : plot::rasterise_nodal(mesh, values);
          });
        }
    for (const MapInfo &info : cell_maps)
      if (const auto column = find_column(state.elements, info.name))
        {
          const auto values = state.elements.numbers(column->name);
          draw_map(state, info, column->unit, folder,
                   [&](const plot::PlanMesh &mesh) { return plot::rasterise_cells(mesh, values); });
        }
  }

  void
  draw_forming_limits(const std::filesystem::path &folder)
  {
    const auto file = folder / "elements_final.csv";
    if (!std::filesystem::exists(file))
      return;
    const CsvData elements = read_csv(file);
    if (!elements.has("major_strain") || !elements.has("minor_strain"))
      return;
    plot::LineChart chart{ "Forming limit diagram", "Minor logarithmic strain", "Major logarithmic strain" };
    chart.series.push_back(
        { "elements", elements.numbers("minor_strain"), elements.numbers("major_strain"), Style::dots });
    if (std::filesystem::exists(folder / "flc.csv"))
      {
        const CsvData flc = read_csv(folder / "flc.csv");
        chart.series.push_back(
            { "limit curve", flc.numbers("minor_strain"), flc.numbers("major_strain"), Style::line });
      }
    plot::draw(chart, folder / "fld");
  }
} // namespace tribodraw::figures
