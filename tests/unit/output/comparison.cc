// Measured against computed curves: figures of known differences, units, and what does not fit.
#include "temporary_folder.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/output/comparison.h>

#include "claims.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <limits>

using namespace tribodraw;

namespace
{
  /// history.csv with the punch force F = 2 x kN up to 40 mm.
  void
  write_run(const TemporaryFolder &folder)
  {
    std::string text = "time_s,punch_travel_mm,punch_force_n\n";
    for (int i = 0; i <= 40; i += 4)
      text += std::to_string(i) + "," + std::to_string(i) + "," + std::to_string(2000 * i) + "\n";
    write_file(folder / "history.csv", text);
  }
} // namespace

// Computed 2 x, measured 2 x + 1 at x = 5, 15, 25: difference -1 kN throughout; areas of straight lines are exact.
TEST(Comparison, FiguresOfAConstantDifference)
{
  TemporaryFolder folder;
  write_run(folder);
  write_file(folder / "measured.csv", "punch_travel_mm,punch_force_kn,temperature\n5,11,20\n15,31,20\n25,51,20\n50,0,20\n25,60,20\n26,,20\n");
  const auto curves = compare_with_run(read_measured_table((folder / "measured.csv").string()), folder.path(), {});
  ASSERT_EQ(curves.size(), 1u);
  const auto &c = curves[0];
  EXPECT_EQ(c.quantity, "punch_force_n");
  EXPECT_EQ(c.points, 3u);
  EXPECT_EQ(c.left_out, 2u); // the way back and the empty cell
  EXPECT_NEAR(c.rms, 1000, 1e-9);
  EXPECT_NEAR(c.mean, -1000, 1e-9);
  EXPECT_NEAR(c.largest, -1000, 1e-9);
  EXPECT_TRUE(claims::agrees("curve 1 kN too low, rms over the peak of 51 kN", "1/51", c.relative_rms(), 1. / 51, 1e-12));
  EXPECT_TRUE(claims::agrees("area under a measured curve, N mm", "mean height times length", c.measured_area, 31e3 * 20, 1e-6)); // mean height times length
  EXPECT_NEAR(c.computed_area, 30e3 * 20, 1e-6);
  EXPECT_EQ(c.computed_peak, 50e3);
  write_comparison(curves, folder.path());
  EXPECT_NE(read_file(folder / "compare.csv").find("punch_force_n,punch_travel_mm,3,5,40,"), std::string::npos) << read_file(folder / "compare.csv");
}

TEST(Comparison, ColumnsCanBeNamed)
{
  TemporaryFolder folder;
  write_run(folder);
  write_file(folder / "measured.csv", "F_kn,stroke_m\n2,0.001\n4,0.002\n6,0.003\n");
  const auto measured = read_measured_table((folder / "measured.csv").string());
  const auto curves   = compare_with_run(measured, folder.path(), { { "stroke_m", "punch_travel_mm" }, { "F_kn", "punch_force_n" } });
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_NEAR(curves[0].rms, 0, 1e-9);
  EXPECT_NEAR(curves[0].to, 3, 1e-12);
}

