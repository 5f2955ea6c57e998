#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>
#include <tribodraw/friction_table/coefficient_table.h>
#include <tribodraw/friction_table/friction_table.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using nlohmann::json;

    constexpr const char *format_name    = "tribodraw friction coefficients";
    constexpr int         format_version = 1;

    [[noreturn]] void
    fail(const std::string &file, const std::string &what, const std::string &place, const std::string &value = "",
         const std::string &allowed = "")
    {
      throw InputError(describe_error(what, file + (place.empty() ? "" : ", `" + place + "`"), value, allowed,
                                      "Make the file again by a strip draw, or name another file."));
    }

    json
    axis(const char *name, const char *unit, const std::vector<double> &points)
    {
      return { { "name", name }, { "unit", unit }, { "points", points } };
    }

    std::vector<double>
    numbers(const json &object, const char *key, const std::string &file, const std::string &place)
    {
      if (!object.is_object() || !object.contains(key) || !object.at(key).is_array())
        fail(file, "A list of numbers is missing", place + "/" + key);
      std::vector<double> result;
      for (const json &item : object.at(key))
        {
          if (!item.is_number())
            fail(file, "A list of numbers has an item that is no number", place + "/" + key, item.dump().substr(0, 40));
          result.push_back(item.get<double>());
        }
      return result;
    }

    std::vector<double>
    read_axis(const json &j, const std::size_t index, const std::string &name, const std::string &unit,
              const std::string &file)
    {
      const std::string place = "axes/" + std::to_string(index + 1);
      const json       &a     = j.at("axes")[index];
      const auto        text  = [&](const char *key) {
        return a.is_object() && a.contains(key) && a.at(key).is_string() ? a.at(key).get<std::string>() : std::string();
      };
      if (text("name") != name || text("unit") != unit)
        fail(file, "An axis is not the expected one", place, text("name") + " in " + text("unit"),
             name + " in " + unit);
      return numbers(a, "points", file, place);
    }
  } // namespace

  CoefficientTable
  CoefficientTable::from(const FrictionTable &table)
  {
    CoefficientTable t;
    const auto      &axes  = table.cut_height_monotone.axes();
    t.pressures            = axes[0].points;
    t.speeds               = { 0. };
    t.strains              = axes[1].points;
    const CsvTable look_up = table.monotone_look_up();
    const auto     column
        = std::find(look_up.columns().begin(), look_up.columns().end(), "mu_boundary") - look_up.columns().begin();
    for (const auto &row : look_up.rows())
      t.values.push_back(std::get<double>(row[column]));
    t.provenance = { { "source", "friction table, boundary friction without lubricant pressure" },
                     { "friction table", table.provenance } };
    return t;
  }

  CoefficientTable
  CoefficientTable::at_strain(const double strain) const
  {
    if (!(strain >= strains.front() && strain <= strains.back()))
      throw InputError(describe_error("The strain lies outside the table of friction coefficients", "strain",
                                      units::number(strain),
                                      units::number(strains.front()) + " to " + units::number(strains.back())));
    CoefficientTable t = *this;
    t.strains          = { strain };
    t.values.clear();
    const auto        upper = std::lower_bound(strains.begin(), strains.end(), strain) - strains.begin();
    const std::size_t b = upper, a = b > 0 ? b - 1 : 0;
    const double      w = a == b ? 0. : (strain - strains[a]) / (strains[b] - strains[a]);
    for (std::size_t i = 0; i < pressures.size(); ++i)
      for (std::size_t j = 0; j < speeds.size(); ++j)
        t.values.push_back((1. - w) * (*this)(i, j, a) + w * (*this)(i, j, b));
    return t;
  }

  CoefficientTable
  CoefficientTable::mean_over_strain() const
  {
    if (strains.size() == 1)
      return *this;
    CoefficientTable t = *this;
    t.strains          = { 0.5 * (strains.front() + strains.back()) };
    t.values.clear();
    for (std::size_t i = 0; i < pressures.size(); ++i)
      for (std::size_t j = 0; j < speeds.size(); ++j)
        {
          double integral = 0;
          for (std::size_t k = 1; k < strains.size(); ++k)
            integral += 0.5 * (strains[k] - strains[k - 1]) * ((*this)(i, j, k - 1) + (*this)(i, j, k));
          t.values.push_back(integral / (strains.back() - strains.front()));
        }
    return t;
  }

  double
  CoefficientTable::strain_deviation() const
  {
    const CoefficientTable mean     = mean_over_strain();
    double                 greatest = 0;
    for (std::size_t i = 0; i < pressures.size(); ++i)
      for (std::size_t j = 0; j < speeds.size(); ++j)
        for (std::size_t k = 0; k < strains.size(); ++k)
          greatest = std::max(greatest, std::abs((*this)(i, j, k) - mean(i, j, 0)));
    return greatest;
  }

  void
  CoefficientTable::check(const std::string &name) const
  {
    const auto check_axis = [&](const std::vector<double> &points, const char *what, const bool positive) {
      if (points.empty())
        fail(name, "An axis has no points", what);
      for (std::size_t i = 0; i < points.size(); ++i)
        if (!std::isfinite(points[i]) || points[i] < 0 || (positive && points[i] == 0)
            || (i > 0 && !(points[i] > points[i - 1])))
          fail(name, "The points of an axis are not ascending and finite",
               std::string(what) + ", point " + std::to_string(i + 1), units::number(points[i]),
               positive ? "above zero, ascending" : "from zero, ascending");
    };
    check_axis(pressures, "pressure", true);
    check_axis(speeds, "speed", false);
    check_axis(strains, "strain", false);
    const std::size_t n = pressures.size() * speeds.size() * strains.size();
    if (values.size() != n)
      fail(name, "The number of coefficients does not belong to the axes", "values", std::to_string(values.size()),
           std::to_string(n));
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isfinite(values[i]) || values[i] < 0)
        fail(name, "A friction coefficient is not a number from zero", "values, number " + std::to_string(i + 1),
             units::number(values[i]));
  }

  json
  CoefficientTable::to_json() const
  {
    return { { "format", format_name },
             { "version", format_version },
             { "meaning", "friction coefficient; values[(i_pressure * n_speeds + i_speed) * n_strains + i_strain]" },
             { "axes",
               { axis("nominal pressure", "MPa", pressures), axis("sliding speed", "mm/s", speeds),
                 axis("equivalent plastic strain", "1", strains) } },
             { "outside", "the value at the end of the axis" },
             { "values", values },
             { "provenance", provenance } };
  }

  CoefficientTable
  CoefficientTable::from_json(const json &j, const std::string &name)
  {
    if (!j.is_object() || j.value("format", json()) != format_name)
      fail(name, "The file holds no friction coefficients", "format", "", std::string("`") + format_name + "`");
    if (j.value("version", json()) != format_version)
      fail(name, "The version of the file is unknown", "version", j.value("version", json()).dump().substr(0, 40),
           std::to_string(format_version));
    if (!j.contains("axes") || !j.at("axes").is_array() || j.at("axes").size() != 3)
      fail(name, "The file needs three axes", "axes");
    CoefficientTable t;
    t.pressures  = read_axis(j, 0, "nominal pressure", "MPa", name);
    t.speeds     = read_axis(j, 1, "sliding speed", "mm/s", name);
    t.strains    = read_axis(j, 2, "equivalent plastic strain", "1", name);
    t.values     = numbers(j, "values", name, "");
    t.provenance = j.value("provenance", json());
    t.check(name);
    return t;
  }

  CoefficientTable
  CoefficientTable::read(const std::filesystem::path &json_file)
  {
    const json j = json::parse(read_file(json_file, 1ull << 30), nullptr, false);
    if (j.is_discarded())
      fail(json_file.string(), "The file is not valid JSON (truncated or altered?)", "");
    if (j.is_object() && j.value("format", json()) == "tribodraw friction table")
      return from(FrictionTable::from_json(j, json_file.string()));
    return from_json(j, json_file.string());
  }

  CsvTable
  CoefficientTable::csv() const
  {
    CsvTable csv({ "pressure_mpa", "speed_mm_per_s", "eps_p", "mu" });
    for (std::size_t i = 0; i < pressures.size(); ++i)
      for (std::size_t j = 0; j < speeds.size(); ++j)
        for (std::size_t k = 0; k < strains.size(); ++k)
          csv.add_row({ pressures[i], speeds[j], strains[k], (*this)(i, j, k) });
    return csv;
  }

  void
  CoefficientTable::write(const std::filesystem::path &json_file, const std::filesystem::path &csv_file) const
  {
    check(json_file.string());
    write_file(json_file, to_json().dump(1, ' ') + "\n");
    csv().save(csv_file);
  }
} // namespace tribodraw
