#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

namespace tribodraw
{
  namespace
  {
    std::string_view
    trimmed(std::string_view text)
    {
      const char *blanks = " \t\r";
      const auto  first  = text.find_first_not_of(blanks);
      return first == std::string_view::npos ? std::string_view()
                                             : text.substr(first, text.find_last_not_of(blanks) - first + 1);
    }

    std::string
    lower(std::string_view text)
    {
      std::string result(text);
      std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
      return result;
    }

    std::string_view
    without_byte_order_mark(std::string_view content)
    {
      return content.substr(0, 3) == "\xEF\xBB\xBF" ? content.substr(3) : content;
    }

    bool
    is_missing_mark(std::string_view field)
    {
      const std::string text = lower(field);
      return text.empty() || text == "bad" || text == "nan" || text == "***" || text == "---";
    }

    /// The whole field as a number (NaN for the marks of a missing point), or nothing.
    std::optional<double>
    parse_number(std::string_view field)
    {
      if (is_missing_mark(field))
        return std::numeric_limits<double>::quiet_NaN();
      if (field.front() == '+')
        field.remove_prefix(1);
      double value            = 0;
      const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
      if (error != std::errc() || end != field.data() + field.size())
        return {};
      return value;
    }

    /// Cuts a text at line ends and counts the lines.
    class Lines
    {
    public:
      explicit Lines(std::string_view content) : rest(content) {}

      bool
      next(std::string_view &line)
      {
        if (rest.empty())
          return false;
        const auto end = rest.find('\n');
        line           = trimmed_right(rest.substr(0, end));
        rest           = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
        ++count;
        return true;
      }
      std::size_t
      number() const
      {
        return count;
      }

    private:
      static std::string_view
      trimmed_right(std::string_view line)
      {
        return !line.empty() && line.back() == '\r' ? line.substr(0, line.size() - 1) : line;
      }

      std::string_view rest;
      std::size_t      count = 0;
    };

    /// Numbers of one line. The separator is `;` or `,` if the line has one, else a tabulator, else blanks.
    void
    split(std::string_view line, std::vector<std::string_view> &fields)
    {
      fields.clear();
      char separator = 0;
      for (const char candidate : { ';', ',', '\t' })
        if (!separator && line.find(candidate) != std::string_view::npos)
          separator = candidate;
      // Blanks and tabulators at the ends are no empty fields; one separator may end the line.
      line = trimmed(line);
      if (separator && !line.empty() && line.back() == separator)
        line.remove_suffix(1);
      while (!line.empty())
        {
          const auto end = separator ? line.find(separator) : line.find_first_of(" \t");
          fields.push_back(trimmed(line.substr(0, end)));
          if (end == std::string_view::npos)
            return;
          line.remove_prefix(end + 1);
          if (!separator)
            line = trimmed(line);
          else if (line.empty())
            fields.emplace_back();
        }
    }

    /// What comment lines say about the size of the map: `# Width: 2 mm`, `# Height: 2 mm`, `# Value units: um`.
    struct Comments
    {
      std::optional<double> width, height, value_unit;

      void
      read(std::string_view comment, const std::string &where)
      {
        const auto colon = comment.find(':');
        if (colon == std::string_view::npos)
          return;
        const std::string key   = lower(trimmed(comment.substr(0, colon)));
        const auto        value = trimmed(comment.substr(colon + 1));
        if (key == "width")
          set(width, length(value, where), where);
        else if (key == "height")
          set(height, length(value, where), where);
        else if (key == "value units")
          {
            const auto unit = length_unit(std::string(value));
            if (!unit)
              throw InputError(describe_error("`Value units` is not a unit of length.", where,
                                              "`" + std::string(value) + "`", "m, mm, um, nm"));
            set(value_unit, *unit, where);
          }
      }

    private:
      static void
      set(std::optional<double> &entry, double value, const std::string &where)
      {
        if (entry)
          throw InputError(describe_error("a comment line states a scale for the second time.", where));
        entry = value;
      }

