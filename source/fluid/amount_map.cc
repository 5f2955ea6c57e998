#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/fluid/amount_map.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    // Coordinates closer than this are one point of the grid [mm].
    constexpr double tolerance = 1e-6;
    // What no oil film on a sheet reaches [g/m^2]; catches mg for g.
    constexpr double largest_amount = 200;

    std::vector<double>
    grid_points(std::vector<double> values)
    {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end(),
                               [](const double a, const double b) { return std::abs(a - b) <= tolerance; }),
                   values.end());
      return values;
    }

    std::size_t
    place(const std::vector<double> &points, const double x)
    {
      return static_cast<std::size_t>(std::lower_bound(points.begin(), points.end(), x - tolerance) - points.begin());
    }

    Table<2>
    make_table(const CsvData &data, const std::vector<double> &x, const std::vector<double> &y,
               const std::string &column)
    {
      const std::vector<double> given = data.numbers(column);
      const Axis                axis_x{ grid_points(x), AxisScale::linear }, axis_y{ grid_points(y), AxisScale::linear };
      const std::size_t         n_y = axis_y.points.size();
      if (given.size() != axis_x.points.size() * n_y)
        throw InputError(describe_error("The points of the map form no rectangular grid", data.file,
                                        std::to_string(given.size()) + " points",
                                        std::to_string(axis_x.points.size()) + " x " + std::to_string(n_y)
                                            + ", each value of x with each value of y",
                                        "Resample the measurement on a grid, or give a traverse with one coordinate."));
      std::vector<double> values(given.size(), -1.);
      for (std::size_t row = 0; row < given.size(); ++row)
        {
          const std::string where = data.file + ", line " + std::to_string(row + 2);
          if (!(given[row] >= 0 && given[row] <= largest_amount))
            throw InputError(describe_error("The amount of lubricant is not physical", where,
                                            units::number(given[row]) + " g/m^2",
                                            "0 to " + units::number(largest_amount) + " g/m^2"));
          double &target = values[place(axis_x.points, x[row]) * n_y + place(axis_y.points, y[row])];
          if (target >= 0)
            throw InputError(describe_error("A point of the map is given twice", where));
          target = given[row] * units::factor("g/m^2");
        }
      return Table<2>({ axis_x, axis_y }, values);
    }
  } // namespace

  AmountMap
  AmountMap::read(const std::filesystem::path &file)
  {
    const CsvData data  = read_csv(file);
    const bool    has_x = data.has("x_mm"), has_y = data.has("y_mm");
    if (data.rows.empty() || (!has_x && !has_y))
      throw InputError(describe_error("The map of the lubricant has no coordinates or no rows", file.string(), "",
                                      "columns x_mm, y_mm or both"));
    const bool both = data.has("amount_g_per_m2");
    if (!both && (!data.has("amount_punch_g_per_m2") || !data.has("amount_die_g_per_m2")))
      throw InputError(describe_error("The map of the lubricant has no amounts", file.string(), "",
                                      "a column amount_g_per_m2, or amount_punch_g_per_m2 and amount_die_g_per_m2"));
    const std::vector<double> none(data.rows.size(), 0.);
    const auto                x = has_x ? data.numbers("x_mm") : none, y = has_y ? data.numbers("y_mm") : none;
    for (std::size_t row = 0; row < x.size(); ++row)
      if (!std::isfinite(x[row]) || !std::isfinite(y[row]))
        throw InputError(
            describe_error("A coordinate of the map is no number", file.string() + ", line " + std::to_string(row + 2)));
    AmountMap map;
    map.name   = file.string();
    map.amount = { make_table(data, x, y, both ? "amount_g_per_m2" : "amount_punch_g_per_m2"),
                   make_table(data, x, y, both ? "amount_g_per_m2" : "amount_die_g_per_m2") };
    return map;
  }

  double
  AmountMap::at(const unsigned face, const double x, const double y) const
  {
    const auto &axes    = amount[face].axes();
    const auto  outside = [](const Axis &axis, const double value) {
      return axis.points.size() > 1 && (value < axis.points.front() - tolerance || value > axis.points.back() + tolerance);
    };
    if (outside(axes[0], x) || outside(axes[1], y))
      throw InputError(describe_error("The map of the lubricant does not reach a point of the blank", name,
                                      "(" + units::number(x) + ", " + units::number(y) + ") mm",
                                      "x and y of the whole blank, its middle at (0, 0)"));
    return amount[face].value({ x, y });
  }

  double
  AmountMap::asymmetry() const
  {
    double result = 0;
    for (const Table<2> &table : amount)
      {
        const auto  &xs = table.axes()[0].points, &ys = table.axes()[1].points;
        const double greatest = *std::max_element(table.values().begin(), table.values().end());
        const auto   compare  = [&](const double x, const double y, const double there) {
          if (greatest > 0)
            result = std::max(result, std::abs(there - table.value({ x, y })) / greatest);
        };
        for (const double x : xs)
          for (const double y : ys)
            {
              if (-x >= xs.front() && -x <= xs.back())
                compare(x, y, table.value({ -x, y }));
              if (-y >= ys.front() && -y <= ys.back())
                compare(x, y, table.value({ x, -y }));
            }
      }
    return result;
  }
} // namespace tribodraw
