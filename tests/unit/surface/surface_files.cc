// Readers and writers of surface files. Byte sequences are written by this test, not by the program's writers, except
// in the round trips.
#include "temporary_folder.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/surface/surface.h>
#include <tribodraw/surface/surface_reader.h>
#include <tribodraw/surface/surface_writer.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>

using namespace tribodraw;

namespace
{
  namespace fs = std::filesystem;

  class SurfaceFiles : public ::testing::Test
  {
  protected:
    const TemporaryFolder folder;

    fs::path
    write(const std::string &content) const
    {
      const fs::path file = folder / "surface.dat";
      write_file(file, content);
      return file;
    }

    std::string
    error_of(const std::string &content, const GivenScales &given = {}) const
    {
      try
        {
          read_surface_file(write(content), given);
        }
      catch (const InputError &e)
        {
          return e.what();
        }
      return "accepted";
    }
  };

  std::string
  floats(const std::vector<float> &values)
  {
    std::string bytes;
    for (const float value : values)
      {
        std::uint32_t bits;
        std::memcpy(&bits, &value, 4);
        for (int i = 0; i < 4; ++i)
          bytes += static_cast<char>(bits >> (8 * i));
      }
    return bytes;
  }

  const std::string magic        = "Gwyddion Simple Field 1.0\n";
  const std::string units_of_gsf = "XYUnits = m\nZUnits = m\n";
  const std::string size_of_gsf  = "XReal = 6e-6\nYReal = 8e-6\n";

  std::string
  gsf(std::string header, const std::string &data)
  {
    header = magic + header;
    return header + std::string(4 - header.size() % 4, '\0') + data;
  }

  // 3 x 2 points; heights in m with exact binary fractions of the float format.
  const std::vector<float> heights{ 1e-6f, 2e-6f, 3e-6f, -1e-6f, -2e-6f, -3e-6f };

  HeightMap
  some_map()
  {
    HeightMap map;
    map.nx          = 5;
    map.ny          = 4;
    map.dx          = 3e-3;
    map.dy          = 2e-3;
    map.description = "some map\nwith a line break";
    for (int i = 0; i < 20; ++i)
      map.z.push_back(1e-3 * std::sin(1.7 * i * i));
    return map;
  }

  const GivenScales both{ std::array<double, 2>{ 3e-3, 3e-3 }, 1e-3 };
} // namespace

TEST_F(SurfaceFiles, GsfIsReadWithTheTopRowLast)
{
  const auto map = read_surface_file(
      write(gsf("XRes = 3\nYRes = 2\n" + size_of_gsf + units_of_gsf + "Title = t = 1\n", floats(heights))));
  ASSERT_EQ(map.nx, 3u);
  ASSERT_EQ(map.ny, 2u);
  EXPECT_DOUBLE_EQ(map.dx, 2e-3); // 6 um / 3
  EXPECT_DOUBLE_EQ(map.dy, 4e-3); // 8 um / 2
  for (std::size_t ix = 0; ix < 3; ++ix)
    {
      EXPECT_DOUBLE_EQ(map(ix, 1), 1e3 * heights[ix]); // m to mm; first row of the file is the top
      EXPECT_DOUBLE_EQ(map(ix, 0), 1e3 * heights[3 + ix]);
    }
  EXPECT_FALSE(map.periodic);
  EXPECT_NE(map.description.find("surface.dat"), std::string::npos);
}

