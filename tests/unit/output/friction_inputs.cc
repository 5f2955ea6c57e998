#include "temporary_folder.h"
#include "unit/lubrication/hand_made_table.h"

#include <tribodraw/base/csv.h>
#include <tribodraw/output/friction_inputs.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

using namespace tribodraw;

// Die and punch have one table, that of the holder has other numbers, and the pad's is a copy of the first one: each
// table is there once, under the name of the first tool that has it.
TEST(FrictionInputs, tables_that_tools_share_are_written_once)
{
  const TemporaryFolder folder;
  const auto            shared = test::hand_made_table(), other = test::hand_made_table();
  other->ploughing_coefficient = Table<2>(shared->ploughing_coefficient.axes(), std::vector<double>(8, 0.1));
  shared->provenance["tool_map"]["description"] = "ground";
  write_friction_inputs(
      { { "Die", shared }, { "Punch", shared }, { "Blank holder", other }, { "Pad", test::hand_made_table() } },
      folder.path());
  std::set<std::string> files;
  for (const auto &entry : std::filesystem::directory_iterator(folder.path()))
    files.insert(entry.path().filename().string());
  EXPECT_EQ(files,
            (std::set<std::string>{ "surfaces.csv", "friction_table.csv", "friction_table_of_Blank_holder.csv" }));
  const auto mu = [&](const char *file) { return read_csv(folder / file).numbers("mu_boundary").front(); };
  EXPECT_NEAR(mu("friction_table_of_Blank_holder.csv") - mu("friction_table.csv"), 0.1 - 0.02, 1e-12);
}
