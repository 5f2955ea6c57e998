#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <cmath>
#include <limits>
#include <map>

#include "sdf_format.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    [[noreturn]] void
    fail(const std::string &what, const std::string &where, const std::string &value = "",
         const std::string &allowed = "", const std::string &hint = "")
    {
      throw InputError(describe_error("SDF: " + what, where, value, allowed, hint));
    }

    struct Header
    {
      std::size_t    nx = 0, ny = 0;
      double         dx = 0, dy = 0, dz = 0;
      const SdfType *type       = nullptr;
      std::size_t    first_line = 0; ///< of the data, from 1
      std::size_t    begin      = 0; ///< of the data, byte
      std::string    remark;
    };

    /// Header lines `Name = value` up to a line with an asterisk.
    class HeaderLines
    {
    public:
      HeaderLines(std::string_view content, std::string file_name) : file(std::move(file_name))
      {
        Lines            lines(content);
        std::string_view line;
        lines.next(line);
        if (trimmed(line).size() != 8)
          fail("text follows the mark of the format.", where(1), "`" + excerpt(line) + "`");
        while (lines.next(line))
          {
            const auto text = trimmed(line);
            if (text == "*")
              {
                data_line  = lines.number() + 1;
                data_begin = static_cast<std::size_t>(line.data() + line.size() - content.data());
                return;
              }
            if (text.empty() || text.front() == ';')
              continue;
            const auto equals = text.find('=');
            if (equals == std::string_view::npos || equals > 200 || lines.number() > 1000)
              fail("a header line is not of the form `Name = value`.", where(lines.number()), "`" + excerpt(text) + "`",
                   "", "A line with an asterisk ends the header.");
            const std::string name = lower(trimmed(text.substr(0, equals)));
            if (!fields.emplace(name, Field{ trimmed(text.substr(equals + 1)), lines.number() }).second)
              fail("a header field occurs twice.", where(lines.number()), "`" + excerpt(name) + "`");
          }
        fail("the header is not ended by a line with an asterisk (truncated file?).", where(lines.number()));
      }

      std::string_view
      text(const std::string &name) const
      {
        const auto found = fields.find(lower(name));
        return found == fields.end() ? std::string_view() : found->second.value;
      }

      std::size_t
      count(const std::string &name) const
      {
        const Field &field = find(name);
        const auto   value = parse_count(field.value);
        if (!value || *value == 0)
          fail("`" + name + "` is not a positive integer.", where(field.line), "`" + excerpt(field.value) + "`");
        return *value;
      }

      double
      scale(const std::string &name) const
      {
        const Field &field = find(name);
        const auto   value = parse_finite(field.value);
        if (!value || *value <= 0.)
          fail("`" + name + "` is not a positive number.", where(field.line), "`" + excerpt(field.value) + "`");
        return *value;
      }

      void
      zero(const std::string &name) const
      {
        const Field &field = find(name);
        if (parse_count(field.value) != std::size_t(0))
          fail("`" + name + "` is not supported.", where(field.line), "`" + excerpt(field.value) + "`", "0");
      }

      const SdfType *
      type(const SdfDialect &dialect) const
      {
        const Field   &field = find("DataType");
        const auto     code  = parse_count(field.value);
        const SdfType *found = code && *code < 256 ? sdf_type(static_cast<unsigned>(*code), dialect) : nullptr;
        if (!found)
          fail("`DataType` is unknown in this version.", where(field.line), "`" + excerpt(field.value) + "`",
               dialect.bcr ? "0 to 7" : "3 to 7");
        return found;
      }

      std::size_t data_line = 0, data_begin = 0;

    private:
      struct Field
      {
        std::string_view value;
        std::size_t      line;
      };

      std::string
      where(std::size_t line) const
      {
        return file + ", line " + std::to_string(line);
      }

      const Field &
      find(const std::string &name) const
      {
        const auto found = fields.find(lower(name));
        if (found == fields.end())
          fail("the header field `" + name + "` is missing.", where(data_line - 1));
        return found->second;
      }

      std::string                  file;
      std::map<std::string, Field> fields;
    };

    Header
    read_header(std::string_view content, const std::string &file, const SdfDialect &dialect)
    {
      const HeaderLines lines(content, file);
      Header            header;
      header.nx         = lines.count("NumPoints");
      header.ny         = lines.count("NumProfiles");
      header.dx         = lines.scale("Xscale");
      header.dy         = lines.scale("Yscale");
      header.dz         = lines.scale("Zscale");
      header.type       = lines.type(dialect);
      header.first_line = lines.data_line;
      header.begin      = lines.data_begin;
      header.remark     = excerpt(lines.text("ManufacID")) + " " + excerpt(lines.text("CreateDate"));
      lines.zero("Compression");
      lines.zero("CheckType");
      return header;
    }

    /// Numbers between blanks and line ends, with the line in which they stand.
    class Tokens
    {
    public:
      Tokens(std::string_view data, std::size_t first_line) : rest(data), line_number(first_line - 1) {}

      /// @return false at the end of the text.
      bool
      next(std::string_view &token)
      {
        while (!rest.empty() && is_blank(rest.front()))
          {
            line_number += rest.front() == '\n';
            rest.remove_prefix(1);
          }
        std::size_t n = 0;
        while (n < rest.size() && !is_blank(rest[n]))
          ++n;
        token = rest.substr(0, n);
        rest.remove_prefix(n);
        return n > 0;
      }

      bool
      at_end_of_file() const
      {
        return rest.empty();
      }

      std::size_t
      line() const
      {
        return line_number;
      }

    private:
      static bool
      is_blank(char c)
      {
        return c == ' ' || c == '\t' || c == '\r' || c == '\n';
      }

      std::string_view rest;
      std::size_t      line_number;
    };

    class Data
    {
    public:
      Data(std::string_view all, std::string file_name, const Header &head, const SdfDialect &kind)
          : content(all), file(std::move(file_name)), header(head), dialect(kind)
      {
      }

      void
      operator()(const HeightSink &sink) const
      {
        Tokens tokens(content.substr(header.begin), header.first_line);
        for (std::size_t row = 0; row < header.ny; ++row)
          for (std::size_t ix = 0; ix < header.nx; ++ix)
            sink(ix, dialect.bcr ? header.ny - 1 - row : row, read(tokens, row * header.nx + ix));
        std::string_view token;
        if (tokens.next(token) && token.front() != '*')
          fail("more numbers than the header says.", where(tokens), "`" + excerpt(token) + "`", expected());
      }

    private:
      double
      read(Tokens &tokens, std::size_t n_before) const
      {
        std::string_view token;
        if (!tokens.next(token) || token.front() == '*' || tokens.at_end_of_file())
          fail("fewer numbers than the header says (truncated file?).", where(tokens),
               std::to_string(n_before) + " complete numbers", expected());
        if (lower(token.substr(0, 4)) == "bad")
          return std::numeric_limits<double>::quiet_NaN();
        const auto value = parse_finite(token);
        if (!value)
          fail("neither a finite number nor `BAD`.", where(tokens), "`" + excerpt(token) + "`");
        if (!header.type->is_float && !(*value >= header.type->lowest && *value <= header.type->highest))
          fail("a height is outside the range of `DataType`.", where(tokens), "`" + excerpt(token) + "`",
               units::number(header.type->lowest) + " to " + units::number(header.type->highest));
        return header.type->is_missing(*value, dialect) ? std::numeric_limits<double>::quiet_NaN() : *value;
      }

      std::string
      where(const Tokens &tokens) const
      {
        return file + ", line " + std::to_string(tokens.line());
      }

      std::string
      expected() const
      {
        return std::to_string(header.nx) + " x " + std::to_string(header.ny);
      }

      std::string_view content;
      std::string      file;
      Header           header;
      SdfDialect       dialect;
    };

    /// SDF, text: header lines, a line `*`, numbers between blanks, a line `*`, a trailer that is not read.
    class SdfTextReader : public SurfaceReader
    {
    public:
      explicit SdfTextReader(Parameters &) {}

      Match
      recognises(std::string_view content) const override
      {
        return SdfDialect::recognise(without_byte_order_mark(content), 'a') ? Match::certain : Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const std::string_view text    = without_byte_order_mark(content);
        const auto             dialect = SdfDialect::recognise(text, 'a').value_or(SdfDialect{});
        const Header           header  = read_header(text, file, dialect);
        // Each number takes a character and a blank.
        if (header.ny > text.size() / 2 / header.nx)
          fail("the file is shorter than its header says (truncated file?).",
               file + ", line " + std::to_string(header.first_line), std::to_string(text.size()) + " bytes",
               std::to_string(header.nx) + " x " + std::to_string(header.ny) + " numbers");
        RawSurface   raw;
        const double metre = units::factor("m");
        raw.nx             = header.nx;
        raw.ny             = header.ny;
        raw.pixel_size     = { header.dx * metre, header.dy * metre };
        raw.height_unit    = header.dz * metre;
        raw.heights        = Data(text, file, header, dialect);
        raw.remark         = header.remark;
        return raw;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, SdfTextReader, "SDF text", "SDF 1.0, 2.0 and BCR 1.0, as text.", "ISO 25178-71")
} // namespace tribodraw