TEST_F(SurfaceFiles, GsfVariants)
{
  // Every padding (1 to 4 zero bytes), carriage returns, and units with prefix.
  for (const std::string title : { "", "a", "ab", "abc" })
    EXPECT_EQ(
        error_of(gsf("XRes = 3\nYRes = 2\n" + size_of_gsf + units_of_gsf + "Title = " + title + "\n", floats(heights))),
        "accepted");
  const auto windows = read_surface_file(write(
      "Gwyddion Simple Field 1.0\r\nXRes=3\r\nYRes = 2\r\nXReal = 6\r\nYReal = 8\r\nXYUnits = \xC2\xB5m\r\nZUnits = um "
      "\r\n"
      + std::string(
          4
              - (std::string("Gwyddion Simple Field 1.0\r\nXRes=3\r\nYRes = 2\r\nXReal = 6\r\nYReal = 8\r\nXYUnits = "
                             "\xC2\xB5m\r\nZUnits = um \r\n")
                     .size()
                 % 4),
          '\0')
      + floats({ 1, 2, 3, 0, 0, 0 })));
  EXPECT_DOUBLE_EQ(windows.dx, 2e-3);
  EXPECT_DOUBLE_EQ(windows(1, 1), 2e-3);
  // Scales the file does not state come from the parameter file.
  const auto given = read_surface_file(write(gsf("XRes = 3\nYRes = 2\n", floats(heights))),
                                       { std::array<double, 2>{ 1e-3, 2e-3 }, 1. });
  EXPECT_DOUBLE_EQ(given.dy, 2e-3);
  EXPECT_DOUBLE_EQ(given(0, 1), heights[0]);
}

TEST_F(SurfaceFiles, TextMatrixVariantsGiveTheSameMap)
{
  // Rows from the top: 1 2 3 / 4 5 6 (um).
  for (const std::string content : { "1 2 3\n4 5 6\n", "1 2 3\r\n4 5 6\r\n",
                                     "\xEF\xBB\xBF"
                                     "1 2 3\n4 5 6\n",
                                     "  1\t2\t3\n\n4\t5\t6\n\n", "1;2;3\n4;5;6\n", "1;2;3;\n4;5;6;\n",
                                     "1, 2, 3\n4, 5, 6\n", "1.0,2.0,3.0\n4.0,5.0,6.0\n", "+1 2e0 0.3E+1\n4. 5 6\n",
                                     "# measured yesterday: yes\n1 2 3\n# half way\n4 5 6\n" })
    {
      const auto map = read_surface_file(write(content), both);
      ASSERT_EQ(map.nx, 3u) << content;
      ASSERT_EQ(map.ny, 2u) << content;
      for (int i = 0; i < 3; ++i)
        {
          EXPECT_DOUBLE_EQ(map(i, 1), 1e-3 * (i + 1)) << content;
          EXPECT_DOUBLE_EQ(map(i, 0), 1e-3 * (i + 4)) << content;
        }
    }
}

TEST_F(SurfaceFiles, TextMatrixStatesItsScalesInComments)
{
  const auto map
      = read_surface_file(write("# Channel: topography\n# Width: 0.06 mm\n# Height: 20 \xC2\xB5m\n# Value units: nm\n"
                                "1 2 3\n4 5 6\n"));
  EXPECT_DOUBLE_EQ(map.dx, 0.02);
  EXPECT_DOUBLE_EQ(map.dy, 0.01);
  EXPECT_DOUBLE_EQ(map(0, 1), 1e-6);
}

TEST_F(SurfaceFiles, MissingPointsAreNaNAndRefusedByReadSurface)
{
  const auto file = write("1 BAD 3\n4 nan 6\n");
  const auto map  = read_surface_file(file, both);
  EXPECT_EQ(n_missing(map), 2u);
  EXPECT_TRUE(std::isnan(map(1, 0)));
  EXPECT_TRUE(std::isnan(map(1, 1)));
  EXPECT_DOUBLE_EQ(map(2, 0), 6e-3);
  EXPECT_EQ(n_missing(read_surface_file(write("1;;3\n4;5;6\n"), both)), 1u);
  EXPECT_EQ(n_missing(read_surface_file(write("1;;3\n4;5;\n"), both)), 2u);
  EXPECT_EQ(
      n_missing(read_surface_file(write(gsf("XRes = 3\nYRes = 2\n" + size_of_gsf + units_of_gsf,
                                            floats({ 1e-6f, std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0 }))))),
      1u);

  auto parameters = Parameters::from_text(
      "set Model = file\nsubsection Processing\nset Form = mean\nend\nsubsection File\nset Path = "
      + write("1 BAD 3\n4 nan 6\n").string() + "\nset Pixel size = 3 um\nset Height unit = um\nend\n");
  const auto surface = read_surface(parameters);
  parameters.finish();
  try
    {
      surface();
      ADD_FAILURE() << "accepted";
    }
  catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find("2 of 6"), std::string::npos) << e.what();
    }
}

