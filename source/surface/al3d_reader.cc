#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <cmath>
#include <limits>
#include <map>

#include "byte_view.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    constexpr std::string_view magic("AliconaImaging\0\r\n", 17);
    constexpr std::size_t      key_bytes = 20, tag_bytes = 52; // key, value, line end

    /// Tags at the beginning of the file: `Version`, `TagCount`, then as many as it says.
    class Tags
    {
    public:
      explicit Tags(const ByteView &all) : view(all)
      {
        read_tag(magic.size(), "Version");
        read_tag(magic.size() + tag_bytes, "TagCount");
        const std::size_t n = count("TagCount");
        for (std::size_t i = 0; i < n; ++i)
          read_tag(magic.size() + (2 + i) * tag_bytes);
      }

      bool
      has(const std::string &key) const
      {
        return tags.count(key) > 0;
      }

      std::string
      text(const std::string &key) const
      {
        return find(key).value;
      }

      std::size_t
      count(const std::string &key) const
      {
        const Tag &tag   = find(key);
        const auto value = parse_count(tag.value);
        if (!value)
          view.fail("the tag `" + key + "` is not a count", tag.offset, "`" + excerpt(tag.value) + "`");
        return *value;
      }

      double
      number(const std::string &key) const
      {
        const Tag &tag   = find(key);
        const auto value = parse_finite(tag.value);
        if (!value)
          view.fail("the tag `" + key + "` is not a number", tag.offset, "`" + excerpt(tag.value) + "`");
        return *value;
      }

      double
      positive(const std::string &key) const
      {
        const double value = number(key);
        if (!(value > 0.))
          view.fail("the tag `" + key + "` is not positive", find(key).offset, units::number(value));
        return value;
      }

      std::size_t
      offset(const std::string &key) const
      {
        return find(key).offset;
      }

    private:
      struct Tag
      {
        std::string value;
        std::size_t offset;
      };

      void
      read_tag(std::size_t at, const std::string &expected = "")
      {
        const std::string_view line_end(view.at(at, tag_bytes) + tag_bytes - 2, 2);
        if (line_end != "\r\n")
          view.fail("a tag is not ended by a line end (wrong number of tags?)", at + tag_bytes - 2);
        const std::string key = view.text(at, key_bytes);
        if (!expected.empty() && key != expected)
          view.fail("the tag `" + expected + "` is missing", at, "`" + excerpt(key) + "`");
        if (!tags.emplace(key, Tag{ view.text(at + key_bytes, tag_bytes - key_bytes - 2), at }).second && !key.empty())
          view.fail("a tag occurs twice", at, "`" + excerpt(key) + "`");
      }

      const Tag &
      find(const std::string &key) const
      {
        const auto found = tags.find(key);
        if (found == tags.end())
          view.fail("the tag `" + key + "` is missing", magic.size());
        return found->second;
      }

      const ByteView            &view;
      std::map<std::string, Tag> tags;
    };

    /// Alicona AL3D: tags of 52 bytes, then heights in m as 32-bit floating point numbers, rows from the top and padded
    /// to a multiple of 8 bytes.
    class Al3dReader : public SurfaceReader
    {
    public:
      explicit Al3dReader(Parameters &) {}

      Match
      recognises(std::string_view content) const override
      {
        return content.substr(0, magic.size()) == magic ? Match::certain : Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const ByteView view(content, "AL3D", file);
        const Tags     tags(view);
        RawSurface     raw;
        raw.nx                  = tags.count("Cols");
        raw.ny                  = tags.count("Rows");
        const std::size_t begin = tags.count("DepthImageOffset");
        if (begin < magic.size() + tag_bytes)
          view.fail("there is no depth image, or it begins inside the tags", tags.offset("DepthImageOffset"),
                    std::to_string(begin), "", "Export the measurement with its height data.");
        if (raw.nx > view.size())
          view.fail("more columns than the file has bytes", tags.offset("Cols"), std::to_string(raw.nx));
        const std::size_t stride = (4 * raw.nx + 7) / 8 * 8;
        view.check_counts(raw.nx, raw.ny, stride, begin);
        // The texture, if any, follows: counts that reach into it are wrong.
        const std::size_t end     = begin + stride * raw.ny;
        const std::size_t texture = tags.has("TextureImageOffset") ? tags.count("TextureImageOffset") : std::size_t(0);
        if (texture > begin && end > texture)
          view.fail("the depth image reaches into the texture image", tags.offset("Cols"),
                    std::to_string(raw.nx) + " x " + std::to_string(raw.ny) + " points");
        if (texture <= begin && end < view.size())
          view.fail("the file is longer than its tags say", end, std::to_string(view.size()) + " bytes",
                    std::to_string(end));
        if (texture > begin && texture - end >= 8)
          view.fail("the depth image does not reach to the texture image", tags.offset("Cols"),
                    std::to_string(raw.nx) + " x " + std::to_string(raw.ny) + " points");

        raw.pixel_size  = { tags.positive("PixelSizeXMeter") * units::factor("m"),
                            tags.positive("PixelSizeYMeter") * units::factor("m") };
        raw.height_unit = units::factor("m");
        const double invalid
            = tags.has("InvalidPixelValue") ? tags.number("InvalidPixelValue") : std::numeric_limits<double>::max();
        const auto offset = [begin, stride, ny = raw.ny](std::size_t ix, std::size_t iy) {
          return begin + stride * (ny - 1 - iy) + 4 * ix;
        };
        raw.heights = [content, offset, invalid, nx = raw.nx, ny = raw.ny](const HeightSink &sink) {
          for (std::size_t iy = ny; iy-- > 0;)
            for (std::size_t ix = 0; ix < nx; ++ix)
              {
                const double z = decode_to_double<float>(content.data() + offset(ix, iy));
                // The tag is a decimal text of the mark: equal up to the precision of a 32-bit number.
                const bool missing = std::abs(z - invalid) <= 1.5e-7 * std::abs(invalid);
                sink(ix, iy, missing ? std::numeric_limits<double>::quiet_NaN() : z);
              }
        };
        raw.place = [offset](std::size_t ix, std::size_t iy) { return "byte " + std::to_string(offset(ix, iy)); };
        if (tags.has("CreatingApplication"))
          raw.remark = excerpt(tags.text("CreatingApplication"), 30);
        return raw;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, Al3dReader, "Alicona AL3D", "AL3D: tags and 32-bit floating point heights.", "")
} // namespace tribodraw
