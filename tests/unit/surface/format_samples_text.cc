// Text matrices in several dialects and lists of points.
#include "format_samples.h"

#include <algorithm>
#include <random>

namespace format_samples
{
  namespace
  {
    struct MatrixStyle
    {
      std::string header, separator = " ", line_end = "\n", missing_mark = "BAD";
      bool        with_missing = false, decimal_comma = false;
    };

    /// 10 nm as text in um: 0.17 for 17.
    std::string
    in_um(int value, bool decimal_comma)
    {
      std::string digits = std::to_string(std::abs(value));
      while (digits.size() < 3)
        digits = "0" + digits;
      return (value < 0 ? "-" : "") + digits.substr(0, digits.size() - 2) + (decimal_comma ? "," : ".")
             + digits.substr(digits.size() - 2);
    }

    std::string
    matrix(const MatrixStyle &style)
    {
      std::string text = style.header;
      for (int iy = ny - 1; iy >= 0; --iy)
        for (int ix = 0; ix < nx; ++ix)
          {
            text += style.with_missing && missing(ix, iy) ? style.missing_mark
                                                          : in_um(height(ix, iy), style.decimal_comma);
            text += ix + 1 < nx ? style.separator : style.line_end;
          }
      return text;
    }

    const tribodraw::GivenScales in_micrometres{ std::array<double, 2>{ 2e-3, 3e-3 }, 1e-3 };

    void
    add_matrices(std::vector<Sample> &samples)
    {
      const auto add = [&](const std::string &variant, const MatrixStyle &style,
                           const tribodraw::GivenScales &given = in_micrometres) {
        samples.push_back({ "matrix", variant, matrix(style), given, expected(style.with_missing) });
      };
      for (const std::string separator : { " ", "\t", ";", ",", ", ", "   ", " ; " })
        for (const std::string line_end : { "\n", "\r\n" })
          {
            MatrixStyle style;
            style.separator = separator;
            style.line_end  = line_end;
            add("separator `" + separator + "`", style);
          }
      for (const std::string mark : { "BAD", "Bad", "nan", "NaN", "***", "---", "" })
        {
          MatrixStyle style;
          style.separator    = ";";
          style.with_missing = true;
          style.missing_mark = mark;
          add("missing `" + mark + "`", style);
        }
      for (const std::string separator : { ";", "\t" })
        {
          MatrixStyle style;
          style.separator     = separator;
          style.decimal_comma = true;
          add("decimal comma", style);
        }
      MatrixStyle style;
      style.header
          = "\xEF\xBB\xBF# Channel: Topography\n# Width: 10 \xC2\xB5m\n# Height: 0.012 mm\n# Value units: um\n";
      add("Gwyddion", style, {});
      style.header = "# Kanal: H\xC3\xB6he\n# Breite: 10 um\n# H\xC3\xB6he: 12 um\n# Value units: \xB5m\n";
      add("Gwyddion, German", style, {});
      style.header
          = "# x-pixels = 5\n# y-pixels = 4\n# x-length = 10000\n# y-length = 12000\n# x-unit = nm\n# y-unit = "
            "nm\n# z-unit = um\n";
      add("x-length", style, {});
      style.header = "h=4 w=5\nheight conversion factor (-> m)=1e-006\n";
      add("h= w=", style, { std::array<double, 2>{ 2e-3, 3e-3 }, {} });
      style.header = "# Columns: 5\n# Rows: 4\n";
      add("counts", style);
    }

    struct PointStyle
    {
      std::string header, separator = " ", line_end = "\n";
      bool   with_missing = false, list_missing = false, decimal_comma = false, shuffled = false, by_column = false;
      double noise    = 0; ///< of the coordinates [um]
      double y_factor = 1;
    };

    std::string
    points(const PointStyle &style)
    {
      std::vector<std::array<int, 2>> order;
      for (int i = 0; i < nx * ny; ++i)
        order.push_back(style.by_column ? std::array<int, 2>{ i / ny, i % ny } : std::array<int, 2>{ i % nx, i / nx });
      std::mt19937 random(7);
      if (style.shuffled)
        for (std::size_t i = order.size(); i > 1; --i)
          std::swap(order[i - 1], order[random() % i]);
      std::string text = style.header;
      for (const auto &[ix, iy] : order)
        {
          const bool gone = style.with_missing && missing(ix, iy);
          if (gone && !style.list_missing)
            continue;
          const auto number = [&](double value) {
            std::string digits
                = std::to_string(value + style.noise * (static_cast<double>(random() % 1000) / 500. - 1.));
            if (style.decimal_comma)
              std::replace(digits.begin(), digits.end(), '.', ',');
            return digits;
          };
          text += number(100.25 + 2. * ix) + style.separator + number(style.y_factor * (-7. + 3. * iy))
                  + style.separator + (gone ? "NaN" : in_um(height(ix, iy), style.decimal_comma)) + style.line_end;
        }
      return text;
    }

    void
    add_points(std::vector<Sample> &samples)
    {
      const auto add = [&](const std::string &variant, const PointStyle &style,
                           const tribodraw::GivenScales &given = in_micrometres) {
        samples.push_back({ "points", variant, points(style), given, expected(style.with_missing) });
        samples.back().tolerance = 1e-12;
      };
      PointStyle style;
      for (const std::string separator : { " ", "\t", ";", ",", "  " })
        {
          style.separator = separator;
          add("separator `" + separator + "`", style);
        }
      style           = {};
      style.by_column = true;
      add("column by column", style);
      style          = {};
      style.shuffled = true;
      add("any order", style);
      style.with_missing = true;
      add("points left out", style);
      style.list_missing = true;
      add("points marked", style);
      style               = {};
      style.separator     = ";";
      style.decimal_comma = true;
      style.line_end      = "\r\n";
      add("decimal comma", style);
      style          = {};
      style.noise    = 0.009; // below 1 % of 2 um from the axis through the others
      style.shuffled = true;
      add("rounded coordinates", style);
      style           = {};
      style.separator = ",";
      style.header    = "X[um],Y[\xC2\xB5m],Z[um]\n";
      add("titles with units", style, {});
      style.header   = "X[um],Y[mm],Z[um]\n";
      style.y_factor = 1e-3;
      add("titles with different units", style, {});
      style.y_factor = 1;
      style.header   = "x, y, z\n";
      add("titles", style);
      style.header = "# XY units: um\n# Value units: um\n";
      add("comments with units", style, {});
    }
  } // namespace

  std::vector<Sample>
  text_samples()
  {
    std::vector<Sample> samples;
    add_matrices(samples);
    add_points(samples);
    return samples;
  }
} // namespace format_samples
