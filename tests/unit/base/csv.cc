#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

using namespace tribodraw;

namespace
{
  std::filesystem::path scratch(const std::string &name)
  {
    return std::filesystem::temp_directory_path() / (name + std::to_string(::getpid()));
  }
} // namespace

TEST(Csv, WritesFullPrecisionAndReadsBack)
{
  CsvTable table({"x_mm", "n", "text"});
  table.add_row({1. / 3., 4l, std::string("a")});
  table.add_row({1e-300, -1l, std::string("b")});
  const auto file = scratch("csv_round_trip.csv");
  table.save(file);
  const CsvData data = read_csv(file);
  EXPECT_EQ(data.numbers("x_mm"), (std::vector<double>{1. / 3., 1e-300}));
  EXPECT_FALSE(data.has("y"));
  EXPECT_THROW(data.numbers("text"), InputError);
  EXPECT_THROW(data.numbers("y"), InputError);
  std::filesystem::remove(file);
}

TEST(Csv, RejectsRaggedFiles)
{
  const auto file = scratch("csv_ragged.csv");
  write_file(file, "a,b\n1,2\n3\n");
  try
    {
      read_csv(file);
      FAIL();
    }
  catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find(":3"), std::string::npos) << e.what();
    }
  std::filesystem::remove(file);
}

TEST(Files, FolderThatCannotBeWritten)
{
  const auto file = scratch("a_file");
  write_file(file, "x");
  EXPECT_THROW(prepare_output_folder(file / "below"), InputError);
  EXPECT_THROW(write_file(file / "below" / "f", "x"), InputError);
  EXPECT_THROW(read_file(file, 0), InputError);
  std::filesystem::remove(file);
  EXPECT_THROW(read_file(file), InputError);
}

// FNV-1a test vectors of the authors (Fowler, Noll, Vo): "" and "foobar".
TEST(Files, HashIsFnv1a)
{
  EXPECT_EQ(hash_text(""), "cbf29ce484222325");
  EXPECT_EQ(hash_text("foobar"), "85944171f73967e8");
}
