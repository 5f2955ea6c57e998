#include <tribodraw/base/errors.h>
#include <tribodraw/output/friction_export.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>

using namespace tribodraw;

// The readers below follow the published formats of the receiving programs and share nothing with the writers.
namespace
{
  /// Falls with pressure and speed as measured friction does, rises with strain; no formula of an export is like it.
  double
  friction(const double p, const double v, const double eps)
  {
    return 0.05 + 0.1 / (1. + 0.02 * p) / (1. + 0.004 * v) + 0.04 * eps;
  }

  CoefficientTable
  sample(const std::vector<double> &strains = { 0., 0.1, 0.3 })
  {
    CoefficientTable t;
    t.pressures = { 1, 5, 12.5, 30 };
    t.speeds    = { 0, 20, 60, 200 };
    t.strains   = strains;
    for (const double p : t.pressures)
      for (const double v : t.speeds)
        for (const double e : t.strains)
          t.values.push_back(friction(p, v, e));
    t.provenance = { { "source", "test" } };
    t.check("sample");
    return t;
  }

  FrictionExportSettings
  settings(const double max_error = 0.05)
  {
    FrictionExportSettings s;
    s.name      = "sheet-die";
    s.max_error = max_error;
    return s;
  }

  std::vector<std::string>
  lines_of(const std::string &text)
  {
    std::istringstream       in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    return lines;
  }

  std::vector<std::string>
  split(const std::string &line, const char separator)
  {
    std::istringstream       in(line);
    std::vector<std::string> parts;
    for (std::string part; std::getline(in, part, separator);)
      parts.push_back(part);
    return parts;
  }

  std::vector<double>
  fixed_columns(const std::string &line, const std::vector<std::size_t> &widths)
  {
    std::vector<double> values;
    std::size_t         at = 0;
    for (const std::size_t width : widths)
      {
        if (at >= line.size())
          break;
        values.push_back(std::stod(line.substr(at, width)));
        at += width;
      }
    return values;
  }
} // namespace

TEST(FrictionExport, abaqus_round_trip)
{
  const auto                              table    = sample();
  const auto                              lines    = lines_of(make_friction_export("abaqus")->text(table, settings()));
  bool                                    in_table = false;
  std::map<std::array<double, 3>, double> read; // slip rate, pressure, field -> mu
  std::vector<std::array<double, 3>>      order;
  for (const auto &line : lines)
    {
      EXPECT_LE(line.size(), 256u);
      if (line.rfind("**", 0) == 0)
        continue;
      if (line[0] == '*')
        {
          in_table = line.rfind("*FRICTION", 0) == 0;
          EXPECT_EQ(in_table, line.find("DEPENDENCIES=1") != std::string::npos);
          continue;
        }
      ASSERT_TRUE(in_table);
      const auto part = split(line, ',');
      ASSERT_EQ(part.size(), 5u); // mu, slip rate, pressure, temperature, field
      EXPECT_EQ(part[3].find_first_not_of(' '), std::string::npos);
      const std::array<double, 3> key{ std::stod(part[1]), std::stod(part[2]), std::stod(part[4]) };
      read[key] = std::stod(part[0]);
      order.push_back(key);
    }
  ASSERT_EQ(read.size(), table.values.size());
  for (const double p : table.pressures)
    for (const double v : table.speeds)
      for (const double e : table.strains)
        EXPECT_NEAR(read.at({ v, p, e }), friction(p, v, e), 1e-8);
  // The first independent variable (slip rate) varies fastest, the field slowest.
  for (std::size_t i = 1; i < order.size(); ++i)
    EXPECT_TRUE(std::make_tuple(order[i - 1][2], order[i - 1][1], order[i - 1][0])
                < std::make_tuple(order[i][2], order[i][1], order[i][0]));
  const std::string one = make_friction_export("abaqus")->text(sample({ 0. }), settings());
  EXPECT_EQ(one.find("DEPENDENCIES"), std::string::npos);
}

