#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <cmath>
#include <limits>

#include "byte_view.h"
#include "sdf_format.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    // Offsets of the header; counts have 2 or 4 bytes, what follows them is shifted accordingly.
    constexpr std::size_t manufacturer = 8, create_date = 18, counts = 42;

    struct Header
    {
      std::size_t    nx = 0, ny = 0;
      double         dx = 0, dy = 0, dz = 0;
      const SdfType *type  = nullptr;
      std::size_t    begin = 0; ///< of the data
    };

    double
    read_scale(const ByteView &view, std::size_t offset, const char *name)
    {
      const double scale = view.number<double>(offset);
      if (!std::isfinite(scale) || scale <= 0.)
        view.fail(std::string("`") + name + "` is not positive and finite", offset, units::number(scale), "",
                  "The format is little-endian, lengths are in m.");
      return scale;
    }

    void
    read_zero(const ByteView &view, std::size_t offset, const char *name)
    {
      if (const unsigned value = view.number<std::uint8_t>(offset); value != 0)
        view.fail(std::string("`") + name + "` is not supported", offset, std::to_string(value), "0");
    }

    Header
    read_header(const ByteView &view, const SdfDialect &dialect)
    {
      Header            header;
      const std::size_t width  = dialect.wide_counts ? 4 : 2;
      const std::size_t scales = counts + 2 * width, codes = scales + 4 * 8;
      header.nx    = dialect.wide_counts ? view.number<std::uint32_t>(counts) : view.number<std::uint16_t>(counts);
      header.ny    = dialect.wide_counts ? view.number<std::uint32_t>(counts + width)
                                         : view.number<std::uint16_t>(counts + width);
      header.dx    = read_scale(view, scales, "Xscale");
      header.dy    = read_scale(view, scales + 8, "Yscale");
      header.dz    = read_scale(view, scales + 16, "Zscale");
      header.begin = codes + 3;
      read_zero(view, codes, "Compression");
      const unsigned code = view.number<std::uint8_t>(codes + 1);
      header.type         = sdf_type(code, dialect);
      if (!header.type)
        view.fail("`DataType` is unknown in this version", codes + 1, std::to_string(code),
                  dialect.bcr ? "0 to 7" : "3 to 7");
      read_zero(view, codes + 2, "CheckType");
      return header;
    }

    /// Nothing or text may follow the data: a trailer. Olympus writes eight bytes more of header.
    void
    check_rest(const ByteView &view, Header &header)
    {
      const std::size_t      end = header.begin + header.nx * header.ny * header.type->bytes;
      const std::string_view olympus("\5\0\0\0\1\0\0\0", 8);
      if (view.size() == end + 8 && view.bytes().substr(header.begin, 8) == olympus)
        {
          header.begin += 8;
          return;
        }
      const auto trailer = view.bytes().substr(end);
      for (std::size_t i = 0; i < trailer.size(); ++i)
        {
          const unsigned char c = static_cast<unsigned char>(trailer[i]);
          if (c == 0x7F || (c < 0x20 && c != '\t' && c != '\r' && c != '\n' && c != 0x1A))
            view.fail("the file is longer than its header says, and what follows is no text", end + i,
                      std::to_string(trailer.size()) + " bytes after the data",
                      std::to_string(header.nx) + " x " + std::to_string(header.ny) + " points");
        }
    }

    /// SDF, binary: header of 81 or 85 bytes, numbers row by row, trailer of text.
    class SdfBinaryReader : public SurfaceReader
    {
    public:
      explicit SdfBinaryReader(Parameters &) {}

      Match
      recognises(std::string_view content) const override
      {
        return SdfDialect::recognise(content, 'b') ? Match::certain : Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const ByteView view(content, "SDF", file);
        const auto     dialect = SdfDialect::recognise(content, 'b').value_or(SdfDialect{});
        Header         header  = read_header(view, dialect);
        view.check_counts(header.nx, header.ny, header.nx * header.type->bytes, header.begin);
        check_rest(view, header);

        RawSurface   raw;
        const double metre = units::factor("m");
        raw.nx             = header.nx;
        raw.ny             = header.ny;
        raw.pixel_size     = { header.dx * metre, header.dy * metre };
        raw.height_unit    = header.dz * metre;
        const auto offset  = [header, dialect](std::size_t ix, std::size_t iy) {
          const std::size_t row = dialect.bcr ? header.ny - 1 - iy : iy;
          return header.begin + header.type->bytes * (row * header.nx + ix);
        };
        raw.heights = [content, header, dialect, offset](const HeightSink &sink) {
          for (std::size_t iy = 0; iy < header.ny; ++iy)
            for (std::size_t ix = 0; ix < header.nx; ++ix)
              {
                const double z = header.type->decode(content.data() + offset(ix, iy));
                sink(ix, iy, header.type->is_missing(z, dialect) ? std::numeric_limits<double>::quiet_NaN() : z);
              }
        };
        raw.place  = [offset](std::size_t ix, std::size_t iy) { return "byte " + std::to_string(offset(ix, iy)); };
        raw.remark = excerpt(view.text(manufacturer, 10)) + " " + excerpt(view.text(create_date, 12));
        return raw;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, SdfBinaryReader, "SDF binary", "SDF 1.0, 2.0 and BCR 1.0, little endian.",
                     "ISO 25178-71")
} // namespace tribodraw
