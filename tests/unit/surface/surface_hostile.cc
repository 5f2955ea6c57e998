// Files made to hurt, one by one: counts beyond the file and the memory, bombs, scales that are none, wrong byte order,
// all points missing. The message names the place and the reason; memory stays near the size of the file.
#include "format_samples.h"
#include "guarded_read.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace tribodraw;
using namespace format_samples;

namespace
{
  /// The message of the rejection, with the memory checked; another text if the file is not rejected.
  std::string
  rejection(const std::string &content, const GivenScales &given = {})
  {
    const auto outcome = guarded_read::read(content, given);
    if (outcome.map)
      return "accepted: " + outcome.map->description;
    if (!outcome.failure.empty())
      return outcome.failure;
    if (outcome.peak > content.size() + guarded_read::allowance)
      return "memory: " + std::to_string(outcome.peak) + " for a file of " + std::to_string(content.size());
    return outcome.message;
  }

  struct Case
  {
    std::string content, expected;
    GivenScales given = {};
  };

  void
  expect_rejections(const std::vector<Case> &cases)
  {
    for (std::size_t i = 0; i < cases.size(); ++i)
      {
        const std::string message = rejection(cases[i].content, cases[i].given);
        EXPECT_NE(message.find(cases[i].expected), std::string::npos)
            << "case " << i << "\nexpected: " << cases[i].expected << "\ngot: " << message;
        EXPECT_NE(message.find("tribodraw_guarded_"), std::string::npos) << message;
      }
  }

  template <class T>
  std::string
  changed(std::string content, std::size_t offset, T value)
  {
    const std::string bytes = Bytes().little(value).text;
    return content.replace(offset, bytes.size(), bytes);
  }

  std::string
  replaced(std::string content, const std::string &old, const std::string &by)
  {
    const auto at = content.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return content.replace(at, old.size(), by);
  }

  const double      not_a_number_64 = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const GivenScales um{ std::array<double, 2>{ 2e-3, 3e-3 }, 1e-3 };

  std::string
  of_format(const std::vector<Sample> &samples, const std::string &format, const std::string &variant)
  {
    for (const Sample &sample : samples)
      if (sample.format == format && sample.variant == variant)
        return sample.content;
    ADD_FAILURE() << format << ", " << variant;
    return "";
  }

  std::string
  npy(const std::string &dictionary, const std::string &data = std::string(160, '\1'))
  {
    Bytes bytes;
    bytes.add(std::string("\x93NUMPY\1\0", 8)).little(static_cast<std::uint16_t>(dictionary.size()));
    return bytes.add(dictionary).add(data).text;
  }

  std::string
  numbers(std::size_t n)
  {
    Bytes bytes;
    for (std::size_t i = 0; i < n; ++i)
      bytes.little(1e-6 * static_cast<double>(i % 7));
    return bytes.text;
  }
} // namespace

