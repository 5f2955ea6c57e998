#include "sample_pair.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <gtest/gtest.h>

#include <filesystem>

using namespace tribodraw;
using nlohmann::json;

namespace
{
  /// A folder that is gone after the test.
  struct Folder
  {
    std::filesystem::path path;

    Folder()
        : path(std::filesystem::temp_directory_path()
               / ("tribodraw_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name())))
    {
      std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
  };

  const FrictionTable &
  sample_table()
  {
    static const FrictionTable table = build_friction_table(test::sample_pair(64, true));
    return table;
  }

  /// The message with which a changed table is refused.
  std::string
  refusal(const std::function<void(json &)> &change)
  {
    json j = sample_table().to_json();
    change(j);
    try
      {
        FrictionTable::from_json(j, "table.json");
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "accepted";
  }

  void
  expect_refused(const std::function<void(json &)> &change, const std::string &culprit, const std::string &what)
  {
    const std::string text = refusal(change);
    EXPECT_NE(text.find("table.json"), std::string::npos) << text;
    EXPECT_NE(text.find(culprit), std::string::npos) << text;
    EXPECT_NE(text.find(what), std::string::npos) << text;
  }
} // namespace

TEST(FrictionTableExchange, RoundTripIsBitwise)
{
  const Folder         folder;
  const FrictionTable &table = sample_table();
  table.write(folder.path / "friction_table.json", folder.path / "friction_table.csv");
  const FrictionTable copy = FrictionTable::read(folder.path / "friction_table.json");
  EXPECT_EQ(copy.curves.cut_height, table.curves.cut_height);
  EXPECT_EQ(copy.curves.h_avg, table.curves.h_avg);
  EXPECT_EQ(copy.curves.phi_s_yx, table.curves.phi_s_yx);
  EXPECT_EQ(copy.strain_load_per_descent.values(), table.strain_load_per_descent.values());
  EXPECT_EQ(copy.strain_load_per_descent.axes()[1].points, table.strain_load_per_descent.axes()[1].points);
  EXPECT_EQ(copy.cut_height_monotone.axes()[0].scale, AxisScale::logarithmic);
  EXPECT_EQ(copy.ploughing_coefficient.values(), table.ploughing_coefficient.values());
  EXPECT_EQ(copy.sq, table.sq);
  EXPECT_EQ(copy.initial_cut_height, table.initial_cut_height);
  copy.write(folder.path / "again.json", folder.path / "again.csv");
  EXPECT_EQ(read_file(folder.path / "again.json"), read_file(folder.path / "friction_table.json"));
  EXPECT_EQ(read_file(folder.path / "again.csv"), read_file(folder.path / "friction_table.csv"));
}

TEST(FrictionTableExchange, CsvHasTheColumnsOfTheMonotoneLookUp)
{
  const Folder         folder;
  const FrictionTable &table = sample_table();
  table.write(folder.path / "t.json", folder.path / "t.csv");
  const CsvData                  csv = read_csv(folder.path / "t.csv");
  const std::vector<std::string> columns{ "p_solid_mpa", "eps_p",         "cut_height_um", "contact_fraction",
                                          "h_avg_um",    "tau_solid_mpa", "mu_boundary",   "phi_p_xx",
                                          "phi_p_yy",    "phi_s_xx",      "phi_s_yy" };
  EXPECT_EQ(csv.columns, columns);
  EXPECT_EQ(csv.rows.size(), 90u); // 10 pressures x 9 strains
  const auto p = csv.numbers("p_solid_mpa"), eps = csv.numbers("eps_p"), s = csv.numbers("cut_height_um"),
             alpha = csv.numbers("contact_fraction"), tau = csv.numbers("tau_solid_mpa"),
             mu = csv.numbers("mu_boundary");
  for (std::size_t i = 0; i < p.size(); ++i)
    {
      EXPECT_NEAR(s[i], 1e3 * table.cut_height_monotone.value({ p[i], eps[i] }), 1e-12);
      EXPECT_NEAR(tau[i], mu[i] * p[i], 1e-12 * tau[i]);
      // per nominal area, with the pressure p/alpha in the boundary layer
      EXPECT_NEAR(tau[i], table.solid_shear(1e-3 * s[i], p[i], p[i] / alpha[i], eps[i]), 1e-9 * tau[i]);
      if (i % 9 > 0)
        {
          EXPECT_LT(s[i], s[i - 1]);
          EXPECT_GE(alpha[i], alpha[i - 1]);
        }
    }
}

TEST(FrictionTableExchange, RefusesForeignAndBrokenFiles)
{
  const Folder folder;
  sample_table().write(folder.path / "good.json", "");
  const std::string good = read_file(folder.path / "good.json");
  for (const std::string &content : { good.substr(0, good.size() / 2), std::string("p,mu\n1,0.1\n"), std::string() })
    {
      write_file(folder.path / "bad.json", content);
      try
        {
          FrictionTable::read(folder.path / "bad.json");
          FAIL() << "accepted";
        }
      catch (const InputError &e)
        {
          EXPECT_NE(std::string(e.what()).find("not valid JSON"), std::string::npos) << e.what();
          EXPECT_NE(std::string(e.what()).find("bad.json"), std::string::npos) << e.what();
        }
    }
  EXPECT_THROW(FrictionTable::read(folder.path / "absent.json"), InputError);
  expect_refused([](json &j) { j = json::array(); }, "format", "not a friction table");
  expect_refused([](json &j) { j["format"] = "something else"; }, "format", "not a friction table");
  expect_refused([](json &j) { j["version"] = 99; }, "version", "99");
}

TEST(FrictionTableExchange, RefusesInconsistentContent)
{
  EXPECT_EQ(refusal([](json &) {}), "accepted");
  expect_refused([](json &j) { j["tables"].erase("shear_strength"); }, "tables/shear_strength", "lacks");
  expect_refused([](json &j) { j["state_curves"]["h_avg"]["values"][3] = "thick"; }, "state_curves/h_avg",
                 "not a number");
  expect_refused([](json &j) { j["state_curves"]["h_avg"]["values"][3] = nullptr; }, "state_curves/h_avg",
                 "not a number");
  expect_refused([](json &j) { j["state_curves"]["h_avg"]["values"].erase(3); }, "h_avg", "values");
  expect_refused([](json &j) { j["state_curves"]["h_avg"]["unit"] = "um"; }, "state_curves/h_avg", "`um`");
  expect_refused([](json &j) { j["state_curves"]["h_avg"]["values"][3] = 1.; }, "h_avg", "decrease");
  expect_refused([](json &j) { j["state_curves"]["contact_fraction"]["values"][0] = 1.2; }, "contact fraction", "1.2");
  expect_refused([](json &j) { j["state_curves"]["phi_p_xx"]["values"][0] = -0.5; }, "phi_p_xx", "-0.5");
  expect_refused([](json &j) { j["tables"]["shear_strength"]["values"][0] = -1; }, "shear strength", "greater than 0");
  expect_refused([](json &j) { j["tables"]["shear_strength"]["values"].push_back(1.); }, "tables/shear_strength",
                 "by its axes");
  expect_refused([](json &j) { j["tables"]["cut_height_monotone"]["values"][5] = 1.; }, "monotone cut height",
                 "increase");
  expect_refused([](json &j) { j["tables"]["cut_height_monotone"]["axes"][0]["points"][0] = 50; }, "axes/1",
                 "increasing");
  expect_refused([](json &j) { j["tables"]["cut_height_monotone"]["axes"][0]["scale"] = "cubic"; }, "axes/1", "cubic");
  expect_refused([](json &j) { j["tables"]["cut_height_monotone"]["axes"].erase(1); }, "cut_height_monotone",
                 "number of axes");
  expect_refused([](json &j) { j["tables"]["ploughing_coefficient"]["values"][0] = -1e-3; }, "ploughing", "-0.001");
  expect_refused([](json &j) { j["sq"]["value"] = 0; }, "Sq", "greater than 0");
  expect_refused([](json &j) { j["initial_cut_height"]["value"] = -1; }, "initial cut height", "not below");
  expect_refused([](json &j) { j.erase("provenance"); }, "provenance", "lacks");
}

// A run that finds the JSON file takes the table for finished: it must not stand before the CSV file does, which here cannot be written.
TEST(FrictionTableExchange, JsonIsWrittenLast)
{
  const Folder folder;
  EXPECT_THROW(sample_table().write(folder.path / "t.json", folder.path / "missing" / "t.csv"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "t.json"));
}

// A table that is not consistent is never written.
TEST(FrictionTableExchange, DoesNotWriteNonsense)
{
  const Folder  folder;
  FrictionTable table   = sample_table();
  table.curves.h_avg[2] = std::nan("");
  EXPECT_THROW(table.write(folder.path / "t.json", folder.path / "t.csv"), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}