      static double
      length(std::string_view text, const std::string &where)
      {
        const auto blank  = text.find_first_of(" \t");
        const auto number = parse_number(text.substr(0, blank));
        const auto unit   = blank == std::string_view::npos ? std::optional<double>()
                                                            : length_unit(std::string(trimmed(text.substr(blank))));
        if (!number || !unit || !std::isfinite(*number) || *number <= 0.)
          throw InputError(describe_error("the size of the map is not a positive length with unit.", where,
                                          "`" + std::string(text.substr(0, 60)) + "`", "such as `2 mm`"));
        return *number * *unit;
      }
    };

    /// Numbers separated by blanks, tabulators, `;` or `,`, one line for each row of constant y, from the largest y
    /// down (as the surface is seen from above). `#` starts a comment line.
    class AsciiMatrixReader : public SurfaceReader
    {
    public:
      explicit AsciiMatrixReader(Parameters &) {}

      Match
      recognises(const std::string &content) const override
      {
        const std::string_view text = without_byte_order_mark(content);
        if (text.substr(0, 4096).find('\0') != std::string_view::npos)
          return Match::none;
        Lines            lines(text);
        std::string_view line;
        while (lines.next(line))
          if (const auto start = trimmed(line); !start.empty() && start.front() != '#')
            return starts_like_a_number(start) ? Match::plausible : Match::none;
        return Match::none;
      }

      RawSurface
      read(const std::string &content, const std::string &file) const override
      {
        RawSurface                    raw;
        Comments                      comments;
        Lines                         lines(without_byte_order_mark(content));
        std::string_view              line;
        std::vector<std::string_view> fields;
        while (lines.next(line))
          {
            const auto text = trimmed(line);
            if (text.empty())
              continue;
            if (text.front() == '#')
              comments.read(text.substr(1), place(file, lines));
            else
              {
                split(line, fields);
                add_row(fields, place(file, lines), raw);
              }
          }
        turn_upside_down(raw);
        if (comments.width && comments.height && raw.nx > 0 && raw.ny > 0)
          raw.pixel_size
              = { *comments.width / static_cast<double>(raw.nx), *comments.height / static_cast<double>(raw.ny) };
        raw.height_unit = comments.value_unit;
        return raw;
      }

    private:
      static bool
      starts_like_a_number(std::string_view text)
      {
        const auto end = text.find_first_of(" \t,;");
        return std::isdigit(static_cast<unsigned char>(text.front())) || std::strchr("+-.,;", text.front())
               || is_missing_mark(text.substr(0, end));
      }

      static std::string
      place(const std::string &file, const Lines &lines)
      {
        return file + ", line " + std::to_string(lines.number());
      }

      static void
      add_row(const std::vector<std::string_view> &fields, const std::string &where, RawSurface &raw)
      {
        if (raw.ny > 0 && fields.size() != raw.nx)
          throw InputError(describe_error("the rows of the text matrix differ in length (truncated file?).", where,
                                          std::to_string(fields.size()) + " numbers",
                                          std::to_string(raw.nx) + " as in the first row"));
        raw.nx = fields.size();
        ++raw.ny;
        for (std::size_t i = 0; i < fields.size(); ++i)
          {
            const auto value = parse_number(fields[i]);
            if (!value)
              throw InputError(
                  describe_error("not a number in the text matrix.", where + ", column " + std::to_string(i + 1),
                                 "`" + std::string(fields[i].substr(0, 40)) + "`", "",
                                 "Separate all numbers alike and write decimal points, not decimal commas."));
            raw.z.push_back(*value);
          }
      }

      static void
      turn_upside_down(RawSurface &raw)
      {
        for (std::size_t iy = 0; iy < raw.ny / 2; ++iy)
          std::swap_ranges(raw.z.begin() + iy * raw.nx, raw.z.begin() + (iy + 1) * raw.nx,
                           raw.z.begin() + (raw.ny - 1 - iy) * raw.nx);
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, AsciiMatrixReader, "text matrix",
                     "Numbers in rows, separated by blanks, tabulators, semicolons or commas; `#` starts a comment.",
                     "")
} // namespace tribodraw