// Offsets of the 81-byte header: counts 42 and 44, scales 46, 54, 62, compression 78, type 79, check 80.
TEST(HostileFiles, SdfBinary)
{
  const std::string good = sdf_binary("bISO-1.0", 6, false), wide = sdf_binary("bISO-2.0", 6, false);
  std::string       big_endian = good;
  for (const auto &[begin, width] : { std::pair(42, 2), { 44, 2 }, { 46, 8 }, { 54, 8 }, { 62, 8 }, { 70, 8 } })
    std::reverse(big_endian.begin() + begin, big_endian.begin() + begin + width);
  std::string doubles = sdf_binary("bISO-1.0", 7, false);
  for (std::size_t i = 81; i < doubles.size(); i += 8)
    std::reverse(doubles.begin() + static_cast<std::ptrdiff_t>(i),
                 doubles.begin() + static_cast<std::ptrdiff_t>(i) + 8);
  expect_rejections({
      { changed<std::uint16_t>(changed<std::uint16_t>(good, 42, 65535), 44, 65535),
        "byte 81: SDF: the file is shorter" },
      { changed<std::uint32_t>(changed<std::uint32_t>(wide, 42, 0xFFFFFFFF), 46, 0xFFFFFFFF),
        "byte 85: SDF: the file is shorter" },
      { changed<std::uint16_t>(good, 42, 0), "shorter than its header" },
      { changed<std::uint16_t>(good, 44, 3), "byte 142: SDF: the file is longer than its header says" },
      { changed(good, 62, 0.), "byte 62: SDF: `Zscale` is not positive and finite. Value: 0" },
      { changed(good, 62, -1e-8), "`Zscale` is not positive" },
      { changed(good, 46, not_a_number_64), "byte 46: SDF: `Xscale` is not positive" },
      { changed(good, 54, infinity), "byte 54: SDF: `Yscale` is not positive" },
      { changed(good, 62, 1.), "the heights span more than the surface is wide" },
      { changed(good, 62, 1e-20), "the heights span less than a thousand-millionth" },
      { changed<std::uint8_t>(good, 78, 1), "byte 78: SDF: `Compression` is not supported" },
      { changed<std::uint8_t>(good, 80, 1), "byte 80: SDF: `CheckType` is not supported" },
      { changed<std::uint8_t>(good, 79, 2), "byte 79: SDF: `DataType` is unknown in this version. Value: 2" },
      { changed<std::uint8_t>(good, 79, 8), "`DataType` is unknown" },
      { big_endian, "byte 46: SDF: `Xscale` is not positive and finite" },
      { doubles, "byte order" },
      { changed(sdf_binary("bISO-1.0", 7, false), 81 + 8 * 7, infinity),
        "byte 137, column 3, row 2 from the bottom: a height is not finite" },
      { good.substr(0, 81), "shorter than its header" },
      { good.substr(0, 60), "ends in the middle of its header" },
      { replaced(good, "bISO-1.0", "bISO-9.0"), "the format of the surface file is unknown" },
  });
  std::string missing_all = good;
  for (std::size_t i = 0; i < 20; ++i)
    missing_all = changed(missing_all, 81 + 4 * i, std::numeric_limits<std::int32_t>::min());
  expect_rejections({ { missing_all, "all points of the surface are missing" } });
}

TEST(HostileFiles, SdfText)
{
  const std::string good = of_format(sdf_samples(), "sdf text", "aISO-1.0 type 7");
  expect_rejections({
      { replaced(good, "NumPoints = 5", "NumPoints = 4294967296"), "line 15: SDF: the file is shorter" },
      { replaced(good, "NumPoints = 5", "NumPoints = 99999999999999999999"),
        "line 5: SDF: `NumPoints` is not a positive integer" },
      { replaced(good, "NumPoints = 5", "NumPoints = 0"), "line 5: SDF: `NumPoints`" },
      { replaced(good, "NumPoints = 5", "NumPoints = -5"), "line 5: SDF: `NumPoints`" },
      { replaced(good, "NumPoints = 5", "NumPoints = 6"), "fewer numbers than the header says" },
      { replaced(good, "NumPoints = 5", "NumPoints = 4"), "more numbers than the header says" },
      { replaced(good, "NumPoints", "NumPaints"), "the header field `NumPoints` is missing" },
      { replaced(good, "Yscale", "Xscale"), "line 8: SDF: a header field occurs twice" },
      { replaced(good, "Zscale = +1.0E-8", "Zscale = 0"), "line 9: SDF: `Zscale` is not a positive number" },
      { replaced(good, "Zscale = +1.0E-8", "Zscale = -1"), "line 9: SDF: `Zscale`" },
      { replaced(good, "Xscale = 2.0E-6", "Xscale = nan"), "line 7: SDF: `Xscale`" },
      { replaced(good, "Xscale = 2.0E-6", "Xscale = 1e999"), "line 7: SDF: `Xscale`" },
      { replaced(good, "DataType = 7", "DataType = 1"), "line 12: SDF: `DataType` is unknown in this version" },
      { replaced(good, "Compression = 0", "Compression = 1"), "line 11: SDF: `Compression` is not supported" },
      { replaced(good, "55.0", "inf"), "line 15: SDF: neither a finite number nor `BAD`. Value: `inf`" },
      { replaced(good, "55.0", "5,5"), "line 15: SDF: neither a finite number" },
      { replaced(replaced(good, "DataType = 7", "DataType = 5"), "55.0", "70000"), "outside the range of `DataType`" },
      { good.substr(0, good.find("\n*")), "the header is not ended by a line with an asterisk" },
      { good.substr(0, good.rfind("6.0") + 2), "line 18: SDF: fewer numbers than the header says" },
      { "aISO-1.0" + std::string(5000, 'x'), "the mark of the format" },
  });
}

