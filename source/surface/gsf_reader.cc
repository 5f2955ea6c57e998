#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/surface/surface_reader.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

namespace tribodraw
{
  namespace
  {
    const std::string magic = "Gwyddion Simple Field 1.0";

    [[noreturn]] void
    fail(const std::string &what, const std::string &file, const std::string &value = "",
         const std::string &allowed = "")
    {
      throw InputError(describe_error(what, file, value, allowed));
    }

    std::string
    trimmed(const std::string &text)
    {
      const char *blanks = " \t\r";
      const auto  first  = text.find_first_not_of(blanks);
      return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
    }

    struct Header
    {
      std::map<std::string, std::string> fields;
      std::size_t                        data_begin = 0;
    };

    Header
    read_header(const std::string &content, const std::string &file)
    {
      const auto end = content.find('\0');
      if (end == std::string::npos)
        fail("GSF: the header is not ended by a zero byte (truncated file?).", file);
      Header header;
      // One to four zero bytes bring the data to a multiple of four.
      header.data_begin = (end / 4 + 1) * 4;
      for (std::size_t i = end; i < header.data_begin; ++i)
        if (i >= content.size() || content[i] != '\0')
          fail("GSF: the header is not padded with zero bytes to a multiple of four.", file,
               "byte " + std::to_string(i));
      for (std::size_t begin = content.find('\n') + 1, line = 2; begin < end; ++line)
        {
          const std::size_t stop = std::min(content.find('\n', begin), end);
          const std::string text = content.substr(begin, stop - begin);
          begin                  = stop + 1;
          if (trimmed(text).empty())
            continue;
          const auto        equals = text.find('=');
          const std::string where  = file + ", line " + std::to_string(line);
          if (equals == std::string::npos)
            fail("GSF: a header line is not of the form `Name = value`.", where, "`" + text.substr(0, 60) + "`");
          if (!header.fields.emplace(trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))).second)
            fail("GSF: a header field occurs twice.", where, "`" + trimmed(text.substr(0, equals)) + "`");
        }
      return header;
    }

    std::size_t
    read_count(const Header &header, const std::string &name, const std::string &file)
    {
      const auto found = header.fields.find(name);
      if (found == header.fields.end())
        fail("GSF: the header field `" + name + "` is missing.", file);
      const std::string &text  = found->second;
      std::size_t        value = 0;
      const auto [end, error]  = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || end != text.data() + text.size() || value == 0)
        fail("GSF: `" + name + "` is not a positive integer.", file, "`" + text + "`");
      return value;
    }

    /// Total length along an axis in its unit, or nothing if not stated. The format's own default (1.0) would be a
    /// guess.
    std::optional<double>
    read_length(const Header &header, const std::string &name, const std::string &file)
    {
      const auto found = header.fields.find(name);
      if (found == header.fields.end())
        return {};
      const std::string &text  = found->second;
      double             value = 0;
      const auto [end, error]  = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value) || value <= 0.)
        fail("GSF: `" + name + "` is not a positive number.", file, "`" + text + "`");
      return value;
    }

    std::optional<double>
    read_unit(const Header &header, const std::string &name, const std::string &file)
    {
      const auto found = header.fields.find(name);
      if (found == header.fields.end() || found->second.empty())
        return {};
      const auto unit = length_unit(found->second);
      if (!unit)
        fail("GSF: `" + name + "` is not a unit of length.", file, "`" + found->second + "`", "m, mm, um, nm");
      return unit;
    }

    float
    read_float(const char *bytes)
    {
      std::uint32_t bits = 0; // little endian, whatever this machine is
      for (int i = 3; i >= 0; --i)
        bits = (bits << 8) | static_cast<unsigned char>(bytes[i]);
      float value;
      std::memcpy(&value, &bits, sizeof(value));
      return value;
    }

    /// Gwyddion Simple Field: the line `Gwyddion Simple Field 1.0`, lines `Name = value` (XRes, YRes, XReal, YReal:
    /// total lengths, XYUnits, ZUnits, ...), 1 to 4 zero bytes up to a multiple of four, then XRes * YRes 32-bit
    /// floating point numbers, little endian, row by row from the top. NaN marks missing points.
    class GsfReader : public SurfaceReader
    {
    public:
      explicit GsfReader(Parameters &) {}

      Match
      recognises(const std::string &content) const override
      {
        const bool match = content.compare(0, magic.size(), magic) == 0 && content.size() > magic.size()
                           && (content[magic.size()] == '\n' || content[magic.size()] == '\r');
        return match ? Match::certain : Match::none;
      }

      RawSurface
      read(const std::string &content, const std::string &file) const override
      {
        const Header header = read_header(content, file);
        RawSurface   raw;
        raw.nx = read_count(header, "XRes", file);
        raw.ny = read_count(header, "YRes", file);
        check_size(raw, content.size() - header.data_begin, file);

        const auto width = read_length(header, "XReal", file), height = read_length(header, "YReal", file);
        const auto unit = read_unit(header, "XYUnits", file);
        if (width && height && unit)
          raw.pixel_size
              = { *width * *unit / static_cast<double>(raw.nx), *height * *unit / static_cast<double>(raw.ny) };
        raw.height_unit = read_unit(header, "ZUnits", file);

        raw.z.resize(raw.nx * raw.ny);
        for (std::size_t row = 0; row < raw.ny; ++row)
          for (std::size_t ix = 0; ix < raw.nx; ++ix)
            raw.z[(raw.ny - 1 - row) * raw.nx + ix]
                = read_float(content.data() + header.data_begin + 4 * (row * raw.nx + ix));
        return raw;
      }

    private:
      static void
      check_size(const RawSurface &raw, std::size_t n_bytes, const std::string &file)
      {
        const std::size_t n_points = n_bytes / 4;
        // Division, because the product of hostile counts may overflow.
        if (raw.ny > n_points / raw.nx)
          fail("GSF: the file is shorter than its header says (truncated file?).", file,
               std::to_string(n_bytes) + " bytes of data",
               std::to_string(raw.nx) + " x " + std::to_string(raw.ny) + " points of 4 bytes");
        if (n_bytes != 4 * raw.nx * raw.ny)
          fail("GSF: the file is longer than its header says.", file, std::to_string(n_bytes) + " bytes of data",
               std::to_string(raw.nx) + " x " + std::to_string(raw.ny) + " points of 4 bytes");
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, GsfReader, "Gwyddion Simple Field",
                     "GSF: text header and 32-bit floating point heights.", "Gwyddion user guide, file format GSF")
} // namespace tribodraw
