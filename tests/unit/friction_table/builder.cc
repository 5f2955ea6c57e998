#include "sample_pair.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <gtest/gtest.h>

#include <filesystem>

using namespace tribodraw;

namespace
{
  std::string
  pair_file(const std::string &tool, const std::string &friction_table)
  {
    return "subsection Sheet surface\n" + test::bimodal_sheet(64) + "end\n" + //
           "subsection Tool surface\n" + tool + "end\n" +                     //
           "subsection Flattening\n set Model = Wilson-Sheu\n set Asperity half spacing = 25 um\n set Strain rate = "
           "0.1 1/s\nend\n"
           "subsection Boundary friction\n set Model = power law\n subsection Power law\n"
           "  set c0 = 11.2 Pa^0.25\n  set m = 0.75\n end\nend\n"
           "subsection Friction table\n"
           + friction_table
           + "end\n"
             "subsection Sheet material\n"
             " set Young's modulus = 210 GPa\n set Poisson's ratio = 0.3\n set Yield locus = von Mises\n"
             " set Hardening = Swift\n subsection Swift\n"
             "  set Strength coefficient = 500 MPa\n  set Initial strain = 0.005\n  set Hardening exponent = 0.22\n "
             "end\nend\n";
  }

  const std::string few_points = " set Pressures = 1, 10, 50 MPa\n set Strains = 0, 0.1, 0.4\n set Cut heights = 5\n";

  FrictionTableBuilder
  read(const std::string &text, const std::string &zone = "")
  {
    Parameters           parameters = Parameters::from_text(text);
    FrictionTableBuilder builder    = FrictionTableBuilder::read(parameters, zone);
    parameters.finish();
    return builder;
  }

  std::string
  problems(const std::string &friction_table)
  {
    try
      {
        read(pair_file("set Model = smooth\n", friction_table));
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "accepted";
  }

  struct Folder
  {
    std::filesystem::path path = std::filesystem::temp_directory_path() / "tribodraw_table_cache";

    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
  };
} // namespace

// Built once, found again with the same content; a file that was damaged is built again, not believed.
TEST(FrictionTableBuilder, KeepsTables)
{
  const Folder         folder;
  FrictionTableBuilder first         = read(pair_file("set Model = smooth\n", few_points));
  double               last_progress = 0;
  const FrictionTable  built         = first.load_or_build(folder.path, [&](double done) {
    EXPECT_GE(done, last_progress);
    last_progress = done;
  });
  EXPECT_EQ(last_progress, 1.);
  EXPECT_FALSE(first.was_cached());
  EXPECT_TRUE(std::filesystem::exists(first.cached_file(folder.path)));

  FrictionTableBuilder second = read(pair_file("set Model = smooth\n", few_points));
  const FrictionTable  kept   = second.load_or_build(folder.path);
  EXPECT_TRUE(second.was_cached());
  EXPECT_EQ(kept.to_json(), built.to_json());
  EXPECT_EQ(kept.provenance.at("fingerprint"), second.fingerprint());
  EXPECT_NE(kept.provenance.at("settings").get<std::string>().find("Asperity half spacing"), std::string::npos);

  const auto        file    = second.cached_file(folder.path);
  const std::string content = read_file(file);
  write_file(file, content.substr(0, 1000));
  const FrictionTable again = second.load_or_build(folder.path);
  EXPECT_FALSE(second.was_cached());
  EXPECT_EQ(again.to_json(), built.to_json());
  EXPECT_EQ(read_file(file), content);
}

TEST(FrictionTableBuilder, FingerprintDependsOnWhatMatters)
{
  const std::string base        = pair_file("set Model = smooth\n", few_points);
  const auto        fingerprint = [](const std::string &text) { return read(text).fingerprint(); };
  const auto        replaced    = [&](const std::string &from, const std::string &to) {
    std::string text = base;
    text.replace(text.find(from), from.size(), to);
    return fingerprint(text);
  };
  const std::string reference = fingerprint(base);
  EXPECT_EQ(fingerprint(base), reference);
  EXPECT_NE(replaced("= 25 um", "= 26 um"), reference);
  EXPECT_NE(replaced("set Seed = 1", "set Seed = 2"), reference);
  EXPECT_NE(replaced("11.2 Pa", "11.3 Pa"), reference);
  EXPECT_NE(replaced("500 MPa", "510 MPa"), reference);
  EXPECT_NE(replaced("10, 50 MPa", "10, 60 MPa"), reference);
  EXPECT_NE(fingerprint(pair_file(test::ground_tool(64), few_points)), reference);
  // Comments and the order of entries do not matter.
  EXPECT_EQ(fingerprint("# a comment\n" + base), reference);
}

TEST(FrictionTableBuilder, ReadsToolSurfacesByZone)
{
  const std::string zones
      = "subsection Punch\nset Model = smooth\nend\nsubsection Die\n" + test::ground_tool(64) + "end\n";
  Parameters           parameters = Parameters::from_text(pair_file(zones, few_points));
  FrictionTableBuilder punch      = FrictionTableBuilder::read(parameters, "Punch"),
                       die        = FrictionTableBuilder::read(parameters, "Die");
  parameters.finish();
  EXPECT_EQ(punch.tool().size(), 0u);
  EXPECT_EQ(die.tool().size(), 64u * 64u);
  EXPECT_NE(punch.fingerprint(), die.fingerprint());
  // Without zones in the file all tools have the same surface, and share one table.
  const std::string common = pair_file(test::ground_tool(64), few_points);
  EXPECT_EQ(read(common, "Punch").fingerprint(), read(common, "Die").fingerprint());
}

TEST(FrictionTableBuilder, NamesWrongAxes)
{
  EXPECT_EQ(problems(few_points), "accepted");
  EXPECT_NE(problems(" set Pressures = 10, 5, 50 MPa\n").find("Friction table/Pressures"), std::string::npos);
  EXPECT_NE(problems(" set Pressures = 10 MPa\n").find("less than two"), std::string::npos);
  EXPECT_NE(problems(" set Pressures = 0, 10 MPa\n").find("Friction table/Pressures"), std::string::npos);
  EXPECT_NE(problems(" set Strains = 0.1, 0.2\n").find("0 as the first value"), std::string::npos);
  EXPECT_NE(problems(" set Cut heights = 2\n").find("Friction table/Cut heights"), std::string::npos);
  EXPECT_NE(problems(" set Cut hights = 7\n").find("Cut heights"), std::string::npos); // the nearest name is suggested
}

TEST(FrictionTableBuilder, DocumentsItself)
{
  Parameters parameters = Parameters::for_documentation();
  FrictionTableBuilder::read(parameters, "Die");
  std::set<std::string> paths;
  for (const EntryInfo &e : parameters.entries())
    paths.insert(e.path);
  for (const char *path : { "Friction table/Pressures", "Flattening/Asperity half spacing",
                            "Boundary friction/Power law/c0", "Tool surface/Die/Model", "Sheet surface/Model" })
    EXPECT_TRUE(paths.count(path)) << path;
}