// Offsets: format 12, type 18, bits 98, counts 108, 112, 116, steps 120, 124, 128, unit of the heights 212.
TEST(HostileFiles, Sur)
{
  const std::string good = sur(32, false, 1, true), zlib = sur(32, true, 3, true);
  const std::size_t data = 512;
  expect_rejections({
      { changed<std::int16_t>(good, 12, 257), "byte 12: SUR: the byte order is not the one of PCs" },
      { changed<std::int16_t>(good, 18, 10), "byte 18: SUR: the file does not hold a surface" },
      { changed<std::int16_t>(good, 98, 24), "byte 98: SUR: the number of bits" },
      { changed<std::int32_t>(good, 108, -5), "byte 108: SUR: the number of points of a line is not positive" },
      { changed<std::int32_t>(good, 112, 0), "byte 112: SUR: the number of lines is not positive" },
      { changed<std::int32_t>(good, 112, 0x7FFFFFFF), "byte 116: SUR: the number of points is not that of the lines" },
      { changed<std::int32_t>(changed<std::int32_t>(changed<std::int32_t>(good, 108, 40000), 112, 50000), 116,
                              2000000000),
        "byte 512: SUR: the file is shorter" },
      { changed(good, 120, 0.f), "byte 120: SUR: the step along x is not positive" },
      { changed(good, 124, -1.f), "byte 124: SUR: the step along y" },
      { changed(good, 128, std::numeric_limits<float>::quiet_NaN()), "byte 128: SUR: the step of the heights" },
      { changed(good, 474, std::numeric_limits<float>::infinity()), "byte 474: SUR: the offset of the heights" },
      { std::string(good).replace(212, 2, "V "), "byte 212: SUR: not a unit of length. Value: `V`" },
      { std::string(good).replace(212, 2, "  "), "does not state the unit of its heights" },
      { good + "x", "byte 592: SUR: the file is longer" },
      { changed<std::uint16_t>(good, 336, 60000), "SUR: the file is shorter" },
      // the directory of the compressed form: number of blocks, then pairs of lengths
      { changed<std::uint32_t>(zlib, data, 0), "byte 512: SUR: the list of compressed blocks is empty" },
      { changed<std::uint32_t>(zlib, data, 0xFFFFFFFF), "byte 512: SUR: the list of compressed blocks" },
      { changed<std::uint32_t>(zlib, data + 4, 0xFFFFFFFF), "byte 516: SUR: a compressed block claims to hold more" },
      { changed<std::uint32_t>(zlib, data + 8, 0xFFFFFFFF),
        "byte 520: SUR: a compressed block is longer than the file" },
      { changed<std::uint32_t>(zlib, data + 4, 27),
        "byte 516: SUR: the compressed blocks hold another number of bytes" },
      { changed<std::uint32_t>(changed<std::uint32_t>(zlib, data + 4, 27), data + 12, 26),
        "SUR: a compressed block holds another number of bytes than it says" },
      { changed<std::uint32_t>(changed<std::uint32_t>(zlib, data + 4, 25), data + 12, 28),
        "SUR: a compressed block holds more than it says" },
      { changed<std::uint16_t>(zlib, data + 28, 0xFFFF), "SUR: a compressed block is damaged" },
  });
}

