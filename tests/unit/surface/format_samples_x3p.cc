// X3P: zip archive, written by hand (PKWARE's description of the format), with main.xml and binary data.
#include "format_samples.h"

#include <array>
#include <cmath>
#include <limits>
#include <zlib.h>

namespace format_samples
{
  namespace
  {
    struct Style
    {
      std::string cz_type      = "D", prefix, cx_type, cy_type; ///< types of absolute axes, empty: incremental
      bool        with_missing = false, inline_data = false, valid_file = false, stored = false, digests = true;
      bool        upside_down = false; ///< absolute y axis that runs downwards
      int         layers      = 1;
    };

    std::string
    element(const std::string &name, const std::string &text)
    {
      return "<" + name + ">" + text + "</" + name + ">\n";
    }

    std::string
    axis(const std::string &name, const std::string &type, const std::string &increment, const std::string &data_type,
         const std::string &offset)
    {
      return element(name, "\n" + element("AxisType", type) + (data_type.empty() ? "" : element("DataType", data_type))
                               + (increment.empty() ? "" : element("Increment", increment))
                               + (offset.empty() ? "" : element("Offset", offset)));
    }

    /// Heights are stored in units of 10 nm as integers, in m as floating point numbers.
    bool
    is_integer(const std::string &type)
    {
      return type == "I" || type == "L";
    }

    std::string
    main_xml(const Style &style, const std::string &record3)
    {
      const std::string cx = style.cx_type.empty() ? axis("CX", "I", "2e-006", "", "1.5E-5")
                                                   : axis("CX", "A", "1e-6", style.cx_type, "");
      const std::string cy
          = style.cy_type.empty() ? axis("CY", "I", "0.000003", "", "") : axis("CY", "A", "", style.cy_type, "0");
      const std::string cz = axis("CZ", "A", is_integer(style.cz_type) ? "1e-8" : "", style.cz_type, "");
      const std::string head
          = element("Revision", "ISO5436 - 2000") + element("FeatureType", "SUR") + element("Axes", cx + cy + cz);
      std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"no\" ?>\n<p:ISO5436_2 "
                        "xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\n"
                        + element(style.prefix + "Record1", head)
                        + element("Record2", element("Date", "2020-01-01T00:00:00")
                                                 + element("Instrument", element("Manufacturer", "maker")))
                        + element("Record3", record3) + element("Record4", element("ChecksumFile", "md5checksum.hex"))
                        + "</p:ISO5436_2>\n";
      return xml;
    }

    std::string
    matrix(int layers)
    {
      return element("MatrixDimension", element("SizeX", std::to_string(nx)) + element("SizeY", std::to_string(ny))
                                            + element("SizeZ", std::to_string(layers)));
    }

    void
    add_number(Bytes &bytes, const std::string &type, double value)
    {
      if (type == "I")
        bytes.little(static_cast<std::int16_t>(std::lround(value)));
      else if (type == "L")
        bytes.little(static_cast<std::int32_t>(std::lround(value)));
      else if (type == "F")
        bytes.little(static_cast<float>(value));
      else
        bytes.little(value);
    }

    double
    stored_height(const Style &style, int ix, int iy)
    {
      if (style.with_missing && missing(ix, iy))
        return is_integer(style.cz_type) ? 0. : std::numeric_limits<double>::quiet_NaN();
      return is_integer(style.cz_type) ? height(ix, iy) : height(ix, iy) * 1e-8;
    }

    /// x fastest, then y; v runs upwards.
    std::string
    binary(const Style &style)
    {
      Bytes bytes;
      for (int layer = 0; layer < style.layers; ++layer)
        for (int v = 0; v < ny; ++v)
          for (int u = 0; u < nx; ++u)
            {
              const int iy = style.upside_down ? ny - 1 - v : v;
              if (!style.cx_type.empty())
                add_number(bytes, style.cx_type, 7. + 2. * u); // um
              if (!style.cy_type.empty())
                add_number(bytes, style.cy_type, 1e-3 + 3e-6 * iy); // m
              add_number(bytes, style.cz_type, stored_height(style, u, iy) + 1e-8 * layer);
            }
      return bytes.text;
    }

