#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <array>
#include <cmath>

#include "regular_axis.h"
#include "text_header.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    struct Point
    {
      double x = 0, y = 0, z = 0;
    };

    /// The points of a text, one a line; titles and comments are handed to @p header if it is given.
    class Points
    {
    public:
      Points(std::string_view content, std::string file_name, TextHeader *text_header = nullptr)
          : lines(content), file(std::move(file_name)), header(text_header)
      {
      }

      bool
      next(Point &point)
      {
        std::string_view line;
        while (lines.next(line))
          {
            const auto text = trimmed(line);
            if (text.empty() || is_header(text))
              continue;
            if (!lines.complete())
              throw InputError(describe_error("the file ends inside a line (truncated?).", where(),
                                              "`" + excerpt(text) + "`", "a line end after the last number",
                                              "If nothing is missing, add a line end."));
            if (!any_point)
              separation = separation_of(text);
            any_point = true;
            if (!parse(text, separation, point))
              throw InputError(describe_error("not a point in the list of points.", where(), "`" + excerpt(text) + "`",
                                              "three numbers x, y, z"));
            return true;
          }
        return false;
      }

      std::string
      where() const
      {
        return file + ", line " + std::to_string(lines.number());
      }

      static bool
      parse(std::string_view text, const Separation &separation, Point &point)
      {
        Fields                  fields(text, separation);
        std::string_view        field;
        std::array<double *, 3> target{ &point.x, &point.y, &point.z };
        std::size_t             n = 0;
        for (; fields.next(field); ++n)
          {
            if (n >= 3)
              return false;
            const auto value
                = n < 2 ? parse_finite(field, separation.decimal_comma) : parse_height(field, separation.decimal_comma);
            if (!value)
              return false;
            *target[n] = *value;
          }
        return n == 3;
      }

    private:
      bool
      is_header(std::string_view text)
      {
        if (text.front() == '#')
          {
            if (header)
              header->read(text, where());
            return true;
          }
        TextHeader ignored;
        return !any_point && (header ? header : &ignored)->read_point_titles(text, where());
      }

      Lines       lines;
      std::string file;
      TextHeader *header;
      Separation  separation;
      bool        any_point = false;
    };

    struct PointGrid
    {
      RegularAxis x, y;
    };

    [[noreturn]] void
    fail_scattered(std::string_view text, const std::string &file, const char *axis_name, double Point::*coordinate,
                   AxisFinder &finder)
    {
      // The first line whose coordinate is far from the axis of the others is of use only if there is such an axis;
      // the number of different values tells what kind of file this is.
      Points points(text, file);
      Point  point;
      points.next(point);
      throw InputError(describe_error("the points do not lie on a regular grid along " + std::string(axis_name) + ".",
                                      points.where() + " and following",
                                      std::to_string(finder.n_different()) + " different values of "
                                          + std::string(axis_name) + ", the first " + units::number(point.*coordinate),
                                      "equal distances, within 1 % of a pixel",
                                      "Interpolate scattered points on a grid first (Gwyddion: Raw XYZ, Rasterize)."));
    }

    PointGrid
    find_grid(std::string_view text, const std::string &file, TextHeader &header, std::size_t &n_points)
    {
      AxisFinder x, y;
      Points     points(text, file, &header);
      for (Point point; points.next(point); ++n_points)
        {
          x.add(point.x);
          y.add(point.y);
        }
      const auto x_axis = x.find();
      if (!x_axis)
        fail_scattered(text, file, "x", &Point::x, x);
      const auto y_axis = y.find();
      if (!y_axis)
        fail_scattered(text, file, "y", &Point::y, y);
      return { *x_axis, *y_axis };
    }

    /// Each point of the grid at most once, and a grid that is mostly there.
    void
    check_occupation(const PointGrid &grid, std::size_t n_points, std::string_view text, const std::string &file)
    {
      if (grid.y.n > 4 * n_points / grid.x.n)
        throw InputError(describe_error(
            "less than a quarter of the regular grid has a point (scattered points?).", file,
            std::to_string(n_points) + " points on " + std::to_string(grid.x.n) + " x " + std::to_string(grid.y.n), "",
            "Interpolate scattered points on a grid first."));
      std::vector<bool> taken(grid.x.n * grid.y.n);
      Points            points(text, file);
      for (Point point; points.next(point);)
        {
          auto seen = taken[grid.y.index(point.y) * grid.x.n + grid.x.index(point.x)];
          if (seen)
            throw InputError(describe_error("a point occurs for the second time.", points.where(),
                                            "x = " + units::number(point.x) + ", y = " + units::number(point.y),
                                            "each point of the grid once"));
          seen = true;
        }
    }

    /// One point a line, `x y z`, on a regular grid, in any order. Points of the grid that are not listed, or listed
    /// with the mark of a missing height, were not measured.
    class XyzReader : public SurfaceReader
    {
    public:
      explicit XyzReader(Parameters &) {}

      /// Three columns and at least four lines: a matrix would be three points wide.
      Match
      recognises(std::string_view content) const override
      {
        const std::string_view text = without_byte_order_mark(content);
        if (text.substr(0, 4096).find('\0') != std::string_view::npos)
          return Match::none;
        Lines            lines(text);
        Separation       separation;
        std::string_view line;
        std::size_t      n_points = 0, n_titles = 0;
        while (n_points < 4 && lines.next(line))
          {
            const auto row = trimmed(line);
            if (row.empty())
              continue;
            if (row.front() == '#')
              {
                if (TextHeader::states_size_of_matrix(row))
                  return Match::none;
                continue;
              }
            if (n_points == 0)
              separation = separation_of(row);
            Point point;
            if (Points::parse(row, separation, point))
              ++n_points;
            else if (n_points > 0 || ++n_titles > 1 || !looks_like_titles(row))
              return Match::none;
          }
        return n_points >= 4 ? Match::likely : Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const std::string_view text = without_byte_order_mark(content);
        TextHeader             header;
        std::size_t            n_points = 0;
        const PointGrid        grid     = find_grid(text, file, header, n_points);
        check_occupation(grid, n_points, text, file);
        RawSurface raw;
        raw.nx    = grid.x.n;
        raw.ny    = grid.y.n;
        raw.pitch = { grid.x.pitch, grid.y.pitch };
        if (const auto unit = header.coordinate_units())
          raw.pixel_size = { grid.x.pitch * (*unit)[0], grid.y.pitch * (*unit)[1] };
        raw.height_unit = header.height_unit();
        raw.heights     = [text, file, grid](const HeightSink &sink) {
          Points points(text, file);
          for (Point point; points.next(point);)
            sink(grid.x.index(point.x), grid.y.index(point.y), point.z);
        };
        return raw;
      }

    private:
      static bool
      looks_like_titles(std::string_view row)
      {
        const auto first = row.find_first_not_of("\"");
        return first != std::string_view::npos && (row[first] == 'x' || row[first] == 'X');
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, XyzReader, "list of points",
                     "XYZ: one point `x y z` a line on a regular grid, in any order; missing points may be left out.",
                     "")
} // namespace tribodraw
