// The map of the samples and the small formats: GSF, AL3D, NPY.
#include "format_samples.h"

#include <cmath>
#include <limits>

namespace format_samples
{
  int
  height(int ix, int iy)
  {
    static const int table[ny][nx]
        = { { -100, 3, 17, 55, -8 }, { 20, -61, 99, 4, 36 }, { 71, 12, -33, 90, -2 }, { 45, 100, 28, -77, 6 } };
    return table[iy][ix];
  }

  bool
  missing(int ix, int iy)
  {
    return (ix == 2 && iy == 0) || (ix == 4 && iy == 2);
  }

  std::vector<double>
  expected(bool with_missing)
  {
    std::vector<double> z;
    for (int iy = 0; iy < ny; ++iy)
      for (int ix = 0; ix < nx; ++ix)
        z.push_back(with_missing && missing(ix, iy) ? std::numeric_limits<double>::quiet_NaN()
                                                    : height(ix, iy) * 1e-5); // 10 nm in mm
    return z;
  }

  namespace
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    /// Heights in m as they are in GSF and AL3D: 32-bit floating point numbers, row by row from the top.
    std::string
    gsf(const std::string &header, bool with_missing)
    {
      Bytes bytes;
      bytes.add(header);
      // one to four zero bytes up to a multiple of four
      const std::size_t zeros = 4 - header.size() % 4;
      bytes.add(std::string(zeros, '\0'));
      for (int iy = ny - 1; iy >= 0; --iy)
        for (int ix = 0; ix < nx; ++ix)
          bytes.little(static_cast<float>(with_missing && missing(ix, iy) ? nan : height(ix, iy) * 1e-8));
      return bytes.text;
    }

    void
    add_gsf(std::vector<Sample> &samples)
    {
      const std::string size = "Gwyddion Simple Field 1.0\nXRes = 5\nYRes = 4\n";
      const std::string all  = size + "XReal = 10e-6\nYReal = 12e-6\nXYUnits = m\nZUnits = m\n";
      for (const std::string title : { "", "T", "Ti", "Tit" }) // all paddings
        {
          samples.push_back(
              { "gsf", "title " + title, gsf(all + "Title = " + title + "\n", false), {}, expected(false) });
          samples.back().tolerance = 1e-7; // 24-bit mantissa
        }
      samples.push_back({ "gsf", "missing", gsf(all, true), {}, expected(true) });
      samples.back().tolerance = 1e-7;
      samples.push_back({ "gsf",
                          "other units",
                          gsf(size + "XReal = 10\nYReal = 12\nXYUnits = \xC2\xB5m\nZUnits = m\n", false),
                          {},
                          expected(false) });
      samples.back().tolerance = 1e-7;
      samples.push_back(
          { "gsf", "given scales", gsf(size, false), { std::array<double, 2>{ 2e-3, 3e-3 }, 1e3 }, expected(false) });
      samples.back().tolerance = 1e-7;
    }

    std::string
    al3d(bool with_missing, bool with_texture)
    {
      Bytes      bytes;
      const auto tag = [&](const std::string &key, const std::string &value) {
        bytes.field(key, 20, '\0').field(value, 30, '\0').add("\r\n");
      };
      // magic 17, Version, TagCount and 9 tags of 52, comment 16
      const std::size_t begin = 17 + 11 * 52 + 16, row = 24; // 5 numbers are 20 bytes, padded to 24
      bytes.add(std::string("AliconaImaging\0\r\n", 17));
      tag("Version", "1");
      tag("TagCount", "9");
      tag("Cols", "5");
      tag("Rows", "4");
      tag("PlaceHolder", "garbage");
      tag("DepthImageOffset", std::to_string(begin));
      tag("TextureImageOffset", with_texture ? std::to_string(begin + 4 * row) : "0");
      tag("InvalidPixelValue", "3.000000028082e+15"); // the text of a float of the real file
      tag("PixelSizeXMeter", "2e-06");
      tag("PixelSizeYMeter", "3e-06");
      tag("CreatingApplication", "test");
      bytes.field("Comment", 16, '\0');
      for (int iy = ny - 1; iy >= 0; --iy)
        {
          for (int ix = 0; ix < nx; ++ix)
            bytes.little(static_cast<float>(with_missing && missing(ix, iy) ? (ix == 2 ? 3.000000028082e15 : nan)
                                                                            : height(ix, iy) * 1e-8));
          bytes.add(std::string(4, 'x'));
        }
      if (with_texture)
        bytes.add(std::string(37, 't'));
      return bytes.text;
    }

