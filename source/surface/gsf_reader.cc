#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "byte_view.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    constexpr std::string_view magic = "Gwyddion Simple Field 1.0";
    // Far more than the handful of fields of the format.
    constexpr std::size_t longest_header = 1 << 20;

    [[noreturn]] void
    fail(const std::string &what, const std::string &where, const std::string &value = "",
         const std::string &allowed = "")
    {
      throw InputError(describe_error("GSF: " + what, where, value, allowed));
    }

    struct Field
    {
      std::string value;
      std::string where; ///< file and line
    };

    struct Header
    {
      std::map<std::string, Field> fields;
      std::size_t                  data_begin = 0;
    };

    Header
    read_header(std::string_view content, const std::string &file)
    {
      const auto end = content.substr(0, longest_header).find('\0');
      if (end == std::string_view::npos)
        fail("the header is not ended by a zero byte (truncated file?).", file,
             "none in " + std::to_string(std::min(content.size(), longest_header)) + " bytes");
      Header header;
      // One to four zero bytes bring the data to a multiple of four.
      header.data_begin = (end / 4 + 1) * 4;
      for (std::size_t i = end; i < header.data_begin; ++i)
        if (i >= content.size() || content[i] != '\0')
          fail("the header is not padded with zero bytes to a multiple of four.", file + ", byte " + std::to_string(i));
      Lines            lines(content.substr(0, end));
      std::string_view text;
      lines.next(text); // the mark of the format
      while (lines.next(text))
        {
          if (trimmed(text).empty())
            continue;
          const auto        equals = text.find('=');
          const std::string where  = file + ", line " + std::to_string(lines.number());
          if (equals == std::string_view::npos)
            fail("a header line is not of the form `Name = value`.", where, "`" + excerpt(text) + "`");
          const std::string name(trimmed(text.substr(0, equals)));
          if (!header.fields.emplace(name, Field{ std::string(trimmed(text.substr(equals + 1))), where }).second)
            fail("a header field occurs twice.", where, "`" + excerpt(name) + "`");
        }
      return header;
    }

    std::size_t
    read_count(const Header &header, const std::string &name, const std::string &file)
    {
      const auto found = header.fields.find(name);
      if (found == header.fields.end())
        fail("the header field `" + name + "` is missing.", file);
      const auto value = parse_count(found->second.value);
      if (!value || *value == 0)
        fail("`" + name + "` is not a positive integer.", found->second.where,
             "`" + excerpt(found->second.value) + "`");
      return *value;
    }

    /// Total length along an axis in its unit, or nothing if not stated. The format's own default (1.0) would be a
    /// guess.
    std::optional<double>
    read_length(const Header &header, const std::string &name)
    {
      const auto found = header.fields.find(name);
      if (found == header.fields.end())
        return {};
      const auto value = parse_finite(found->second.value);
      if (!value || *value <= 0.)
        fail("`" + name + "` is not a positive number.", found->second.where, "`" + excerpt(found->second.value) + "`");
      return value;
    }

    std::optional<double>
    read_unit(const Header &header, const std::string &name)
    {
      const auto found = header.fields.find(name);
      if (found == header.fields.end() || found->second.value.empty())
        return {};
      const auto unit = length_unit(found->second.value);
      if (!unit)
        fail("`" + name + "` is not a unit of length.", found->second.where, "`" + excerpt(found->second.value) + "`",
             "m, mm, um, nm");
      return unit;
    }

    /// Gwyddion Simple Field: the line `Gwyddion Simple Field 1.0`, lines `Name = value` (XRes, YRes, XReal, YReal:
    /// total lengths, XYUnits, ZUnits, ...), 1 to 4 zero bytes up to a multiple of four, then XRes * YRes 32-bit
    /// floating point numbers, little endian, row by row from the top. NaN marks missing points.
    class GsfReader : public SurfaceReader
    {
    public:
      explicit GsfReader(Parameters &) {}

      Match
      recognises(std::string_view content) const override
      {
        const bool match = content.substr(0, magic.size()) == magic && content.size() > magic.size()
                           && (content[magic.size()] == '\n' || content[magic.size()] == '\r');
        return match ? Match::certain : Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const Header      header = read_header(content, file);
        const std::size_t begin  = header.data_begin;
        RawSurface        raw;
        raw.nx = read_count(header, "XRes", file);
        raw.ny = read_count(header, "YRes", file);
        check_size(raw, content.size() - begin, file + ", byte " + std::to_string(begin));

        const auto width = read_length(header, "XReal"), height = read_length(header, "YReal");
        const auto unit = read_unit(header, "XYUnits");
        if (width && height && unit)
          raw.pixel_size
              = { *width * *unit / static_cast<double>(raw.nx), *height * *unit / static_cast<double>(raw.ny) };
        raw.height_unit = read_unit(header, "ZUnits");
        if (const auto title = header.fields.find("Title"); title != header.fields.end())
          raw.remark = excerpt(title->second.value, 200);

        const auto offset = [begin, nx = raw.nx, ny = raw.ny](std::size_t ix, std::size_t iy) {
          return begin + 4 * ((ny - 1 - iy) * nx + ix);
        };
        raw.heights = [content, offset, nx = raw.nx, ny = raw.ny](const HeightSink &sink) {
          for (std::size_t iy = ny; iy-- > 0;)
            for (std::size_t ix = 0; ix < nx; ++ix)
              sink(ix, iy, decode_to_double<float>(content.data() + offset(ix, iy)));
        };
        raw.place = [offset](std::size_t ix, std::size_t iy) { return "byte " + std::to_string(offset(ix, iy)); };
        return raw;
      }

    private:
      static void
      check_size(const RawSurface &raw, std::size_t n_bytes, const std::string &where)
      {
        const std::size_t n_points = n_bytes / 4;
        const std::string allowed  = std::to_string(raw.nx) + " x " + std::to_string(raw.ny) + " points of 4 bytes";
        // Division, because the product of hostile counts may overflow.
        if (raw.ny > n_points / raw.nx)
          fail("the file is shorter than its header says (truncated file?).", where,
               std::to_string(n_bytes) + " bytes of data", allowed);
        if (n_bytes != 4 * raw.nx * raw.ny)
          fail("the file is longer than its header says.", where, std::to_string(n_bytes) + " bytes of data", allowed);
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, GsfReader, "Gwyddion Simple Field",
                     "GSF: text header and 32-bit floating point heights.", "Gwyddion user guide, file format GSF")
} // namespace tribodraw