    /// One bit a point, the lowest bit of each byte first.
    std::string
    valid_bits()
    {
      std::string bits((nx * ny + 7) / 8, '\0');
      for (int i = 0; i < nx * ny; ++i)
        if (!missing(i % nx, i / nx))
          bits[i / 8] = static_cast<char>(bits[i / 8] | (1 << (i % 8)));
      return bits;
    }

    std::string
    inline_list(const Style &style)
    {
      std::string list;
      for (int i = 0; i < nx * ny; ++i)
        if (style.with_missing && missing(i % nx, i / nx))
          list += i % 2 == 0 ? "<Datum></Datum>\n" : "<Datum/> <!-- gap -->\n";
        else
          list += element("Datum", (style.cx_type.empty() ? "" : std::to_string(7 + 2 * (i % nx)) + ";")
                                       + std::to_string(height(i % nx, i / nx)) + "e-8");
      return element("DataList", list);
    }

    std::string
    file(const Style &style)
    {
      std::vector<ZipEntry> entries;
      const std::string     data    = binary(style);
      std::string           record3 = matrix(style.layers);
      if (style.inline_data)
        record3 += inline_list(style);
      else
        {
          std::string link = element("PointDataLink", "bindata/data.bin");
          if (style.digests)
            {
              std::string digest = md5(data);
              for (char &c : digest)
                c = static_cast<char>(std::toupper(c)); // as MountainsMap writes it
              link += element("MD5ChecksumPointData", digest);
            }
          if (style.valid_file)
            link += element("ValidPointsLink", "bindata/valid.bin")
                    + element("MD5ChecksumValidPoints", md5(valid_bits()));
          record3 += element("DataLink", link);
          entries.push_back({ "bindata/data.bin", data, !style.stored });
          if (style.valid_file)
            entries.push_back({ "bindata/valid.bin", valid_bits(), !style.stored });
        }
      const std::string main = main_xml(style, record3);
      entries.push_back({ "main.xml", main, !style.stored });
      if (style.digests)
        entries.push_back({ "md5checksum.hex", md5(main) + " *main.xml", !style.stored });
      return zip(entries);
    }

    Sample
    make_sample(const std::string &variant, const Style &style)
    {
      Sample result{ "x3p", variant, file(style), {}, expected(style.with_missing) };
      if (style.cz_type == "F")
        result.tolerance = 1e-7;
      return result;
    }
  } // namespace

  std::string
  md5(const std::string &content)
  {
    // RFC 1321
    std::array<std::uint32_t, 64> k;
    for (int i = 0; i < 64; ++i)
      k[i] = static_cast<std::uint32_t>(std::floor(4294967296. * std::abs(std::sin(i + 1.))));
    static const int s[4][4] = { { 7, 12, 17, 22 }, { 5, 9, 14, 20 }, { 4, 11, 16, 23 }, { 6, 10, 15, 21 } };
    std::array<std::uint32_t, 4> state{ 0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476 };
    Bytes                        padded;
    padded.add(content).add("\x80");
    while (padded.text.size() % 64 != 56)
      padded.text += '\0';
    padded.little(static_cast<std::uint64_t>(content.size()) * 8);
    for (std::size_t block = 0; block < padded.text.size(); block += 64)
      {
        std::array<std::uint32_t, 16> m{};
        for (int i = 0; i < 64; ++i)
          m[i / 4] |= static_cast<std::uint32_t>(static_cast<unsigned char>(padded.text[block + i])) << (8 * (i % 4));
        auto [a, b, c, d] = state;
        for (int i = 0; i < 64; ++i)
          {
            const int     round = i / 16;
            std::uint32_t f     = round == 0   ? (b & c) | (~b & d)
                                  : round == 1 ? (d & b) | (~d & c)
                                  : round == 2 ? b ^ c ^ d
                                               : c ^ (b | ~d);
            const int g = round == 0 ? i : round == 1 ? (5 * i + 1) % 16 : round == 2 ? (3 * i + 5) % 16 : 7 * i % 16;
            f += a + k[i] + m[g];
            a             = d;
            d             = c;
            c             = b;
            const int bit = s[round][i % 4];
            b += (f << bit) | (f >> (32 - bit));
          }
        state = { state[0] + a, state[1] + b, state[2] + c, state[3] + d };
      }
    std::string text;
    for (const std::uint32_t word : state)
      for (int i = 0; i < 4; ++i)
        for (const int shift : { 4, 0 })
          text += "0123456789abcdef"[(word >> (8 * i + shift)) & 15];
    return text;
  }

