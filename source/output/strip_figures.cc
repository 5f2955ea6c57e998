#include <tribodraw/base/csv.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/plot.h>

namespace tribodraw::figures
{
  namespace
  {
    using Style = plot::Series::Style;

    struct SweepChart
    {
      const char *file, *column, *title, *x_label;
      bool        logarithmic;
    };

    constexpr SweepChart sweep_charts[] = {
      { "sweep_pressure", "pressure_mpa", "Friction over pressure", "Nominal pressure / MPa", true },
      { "sweep_speed", "speed_mm_per_s", "Friction over speed (Stribeck curve)", "Sliding speed / (mm/s)", true },
      { "sweep_strain", "eps_p", "Friction over strain", "Equivalent plastic strain", false },
      { "sweep_amount", "amount_g_per_m2", "Friction over amount of lubricant", "Lubricant / (g/m²)", false },
      { "sweep_viscosity", "viscosity_mpa_s", "Friction over viscosity", "Viscosity / (mPa s)", true },
    };

    void
    draw_sweep(const std::filesystem::path &folder, const SweepChart &sweep)
    {
      const auto file = folder / (std::string(sweep.file) + ".csv");
      if (!std::filesystem::exists(file))
        return;
      const CsvData       data = read_csv(file);
      std::vector<double> x    = data.numbers(sweep.column);
      plot::LineChart     chart{ sweep.title, sweep.x_label, "Friction coefficient" };
      chart.logarithmic_x = sweep.logarithmic && !x.empty() && x.front() > 0;
      chart.y_from_zero   = true;
      chart.series        = { { "friction coefficient", x, data.numbers("mu"), Style::line_with_points },
                              { "part of the asperities", x, data.numbers("solid_friction"), Style::dashed_line } };
      if (data.numbers("mu_lowest") != data.numbers("mu_highest"))
        {
          chart.series.push_back({ "least of the maps", x, data.numbers("mu_lowest"), Style::line });
          chart.series.push_back({ "greatest of the maps", x, data.numbers("mu_highest"), Style::line });
        }
      plot::draw(chart, folder / sweep.file);

      plot::LineChart share{ "Load on the lubricant", sweep.x_label, "Share of the load" };
      share.logarithmic_x = chart.logarithmic_x;
      share.y_from_zero   = true;
      share.series        = { { "", x, data.numbers("lubricant_share"), Style::line_with_points } };
      plot::draw(share, folder / (std::string(sweep.file) + "_share"));
    }

    void
    draw_profile(const std::filesystem::path &folder)
    {
      const auto file = folder / "strip_profile.csv";
      if (!std::filesystem::exists(file))
        return;
      const CsvData   data = read_csv(file);
      const auto      x    = data.numbers("x_mm");
      plot::LineChart pressure{ "Pressure along the contact", "x / mm", "Pressure / MPa" };
      pressure.y_from_zero = true;
      pressure.series      = { { "asperities", x, data.numbers("solid_pressure_mpa"), Style::line },
                               { "lubricant", x, data.numbers("lubricant_pressure_mpa"), Style::line } };
      plot::draw(pressure, folder / "strip_pressure");
      plot::LineChart gap{ "Mean gap along the contact", "x / mm", "Gap / µm" };
      gap.y_from_zero          = true;
      std::vector<double> film = data.numbers("gap_um"), filled = data.numbers("film_fraction");
      gap.series = { { "gap", x, film, Style::line } };
      for (std::size_t i = 0; i < film.size(); ++i)
        filled[i] *= film[i];
      gap.series.push_back({ "lubricant", x, filled, Style::dashed_line });
      plot::draw(gap, folder / "strip_gap");
    }
  } // namespace

  void
  draw_strip(const std::filesystem::path &folder)
  {
    draw_profile(folder);
    for (const SweepChart &sweep : sweep_charts)
      draw_sweep(folder, sweep);
  }
} // namespace tribodraw::figures
