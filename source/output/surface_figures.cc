#include <tribodraw/base/csv.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/plot.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <cmath>

namespace tribodraw::figures
{
  namespace
  {
    using Style = plot::Series::Style;

    /// Range without the lowest and the highest thousandth, so that single spikes do not take the colours from the
    /// rest.
    std::pair<double, double>
    colour_range(std::vector<double> values)
    {
      const std::size_t cut = values.size() / 1000;
      const auto        at  = [&](std::size_t i) {
        const auto it = values.begin() + static_cast<std::ptrdiff_t>(i);
        std::nth_element(values.begin(), it, values.end());
        return *it;
      };
      const double low = at(cut), high = at(values.size() - 1 - cut);
      return plot::value_range({ low, high });
    }

    /// The map in um, averaged over squares of pixels if it has more than a picture can show.
    void
    draw_heights(const HeightMap &map, const std::filesystem::path &stem)
    {
      constexpr std::size_t largest = 1000;
      const std::size_t     step    = (std::max(map.nx, map.ny) + largest - 1) / largest;
      plot::MapChart        chart;
      chart.title       = "Surface heights";
      chart.x_label     = "x / mm";
      chart.y_label     = "y / mm";
      chart.value_label = "Height / µm";
      plot::Raster &r   = chart.raster;
      r.nx              = std::max<std::size_t>(1, map.nx / step);
      r.ny              = std::max<std::size_t>(1, map.ny / step);
      r.x_min = r.y_min   = 0;
      r.x_max             = static_cast<double>(std::min(r.nx * step, map.nx)) * map.dx;
      r.y_max             = static_cast<double>(std::min(r.ny * step, map.ny)) * map.dy;
      constexpr double um = 1e-3;
      for (std::size_t iy = 0; iy < r.ny; ++iy)
        for (std::size_t ix = 0; ix < r.nx; ++ix)
          {
            double      sum = 0;
            std::size_t n   = 0;
            for (std::size_t jy = iy * step; jy < std::min((iy + 1) * step, map.ny); ++jy)
              for (std::size_t jx = ix * step; jx < std::min((ix + 1) * step, map.nx); ++jx, ++n)
                sum += map(jx, jy);
            r.value.push_back(sum / static_cast<double>(n) / um);
          }
      chart.range = colour_range(r.value);
      plot::draw(chart, stem);
    }

    /// The histogram and the normal distribution of the same standard deviation.
    void
    draw_distribution(const CsvData &data, const std::filesystem::path &stem)
    {
      const auto z = data.numbers("height_um"), density = data.numbers("density_per_um");
      double     weight = 0, square = 0;
      for (std::size_t i = 0; i < z.size(); ++i)
        {
          weight += density[i];
          square += density[i] * z[i] * z[i];
        }
      plot::LineChart chart{ "Height distribution", "Height / µm", "Probability density / (1/µm)" };
      chart.y_from_zero = true;
      chart.series      = { { "heights", z, density, Style::line } };
      if (const double sq = std::sqrt(square / weight); sq > 0)
        {
          std::vector<double> normal;
          for (const double h : z)
            normal.push_back(std::exp(-0.5 * h * h / (sq * sq)) / (std::sqrt(2 * M_PI) * sq));
          chart.series.push_back({ "Gaussian, same Sq", z, normal, Style::dashed_line });
        }
      plot::draw(chart, stem);
    }

    /// Value of a row `parameter,value,unit`, NaN if there is none.
    double
    row_value(const CsvData &data, const std::string &parameter)
    {
      const auto values = data.numbers("value");
      const auto column = static_cast<std::size_t>(std::find(data.columns.begin(), data.columns.end(), "parameter")
                                                   - data.columns.begin());
      for (std::size_t i = 0; i < data.rows.size() && column < data.columns.size(); ++i)
        if (data.rows[i][column] == parameter)
          return values[i];
      return NAN;
    }

    /// The curve, and if the parameters are there the straight line whose ends bound the core.
    void
    draw_abbott(const CsvData &data, const std::filesystem::path &parameters, const std::filesystem::path &stem)
    {
      std::vector<double> share  = data.numbers("material_ratio");
      const auto          height = data.numbers("height_um");
      for (double &v : share)
        v *= 100;
      plot::LineChart chart{ "Abbott curve", "Share of the area above the height / %", "Height / µm" };
      chart.series = { { "heights", share, height, Style::line } };
      if (std::filesystem::exists(parameters))
        {
          const CsvData values = read_csv(parameters);
          const double  sk = row_value(values, "Sk"), ratio = row_value(values, "Smr1");
          const auto    after = std::lower_bound(share.begin(), share.end(), ratio);
          if (std::isfinite(sk) && std::isfinite(ratio) && after != share.end())
            {
              const auto   k = static_cast<std::size_t>(after - share.begin());
              const double top
                  = k == 0 ? height[0]
                           : height[k - 1]
                                 + (height[k] - height[k - 1]) * (ratio - share[k - 1]) / (share[k] - share[k - 1]);
              chart.series.push_back({ "core, Sk", { 0, 100 }, { top, top - sk }, Style::dashed_line });
            }
        }
      plot::draw(chart, stem);
    }

    void
    draw_voids(const CsvData &data, const std::filesystem::path &stem)
    {
      std::vector<double> contact = data.numbers("contact_fraction");
      for (double &v : contact)
        v *= 100;
      plot::LineChart chart{ "Voids under a flat counter-surface", "Contact area / %", "Volume per area / (µm³/µm²)" };
      chart.y_from_zero = true;
      chart.series      = { { "all voids", contact, data.numbers("void_volume_um"), Style::line },
                            { "closed voids", contact, data.numbers("closed_void_volume_um"), Style::line } };
      plot::draw(chart, stem);
    }
  } // namespace

  void
  draw_surface(const std::filesystem::path &folder)
  {
    if (const auto file = folder / "surface.gsf"; std::filesystem::exists(file))
      draw_heights(read_surface_file(file), folder / "surface_map");
    for (const char *name : { "sheet_surface", "tool_surface" }) // of a drawing
      if (const auto file = folder / (std::string(name) + ".gsf"); std::filesystem::exists(file))
        draw_heights(read_surface_file(file), folder / (std::string(name) + "_map"));
    if (const auto file = folder / "height_distribution.csv"; std::filesystem::exists(file))
      draw_distribution(read_csv(file), folder / "height_distribution");
    if (const auto file = folder / "abbott_curve.csv"; std::filesystem::exists(file))
      draw_abbott(read_csv(file), folder / "surface.csv", folder / "abbott_curve");
    if (const auto file = folder / "closed_voids.csv"; std::filesystem::exists(file))
      draw_voids(read_csv(file), folder / "closed_voids");
  }
} // namespace tribodraw::figures
