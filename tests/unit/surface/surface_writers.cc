// Files that the program writes: read back to the precision of the format, complete or not there at all.
#include "temporary_folder.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/surface/surface_reader.h>
#include <tribodraw/surface/surface_writer.h>

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>

using namespace tribodraw;

namespace
{
  namespace fs = std::filesystem;

  class SurfaceWriters : public ::testing::Test
  {
  protected:
    const TemporaryFolder folder;
  };

  /// 37 x 23 points without any symmetry, three not measured.
  HeightMap
  some_map()
  {
    HeightMap map;
    map.nx          = 37;
    map.ny          = 23;
    map.dx          = 3e-3;
    map.dy          = 1.7e-3;
    map.description = "some map,\nWidth: 3 V\nwith line breaks";
    for (std::size_t i = 0; i < map.nx * map.ny; ++i)
      map.z.push_back(1e-3 * std::sin(1.7 * static_cast<double>(i * i)) / 3.);
    map.z[0] = map.z[36] = map.z[500] = std::numeric_limits<double>::quiet_NaN();
    return map;
  }

  // What a format can hold: SDF stores the 64-bit numbers of the map, text and NPY those in um (two roundings of
  // 1.1e-16 each way), GSF 32-bit numbers in m (6.0e-8 and the roundings).
  const struct
  {
    std::string format, file;
    double      relative_error;
    GivenScales given;
  } formats[] = {
    { "sdf", "map.sdf", 0., {} },      { "sdf ascii", "ascii.sdf", 0., {} },
    { "csv", "map.csv", 4.5e-16, {} }, { "npy", "map.npy", 4.5e-16, { std::array<double, 2>{ 3e-3, 1.7e-3 }, 1e-3 } },
    { "gsf", "map.gsf", 6.1e-8, {} },
  };
} // namespace

TEST_F(SurfaceWriters, RoundTripIsExactToThePrecisionOfTheFormat)
{
  const HeightMap map = some_map();
  for (const auto &f : formats)
    {
      SCOPED_TRACE(f.format);
      write_surface_file(map, folder / f.file, f.format);
      const HeightMap back = read_surface_file(folder / f.file, f.given);
      ASSERT_EQ(back.nx, map.nx);
      ASSERT_EQ(back.ny, map.ny);
      EXPECT_NEAR(back.dx, map.dx, 1e-15 * map.dx);
      EXPECT_NEAR(back.dy, map.dy, 1e-15 * map.dy);
      EXPECT_EQ(n_missing(back), 3u);
      for (std::size_t i = 0; i < map.size(); ++i)
        if (std::isnan(map.z[i]))
          EXPECT_TRUE(std::isnan(back.z[i])) << i;
        else if (f.relative_error == 0.)
          EXPECT_EQ(back.z[i], map.z[i]) << i;
        else
          EXPECT_NEAR(back.z[i], map.z[i], f.relative_error * std::abs(map.z[i])) << i;
    }
}

TEST_F(SurfaceWriters, FormatFollowsTheExtension)
{
  const HeightMap map = some_map();
  const struct
  {
    std::string file, beginning;
  } cases[] = { { "a.sdf", "bISO-1.0tribodraw " },
                { "a.SDF", "bISO-1.0" },
                { "a.gsf", "Gwyddion Simple Field 1.0\n" },
                { "a.npy", "\x93NUMPY" },
                { "a.csv", "# tribodraw: " } };
  for (const auto &c : cases)
    {
      write_surface_file(map, folder / c.file);
      EXPECT_EQ(read_file(folder / c.file).substr(0, c.beginning.size()), c.beginning);
    }
  EXPECT_EQ(surface_format_names(), (std::vector<std::string>{ "csv", "gsf", "npy", "sdf", "sdf ascii" }));
  // Files carry no time stamps: the same map gives the same bytes.
  write_surface_file(map, folder / "b.sdf");
  EXPECT_EQ(read_file(folder / "a.sdf"), read_file(folder / "b.sdf"));
}

TEST_F(SurfaceWriters, WideMapsNeedVersionTwo)
{
  HeightMap map;
  map.nx = 65536;
  map.ny = 2;
  map.dx = map.dy = 1e-3;
  map.z.resize(map.nx * map.ny);
  for (std::size_t i = 0; i < map.size(); ++i)
    map.z[i] = 1e-6 * static_cast<double>(i % 101);
  write_surface_file(map, folder / "wide.sdf");
  EXPECT_EQ(read_file(folder / "wide.sdf").substr(0, 8), "bISO-2.0");
  const HeightMap back = read_surface_file(folder / "wide.sdf");
  EXPECT_EQ(back.nx, map.nx);
  EXPECT_EQ(back.z, map.z);
}

TEST_F(SurfaceWriters, MistakesAreReportedAndLeaveNothing)
{
  const HeightMap map   = some_map();
  const auto      error = [&](const HeightMap &m, const fs::path &file, const std::string &format = "") {
    try
      {
        write_surface_file(m, file, format);
      }
    catch (const InputError &e)
      {
        return std::string(e.what());
      }
    return std::string("written");
  };
  EXPECT_NE(error(map, folder / "map.xyz").find("csv, gsf, npy, sdf, sdf ascii"), std::string::npos);
  EXPECT_NE(error(map, folder / "map").find("unknown"), std::string::npos);
  EXPECT_NE(error(map, folder / "map.sdf", "surf").find("`surf`"), std::string::npos);
  EXPECT_NE(error(HeightMap(), folder / "map.sdf").find("an empty map cannot be written"), std::string::npos);
  EXPECT_NE(error(map, folder / "no folder" / "map.sdf").find("cannot create the file"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}
