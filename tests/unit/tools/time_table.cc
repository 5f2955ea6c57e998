#include <tribodraw/base/errors.h>
#include <tribodraw/tools/time_table.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <unistd.h>

using namespace tribodraw;

TEST(Motion, ConstantSpeedReachesItsTravel)
{
  // 58 mm at 60 mm/s take 58/60 s.
  const Motion motion = Motion::constant_speed(60, -58);
  EXPECT_DOUBLE_EQ(motion.end_time(), 58. / 60);
  EXPECT_EQ(motion.position(-1), 0);
  EXPECT_DOUBLE_EQ(motion.position(0.5), -30);
  EXPECT_EQ(motion.position(10), -58);
  EXPECT_DOUBLE_EQ(motion.velocity(0.2), -60);
  EXPECT_EQ(motion.velocity(motion.end_time()), 0);
  EXPECT_EQ(motion.velocity(-0.1), 0);
}

TEST(Motion, TableIsPiecewiseLinear)
{
  const Motion motion({ 0, 1, 3, 4 }, { 0, 10, 10, -2 });
  EXPECT_DOUBLE_EQ(motion.position(0.25), 2.5);
  EXPECT_DOUBLE_EQ(motion.position(2), 10);
  EXPECT_DOUBLE_EQ(motion.position(3.5), 4);
  EXPECT_DOUBLE_EQ(motion.velocity(0), 10); // right-sided at the points
  EXPECT_DOUBLE_EQ(motion.velocity(1), 0);
  EXPECT_DOUBLE_EQ(motion.velocity(3), -12);
  EXPECT_EQ(motion.breakpoints(), (std::vector<double>{ 0, 1, 3, 4 }));
}

TEST(Motion, VelocityIsTheDerivativeOfThePosition)
{
  const Motion motion({ 0, 0.5, 1.5, 2 }, { 0, 3, -1, 5 });
  for (const double t : { 0.1, 0.4, 0.7, 1.2, 1.6, 1.9 })
    EXPECT_NEAR((motion.position(t + 1e-6) - motion.position(t - 1e-6)) / 2e-6, motion.velocity(t), 1e-8);
}

TEST(Motion, WrongTablesAreRefused)
{
  EXPECT_THROW(Motion({ 0 }, { 0 }), InputError);
  EXPECT_THROW(Motion({ 0, 1 }, { 0, 1, 2 }), InputError);
  EXPECT_THROW(Motion({ 0, 1, 1 }, { 0, 1, 2 }), InputError);
  EXPECT_THROW(Motion({ 0, std::numeric_limits<double>::quiet_NaN() }, { 0, 1 }), InputError);
  EXPECT_THROW(Motion::constant_speed(0, 58), InputError);
  EXPECT_THROW(Motion::constant_speed(60, 0), InputError);
}

namespace
{
  /// Reads `Motion` and `Force` of a file; the message of the error, or nothing.
  std::string
  problems(const std::string &text, std::vector<TimeTable> *tables = nullptr)
  {
    Parameters parameters = Parameters::from_text(text);
    const auto motion     = Motion::read(parameters, "Motion", "Motion of the tool.");
    const auto force      = read_force_table(parameters, "Force", "Force on the tool.");
    if (tables)
      *tables = { motion, force };
    try
      {
        parameters.finish();
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }

  class TableFile
  {
  public:
    explicit TableFile(const std::string &content)
        : path(std::filesystem::temp_directory_path() / ("tribodraw_table_" + std::to_string(getpid()) + ".csv"))
    {
      std::ofstream(path) << content;
    }
    ~TableFile() { std::filesystem::remove(path); }
    const std::filesystem::path path;
  };

  const std::string force_entry = "set Force = 0 s, 0 kN, 1 s, 100 kN\n";
} // namespace

TEST(TimeTableReading, PairsWithTheirUnits)
{
  std::vector<TimeTable> tables;
  EXPECT_EQ(problems("set Motion = 0 s, 0 mm, 500 ms, -1 cm, 2 s, -10 mm\n" + force_entry, &tables), "");
  EXPECT_DOUBLE_EQ(tables[0].value(0.25), -5); // half of 10 mm at half of 0.5 s
  EXPECT_DOUBLE_EQ(tables[0].rate(0.25), -20);
  EXPECT_DOUBLE_EQ(tables[0].value(1), -10);
  EXPECT_DOUBLE_EQ(tables[1].value(0.5), 50e3); // N
}

TEST(TimeTableReading, ColumnsOfAFileWithTheirUnits)
{
  const TableFile        file("time_ms,remark,displacement_mm\n0,begin,0\n250,,2.5\n1000,end,-1\n");
  std::vector<TimeTable> tables;
  EXPECT_EQ(problems("set Motion = " + file.path.string() + "\n" + force_entry, &tables), "");
  EXPECT_DOUBLE_EQ(tables[0].value(0.125), 1.25);
  EXPECT_DOUBLE_EQ(tables[0].end_time(), 1);
  EXPECT_DOUBLE_EQ(tables[0].value(5), -1);
}

TEST(TimeTableReading, MistakesAreExplained)
{
  const auto expect = [](const std::string &text, const std::string &part) {
    const std::string message = problems(text);
    EXPECT_NE(message.find(part), std::string::npos) << part << " in\n" << message;
  };
  const std::string motion_entry = "set Motion = 0 s, 0 mm, 1 s, 10 mm\n";
  expect("set Motion = 0 s, 0 mm, 1 s\n" + force_entry, "3 items");
  expect("set Motion = 0 s, 0 mm, 1 s, 10 N\n" + force_entry, "10 N");
  expect("set Motion = 0 s, 0 mm, 1 s, 10\n" + force_entry, "Motion");
  expect("set Motion = 1 s, 0 mm, 1 s, 10 mm\n" + force_entry, "must increase");
  expect("set Motion = 0 s, 0 mm\n" + force_entry, "at least two points");
  expect("set Motion = 0 s, 0 mm, 1 s, 10 km\n" + force_entry, "out of range");
  expect("set Motion = no_such_file.csv\n" + force_entry, "no_such_file.csv");
  expect(motion_entry + "set Force = 0 s, 10 kN, 1 s, -1 kN\n", "point 2");
  expect(force_entry, "Motion");
  const std::pair<const char *, const char *> files[]
      = { { "time_s,displacement_s\n0,0\n1,1\n", "displacement_s" },
          { "time_s,path_mm\n0,0\n1,1\n", "displacement_mm" },
          { "time_s,displacement_mm\n0,0\nx,1\n", "row 2: column 'time_s'" },
          { "time_s,displacement_mm\n0,0\n1,nan\n", "nan mm" },
          { "", "is empty" } };
  for (const auto &[content, part] : files)
    {
      const TableFile file(content);
      expect("set Motion = " + file.path.string() + "\n" + force_entry, part);
    }
}
