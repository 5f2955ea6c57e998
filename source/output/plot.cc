#include "gnuplot.h"

#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>
#include <tribodraw/output/plot.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tribodraw::plot
{
  namespace
  {
    struct Colour
    {
      unsigned char red, green, blue;
    };

    /// viridis (matplotlib's default map, CC0): uniform in perception, readable in grey and for the colour-blind.
    constexpr std::array<Colour, 11> viridis  = { { { 0x44, 0x01, 0x54 },
                                                    { 0x48, 0x24, 0x75 },
                                                    { 0x41, 0x44, 0x87 },
                                                    { 0x35, 0x5f, 0x8d },
                                                    { 0x2a, 0x78, 0x8e },
                                                    { 0x21, 0x91, 0x8c },
                                                    { 0x22, 0xa8, 0x84 },
                                                    { 0x44, 0xbf, 0x70 },
                                                    { 0x7a, 0xd1, 0x51 },
                                                    { 0xbd, 0xdf, 0x26 },
                                                    { 0xfd, 0xe7, 0x25 } } };
    constexpr Colour                 no_value = { 0xb8, 0xb8, 0xb8 };

    constexpr unsigned width = 480; ///< of figures, in points: texts of 14 points stay readable on a phone

    /// Okabe and Ito's colours for lines, told apart by the colour-blind and visible on white and on dark pages.
    constexpr std::array<const char *, 7> line_colours
        = { { "#0080c8", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#888888" } };

    Colour
    colour_of(const double fraction)
    {
      const double      position = std::clamp(fraction, 0., 1.) * (viridis.size() - 1);
      const std::size_t low      = std::min<std::size_t>(static_cast<std::size_t>(position), viridis.size() - 2);
      const double      weight   = position - low;
      const auto        mix      = [weight](const unsigned char a, const unsigned char b) {
        return static_cast<unsigned char>(std::lround((1 - weight) * a + weight * b));
      };
      const Colour a = viridis[low], b = viridis[low + 1];
      return { mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue) };
    }

    std::string
    palette()
    {
      std::ostringstream text;
      text << "set palette defined (";
      for (std::size_t i = 0; i < viridis.size(); ++i)
        {
          char hex[8];
          std::snprintf(hex, sizeof hex, "#%02x%02x%02x", viridis[i].red, viridis[i].green, viridis[i].blue);
          text << (i == 0 ? "" : ", ") << i << " '" << hex << "'";
        }
      text << ")\n";
      return text.str();
    }

    std::string
    axis_titles(const std::string &title, const std::string &x, const std::string &y)
    {
      return "set title " + gnuplot::quote(title) + "\nset xlabel " + gnuplot::quote(x) + "\nset ylabel "
             + gnuplot::quote(y) + "\nset tics nomirror out\nset border 3\n";
    }

    /// 1, 2 or 5 times a power of ten, at most @p n of which fit into a range.
    double
    tic_distance(const double range, const double n = 5)
    {
      const double power = std::pow(10., std::floor(std::log10(range / n)));
      for (const double factor : { 1., 2., 5. })
        if (factor * power * n >= range)
          return factor * power;
      return 10 * power;
    }

    /// Tics of a colour bar of that length in points: where there is no room for more, both ends.
    std::string
    bar_tics(const std::pair<double, double> &range, const double length)
    {
      if (length > 120)
        return "set cbtics " + units::number(tic_distance(range.second - range.first, std::min(length / 40, 7.)))
               + "\n";
      char tics[100];
      std::snprintf(tics, sizeof tics, "set cbtics ('%.3g' %.17g, '%.3g' %.17g)\n", range.first, range.first,
                    range.second, range.second);
      return tics;
    }

    /// Steps of colour with the names of the classes; nothing if the values are a quantity.
    std::string
    class_palette(const std::vector<std::string> &classes)
    {
      if (classes.empty())
        return "";
      std::ostringstream colours, names;
      for (std::size_t i = 0; i < classes.size(); ++i)
        {
          const Colour c
              = colour_of(classes.size() > 1 ? static_cast<double>(i) / static_cast<double>(classes.size() - 1) : 0.);
          char hex[8];
          std::snprintf(hex, sizeof hex, "#%02x%02x%02x", c.red, c.green, c.blue);
          colours << (i == 0 ? "" : ", ") << i << " '" << hex << "', " << i + 1 << " '" << hex << "'";
          names << (i == 0 ? "" : ", ") << gnuplot::quote(classes[i]) << ' ' << i + 1;
        }
      return "set palette defined (" + colours.str() + ")\nset cbtics (" + names.str() + ")\n";
    }

    const char *
    style_of(const Series::Style style)
    {
      switch (style)
        {
        case Series::Style::line:
          return "with lines lw 2";
        case Series::Style::dashed_line:
          return "with lines lw 2 dt 2";
        case Series::Style::points:
          return "with points pt 7 ps 0.5";
        case Series::Style::dots:
          return "with points pt 7 ps 0.25";
        case Series::Style::line_with_points:
          return "with linespoints lw 2 pt 7 ps 0.5";
        }
      return "";
    }

    /// Points as gnuplot reads them: a blank line where the curve is interrupted.
    template <class X, class Y>
    std::string
    data_text(const std::size_t n, const X &x, const Y &y)
    {
      std::string text;
      for (std::size_t i = 0; i < n; ++i)
        if (std::isfinite(x(i)) && std::isfinite(y(i)))
          text += units::number(x(i)) + ' ' + units::number(y(i)) + '\n';
        else
          text += '\n';
      return text;
    }

    /// Red, green, blue, opacity of each pixel. Outside the body the picture is transparent.
    std::string
    pixels(const Raster &raster, const std::pair<double, double> &range)
    {
      std::string bytes;
      bytes.reserve(4 * raster.value.size());
      for (std::size_t i = 0; i < raster.value.size(); ++i)
        {
          const double v = raster.value[i];
          const Colour c = std::isfinite(v) ? colour_of((v - range.first) / (range.second - range.first)) : no_value;
          const bool   visible = raster.inside.empty() || raster.inside[i];
          for (const unsigned char byte : { c.red, c.green, c.blue, static_cast<unsigned char>(visible ? 255 : 0) })
            bytes += static_cast<char>(byte);
        }
      return bytes;
    }
  } // namespace

  std::pair<double, double>
  value_range(const std::vector<double> &values)
  {
    double low = INFINITY, high = -INFINITY;
    for (const double v : values)
      if (std::isfinite(v))
        {
          low  = std::min(low, v);
          high = std::max(high, v);
        }
    if (low > high)
      return { 0., 1. };
    // A constant field: an interval around it, so that the colour bar has two ends.
    if (high - low <= 1e-9 * std::max(std::abs(low), std::abs(high)))
      {
        const double half = low == 0 ? 1. : 0.01 * std::abs(low);
        return { low - half, high + half };
      }
    return { low, high };
  }

  bool
  draw(const LineChart &chart, const std::filesystem::path &stem)
  {
    if (!available())
      return false;
    const gnuplot::TemporaryFolder folder;
    std::ostringstream             script, curves;
    script << axis_titles(chart.title, chart.x_label, chart.y_label) << "set grid lc rgb '#c0c0c0' lw 0.5\n"
           << "set key below center horizontal Left reverse samplen 1.5 spacing 1.2 noautotitle\n";
    if (chart.logarithmic_x)
      script << "set logscale x\n";
    if (chart.logarithmic_y)
      script << "set logscale y\n";
    if (chart.y_from_zero)
      script << "set yrange [0:*]\n";
    if (chart.equal_axes)
      script << "set size ratio -1\n";
    unsigned    n_curves = 0, n_labels = 0;
    std::size_t longest = 0; // label
    for (const Series &series : chart.series)
      {
        const auto usable = [&](const std::size_t i) {
          return std::isfinite(series.x[i]) && std::isfinite(series.y[i]) && (!chart.logarithmic_x || series.x[i] > 0)
                 && (!chart.logarithmic_y || series.y[i] > 0);
        };
        const std::size_t n   = std::min(series.x.size(), series.y.size());
        bool              any = false;
        for (std::size_t i = 0; i < n; ++i)
          any = any || usable(i);
        if (!any)
          continue;
        const std::string name = "data" + std::to_string(n_curves);
        write_file(folder.path() / name, data_text(
                                             n, [&](const std::size_t i) { return series.x[i]; },
                                             [&](const std::size_t i) { return usable(i) ? series.y[i] : NAN; }));
        curves << (n_curves == 0 ? "plot " : ", \\\n  ") << gnuplot::quote((folder.path() / name).string())
               << " using 1:2 " << style_of(series.style) << " lc rgb '" << line_colours[n_curves % line_colours.size()]
               << "' title " << gnuplot::quote(series.label);
        ++n_curves;
        n_labels += !series.label.empty();
        longest = std::max(longest, series.label.size());
      }
    if (n_curves == 0)
      return false;
    const unsigned key_rows = longest > 14 ? n_labels : (n_labels + 1) / 2; // as gnuplot arranges them in this width
    return gnuplot::draw(folder, script.str() + curves.str(), width, (chart.equal_axes ? 400 : 340) + 22 * key_rows,
                         stem);
  }

  bool
  draw(const MapChart &chart, const std::filesystem::path &stem)
  {
    const Raster &raster = chart.raster;
    if (!available() || raster.value.empty())
      return false;
    const gnuplot::TemporaryFolder folder;
    // Classes lie in the middle of equal parts of the colour bar.
    const bool classes = !chart.classes.empty();
    const auto n       = static_cast<double>(chart.classes.size());
    const auto range   = classes ? std::pair{ 1., n } : chart.range.value_or(value_range(raster.value));
    const auto bar     = classes ? std::pair{ 0.5, n + 0.5 } : range;
    write_file(folder.path() / "pixels", pixels(raster, range));
    const double dx = (raster.x_max - raster.x_min) / raster.nx, dy = (raster.y_max - raster.y_min) / raster.ny;
    const auto   text = [](const double v) { return units::number(v); };

    const double aspect = (raster.y_max - raster.y_min) / (raster.x_max - raster.x_min);

    std::ostringstream script;
    script << axis_titles(chart.title, chart.x_label, chart.y_label) << palette() << "set size ratio -1\nset xrange ["
           << text(raster.x_min) << ':' << text(raster.x_max) << "]\nset yrange [" << text(raster.y_min) << ':'
           << text(raster.y_max) << "]\nset xtics " << text(tic_distance(raster.x_max - raster.x_min)) << "\nset ytics "
           << text(tic_distance(raster.y_max - raster.y_min)) << "\nset cbrange [" << text(bar.first) << ':'
           << text(bar.second) << "]\n"
           << (classes ? class_palette(chart.classes) : bar_tics(range, aspect * width))
           << "set format cb '%g'\nset lmargin at screen 0.18\nset rmargin at screen 0.77\nset cblabel "
           << gnuplot::quote(chart.value_label) << " offset 1.5,0"
           << "\nset colorbox\nplot " << gnuplot::quote((folder.path() / "pixels").string()) << " binary array=("
           << raster.nx << ',' << raster.ny << ") dx=" << text(dx) << " dy=" << text(dy) << " origin=("
           << text(raster.x_min + dx / 2) << ',' << text(raster.y_min + dy / 2)
           << ") format='%uchar%uchar%uchar%uchar' using 1:2:3:4 with rgbalpha notitle, \\\n  NaN with points palette "
              "notitle";
    for (std::size_t i = 0; i < chart.lines.size(); ++i)
      {
        const auto       &line = chart.lines[i];
        const std::string name = "line" + std::to_string(i);
        write_file(folder.path() / name, data_text(
                                             line.size(), [&](const std::size_t k) { return line[k][0]; },
                                             [&](const std::size_t k) { return line[k][1]; }));
        script << ", \\\n  " << gnuplot::quote((folder.path() / name).string())
               << " using 1:2 with lines lw 1 lc rgb '#808080' notitle";
      }
    // The field has the width between the margins above; title and labels need the rest of the height.
    const unsigned height = static_cast<unsigned>(std::clamp((0.77 - 0.18) * width * aspect + 110, 180., 800.));
    return gnuplot::draw(folder, script.str(), width, height, stem);
  }
} // namespace tribodraw::plot