TEST(FrictionExport, ls_dyna_round_trip)
{
  const auto          table = sample({ 0.1 });
  const auto          lines = lines_of(make_friction_export("ls-dyna")->text(table, settings()));
  std::string         keyword;
  std::vector<double> values;
  std::vector<std::vector<std::array<double, 2>>> curves;
  int                                             table_id = 0, card = 0;
  std::vector<int>                                curve_ids;
  for (const auto &line : lines)
    {
      EXPECT_LE(line.size(), 80u);
      if (line.empty() || line[0] == '$')
        continue;
      if (line[0] == '*')
        {
          keyword = line;
          card    = 0;
          continue;
        }
      ++card;
      if (keyword == "*DEFINE_TABLE_TITLE" && card == 2)
        table_id = static_cast<int>(fixed_columns(line, { 10 })[0]);
      else if (keyword == "*DEFINE_TABLE_TITLE" && card > 2)
        values.push_back(fixed_columns(line, { 20 })[0]);
      else if (keyword == "*DEFINE_CURVE" && card == 1)
        {
          const auto f = fixed_columns(line, { 10, 10, 10, 10, 10, 10, 10, 10 });
          curve_ids.push_back(static_cast<int>(f[0]));
          EXPECT_EQ(f[2], 1.); // scale factors
          EXPECT_EQ(f[3], 1.);
          curves.emplace_back();
        }
      else if (keyword == "*DEFINE_CURVE")
        {
          const auto f = fixed_columns(line, { 20, 20 });
          curves.back().push_back({ f[0], f[1] });
        }
    }
  EXPECT_EQ(lines.back(), "*END");
  EXPECT_EQ(values, table.pressures);
  ASSERT_EQ(curves.size(), table.pressures.size()); // one curve each, in the same order
  for (std::size_t i = 0; i < curves.size(); ++i)
    {
      EXPECT_NE(curve_ids[i], table_id);
      for (std::size_t j = 0; j < table.speeds.size(); ++j)
        {
          EXPECT_EQ(curves[i][j][0], table.speeds[j]);
          EXPECT_NEAR(curves[i][j][1], friction(table.pressures[i], table.speeds[j], 0.1), 1e-9);
        }
      EXPECT_GT(curves[i].back()[0], table.speeds.back()); // goes on at the last value
      EXPECT_EQ(curves[i].back()[1], curves[i][table.speeds.size() - 1][1]);
    }
}

// The formulas of /FRICTION (I_fric 1, 2, 4) evaluated from the card must give the table within the error that its
// title states, and that error must be the true one.
TEST(FrictionExport, openradioss_round_trip)
{
  const auto               table = sample({ 0. });
  const auto               lines = lines_of(make_friction_export("openradioss")->text(table, settings()));
  std::vector<std::string> data;
  for (const auto &line : lines)
    if (!line.empty() && line[0] != '#')
      data.push_back(line);
  ASSERT_EQ(data.size(), 5u);
  EXPECT_EQ(data[0], "/FRICTION/1");
  const auto head = fixed_columns(data[2], { 10, 10, 20, 10 });
  auto       c    = fixed_columns(data[3], { 20, 20, 20, 20, 20 });
  const auto rest = fixed_columns(data[4], { 20, 20, 20 });
  ASSERT_EQ(c.size(), 5u);
  ASSERT_EQ(rest.size(), 3u);
  c.push_back(rest[0]);
  const double fric    = rest[1];
  const auto   formula = [&](const double p, const double v) {
    switch (static_cast<int>(head[0]))
      {
      case 1:
        return fric + c[0] * p + c[1] * v + c[2] * p * v + c[3] * p * p + c[4] * v * v;
      case 2:
        return fric + c[0] * std::exp(c[1] * v) * p * p + c[2] * std::exp(c[3] * v) * p + c[4] * std::exp(c[5] * v);
      case 4:
        return c[0] + (fric - c[0]) * std::exp(-c[1] * v);
      }
    return 0.;
  };
  double greatest = 0, sum = 0;
  for (const double p : table.pressures)
    for (const double v : table.speeds)
      {
        greatest = std::max(greatest, std::abs(formula(p, v) - friction(p, v, 0.)));
        sum += std::pow(formula(p, v) - friction(p, v, 0.), 2);
        EXPECT_GT(formula(p, v), 0.);
      }
  std::smatch stated;
  ASSERT_TRUE(std::regex_search(data[1], stated, std::regex("rms ([0-9.]+) max ([0-9.]+) p 1-30 MPa v 0-200 mm/s")));
  EXPECT_NEAR(std::stod(stated[1]), std::sqrt(sum / 16.), 1e-4);
  EXPECT_NEAR(std::stod(stated[2]), greatest, 1e-4);
  EXPECT_LT(greatest, 0.01); // 10 % of the range of the table
  EXPECT_THROW(make_friction_export("openradioss")->text(table, settings(1e-5)), InputError);
}