  std::string
  zip(const std::vector<ZipEntry> &entries)
  {
    Bytes archive, directory;
    for (const ZipEntry &entry : entries)
      {
        const std::string packed = entry.deflated ? deflated(entry.content, false) : entry.content;
        const auto        crc    = static_cast<std::uint32_t>(
            crc32(0, reinterpret_cast<const Bytef *>(entry.content.data()), static_cast<uInt>(entry.content.size())));
        const auto offset = static_cast<std::uint32_t>(archive.text.size());
        const auto common = [&](Bytes &b) {
          b.little<std::uint16_t>(20).little<std::uint16_t>(0).little<std::uint16_t>(entry.deflated ? 8 : 0);
          b.little<std::uint16_t>(0).little<std::uint16_t>(0x21).little(crc);
          b.little(static_cast<std::uint32_t>(packed.size())).little(static_cast<std::uint32_t>(entry.content.size()));
          b.little(static_cast<std::uint16_t>(entry.name.size())).little<std::uint16_t>(0);
        };
        archive.add("PK\3\4");
        common(archive);
        archive.add(entry.name).add(packed);
        directory.add("PK\1\2").little<std::uint16_t>(20);
        common(directory);
        directory.little<std::uint16_t>(0).little<std::uint16_t>(0).little<std::uint16_t>(0);
        directory.little<std::uint32_t>(0).little(offset).add(entry.name);
      }
    const auto begin = static_cast<std::uint32_t>(archive.text.size());
    archive.add(directory.text).add("PK\5\6").little<std::uint16_t>(0).little<std::uint16_t>(0);
    for (int i = 0; i < 2; ++i)
      archive.little(static_cast<std::uint16_t>(entries.size()));
    archive.little(static_cast<std::uint32_t>(directory.text.size())).little(begin).little<std::uint16_t>(0);
    return archive.text;
  }

  std::string
  x3p_main(const std::string &cz_type, const std::string &data, const std::string &digest)
  {
    Style style;
    style.cz_type = cz_type;
    return main_xml(style,
                    matrix(1)
                        + element("DataLink", element("PointDataLink", data)
                                                  + (digest.empty() ? "" : element("MD5ChecksumPointData", digest))));
  }

  std::string
  x3p_data(const std::string &cz_type, bool with_missing)
  {
    Style style;
    style.cz_type      = cz_type;
    style.with_missing = with_missing;
    return binary(style);
  }

  std::vector<Sample>
  x3p_samples()
  {
    std::vector<Sample> samples;
    for (const std::string type : { "I", "L", "F", "D" })
      for (const bool stored : { false, true })
        {
          Style style;
          style.cz_type = type;
          style.stored  = stored;
          samples.push_back(make_sample(type + (stored ? " stored" : " deflated"), style));
          style.with_missing = true;
          style.valid_file   = is_integer(type); // integers cannot say themselves that they are missing
          samples.push_back(make_sample(type + " missing", style));
        }
    Style style;
    style.digests = false;
    samples.push_back(make_sample("no digests", style));
    style        = {};
    style.prefix = "p:";
    samples.push_back(make_sample("prefix", style));
    style        = {};
    style.layers = 3;
    samples.push_back(make_sample("three layers", style));
    style             = {};
    style.inline_data = style.with_missing = true;
    samples.push_back(make_sample("inline", style));
    style.cx_type = "D";
    samples.push_back(make_sample("inline, absolute x", style));
    for (const std::string type : { "I", "F", "D" })
      {
        style         = {};
        style.cx_type = type;
        style.cz_type = "L";
        samples.push_back(make_sample("absolute x " + type, style));
      }
    style              = {};
    style.cx_type      = "L";
    style.cy_type      = "D";
    style.with_missing = true;
    samples.push_back(make_sample("absolute x and y", style));
    style.upside_down = true;
    samples.push_back(make_sample("absolute y downwards", style));
    return samples;
  }
} // namespace format_samples
