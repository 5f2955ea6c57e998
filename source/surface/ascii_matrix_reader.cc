#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/surface/surface_reader.h>

#include <cctype>
#include <cstring>

#include "text_header.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    bool
    starts_like_a_number(std::string_view text)
    {
      const auto end = text.find_first_of(" \t,;");
      return std::isdigit(static_cast<unsigned char>(text.front())) || std::strchr("+-.,;", text.front())
             || is_missing_mark(text.substr(0, end));
    }

    std::string
    place(const std::string &file, const Lines &lines)
    {
      return file + ", line " + std::to_string(lines.number());
    }

    /// Lines of numbers, one after another; header lines are handed to @p header if it is given.
    class Rows
    {
    public:
      Rows(std::string_view content, std::string file_name, TextHeader *text_header = nullptr)
          : lines(content), file(std::move(file_name)), header(text_header)
      {
      }

      bool
      next(std::string_view &row)
      {
        while (lines.next(row))
          {
            row = trimmed(row);
            if (row.empty())
              continue;
            const bool is_header
                = row.front() == '#' || (!any_row && !starts_like_a_number(row) && TextHeader::states_known_key(row));
            if (!is_header)
              {
                if (!lines.complete())
                  throw InputError(describe_error("the file ends inside a line (truncated?).", where(),
                                                  "`" + excerpt(row) + "`", "a line end after the last number",
                                                  "If nothing is missing, add a line end."));
                any_row = true;
                return true;
              }
            if (header)
              header->read(row, where());
          }
        return false;
      }

      std::string
      where() const
      {
        return place(file, lines);
      }

    private:
      Lines       lines;
      std::string file;
      TextHeader *header;
      bool        any_row = false;
    };

    /// Numbers separated by blanks, tabulators, `;` or `,`, one line for each row of constant y, from the largest y
    /// down (as the surface is seen from above). `#` starts a comment line.
    class AsciiMatrixReader : public SurfaceReader
    {
    public:
      explicit AsciiMatrixReader(Parameters &) {}

      Match
      recognises(std::string_view content) const override
      {
        const std::string_view text = without_byte_order_mark(content);
        if (text.substr(0, 4096).find('\0') != std::string_view::npos)
          return Match::none;
        Lines            lines(text);
        std::string_view line;
        while (lines.next(line))
          if (const auto start = trimmed(line); !start.empty() && start.front() != '#')
            {
              if (starts_like_a_number(start))
                return Match::plausible;
              if (!TextHeader::states_known_key(start))
                return Match::none;
            }
        return Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const std::string_view text = without_byte_order_mark(content);
        TextHeader             header;
        RawSurface             raw;
        Separation             separation;
        Rows                   rows(text, file, &header);
        for (std::string_view row; rows.next(row); ++raw.ny)
          {
            if (raw.ny == 0)
              separation = separation_of(row);
            const std::size_t n = count_fields(row, separation);
            // A separator at the end of a row stands before an empty field, which is a missing point, or means nothing.
            const bool last_is_missing = separation.separator && row.back() == separation.separator && n + 1 == raw.nx;
            if (raw.ny > 0 && n != raw.nx && !last_is_missing)
              throw InputError(describe_error("the rows of the text matrix differ in length (truncated file?).",
                                              rows.where(), std::to_string(n) + " numbers",
                                              std::to_string(raw.nx) + " as in the first row"));
            if (raw.ny == 0)
              raw.nx = n;
          }
        raw.pixel_size  = header.pixel_size(raw.nx, raw.ny, file);
        raw.height_unit = header.height_unit();
        raw.heights     = [text, file, separation, ny = raw.ny](const HeightSink &sink) {
          Rows all(text, file);
          for (std::size_t iy = ny; iy-- > 0;)
            if (std::string_view row; all.next(row))
              read_row(row, separation, iy, all, sink);
        };
        return raw;
      }

    private:
      static std::size_t
      count_fields(std::string_view row, const Separation &separation)
      {
        Fields           fields(row, separation);
        std::string_view field;
        std::size_t      n = 0;
        while (fields.next(field))
          ++n;
        return n;
      }

      static void
      read_row(std::string_view row, const Separation &separation, std::size_t iy, const Rows &rows,
               const HeightSink &sink)
      {
        Fields           fields(row, separation);
        std::string_view field;
        for (std::size_t ix = 0; fields.next(field); ++ix)
          {
            const auto value = parse_height(field, separation.decimal_comma);
            if (!value)
              throw InputError(
                  describe_error("not a finite number in the text matrix.",
                                 rows.where() + ", column " + std::to_string(ix + 1), "`" + excerpt(field) + "`", "",
                                 "Separate all numbers alike; decimal commas need another separator than commas."));
            sink(ix, iy, *value);
          }
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, AsciiMatrixReader, "text matrix",
                     "Numbers in rows, separated by blanks, tabulators, semicolons or commas; `#` starts a comment.",
                     "")
} // namespace tribodraw