    template <class T>
    void
    add_npy(std::vector<Sample> &samples, const std::string &code, int version, bool big, bool fortran,
            bool with_missing)
    {
      constexpr bool is_float = std::is_floating_point_v<T>;
      // Unsigned numbers cannot hold negative heights: all are shifted.
      const int   shift  = std::is_unsigned_v<T> ? 100 : 0;
      std::string header = "{'descr': '"
                           + std::string(sizeof(T) == 1 ? "|"
                                         : big          ? ">"
                                                        : "<")
                           + code + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (4, 5), }";
      const std::size_t before = version == 1 ? 10 : 12;
      while ((before + header.size() + 1) % 64 != 0)
        header += ' ';
      header += '\n';
      Bytes bytes;
      bytes.add("\x93NUMPY").add(std::string(1, static_cast<char>(version))).add(std::string(1, '\0'));
      if (version == 1)
        bytes.little(static_cast<std::uint16_t>(header.size()));
      else
        bytes.little(static_cast<std::uint32_t>(header.size()));
      bytes.add(header);
      const auto element = [&](int ix, int row) {
        const int iy = ny - 1 - row; // the first row is the top
        const T   value
            = with_missing && is_float && missing(ix, iy) ? not_a_number<T>() : static_cast<T>(height(ix, iy) + shift);
        if (big)
          bytes.big(value);
        else
          bytes.little(value);
      };
      if (fortran)
        for (int ix = 0; ix < nx; ++ix)
          for (int row = 0; row < ny; ++row)
            element(ix, row);
      else
        for (int row = 0; row < ny; ++row)
          for (int ix = 0; ix < nx; ++ix)
            element(ix, row);
      // heights are stored in units of 10 nm
      samples.push_back(
          { "npy",
            code + " version " + std::to_string(version) + (big ? " big" : " little") + (fortran ? " fortran" : ""),
            bytes.text,
            { std::array<double, 2>{ 2e-3, 3e-3 }, 1e-5 },
            expected(with_missing && is_float) });
      for (double &z : samples.back().z)
        z += shift * 1e-5;
    }

    template <class T>
    void
    add_npy(std::vector<Sample> &samples, const std::string &code)
    {
      for (const int version : { 1, 2, 3 })
        for (const bool big : { false, true })
          for (const bool fortran : { false, true })
            add_npy<T>(samples, code, version, big, fortran, version == 2);
    }
  } // namespace

  std::vector<Sample>
  simple_binary_samples()
  {
    std::vector<Sample> samples;
    add_gsf(samples);
    for (const bool with_missing : { false, true })
      for (const bool with_texture : { false, true })
        {
          samples.push_back({ "al3d",
                              std::string(with_texture ? "with" : "without") + " texture",
                              al3d(with_missing, with_texture),
                              {},
                              expected(with_missing) });
          samples.back().tolerance = 1e-7;
        }
    add_npy<float>(samples, "f4");
    add_npy<double>(samples, "f8");
    add_npy<std::int8_t>(samples, "i1");
    add_npy<std::int16_t>(samples, "i2");
    add_npy<std::int32_t>(samples, "i4");
    add_npy<std::int64_t>(samples, "i8");
    add_npy<std::uint8_t>(samples, "u1");
    add_npy<std::uint16_t>(samples, "u2");
    add_npy<std::uint32_t>(samples, "u4");
    add_npy<std::uint64_t>(samples, "u8");
    return samples;
  }

  std::vector<Sample>
  all_samples()
  {
    std::vector<Sample> all;
    for (const auto &part : { sdf_samples(), sur_samples(), x3p_samples(), simple_binary_samples(), text_samples() })
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }
} // namespace format_samples
