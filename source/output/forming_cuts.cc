// Lines through the drawn part: thinning along cuts, and the outline against the blank.
#include <tribodraw/base/csv.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/plot.h>

#include <algorithm>
#include <cmath>

namespace tribodraw::figures
{
  namespace
  {
    using Point = std::array<double, 2>;

    void
    add_outline(plot::LineChart &chart, const std::string &label, const plot::PlanMesh &mesh,
                const plot::Series::Style style)
    {
      plot::Series series;
      series.label = label;
      series.style = style;
      for (const auto &chain : mesh.outline())
        {
          for (const Point &x : chain)
            {
              series.x.push_back(x[0]);
              series.y.push_back(x[1]);
            }
          // Chains are not joined.
          series.x.push_back(std::nan(""));
          series.y.push_back(std::nan(""));
        }
      chart.series.push_back(series);
    }
  } // namespace

  plot::Series
  values_along(const plot::PlanMesh &mesh, const std::vector<double> &values, const std::array<double, 2> &d)
  {
    const auto along  = [&](const unsigned i) { return mesh.points[i][0] * d[0] + mesh.points[i][1] * d[1]; };
    const auto across = [&](const unsigned i) { return mesh.points[i][1] * d[0] - mesh.points[i][0] * d[1]; };
    double     size   = 0;
    for (const Point &x : mesh.points)
      size = std::max({ size, std::abs(x[0]), std::abs(x[1]) });
    const double                           on_line = 1e-6 * size;
    std::vector<std::pair<double, double>> found;
    for (const auto &t : mesh.triangles)
      for (unsigned k = 0; k < 3; ++k)
        {
          const unsigned a = t[k], b = t[(k + 1) % 3];
          const double   da = across(a), db = across(b);
          if (std::abs(da) <= on_line)
            found.emplace_back(along(a), values[a]);
          else if (std::abs(db) > on_line && da * db < 0)
            {
              const double w = da / (da - db);
              found.emplace_back((1 - w) * along(a) + w * along(b), (1 - w) * values[a] + w * values[b]);
            }
        }
    std::sort(found.begin(), found.end());
    plot::Series series;
    for (const auto &[s, value] : found)
      if (series.x.empty() || s > series.x.back() + on_line)
        {
          series.x.push_back(s);
          series.y.push_back(value);
        }
    return series;
  }

  void
  draw_cuts(const std::filesystem::path &folder)
  {
    if (!std::filesystem::exists(folder / "nodes_final.csv") || !std::filesystem::exists(folder / "elements_final.csv"))
      return;
    const CsvData nodes = read_csv(folder / "nodes_final.csv"), elements = read_csv(folder / "elements_final.csv");
    if (!nodes.has("x0_mm") || !nodes.has("y0_mm"))
      return;
    const auto x = nodes.numbers("x_mm"), y = nodes.numbers("y_mm"), x0 = nodes.numbers("x0_mm"),
               y0 = nodes.numbers("y0_mm");
    plot::PlanMesh blank, part;
    for (std::size_t i = 0; i < x.size(); ++i)
      {
        blank.points.push_back({ x0[i], y0[i] });
        part.points.push_back({ x[i], y[i] });
      }
    const auto a = elements.numbers("n1"), b = elements.numbers("n2"), c = elements.numbers("n3");
    for (std::size_t t = 0; t < a.size(); ++t)
      blank.triangles.push_back(
          { static_cast<unsigned>(a[t]), static_cast<unsigned>(b[t]), static_cast<unsigned>(c[t]) });
    part.triangles = blank.triangles;

    plot::LineChart outline{ "Outline of the drawn part and of the blank", "x / mm", "y / mm" };
    outline.equal_axes = true;
    add_outline(outline, "blank", blank, plot::Series::Style::dashed_line);
    add_outline(outline, "drawn part", part, plot::Series::Style::line);
    plot::draw(outline, folder / "outline");

    if (!nodes.has("thinning"))
      return;
    auto thinning = nodes.numbers("thinning");
    for (double &t : thinning)
      t *= 100;
    plot::LineChart cuts{ "Thinning along cuts through the blank", "Distance from the axis on the blank / mm",
                          "Thinning / %" };
    const auto      add = [&](const char *label, const Point &direction) {
      cuts.series.push_back(values_along(blank, thinning, direction));
      cuts.series.back().label = label;
    };
    add("along x (rolling)", { 1, 0 });
    add("along y", { 0, 1 });
    add("diagonal", { std::sqrt(0.5), std::sqrt(0.5) });
    plot::draw(cuts, folder / "thinning_cuts");
  }
} // namespace tribodraw::figures