TEST(HostileFiles, SurBombs)
{
  // 1 GB of zeros as the heights of a map: the points fit the claim, but all are equal. And the same with a claim that
  // is too small, so that the stream must be stopped.
  const std::string zeros = deflated(std::string(64 << 20, '\0'), true);
  for (const bool honest : { true, false })
    {
      std::string       file = sur(32, true, 1, false).substr(0, 512);
      const std::size_t raw  = honest ? 64u << 20 : 1u << 20;
      file                   = changed<std::int32_t>(file, 108, 4096);
      file                   = changed<std::int32_t>(file, 112, static_cast<std::int32_t>(raw / 4 / 4096));
      file                   = changed<std::int32_t>(file, 116, static_cast<std::int32_t>(raw / 4));
      Bytes bytes;
      bytes.add(file).little<std::uint32_t>(1).little(static_cast<std::uint32_t>(raw));
      bytes.little(static_cast<std::uint32_t>(zeros.size())).add(zeros);
      EXPECT_NE(
          rejection(bytes.text)
              .find(honest ? "all heights of the surface are equal" : "a compressed block holds more than it says"),
          std::string::npos)
          << rejection(bytes.text);
    }
}

TEST(HostileFiles, X3p)
{
  const std::string data = x3p_data("D", false), main = x3p_main("D", "d", "");
  const auto        file = [&](const std::string &xml, const std::string &binary) {
    return zip({ { "main.xml", xml }, { "d", binary } });
  };
  const std::string good = file(main, data);
  ASSERT_EQ(rejection(good).substr(0, 8), "accepted");
  std::string wrong_crc = zip({ { "main.xml", main }, { "d", data, false } });
  wrong_crc[wrong_crc.find(data) + 7] ^= 1;
  expect_rejections({
      { "PK\3\4", "no complete zip archive" },
      { good.substr(0, good.size() - 30), "no complete zip archive" },
      { zip({ { "readme.txt", "text" } }), "main.xml: X3P: the archive has no description" },
      { zip({ { "main.xml", main } }), "d: X3P: the entry with the points is missing" },
      { file("", data), "main.xml" },
      { file("no XML", data), "main.xml" },
      { file(main.substr(0, 600), data), "not well-formed XML" },
      { file("<html/>", data), "the description is of something else. Value: `html`" },
      { file(replaced(main, ">SUR<", ">PRF<"), data), "main.xml/Record1: X3P: the file does not hold a surface" },
      { file(replaced(main, "<SizeX>5", "<SizeX>0"), data), "main.xml/Record3/MatrixDimension/SizeX" },
      { file(replaced(main, "<SizeX>5", "<SizeX>-5"), data), "MatrixDimension/SizeX: X3P: not a number of points" },
      { file(replaced(main, "<SizeX>5", "<SizeX>2147483647"), data), "another size than the matrix" },
      { file(replaced(main, "<SizeZ>1", "<SizeZ>2147483647"), data), "another size than the matrix" },
      { file(replaced(main, "<SizeX>5", "<SizeX>4"), data), "another size than the matrix" },
      { file(replaced(main, "2e-006", "0"), data), "main.xml/Record1/Axes/CX/Increment: X3P: the increment is not" },
      { file(replaced(main, "2e-006", "-2e-006"), data), "CX/Increment: X3P: the increment is not positive" },
      { file(replaced(main, "2e-006", "nan"), data), "CX/Increment: X3P: not a finite number" },
      { file(replaced(main, "<Increment>2e-006</Increment>", ""), data), "needs an increment" },
      { file(replaced(main, ">D<", ">Q<"), data), "CZ: X3P: unknown type of the stored numbers. Value: `Q`" },
      { file(replaced(main, "MatrixDimension>", "ListDimension>"), data), "not well-formed" },
      { file(replaced(replaced(main, "<MatrixDimension>", "<ListDimension>"), "</MatrixDimension>", "</ListDimension>"),
             data),
        "the file holds a list of points and no map" },
      { file(x3p_main("D", "d", md5("other")), data), "d: X3P: the MD5 checksum of an entry is wrong" },
      { zip({ { "main.xml", main }, { "d", data }, { "md5checksum.hex", md5("other") + " *main.xml" } }),
        "main.xml: X3P: the MD5 checksum of an entry is wrong" },
      { file(main, data.substr(0, 159)), "another size than the matrix" },
      { file(main, data + "12345678"), "another size than the matrix" },
      { wrong_crc, "an entry is damaged" },
      // entities that would grow: none is expanded
      { file("<!DOCTYPE a [<!ENTITY b \"" + std::string(1000, 'x') + "\"><!ENTITY c \"&b;&b;&b;&b;\">]><a>&c;</a>",
             data),
        "the description is of something else" },
      { file(replaced(main, "<SizeX>", std::string(2000, '<') + "<SizeX>"), data), "not well-formed" },
  });
}