TEST_F(SurfaceFiles, RoundTrips)
{
  const auto     map  = some_map();
  const fs::path text = folder / "map.txt", field = folder / "map.gsf";
  write_ascii_matrix(map, text);
  write_gsf(map, field);
  const auto a = read_surface_file(text), b = read_surface_file(field);
  ASSERT_EQ(a.size(), 20u);
  ASSERT_EQ(b.size(), 20u);
  EXPECT_EQ(a.nx, 5u);
  EXPECT_EQ(b.nx, 5u);
  EXPECT_NEAR(a.dx, 3e-3, 1e-17);
  EXPECT_NEAR(b.dy, 2e-3, 1e-17);
  for (std::size_t i = 0; i < 20; ++i)
    {
      EXPECT_NEAR(a.z[i], map.z[i], 1e-15 * std::abs(map.z[i])); // shortest decimal, unit conversion rounds
      EXPECT_NEAR(b.z[i], map.z[i], 6e-8 * std::abs(map.z[i]));  // half a unit of the 24-bit mantissa
    }
}

TEST_F(SurfaceFiles, MalformedGsfIsRejected)
{
  const std::string sizes = "XRes = 3\nYRes = 2\n", head = sizes + size_of_gsf + units_of_gsf, data = floats(heights);
  const float       nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const struct
  {
    std::string content, expected;
    GivenScales given = {};
  } cases[] = {
    { gsf(head, data.substr(0, 23)), "shorter than its header" },
    { gsf(head, ""), "shorter than its header" },
    { gsf(head, data + "x"), "longer than its header" },
    { magic + head, "not ended by a zero byte" },
    { magic, "not ended by a zero byte" },
    { magic + std::string("XRes = 3\nYRes = 2\nXX=1\n") + std::string(1, '\0') + "abc" + data, "not padded" },
    { gsf("YRes = 2\n" + size_of_gsf + units_of_gsf, data), "`XRes` is missing" },
    { gsf("XRes = 3\n" + size_of_gsf + units_of_gsf, data), "`YRes` is missing" },
    { gsf("XRes = -3\nYRes = 2\n" + size_of_gsf + units_of_gsf, data), "`XRes` is not a positive integer" },
    { gsf("XRes = 0\nYRes = 2\n" + size_of_gsf + units_of_gsf, data), "`XRes` is not a positive integer" },
    { gsf("XRes = 3.5\nYRes = 2\n" + size_of_gsf + units_of_gsf, data), "`XRes` is not a positive integer" },
    { gsf("XRes = 99999999999999999999999\nYRes = 2\n", data), "`XRes` is not a positive integer" },
    // product overflows 64 bits to a small number
    { gsf("XRes = 4294967296\nYRes = 4294967296\n" + units_of_gsf, data), "shorter than its header" },
    { gsf("XRes = 100000\nYRes = 100000\n" + units_of_gsf, data), "shorter than its header" },
    { gsf(sizes + "XReal = -1\nYReal = 1\n" + units_of_gsf, data), "`XReal` is not a positive number" },
    { gsf(sizes + "XReal = nan\nYReal = 1\n" + units_of_gsf, data), "`XReal` is not a positive number" },
    { gsf(sizes + "XReal = 1\nYReal = 0\n" + units_of_gsf, data), "`YReal` is not a positive number" },
    { gsf(sizes + size_of_gsf + "XYUnits = V\nZUnits = m\n", data), "`XYUnits` is not a unit of length" },
    { gsf(sizes + size_of_gsf + "XYUnits = m\nZUnits = N\n", data), "`ZUnits` is not a unit of length" },
    { gsf(sizes + size_of_gsf + "XYUnits = m\n", data), "set `Height unit`" },
    { gsf(sizes + size_of_gsf + "ZUnits = m\n", data), "set `Pixel size`" },
    { gsf(sizes + units_of_gsf, data), "set `Pixel size`" },
    { gsf(head + "nonsense\n", data), "line 8" },
    { gsf(head + "XRes = 4\n", data), "occurs twice" },
    { gsf(head, floats({ nan, nan, nan, nan, nan, nan })), "all points of the surface are missing" },
    { gsf(head, floats({ 1e-6f, infinity, 0, 0, 0, 0 })), "byte 100, column 2, row 2" },
    { gsf(head, floats({ 1, 2, 3, 4, 5, 6 })), "span more than the surface is wide" },
    { gsf(head, floats({ 1, 1, 1, 1, 1, 1 })), "equal" },
    { gsf(head, data), "`Pixel size` is given although", { std::array<double, 2>{ 1e-3, 1e-3 }, {} } },
    { gsf(head, data), "`Height unit` is given although", { {}, 1e-3 } },
    { gsf("XRes = 6\nYRes = 1\n" + size_of_gsf + units_of_gsf, data), "at least 2 x 2" },
  };
  for (const auto &c : cases)
    {
      const auto error = error_of(c.content, c.given);
      // the hint starts a sentence: compare without case of its first letter
      std::string expected = c.expected;
      if (expected.compare(0, 4, "set ") == 0)
        expected[0] = 'S';
      EXPECT_NE(error.find(expected), std::string::npos) << "expected: " << expected << "\ngot: " << error;
      EXPECT_NE(error.find("surface.dat"), std::string::npos) << error;
    }
}