TEST(Comparison, WhatDoesNotFitIsExplained)
{
  TemporaryFolder folder;
  write_run(folder);
  const auto problem = [&](const std::string &csv, const std::vector<std::pair<std::string, std::string>> &pairs = {}) -> std::string {
    write_file(folder / "m.txt", csv);
    try
      {
        compare_with_run(read_measured_table((folder / "m.txt").string()), folder.path(), pairs);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  };
  const auto has = [](const std::string &text, const std::string &piece) { EXPECT_NE(text.find(piece), std::string::npos) << text; };
  has(problem("stroke_mm,load_kn\n1,1\n2,2\n"), "--columns");
  has(problem("punch_travel_mm,punch_force_kn\n50,1\n60,2\n"), "do not overlap");
  has(problem("punch_travel_mm,punch_force_kn\n5,1\n5,2\n"), "fewer than two points");
  has(problem("punch_travel_mm,punch_force_mm\n1,1\n5,2\n"), "units of the columns do not fit");
  has(problem("punch_travel_mm,punch_force_kn\n1,1\n2,x\n"), "is not a number");
  has(problem("a,b\n1,1\n2,2\n", { { "a", "punch_travel_mm" }, { "c", "punch_force_n" } }), "no column 'c'");
}

namespace
{
  struct Row
  {
    float    travel;
    double   force;
    char     comment[8];
  };

  /// An HDF5 file with a compound table `/parts/curve` and, with @p second, another one.
  void
  write_hdf5(const std::filesystem::path &path, const bool second)
  {
    const hid_t file  = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t group = H5Gcreate2(file, "parts", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t text  = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, 8);
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Row));
    H5Tinsert(type, "punch_travel_mm", HOFFSET(Row, travel), H5T_NATIVE_FLOAT);
    H5Tinsert(type, "punch_force_kn", HOFFSET(Row, force), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "comment", HOFFSET(Row, comment), text);
    const Row     rows[3] = { { 1, 2.5, "a" }, { 2, 4.5, "b" }, { 3, 6.5, "c" } };
    const hsize_t n       = 3;
    const hid_t   space   = H5Screate_simple(1, &n, nullptr);
    for (const char *name : { "curve", "other" })
      if (second || std::string(name) == "curve")
        {
          const hid_t data = H5Dcreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
          H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows);
          H5Dclose(data);
        }
    H5Sclose(space);
    H5Tclose(type);
    H5Tclose(text);
    H5Gclose(group);
    H5Fclose(file);
  }
} // namespace

TEST(Comparison, TablesOfHdf5Files)
{
  TemporaryFolder folder;
  write_run(folder);
  const std::string one = (folder / "one.h5").string(), two = (folder / "two.hdf5").string();
  write_hdf5(one, false);
  write_hdf5(two, true);
  for (const std::string &path : { one, two + ":/parts/curve" })
    {
      const MeasuredTable table = read_measured_table(path);
      ASSERT_EQ(table.columns.size(), 2u); // the comment is no number
      EXPECT_EQ(table.column("punch_travel_mm").values, (std::vector<double>{ 1, 2, 3 }));
      const auto curves = compare_with_run(table, folder.path(), {});
      ASSERT_EQ(curves.size(), 1u);
      EXPECT_NEAR(curves[0].mean, -500, 1e-9);
    }
  const auto problem = [](const std::string &path) -> std::string {
    try
      {
        read_measured_table(path);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  };
  EXPECT_NE(problem(two).find("/parts/curve, /parts/other"), std::string::npos) << problem(two);
  EXPECT_NE(problem(one + ":/parts/none").find("there is no '/parts/none'"), std::string::npos);
  EXPECT_NE(problem((folder / "none.h5").string()).find("does not exist"), std::string::npos);
  write_file(folder / "broken.h5", read_file(one).substr(0, 900));
  EXPECT_NE(problem((folder / "broken.h5").string()).find("not an HDF5 file, or a damaged one"), std::string::npos);
}

TEST(Comparison, GroupsOfHdf5ColumnsAreTables)
{
  TemporaryFolder   folder;
  const std::string path = (folder / "columns.h5").string();
  const hid_t       file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t     n    = 2;
  const hid_t       space = H5Screate_simple(1, &n, nullptr);
  const int         values[2] = { 3, 4 };
  for (const char *name : { "time_s", "force_n" })
    {
      const hid_t data = H5Dcreate2(file, name, H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      H5Dwrite(data, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
      H5Dclose(data);
    }
  H5Sclose(space);
  H5Fclose(file);
  const MeasuredTable table = read_measured_table(path);
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.column("time_s").values, (std::vector<double>{ 3, 4 }));
}