TEST(HostileFiles, X3pBombs)
{
  const std::string main = x3p_main("D", "d", "");
  const std::string many = std::string(60 << 20, ' ');
  expect_rejections({
      // a description that unpacks to 60 MB, and one whose tree in memory would be 16 times as large as the text
      { zip({ { "main.xml", main + many }, { "d", "" } }), "main.xml: X3P: an entry is too long" },
      { zip({ { "main.xml", replaced(main, "<Record2>", "<Record2>" + std::string(20 << 20, ' ')) }, { "d", "" } }),
        "the description is too long" },
      // heights that unpack to 64 MB of zeros where 160 bytes belong, and where the matrix says so
      { zip({ { "main.xml", main }, { "d", std::string(64 << 20, '\0') } }), "another size than the matrix" },
      { zip({ { "main.xml", replaced(replaced(main, "<SizeX>5", "<SizeX>2048"), "<SizeY>4", "<SizeY>4096") },
              { "d", std::string(64 << 20, '\0') } }),
        "all heights of the surface are equal" },
  });
  std::string nodes;
  for (int i = 0; i < 200000; ++i)
    nodes += "<a/>";
  EXPECT_NE(rejection(zip({ { "main.xml", "<p:ISO5436_2>" + nodes + "</p:ISO5436_2>" } })).find("`Record1` is missing"),
            std::string::npos);
  // sizes in the list of entries that are not true: 0xFFFFFF00 bytes unpacked
  std::string       liar      = zip({ { "main.xml", main }, { "d", x3p_data("D", false) } });
  const std::size_t directory = liar.rfind("PK\1\2");
  liar                        = changed<std::uint32_t>(liar, directory + 24, 0xFFFFFF00);
  EXPECT_NE(rejection(liar).find("claims to hold more than is possible"), std::string::npos) << rejection(liar);
}

TEST(HostileFiles, Al3d)
{
  const auto        samples = simple_binary_samples();
  const std::string good    = of_format(samples, "al3d", "with texture"),
                    bare    = of_format(samples, "al3d", "without texture");
  const auto tag            = [&](const std::string &content, const std::string &key, std::string value) {
    value.resize(30, '\0');
    const auto at = content.find(key);
    EXPECT_NE(at, std::string::npos);
    return std::string(content).replace(at + 20, 30, value);
  };
  expect_rejections({
      { tag(good, "Cols", "4294967295"), "AL3D: more columns than the file has bytes" },
      { tag(good, "Cols", "300"), "AL3D: the file is shorter" },
      { tag(good, "Cols", "0"), "AL3D: the file is shorter" },
      { tag(good, "Cols", "-5"), "byte 121: AL3D: the tag `Cols` is not a count. Value: `-5`" },
      { tag(good, "Cols", "4"), "the depth image does not reach to the texture image" },
      { tag(good, "Rows", "5"), "the depth image reaches into the texture image" },
      { tag(bare, "Rows", "3"), "the file is longer than its tags say" },
      { tag(good, "Rows", "18446744073709551615"), "AL3D: the file is shorter" },
      { tag(good, "TagCount", "4000000000"), "AL3D: a tag is not ended by a line end" },
      { tag(good, "TagCount", "3"), "AL3D: the tag `DepthImageOffset` is missing" },
      { tag(good, "DepthImageOffset", "0"), "there is no depth image" },
      { tag(good, "DepthImageOffset", "99999999999"), "AL3D: the file is shorter" },
      { tag(good, "PixelSizeXMeter", "0"), "AL3D: the tag `PixelSizeXMeter` is not positive" },
      { tag(good, "PixelSizeYMeter", "-1e-6"), "AL3D: the tag `PixelSizeYMeter` is not positive" },
      { tag(good, "PixelSizeYMeter", "inf"), "AL3D: the tag `PixelSizeYMeter` is not a number" },
      { tag(good, "PixelSizeXMeter", "2"), "a pixel is more than 1000 times" },
      { good.substr(0, 100), "ends in the middle of its header" },
  });
}