TEST_F(SurfaceFiles, GsfTruncatedAtAnyByteIsRejected)
{
  const std::string whole = gsf("XRes = 3\nYRes = 2\n" + size_of_gsf + units_of_gsf, floats(heights));
  ASSERT_EQ(error_of(whole), "accepted");
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_NE(error_of(whole.substr(0, n)), "accepted") << n;
}

TEST_F(SurfaceFiles, MalformedTextIsRejected)
{
  const struct
  {
    std::string content, expected;
    GivenScales given = both;
  } cases[] = {
    { "", "empty" },
    { "# only a comment\n", "format of the surface file is unknown" },
    { "hello world\n", "format of the surface file is unknown" },
    { std::string("1 2\0 3\n", 7), "format of the surface file is unknown" },
    { "Gwyddion Simple Field 2.0\nXRes = 3\n", "format of the surface file is unknown" },
    { "1 2 3\n4 5\n", "line 2" },
    { "1 2 3\n4 5\n", "differ in length" },
    { "1 2 3\n4 5 x6\n", "line 2, column 3" },
    { "1 2 3\n4 5 6 7\n", "differ in length" },
    { "1,5 2,5 3,5\n4,5 5,5 6,5\n", "decimal" },
    { "1,5 2,5\n3,5 4,5\n", "decimal commas" },
    { "1 2 3\n4 5 6", "line 2: the file ends inside a line" },
    { "BAD nan\n*** ---\n", "all points of the surface are missing" },
    { "1;2;\n4;5;6\n", "differ in length" },
    { "1 inf 3\n4 5 6\n", "line 1, column 2: not a finite number" },
    { "1 1e999 3\n4 5 6\n", "`1e999`" },
    { "1 2 3\n", "at least 2 x 2" },
    { "1\n2\n", "at least 2 x 2" },
    { "1 2 3\n4 5 6\n", "Set `Height unit`", { std::array<double, 2>{ 3e-3, 3e-3 }, {} } },
    { "1 2 3\n4 5 6\n", "Set `Pixel size`", { {}, 1e-3 } },
    { "1 2 3\n4 5 6\n", "span more than", { std::array<double, 2>{ 1e-3, 1e-3 }, 1. } },
    { "# Value units: nm\n1 2 3\n4 5 6\n", "`Height unit` is given although" },
    { "# Value units: V\n1 2 3\n4 5 6\n", "line 1: the header of the text file states something that is not a unit" },
    { "# Value units: nm\n# Value units: um\n1 2 3\n4 5 6\n", "second time" },
    { "# Width: 6 um\n# Height: 4 um\n1 2 3\n4 5 6\n", "`Pixel size` is given although" },
    { "# Width: 6\n1 2 3\n4 5 6\n", "not a positive length" },
    { "# Width: -6 um\n1 2 3\n4 5 6\n", "not a positive length" },
  };
  for (const auto &c : cases)
    {
      const auto error = error_of(c.content, c.given);
      EXPECT_NE(error.find(c.expected), std::string::npos)
          << "content: " << c.content << "\nexpected: " << c.expected << "\ngot: " << error;
    }
}

