#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>
#include <zlib.h>

#include "byte_view.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    constexpr std::string_view plain_magic = "DIGITAL SURF", compressed_magic = "DSCOMPRESSED";
    constexpr std::size_t      header_bytes = 512;
    // Deflate cannot shrink anything more than that.
    constexpr std::size_t most_compression = 1032;
    constexpr std::size_t most_blocks      = 1 << 16;

    // Offsets of the header.
    namespace at
    {
      constexpr std::size_t format = 12, objects = 14, type = 18, name = 20, special_points = 86, bits = 98,
                            z_min = 100, nx = 108, ny = 112, n_points = 116, dx = 120, dy = 124, dz = 128,
                            dx_unit = 180, dy_unit = 196, dz_unit = 212, comment_length = 334, private_length = 336,
                            z_offset = 474;
    } // namespace at

    struct Header
    {
      bool        compressed = false;
      std::size_t nx = 0, ny = 0, bytes = 0, begin = 0;
      double      dz = 0, z_offset = 0;
      double      lowest = -std::numeric_limits<double>::infinity(); ///< stored values below it were not measured
    };

    double
    read_step(const ByteView &view, std::size_t offset, const char *name)
    {
      const double step = view.number<float>(offset);
      if (!std::isfinite(step) || step <= 0.)
        view.fail(std::string("the ") + name + " is not positive and finite", offset, units::number(step));
      return step;
    }

    /// Unit of a step in mm; nothing if none is stated.
    std::optional<double>
    read_unit(const ByteView &view, std::size_t offset)
    {
      const std::string text = view.text(offset, 16);
      if (text.empty())
        return {};
      const auto unit = length_unit(text);
      if (!unit)
        view.fail("not a unit of length", offset, "`" + excerpt(text) + "`", "m, mm, um, nm");
      return unit;
    }

    std::size_t
    read_count(const ByteView &view, std::size_t offset, const char *name)
    {
      const auto count = view.number<std::int32_t>(offset);
      if (count <= 0)
        view.fail(std::string("the ") + name + " is not positive", offset, std::to_string(count));
      return static_cast<std::size_t>(count);
    }

    void
    check_kind(const ByteView &view)
    {
      if (const int format = view.number<std::int16_t>(at::format); format != 0)
        view.fail("the byte order is not the one of PCs", at::format, std::to_string(format), "0");
      // 1: profile (Gwyddion writes it for surfaces), 2: surface, 5: series of surfaces, 8: layers, 11, 13, 16: surface
      // with pictures
      const int  type  = view.number<std::int16_t>(at::type);
      const auto kinds = { 1, 2, 5, 8, 11, 13, 16 };
      if (std::find(kinds.begin(), kinds.end(), type) == kinds.end())
        view.fail("the file does not hold a surface", at::type, "object type " + std::to_string(type),
                  "1, 2, 5, 8, 11, 13, 16");
    }

    Header
    read_header(const ByteView &view)
    {
      view.at(0, header_bytes);
      check_kind(view);
      Header header;
      header.compressed = view.bytes().substr(0, compressed_magic.size()) == compressed_magic;
      const int bits    = view.number<std::int16_t>(at::bits);
      if (bits != 16 && bits != 32)
        view.fail("the number of bits of a point is unknown", at::bits, std::to_string(bits), "16 or 32");
      header.bytes           = static_cast<std::size_t>(bits) / 8;
      header.nx              = read_count(view, at::nx, "number of points of a line");
      header.ny              = read_count(view, at::ny, "number of lines");
      const std::size_t both = read_count(view, at::n_points, "number of points");
      if (both != header.nx * header.ny)
        view.fail("the number of points is not that of the lines", at::n_points, std::to_string(both),
                  std::to_string(header.nx) + " x " + std::to_string(header.ny));
      header.begin = header_bytes + view.number<std::uint16_t>(at::comment_length)
                     + view.number<std::uint16_t>(at::private_length);
      header.dz       = read_step(view, at::dz, "step of the heights");
      header.z_offset = view.number<float>(at::z_offset);
      if (!std::isfinite(header.z_offset))
        view.fail("the offset of the heights is not finite", at::z_offset, units::number(header.z_offset));
      if (view.number<std::int16_t>(at::special_points) == 1)
        header.lowest = view.number<std::int32_t>(at::z_min);
      return header;
    }

    /// Streams of compressed data, one after another: the list of their lengths, then the streams.
    class Directory
    {
    public:
      struct Stream
      {
        std::size_t begin, compressed, raw;
      };

      /// @param view must live on only during the call.
      Directory(const ByteView &view, std::size_t begin, std::size_t n_bytes)
      {
        const std::size_t n = view.number<std::uint32_t>(begin), list = begin + 4;
        // Programs write one block or a few; the limit keeps hostile lists small.
        if (n == 0 || n > most_blocks || n > (view.size() - list) / 8)
          view.fail("the list of compressed blocks is empty or longer than the file", begin, std::to_string(n),
                    "1 to " + std::to_string(most_blocks));
        std::size_t position = list + 8 * n, total = 0;
        for (std::size_t i = 0; i < n; ++i)
          {
            const std::size_t raw    = view.number<std::uint32_t>(list + 8 * i),
                              length = view.number<std::uint32_t>(list + 8 * i + 4);
            if (length > view.size() - position)
              view.fail("a compressed block is longer than the file (truncated?)", list + 8 * i + 4,
                        std::to_string(length) + " bytes", std::to_string(view.size() - position));
            if (raw > most_compression * (length + 1))
              view.fail("a compressed block claims to hold more than is possible", list + 8 * i,
                        std::to_string(raw) + " bytes from " + std::to_string(length));
            streams.push_back({ position, length, raw });
            position += length;
            total += raw;
          }
        if (total != n_bytes)
          view.fail("the compressed blocks hold another number of bytes than the points need", list,
                    std::to_string(total), std::to_string(n_bytes));
        end = position;
      }

      std::vector<Stream> streams;
      std::size_t         end = 0;
    };

    /// Bytes of all streams in small pieces.
    class Inflater
    {
    public:
      Inflater(std::string_view content, const Directory &all, std::string file_name)
          : bytes(content), directory(all), file(std::move(file_name)), buffer(1 << 16)
      {
      }

      /// Calls @p use(piece, length) until all streams are at their ends.
      template <class Use>
      void
      run(const Use &use)
      {
        for (const auto &block : directory.streams)
          run(block, use);
      }

    private:
      template <class Use>
      void
      run(const Directory::Stream &block, const Use &use)
      {
        z_stream state{};
        if (inflateInit(&state) != Z_OK)
          throw std::bad_alloc();
        const std::unique_ptr<z_stream, int (*)(z_stream *)> guard(&state, &inflateEnd);
        // zlib takes the input as not const and does not change it.
        state.next_in    = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data() + block.begin));
        state.avail_in   = static_cast<uInt>(block.compressed);
        std::size_t made = 0;
        int         code = Z_OK;
        while (code != Z_STREAM_END)
          {
            state.next_out      = reinterpret_cast<Bytef *>(buffer.data());
            state.avail_out     = static_cast<uInt>(buffer.size());
            code                = inflate(&state, Z_NO_FLUSH);
            const std::size_t n = buffer.size() - state.avail_out;
            made += n;
            if ((code != Z_OK && code != Z_STREAM_END) || made > block.raw || (n == 0 && code == Z_OK))
              fail(block,
                   made > block.raw ? "a compressed block holds more than it says" : "a compressed block is damaged",
                   block.begin + block.compressed - state.avail_in);
            use(buffer.data(), n);
          }
        if (made != block.raw || state.avail_in != 0)
          fail(block, "a compressed block holds another number of bytes than it says",
               block.begin + block.compressed - state.avail_in);
      }

      [[noreturn]] void
      fail(const Directory::Stream &block, const std::string &what, std::size_t at_byte) const
      {
        ByteView(bytes, "SUR", file)
            .fail(what, at_byte, "block at byte " + std::to_string(block.begin), std::to_string(block.raw) + " bytes");
      }

      std::string_view  bytes;
      const Directory  &directory;
      std::string       file;
      std::vector<char> buffer;
    };

    /// Turns stored bytes, in pieces of any length, into heights.
    class Decoder
    {
    public:
      Decoder(const Header &head, const HeightSink &target) : header(head), sink(target) {}

      void
      operator()(const char *piece, std::size_t length)
      {
        for (std::size_t i = 0; i < length; ++i)
          {
            number[filled++] = piece[i];
            if (filled == header.bytes)
              {
                filled = 0;
                put(header.bytes == 2 ? decode_to_double<std::int16_t>(number.data())
                                      : decode_to_double<std::int32_t>(number.data()));
              }
          }
      }

    private:
      void
      put(double stored)
      {
        const std::size_t row = index / header.nx, ix = index % header.nx;
        sink(ix, header.ny - 1 - row,
             stored < header.lowest ? std::numeric_limits<double>::quiet_NaN() : stored * header.dz + header.z_offset);
        ++index;
      }

      const Header       &header;
      const HeightSink   &sink;
      std::array<char, 4> number{};
      std::size_t         filled = 0, index = 0;
    };

    /// Digital Surf: header of 512 bytes, comment, private zone, integers row by row from the top, plain or in zlib
    /// streams.
    class SurReader : public SurfaceReader
    {
    public:
      explicit SurReader(Parameters &) {}

      Match
      recognises(std::string_view content) const override
      {
        const auto magic = content.substr(0, plain_magic.size());
        return magic == plain_magic || magic == compressed_magic ? Match::certain : Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const ByteView view(content, "SUR", file);
        const Header   header = read_header(view);
        RawSurface     raw;
        raw.nx                    = header.nx;
        raw.ny                    = header.ny;
        const std::size_t n_bytes = header.nx * header.ny * header.bytes; // counts of 31 bits: no overflow
        const bool        single  = view.number<std::int16_t>(at::objects) <= 1 && has_one_layer(view);
        std::size_t       end     = header.begin + n_bytes;
        if (header.compressed)
          {
            const Directory directory(view, header.begin, n_bytes);
            end         = directory.end;
            raw.heights = [content, file, header, directory](const HeightSink &sink) {
              Decoder decoder(header, sink);
              Inflater(content, directory, file).run([&](const char *piece, std::size_t n) { decoder(piece, n); });
            };
          }
        else
          {
            view.check_counts(header.nx, header.ny, header.nx * header.bytes, header.begin);
            raw.heights = [content, header, n_bytes](const HeightSink &sink) {
              Decoder(header, sink)(content.data() + header.begin, n_bytes);
            };
          }
        if (single && end < view.size())
          view.fail("the file is longer than its header says", end, std::to_string(view.size()) + " bytes",
                    std::to_string(end));
        if (!single)
          raw.warning = "the file holds several surfaces or layers; only the first is read.";
        set_scales(view, raw);
        raw.remark = excerpt(view.text(at::name, 30));
        return raw;
      }

    private:
      static bool
      has_one_layer(const ByteView &view)
      {
        const int type = view.number<std::int16_t>(at::type);
        return type == 1 || type == 2;
      }

      static void
      set_scales(const ByteView &view, RawSurface &raw)
      {
        const double dx = read_step(view, at::dx, "step along x"), dy = read_step(view, at::dy, "step along y");
        const auto   x_unit = read_unit(view, at::dx_unit), y_unit = read_unit(view, at::dy_unit);
        if (x_unit && y_unit)
          raw.pixel_size = { dx * *x_unit, dy * *y_unit };
        else
          raw.pitch = { dx, dy };
        raw.height_unit = read_unit(view, at::dz_unit);
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, SurReader, "Digital Surf",
                     "SUR: heights as integers of 16 or 32 bits, plain or compressed.", "")
} // namespace tribodraw
