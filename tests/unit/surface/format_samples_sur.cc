// Digital Surf SUR: header of 512 bytes.
#include "format_samples.h"

#include <limits>
#include <zlib.h>

namespace format_samples
{
  namespace
  {
    struct Style
    {
      int         bits = 32, type = 2, objects = 1, blocks = 1;
      bool        compressed = false, special = true, with_missing = true;
      std::string name   = "NEWTONS", comment, private_zone, rest;
      std::string x_unit = "mm", y_unit = "mm", z_unit = "mm";
      float       dx = 2e-3f, dy = 3e-3f, dz = 1e-5f, z_offset = 0;
    };

    std::string
    heights(const Style &style)
    {
      Bytes bytes;
      for (int iy = ny - 1; iy >= 0; --iy) // from the top
        for (int ix = 0; ix < nx; ++ix)
          {
            const int value = style.with_missing && missing(ix, iy) ? -102 : height(ix, iy); // Zmin - 2
            if (style.bits == 16)
              bytes.little(static_cast<std::int16_t>(value));
            else
              bytes.little(static_cast<std::int32_t>(value));
          }
      return bytes.text;
    }

    std::string
    file(const Style &style)
    {
      Bytes b;
      b.add(style.compressed ? "DSCOMPRESSED" : "DIGITAL SURF");
      for (const int value : { 0, style.objects, 1, style.type })
        b.little(static_cast<std::int16_t>(value));
      b.field(style.name, 30).field("operator", 30);
      for (const int value :
           { 0, 0, 0, style.special ? 1 : 0, 0 }) // P size, acquisition, range, special points, absolute
        b.little(static_cast<std::int16_t>(value));
      b.little(0.f).field("", 4, '\0').little(static_cast<std::int16_t>(style.bits));
      for (const std::int32_t value : { -100, 100, nx, ny, nx * ny }) // Zmin, Zmax
        b.little(value);
      b.little(style.dx).little(style.dy).little(style.dz);
      for (const std::string &name :
           { std::string("X"), std::string("Y"), std::string("Z"), style.x_unit, style.y_unit, style.z_unit,
             std::string("um"), std::string("um"), std::string("um") }) // the last three are for display only
        b.field(name, 16);
      b.little(1.f).little(1.f).little(1.f);
      for (int i = 0; i < 3; ++i) // imprint, inverted, levelled
        b.little<std::int16_t>(0);
      b.field("", 12, '\0');
      for (int i = 0; i < 7; ++i) // time
        b.little<std::int16_t>(0);
      b.little(0.f).little<std::uint32_t>(0).field("", 6, '\0');
      b.little(static_cast<std::int16_t>(style.comment.size()));
      b.little(static_cast<std::int16_t>(style.private_zone.size()));
      b.field("client", 128, '\0').little(0.f).little(0.f).little(style.z_offset).little(0.f).little(0.f);
      b.field("", 13).field("", 13);
      b.add(style.comment).add(style.private_zone);
      const std::string data = heights(style);
      if (!style.compressed)
        return b.add(data).add(style.rest).text;
      std::vector<std::string> parts;
      for (int i = 0; i < style.blocks; ++i) // values may straddle the border of blocks
        {
          const std::size_t begin = data.size() * i / style.blocks, end = data.size() * (i + 1) / style.blocks;
          parts.push_back(data.substr(begin, end - begin));
        }
      b.little(static_cast<std::uint32_t>(style.blocks));
      for (const auto &part : parts)
        b.little(static_cast<std::uint32_t>(part.size()))
            .little(static_cast<std::uint32_t>(deflated(part, true).size()));
      for (const auto &part : parts)
        b.add(deflated(part, true));
      return b.add(style.rest).text;
    }

    Sample
    make_sample(const std::string &variant, const Style &style)
    {
      Sample result{ "sur", variant, file(style), {}, expected(style.with_missing) };
      result.tolerance = 1e-6; // steps are 32-bit floating point numbers
      return result;
    }
  } // namespace

  std::string
  deflated(const std::string &content, bool with_zlib_header)
  {
    z_stream state{};
    deflateInit2(&state, 9, Z_DEFLATED, with_zlib_header ? 15 : -15, 8, Z_DEFAULT_STRATEGY);
    std::string result(deflateBound(&state, content.size()) + 64, '\0');
    state.next_in   = reinterpret_cast<Bytef *>(const_cast<char *>(content.data()));
    state.avail_in  = static_cast<uInt>(content.size());
    state.next_out  = reinterpret_cast<Bytef *>(result.data());
    state.avail_out = static_cast<uInt>(result.size());
    deflate(&state, Z_FINISH);
    result.resize(state.total_out);
    deflateEnd(&state);
    return result;
  }

  std::string
  sur(int bits, bool compressed, int blocks, bool special)
  {
    Style style;
    style.bits         = bits;
    style.compressed   = compressed;
    style.blocks       = blocks;
    style.special      = special;
    style.with_missing = special;
    return file(style);
  }

  std::vector<Sample>
  sur_samples()
  {
    std::vector<Sample> samples;
    for (const int bits : { 16, 32 })
      for (const bool special : { false, true })
        {
          Style style;
          style.bits    = bits;
          style.special = style.with_missing = special;
          samples.push_back(make_sample("plain " + std::to_string(bits), style));
          style.compressed = true;
          for (const int blocks : { 1, 3 })
            {
              style.blocks = blocks;
              samples.push_back(make_sample("zlib " + std::to_string(bits), style));
            }
        }
    Style style;
    style.comment      = "comment zone";
    style.private_zone = std::string("private\0zone", 12);
    samples.push_back(make_sample("zones", style));
    style.compressed = true;
    samples.push_back(make_sample("zones, zlib", style));
    // units that differ between the axes, as in real files
    style        = {};
    style.x_unit = "nm", style.dx = 2000.f;
    style.y_unit = "\xB5m", style.dy = 3.f;
    style.z_unit = "m", style.dz = 1e-8f;
    samples.push_back(make_sample("units", style));
    style.y_unit = std::string("um\0m", 4);
    samples.push_back(make_sample("text after the end of a unit", style));
    // heights from an offset
    style          = {};
    style.z_offset = 2.5e-3f;
    samples.push_back(make_sample("offset", style));
    for (double &z : samples.back().z)
      z += 2.5e-3;
    // Gwyddion calls a surface a profile
    style      = {};
    style.type = 1, style.name = "SCRATCH";
    samples.push_back(make_sample("gwyddion", style));
    // more objects follow
    style         = {};
    style.objects = 2, style.rest = "DIGITAL SURF and so on";
    samples.push_back(make_sample("two objects", style));
    // units to be given
    style        = {};
    style.x_unit = style.y_unit = style.z_unit = "";
    samples.push_back(make_sample("no units", style));
    samples.back().given = { std::array<double, 2>{ 2e-3, 3e-3 }, 1. };
    return samples;
  }
} // namespace format_samples
