#include <tribodraw/base/registry.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "byte_view.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    constexpr std::string_view magic("\x93NUMPY", 6);

    struct ElementType
    {
      std::size_t   bytes;
      NumberDecoder decode;
    };

    template <class T>
    void
    add_type(std::map<std::string, ElementType> &types, const std::string &code)
    {
      types["<" + code] = { sizeof(T), &decode_to_double<T> };
      types[">" + code] = { sizeof(T), &decode_to_double<T, true> };
      if (sizeof(T) == 1)
        types["|" + code] = { sizeof(T), &decode_to_double<T> };
    }

    const std::map<std::string, ElementType> &
    element_types()
    {
      static const auto types = [] {
        std::map<std::string, ElementType> t;
        add_type<float>(t, "f4");
        add_type<double>(t, "f8");
        add_type<std::int8_t>(t, "i1");
        add_type<std::int16_t>(t, "i2");
        add_type<std::int32_t>(t, "i4");
        add_type<std::int64_t>(t, "i8");
        add_type<std::uint8_t>(t, "u1");
        add_type<std::uint16_t>(t, "u2");
        add_type<std::uint32_t>(t, "u4");
        add_type<std::uint64_t>(t, "u8");
        return t;
      }();
      return types;
    }

    /// The header of an array, a dictionary in the notation of Python with exactly three entries.
    class Dictionary
    {
    public:
      Dictionary(const ByteView &all, std::size_t first, std::size_t n)
          : view(all), begin(first), text(all.at(first, n), n)
      {
        expect('{');
        while (!accept('}'))
          {
            const std::size_t at  = next();
            const std::string key = quoted();
            expect(':');
            if (key == "descr" && descr.empty())
              descr = quoted();
            else if (key == "fortran_order" && !has_order)
              read_order();
            else if (key == "shape" && !has_shape)
              read_shape();
            else
              fail("an entry of the header is unknown or occurs twice", at, key);
            if (!accept(','))
              {
                expect('}');
                break;
              }
          }
        if (next() < text.size())
          fail("text follows the header's dictionary", position, std::string(text.substr(position, 20)));
        if (descr.empty() || !has_order || !has_shape)
          fail("the header lacks an entry", 0, "", "descr, fortran_order, shape");
      }

      std::string                descr;
      bool                       fortran_order = false;
      std::array<std::size_t, 2> shape{};

    private:
      [[noreturn]] void
      fail(const std::string &what, std::size_t at, const std::string &value = "",
           const std::string &allowed = "") const
      {
        view.fail(what, begin + at, value.empty() ? "" : "`" + excerpt(value) + "`", allowed);
      }

      std::size_t
      next()
      {
        while (position < text.size() && std::isspace(static_cast<unsigned char>(text[position])))
          ++position;
        return position;
      }

      bool
      accept(char c)
      {
        if (next() >= text.size() || text[position] != c)
          return false;
        ++position;
        return true;
      }

      void
      expect(char c)
      {
        if (!accept(c))
          fail("the header is not a dictionary of descr, fortran_order and shape", position,
               std::string(text.substr(position, 20)), std::string("`") + c + "` here");
      }

      std::string
      quoted()
      {
        const char        quote = accept('"') ? '"' : '\'';
        const std::size_t at    = position;
        if (quote == '\'')
          expect('\'');
        const auto end = text.find(quote, position);
        if (end == std::string_view::npos || end - position > 64)
          fail("a text in the header has no end, or the elements are records", at);
        std::string result(text.substr(position, end - position));
        position = end + 1;
        return result;
      }

      void
      read_order()
      {
        next();
        const auto rest = text.substr(position);
        if (rest.substr(0, 4) == "True")
          fortran_order = true;
        else if (rest.substr(0, 5) != "False")
          fail("fortran_order is neither True nor False", position, std::string(rest.substr(0, 10)));
        position += fortran_order ? 4 : 5;
        has_order = true;
      }

      void
      read_shape()
      {
        const std::size_t at = next();
        expect('(');
        std::size_t n = 0;
        while (!accept(')'))
          {
            const std::size_t first = next();
            while (position < text.size() && std::isdigit(static_cast<unsigned char>(text[position])))
              ++position;
            const auto count = parse_count(text.substr(first, position - first));
            if (!count)
              fail("the shape of the array is not a list of counts", first, std::string(text.substr(first, 20)));
            if (n < 2)
              shape[n] = *count;
            ++n;
            if (!accept(','))
              {
                expect(')');
                break;
              }
          }
        if (n != 2)
          fail("the array has another number of dimensions than two", at, std::to_string(n) + " dimensions",
               "rows, columns");
        has_shape = true;
      }

      const ByteView  &view;
      std::size_t      begin;
      std::string_view text;
      std::size_t      position  = 0;
      bool             has_order = false, has_shape = false;
    };

    /// NumPy array file of two dimensions: the first row is the one with the largest y, as pictures are shown.
    class NpyReader : public SurfaceReader
    {
    public:
      explicit NpyReader(Parameters &) {}

      Match
      recognises(std::string_view content) const override
      {
        return content.substr(0, magic.size()) == magic ? Match::certain : Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const ByteView view(content, "NPY", file);
        const int      version = view.number<std::uint8_t>(6), minor = view.number<std::uint8_t>(7);
        if (version < 1 || version > 3 || minor != 0)
          view.fail("the version is unknown", 6, std::to_string(version) + "." + std::to_string(minor),
                    "1.0, 2.0, 3.0");
        const std::size_t header_begin = version == 1 ? 10 : 12;
        const std::size_t length       = version == 1 ? view.number<std::uint16_t>(8) : view.number<std::uint32_t>(8);
        const Dictionary  header(view, header_begin, length);
        const std::size_t begin = header_begin + length;

        const auto type = element_types().find(header.descr);
        if (type == element_types().end())
          view.fail("the type of the elements cannot be heights", header_begin, "`" + excerpt(header.descr) + "`",
                    "integers of 1, 2, 4, 8 bytes and floating point numbers of 4 and 8 bytes, such as `<f8`");
        RawSurface raw;
        raw.ny = header.shape[0];
        raw.nx = header.shape[1];
        check_size(view, raw, type->second.bytes, begin);

        const auto offset = [begin, fortran = header.fortran_order, bytes = type->second.bytes, nx = raw.nx,
                             ny = raw.ny](std::size_t ix, std::size_t iy) {
          const std::size_t row = ny - 1 - iy;
          return begin + bytes * (fortran ? ix * ny + row : row * nx + ix);
        };
        raw.heights
            = [content, offset, decode = type->second.decode, nx = raw.nx, ny = raw.ny](const HeightSink &sink) {
                for (std::size_t iy = ny; iy-- > 0;)
                  for (std::size_t ix = 0; ix < nx; ++ix)
                    sink(ix, iy, decode(content.data() + offset(ix, iy)));
              };
        raw.place  = [offset](std::size_t ix, std::size_t iy) { return "byte " + std::to_string(offset(ix, iy)); };
        raw.remark = "elements " + header.descr;
        return raw;
      }

    private:
      static void
      check_size(const ByteView &view, const RawSurface &raw, std::size_t bytes, std::size_t begin)
      {
        const std::size_t left = view.size() - begin;
        if (raw.nx == 0 || raw.ny == 0 || raw.nx > left / bytes || raw.ny > left / (bytes * raw.nx))
          view.fail("the file is shorter than its header says (truncated file?)", begin,
                    std::to_string(left) + " bytes of data",
                    std::to_string(raw.ny) + " x " + std::to_string(raw.nx) + " elements of " + std::to_string(bytes)
                        + " bytes");
        if (left != bytes * raw.nx * raw.ny)
          view.fail("the file is longer than its header says", begin, std::to_string(left) + " bytes of data",
                    std::to_string(bytes * raw.nx * raw.ny));
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, NpyReader, "NumPy array",
                     "NPY 1.0 to 3.0: two-dimensional array of integers or floating point numbers.",
                     "NumPy Enhancement Proposal 1")
} // namespace tribodraw