TEST(HostileFiles, Npy)
{
  const auto dictionary = [](const std::string &type, const std::string &shape) {
    return "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }\n";
  };
  ASSERT_EQ(rejection(npy(dictionary("<f8", "4, 5"), numbers(20)), um).substr(0, 8), "accepted");
  expect_rejections({
      { npy(dictionary("<f8", "1000000000000, 1000000000000")), "NPY: the file is shorter", um },
      { npy(dictionary("<f8", "4294967296, 4294967296")), "NPY: the file is shorter", um },
      { npy(dictionary("<f8", "0, 5")), "NPY: the file is shorter", um },
      { npy(dictionary("<f8", "4, 4")), "NPY: the file is longer", um },
      { npy(dictionary("<f8", "-4, 5")), "the shape of the array is not a list of counts", um },
      { npy(dictionary("<f8", "20,")), "the array has another number of dimensions than two. Value: `1 dimensions`",
        um },
      { npy(dictionary("<f8", "2, 2, 5")), "`3 dimensions`", um },
      { npy(dictionary("|O", "4, 5")), "the type of the elements cannot be heights. Value: `|O`", um },
      { npy(dictionary("<c16", "4, 5")), "`<c16`", um },
      { npy("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (4, 5)}"), "byte 20: NPY", um },
      { npy("{'fortran_order': False, 'shape': (4, 5)}"), "the header lacks an entry", um },
      { npy("{'descr': '<f8', 'descr': '<f4'}"), "an entry of the header is unknown or occurs twice", um },
      { npy("{'descr': '<f8', 'fortran_order': Maybe}"), "neither True nor False", um },
      { npy("import os"), "byte 10: NPY: the header is not a dictionary", um },
      { npy(dictionary("<f8", "4, 5") + "x"), "text follows the header's dictionary", um },
      { std::string("\x93NUMPY\4\0", 8) + std::string(100, ' '), "byte 6: NPY: the version is unknown. Value: 4.0",
        um },
      { std::string("\x93NUMPY\2\0\xFF\xFF\xFF\x7F", 12) + std::string(100, ' '), "ends in the middle of its header",
        um },
      { npy(dictionary(">f8", "4, 5"), numbers(20)), "byte order", um },
      { npy(dictionary("<f8", "4, 5"), numbers(19) + Bytes().little(infinity).text),
        "column 5, row 1 from the bottom: a height is not finite. Value: inf", um },
      { npy(dictionary("<f8", "4, 5"), std::string(160, '\xFF')), "all points of the surface are missing", um },
      { npy(dictionary("<f8", "4, 5"), numbers(20)), "Set `Pixel size`" },
  });
}