TEST_F(SurfaceFiles, ParameterFileNamesPathAndScales)
{
  const auto file = write("1 2 3\n4 5 6\n");
  const auto text = [&](const std::string &entries,
                        const std::string &form = "subsection Processing\nset Form = mean\nend\n") {
    return "set Model = file\n" + form + "subsection File\nset Path = " + file.string() + "\n" + entries + "end\n";
  };
  auto       parameters = Parameters::from_text(text("set Pixel size = 3 um, 4 um\nset Height unit = nm\n"));
  const auto surface    = read_surface(parameters);
  parameters.finish();
  const auto map = surface();
  EXPECT_DOUBLE_EQ(map.dx, 3e-3);
  EXPECT_DOUBLE_EQ(map.dy, 4e-3);
  EXPECT_NEAR(map(0, 1), -2.5e-6, 1e-20); // 1 nm, mean 3.5 nm subtracted

  const struct
  {
    std::string text, expected;
  } cases[] = {
    { text("set Pixel size = 3 um\nset Height unit = volt\n"), "not a unit of length" },
    { text("set Pixel size = 3\nset Height unit = um\n"), "Pixel size" },
    { text("set Pixel size = 3 um, 3 um, 3 um\nset Height unit = um\n"), "3 values" },
    { text("set Pixel width = 3 um\n"), "Pixel width" },
    { "set Model = file\nsubsection Processing\nset Form = mean\nend\nsubsection File\nset Path = "
      "no_such_file.gsf\nend\n",
      "no_such_file.gsf" },
  };
  for (const auto &c : cases)
    {
      auto p = Parameters::from_text(c.text);
      read_surface(p);
      try
        {
          p.finish();
          ADD_FAILURE() << "accepted: " << c.text;
        }
      catch (const InputError &e)
        {
          EXPECT_NE(std::string(e.what()).find(c.expected), std::string::npos) << e.what();
        }
    }
}

TEST(LengthUnit, KnowsLengthsOnly)
{
  EXPECT_DOUBLE_EQ(length_unit("m").value(), 1e3);
  EXPECT_DOUBLE_EQ(length_unit("um").value(), 1e-3);
  EXPECT_DOUBLE_EQ(length_unit("\xC2\xB5m").value(), 1e-3);
  EXPECT_DOUBLE_EQ(length_unit("\xCE\xBCm").value(), 1e-3);
  EXPECT_DOUBLE_EQ(length_unit("\xB5m").value(), 1e-3);
  EXPECT_DOUBLE_EQ(length_unit("nm").value(), 1e-6);
  for (const std::string text : { "", "1", "V", "m^2", "1/m", "N" })
    EXPECT_FALSE(length_unit(text)) << text;
}