// A table that is itself of the form is found again.
TEST(FrictionExport, fits_find_their_own_form)
{
  auto table = sample({ 0. });
  table.values.clear();
  for (const double p : table.pressures)
    for (const double v : table.speeds)
      table.values.push_back(0.12 - 8e-4 * p - 1e-4 * v + 1e-6 * p * v + 5e-6 * p * p + 1e-7 * v * v);
  const std::string text = make_friction_export("openradioss")->text(table, settings(1e-9));
  EXPECT_NE(text.find("rms 0.0000 max 0.0000"), std::string::npos);

  // mu0 = 0.11, e = 0.9, a = 0.004; p_ref is the geometric mean of the pressures, v_ref the first speed above zero.
  table.values.clear();
  const double p_ref = std::sqrt(30.);
  for (const double p : table.pressures)
    for (const double v : table.speeds)
      table.values.push_back(0.11 * std::pow(p / p_ref, -0.1) - 0.004 * std::log(std::max(v, 20.) / 20.));
  std::map<std::string, double> quantity;
  for (const auto &line : lines_of(make_friction_export("power-law")->text(table, settings(1e-4))))
    if (const auto part = split(line, ','); part.size() == 3 && part[0] != "quantity")
      quantity[part[0]] = std::stod(part[1]);
  EXPECT_NEAR(quantity.at("mu0"), 0.11, 1e-5);
  EXPECT_NEAR(quantity.at("e"), 0.9, 1e-4);
  EXPECT_NEAR(quantity.at("a"), 0.004, 1e-5);
  EXPECT_NEAR(quantity.at("p_ref"), p_ref, 1e-12);
  EXPECT_EQ(quantity.at("v_ref"), 20.);
  EXPECT_LT(quantity.at("fit_max"), 1e-5);
}

TEST(FrictionExport, json_and_csv_round_trip)
{
  const auto table = sample();
  const auto again = CoefficientTable::from_json(
      nlohmann::json::parse(make_friction_export("json")->text(table, settings())), "again");
  EXPECT_EQ(again.pressures, table.pressures);
  EXPECT_EQ(again.speeds, table.speeds);
  EXPECT_EQ(again.strains, table.strains);
  EXPECT_EQ(again.values, table.values);
  EXPECT_EQ(again.provenance, table.provenance);

  const auto lines = lines_of(make_friction_export("csv")->text(table, settings()));
  EXPECT_EQ(lines[0], "pressure_mpa,speed_mm_per_s,eps_p,mu");
  ASSERT_EQ(lines.size(), 1 + table.values.size());
  for (std::size_t i = 1; i < lines.size(); ++i)
    {
      const auto part = split(lines[i], ',');
      EXPECT_EQ(std::stod(part[3]), friction(std::stod(part[0]), std::stod(part[1]), std::stod(part[2])));
    }
}

// One speed and one strain are enough for every format, and every format names its unknown brothers.
TEST(FrictionExport, all_formats_take_the_smallest_table)
{
  CoefficientTable table;
  table.pressures = { 1, 10 };
  table.speeds    = { 0. };
  table.strains   = { 0. };
  table.values    = { 0.15, 0.12 };
  ASSERT_EQ(friction_export_formats().size(), 6u);
  for (const auto &name : friction_export_formats())
    {
      const auto format = make_friction_export(name);
      EXPECT_FALSE(format->text(table, settings()).empty()) << name;
      EXPECT_FALSE(format->file_ending().empty()) << name;
    }
  try
    {
      make_friction_export("abacus");
      FAIL();
    }
  catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find("Did you mean 'abaqus'?"), std::string::npos);
    }
}

TEST(CoefficientTable, strain_is_interpolated_or_averaged)
{
  const auto table = sample();
  const auto at    = table.at_strain(0.2);
  ASSERT_EQ(at.values.size(), 16u);
  EXPECT_NEAR(at(1, 2, 0), friction(5, 60, 0.2), 1e-15); // linear in strain
  EXPECT_NEAR(table.at_strain(0.3)(3, 3, 0), friction(30, 200, 0.3), 1e-15);
  EXPECT_NEAR(table.mean_over_strain()(0, 0, 0), friction(1, 0, 0.15), 1e-15);
  EXPECT_NEAR(table.strain_deviation(), 0.04 * 0.15, 1e-15);
  EXPECT_THROW(table.at_strain(0.31), InputError);
}

TEST(CoefficientTable, inconsistent_files_are_refused)
{
  const auto good   = sample().to_json();
  const auto reject = [](const nlohmann::json &j, const std::string &word) {
    try
      {
        CoefficientTable::from_json(j, "file.json");
        ADD_FAILURE() << word;
      }
    catch (const InputError &e)
      {
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find("file.json"), std::string::npos);
      }
  };
  reject(nlohmann::json(), "format");
  reject(nlohmann::json::array(), "format");
  auto j      = good;
  j["format"] = "something else";
  reject(j, "format");
  j            = good;
  j["version"] = 99;
  reject(j, "version");
  j = good;
  j["axes"].erase(2);
  reject(j, "axes");
  j                    = good;
  j["axes"][0]["unit"] = "Pa";
  reject(j, "axes/1");
  j                      = good;
  j["axes"][1]["points"] = { 0, 60, 20, 200 };
  reject(j, "speed, point 3");
  j                      = good;
  j["axes"][0]["points"] = { 0, 5, 12.5, 30 };
  reject(j, "pressure, point 1");
  j = good;
  j["values"].erase(5);
  reject(j, "values");
  j              = good;
  j["values"][7] = -0.1;
  reject(j, "number 8");
  j              = good;
  j["values"][7] = "0.1";
  reject(j, "values");
}
