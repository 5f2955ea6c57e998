#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/time_table.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Points = std::pair<std::vector<double>, std::vector<double>>;

    std::vector<std::string>
    split(const std::string &text)
    {
      std::vector<std::string> parts;
      std::size_t              start = 0;
      for (std::size_t comma = text.find(','); comma != std::string::npos; comma = text.find(',', start))
        {
          parts.push_back(text.substr(start, comma - start));
          start = comma + 1;
        }
      parts.push_back(text.substr(start));
      return parts;
    }

    Points
    read_pairs(const std::string &text, const TimeTable::Quantity &quantity)
    {
      const auto parts = split(text);
      if (parts.size() % 2 != 0)
        throw InputError(describe_error(
            "the list does not hold pairs of time and value.", "", std::to_string(parts.size()) + " items",
            "an even number", "Write for example '0 s, 0 " + quantity.unit + ", 1 s, 10 " + quantity.unit + "'."));
      Points points;
      for (std::size_t i = 0; i < parts.size(); i += 2)
        {
          points.first.push_back(units::parse_quantity(parts[i], "s"));
          points.second.push_back(units::parse_quantity(parts[i + 1], quantity.unit));
        }
      return points;
    }

    /// Column `name_unit` in internal units.
    std::vector<double>
    read_column(const CsvData &data, const std::string &name, const std::string &unit)
    {
      for (const std::string &column : data.columns)
        if (column.rfind(name + "_", 0) == 0)
          {
            const std::string own = column.substr(name.size() + 1);
            const auto        u   = units::parse_unit(own);
            if (!u || u->dimension != units::parse_unit(unit)->dimension)
              throw InputError(describe_error("the unit of a column does not fit.", data.file, "'" + column + "'",
                                              "'" + name + "_" + unit + "'"));
            std::vector<double> values = data.numbers(column);
            for (double &value : values)
              value *= u->factor;
            return values;
          }
      throw InputError(describe_error("a column is missing.", data.file, "", "'" + name + "_" + unit + "'"));
    }

    Points
    read_table_file(const std::filesystem::path &file, const TimeTable::Quantity &quantity)
    {
      const CsvData data = read_csv(file);
      return { read_column(data, "time", "s"), read_column(data, quantity.name, quantity.unit) };
    }

    void
    check_range(const std::vector<double> &values, const TimeTable::Quantity &quantity)
    {
      const Range &range = quantity.range;
      for (std::size_t i = 0; i < values.size(); ++i)
        {
          const double x = values[i] / units::factor(quantity.unit);
          if (!(range.excludes_min ? x > range.min : x >= range.min) || !(x <= range.max))
            throw InputError(describe_error("a value is out of range.", "point " + std::to_string(i + 1),
                                            units::format(values[i], quantity.unit), range.describe(quantity.unit)));
        }
    }
  } // namespace

  TimeTable::TimeTable(std::vector<double> time_points, std::vector<double> value_points)
      : times(std::move(time_points)), values(std::move(value_points))
  {
    if (times.size() < 2 || times.size() != values.size())
      throw InputError(
          describe_error("A table over time needs at least two points and as many values as times.", "",
                         std::to_string(times.size()) + " times, " + std::to_string(values.size()) + " values"));
    for (std::size_t i = 0; i < times.size(); ++i)
      {
        if (!std::isfinite(times[i]) || !std::isfinite(values[i]))
          throw InputError("Point " + std::to_string(i + 1) + " of the table over time is not a finite number.");
        if (i > 0 && !(times[i] > times[i - 1]))
          throw InputError(describe_error("The times of a table must increase.", "point " + std::to_string(i + 1),
                                          units::number(times[i]) + " s",
                                          "more than " + units::number(times[i - 1]) + " s"));
      }
  }

  TimeTable
  TimeTable::read(Parameters &parameters, const std::string &entry, const Quantity &quantity,
                  const std::string &documentation)
  {
    const std::string text = parameters.text(
        entry, documentation + " Pairs of time and value, each with its unit, for example `0 s, 0 " + quantity.unit
                   + ", 1 s, 10 " + quantity.unit + "`; between them it is linear. Or the name of a CSV file with the "
                   + "columns `time_s` and `" + quantity.name + "_" + quantity.unit + "` (other units of the same kind "
                   + "in their place), relative to the folder of the parameter file.");
    const TimeTable zero({ 0, 1 }, { 0, 0 });
    if (parameters.documentation_mode() || text.empty())
      return zero;
    try
      {
        const std::filesystem::path file(text);
        const Points                points
            = text.find(',') != std::string::npos
                  ? read_pairs(text, quantity)
                  : read_table_file(file.is_absolute() ? file : parameters.base_folder() / file, quantity);
        check_range(points.second, quantity);
        if (!points.first.empty() && points.first.front() < 0)
          throw InputError(describe_error("a time is negative.", "point 1", units::format(points.first.front(), "s"), "0 s or more"));
        return TimeTable(points.first, points.second);
      }
    catch (const InputError &e)
      {
        parameters.problem(entry, e.what());
        return zero;
      }
  }

  std::size_t
  TimeTable::piece(const double time) const
  {
    // The first point later than the time ends the piece.
    const auto end = std::upper_bound(times.begin() + 1, times.end() - 1, time);
    return static_cast<std::size_t>(end - times.begin()) - 1;
  }

  double
  TimeTable::value(const double time) const
  {
    if (time <= times.front())
      return values.front();
    if (time >= times.back())
      return values.back();
    const std::size_t i      = piece(time);
    const double      weight = (time - times[i]) / (times[i + 1] - times[i]);
    return (1 - weight) * values[i] + weight * values[i + 1];
  }

  double
  TimeTable::rate(const double time) const
  {
    if (time < times.front() || time >= times.back())
      return 0;
    const std::size_t i = piece(time);
    return (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
  }

  Motion
  Motion::constant_speed(const double speed, const double travel)
  {
    if (!(speed > 0) || !std::isfinite(speed))
      throw InputError(describe_error("Motion: the speed must be positive.", "", units::number(speed) + " mm/s",
                                      "more than 0 mm/s"));
    if (travel == 0)
      throw InputError(describe_error("Motion: the travel must not be zero.", "", "0 mm"));
    return Motion({ 0, std::abs(travel) / speed }, { 0, travel });
  }

  Motion
  Motion::read(Parameters &parameters, const std::string &entry, const std::string &documentation)
  {
    return Motion(
        TimeTable::read(parameters, entry, { "displacement", "mm", Range::between(-5000, 5000) }, documentation));
  }

  TimeTable
  read_force_table(Parameters &parameters, const std::string &entry, const std::string &documentation)
  {
    return TimeTable::read(parameters, entry, { "force", "kN", Range::between(0, 1e5) }, documentation);
  }
} // namespace tribodraw