TEST(HostileFiles, Points)
{
  std::string  scattered, square, sparse, jitter;
  std::mt19937 random(3);
  for (int i = 0; i < 400; ++i)
    {
      scattered += std::to_string(random() % 100000 / 1000.) + " " + std::to_string(random() % 100000 / 1000.) + " 1\n";
      sparse += std::to_string(i) + " " + std::to_string(i) + " " + std::to_string(i % 7) + "\n";
      square += std::to_string(i % 20) + " " + std::to_string(i / 20) + " " + std::to_string(i % 7) + "\n";
      jitter += std::to_string(i % 20 + random() % 1000 * 1e-4) + " " + std::to_string(i / 20) + " "
                + std::to_string(i % 7) + "\n";
    }
  const GivenScales square_pixels{ std::array<double, 2>{ 2e-2, 2e-2 }, 1e-3 };
  ASSERT_EQ(rejection(square, square_pixels).substr(0, 8), "accepted");
  expect_rejections({
      { scattered, "regular grid", square_pixels },
      { jitter, "regular grid", square_pixels },
      { sparse, "less than a quarter of the regular grid has a point", square_pixels },
      { square + "0 0 1\n", "line 401: a point occurs for the second time", square_pixels },
      { square + "0 0.5 1\n", "`Pixel size` does not have the proportions", square_pixels },
      { square + "0 1e300 1\n", "a point occurs for the second time", square_pixels },
      { square + "0 nan 1\n", "line 401: not a point in the list of points", square_pixels },
      { square + "0 1 inf\n", "line 401: not a point", square_pixels },
      { square + "0 21\n", "line 401: not a point", square_pixels },
      { square + "0 21 1 1\n", "line 401: not a point", square_pixels },
      { square + "0 21 1", "line 401: the file ends inside a line", square_pixels },
      { square, "`Pixel size` does not have the proportions of the coordinates", um },
      { "0 0 1\n1 0 2\n2 0 3\n3 0 1\n", "regular grid along y", square_pixels },
      { "x [V], y [V], z [V]\n" + square, "line 1: the header of the text file states something that is not a unit" },
  });
}

// Large files that are found to be wrong at their very end: a reader that keeps what it has read would need several
// times their size.
TEST(HostileFiles, LateRejectionTakesNoMemory)
{
  constexpr std::size_t n     = 5000; // 25 million points
  std::string           bytes = sdf_binary("bISO-2.0", 4, false).substr(0, 85);
  bytes                       = changed<std::uint32_t>(changed<std::uint32_t>(bytes, 42, n), 46, n);
  bytes += std::string(n * n, '\x80'); // -128: not measured
  EXPECT_NE(rejection(bytes).find("all points of the surface are missing"), std::string::npos);

  std::string text;
  for (int i = 0; i < 2500; ++i)
    {
      for (int k = 0; k < 2000; ++k)
        text += (i + k) % 3 == 0 ? "1 " : "2 ";
      text.back() = '\n';
    }
  text[text.size() - 2] = 'x';
  EXPECT_NE(rejection(text, um).find("line 2500, column 2000: not a finite number"), std::string::npos);
  const std::string one_line = std::string(text.begin(), text.end() - 2) + "\n";
  std::string       row(one_line);
  std::replace(row.begin(), row.end() - 1, '\n', ' ');
  EXPECT_NE(rejection(row, um).find("at least 2 x 2 points"), std::string::npos);

  std::string  points;
  std::mt19937 random(5);
  for (int i = 0; i < 1500000; ++i)
    points += std::to_string(random()) + " " + std::to_string(random()) + " 1\n";
  EXPECT_NE(rejection(points, um).find("regular grid along x"), std::string::npos);
}

// The measure itself: an accepted map of 16 million points takes 128 MB, for which the limit leaves no room.
TEST(HostileFiles, TheLimitOfMemoryHolds)
{
#if !defined(__SANITIZE_ADDRESS__)
  constexpr std::size_t n     = 4000;
  std::string           bytes = sdf_binary("bISO-2.0", 4, false).substr(0, 85);
  bytes                       = changed<std::uint32_t>(changed<std::uint32_t>(bytes, 42, n), 46, n);
  for (std::size_t i = 0; i < n * n; ++i)
    bytes += static_cast<char>(i % 50);
  EXPECT_EQ(guarded_read::read(bytes).failure, "other exception: std::bad_alloc");
#endif
}
