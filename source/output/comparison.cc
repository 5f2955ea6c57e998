#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/output/comparison.h>
#include <tribodraw/output/plot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

namespace tribodraw
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Units as they stand at the end of column names.
    constexpr std::array<std::pair<const char *, const char *>, 15> units_in_names{ { { "mm", "mm" },
                                                                                       { "um", "um" },
                                                                                       { "m", "m" },
                                                                                       { "n", "N" },
                                                                                       { "kn", "kN" },
                                                                                       { "mpa", "MPa" },
                                                                                       { "gpa", "GPa" },
                                                                                       { "pa", "Pa" },
                                                                                       { "s", "s" },
                                                                                       { "ms", "ms" },
                                                                                       { "j", "J" },
                                                                                       { "n_mm", "N mm" },
                                                                                       { "mm_per_s", "mm/s" },
                                                                                       { "deg", "deg" },
                                                                                       { "k", "K" } } };

    struct Name
    {
      std::string stem, unit; ///< unit: as units::parse_unit reads it, empty: none
    };

    Name
    take_apart(const std::string &column)
    {
      Name best{ column, "" };
      for (const auto &[ending, unit] : units_in_names)
        {
          const std::string end = std::string("_") + ending;
          if (column.size() > end.size() && column.compare(column.size() - end.size(), end.size(), end) == 0
              && column.size() - end.size() < best.stem.size())
            best = { column.substr(0, column.size() - end.size()), unit };
        }
      return best;
    }

    /// Factor from the unit of one column to that of another.
    double
    conversion(const std::string &from_column, const std::string &to_column)
    {
      const Name from = take_apart(from_column), to = take_apart(to_column);
      if (from.unit.empty() && to.unit.empty())
        return 1;
      const auto a = units::parse_unit(from.unit), b = units::parse_unit(to.unit);
      if (!a || !b || a->dimension != b->dimension)
        throw InputError(describe_error("the units of the columns do not fit.", "tribodraw compare",
                                        "'" + from_column + "' and '" + to_column + "'", "",
                                        "The unit stands at the end of the name, as in punch_force_kn."));
      return a->factor / b->factor;
    }

    double
    interpolate(const std::vector<double> &x, const std::vector<double> &y, const double at)
    {
      const auto   after = std::upper_bound(x.begin() + 1, x.end() - 1, at) - x.begin();
      const double w     = (at - x[after - 1]) / (x[after] - x[after - 1]);
      return (1 - w) * y[after - 1] + w * y[after];
    }

    /// Keep finite points whose abscissa exceeds all before. A curve that falls from its first to its last point is turned.
    std::size_t
    keep_rising(std::vector<double> &x, std::vector<double> &y)
    {
      if (!x.empty() && x.back() < x.front() && std::is_sorted(x.rbegin(), x.rend()))
        {
          std::reverse(x.begin(), x.end());
          std::reverse(y.begin(), y.end());
        }
      std::size_t kept = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        if (std::isfinite(x[i]) && std::isfinite(y[i]) && (kept == 0 || x[i] > x[kept - 1]))
          {
            x[kept] = x[i];
            y[kept] = y[i];
            ++kept;
          }
      const std::size_t left_out = x.size() - kept;
      x.resize(kept);
      y.resize(kept);
      return left_out;
    }

    void
    evaluate(CurveComparison &c)
    {
      c.from = std::max(c.measured_x.front(), c.computed_x.front());
      c.to   = std::min(c.measured_x.back(), c.computed_x.back());
      double sum = 0, squares = 0, last_x = 0, last_measured = 0, last_computed = 0, peak = 0;
      for (std::size_t i = 0; i < c.measured_x.size(); ++i)
        {
          const double x = c.measured_x[i];
          if (x < c.from || x > c.to)
            continue;
          const double measured = c.measured_y[i], computed = interpolate(c.computed_x, c.computed_y, x);
          const double difference = computed - measured;
          sum += difference;
          squares += difference * difference;
          if (std::abs(difference) > std::abs(c.largest))
            {
              c.largest    = difference;
              c.largest_at = x;
            }
          if (c.points > 0)
            {
              c.measured_area += 0.5 * (x - last_x) * (measured + last_measured);
              c.computed_area += 0.5 * (x - last_x) * (computed + last_computed);
            }
          if (c.points == 0 || measured > c.measured_peak)
            c.measured_peak = measured;
          if (c.points == 0 || computed > c.computed_peak)
            c.computed_peak = computed;
          peak   = std::max(peak, std::abs(measured));
          last_x = x, last_measured = measured, last_computed = computed;
          ++c.points;
        }
      if (c.points < 2)
        throw InputError(describe_error("the curves of '" + c.quantity + "' do not overlap over '" + c.abscissa + "'.",
                                        "tribodraw compare",
                                        "measured " + units::number(c.measured_x.front()) + " to " + units::number(c.measured_x.back())
                                            + ", computed " + units::number(c.computed_x.front()) + " to "
                                            + units::number(c.computed_x.back()),
                                        "at least two measured points in the range of the computed curve"));
      c.mean = sum / static_cast<double>(c.points);
      c.rms  = std::sqrt(squares / static_cast<double>(c.points));
    }

    /// Names that a measurement and a table of the run share, but for the units.
    std::vector<std::pair<std::string, std::string>>
    common_names(const MeasuredTable &measured, const std::vector<std::string> &computed)
    {
      std::vector<std::pair<std::string, std::string>> pairs;
      for (const auto &column : measured.columns)
        for (const std::string &name : computed)
          if (take_apart(column.name).stem == take_apart(name).stem)
            pairs.emplace_back(column.name, name);
      return pairs;
    }

    std::vector<fs::path>
    tables_of_run(const fs::path &folder)
    {
      std::vector<fs::path> files;
      for (const auto &entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".csv" && entry.path().filename() != "compare.csv")
          files.push_back(entry.path());
      std::sort(files.begin(), files.end(), [](const fs::path &a, const fs::path &b) {
        const bool a_first = a.filename() == "history.csv", b_first = b.filename() == "history.csv";
        return a_first != b_first ? a_first : a < b;
      });
      return files;
    }
  } // namespace

  double
  CurveComparison::relative_rms() const
  {
    double peak = 0;
    for (std::size_t i = 0; i < measured_x.size(); ++i)
      if (measured_x[i] >= from && measured_x[i] <= to)
        peak = std::max(peak, std::abs(measured_y[i]));
    return peak > 0 ? rms / peak : 0;
  }

  CurveComparison
  compare_curves(const MeasuredTable::Column &measured_x, const MeasuredTable::Column &measured_y,
                 const MeasuredTable::Column &computed_x, const MeasuredTable::Column &computed_y)
  {
    CurveComparison c;
    c.abscissa   = computed_x.name;
    c.quantity   = computed_y.name;
    c.measured_x = measured_x.values;
    c.measured_y = measured_y.values;
    c.computed_x = computed_x.values;
    c.computed_y = computed_y.values;
    for (double &x : c.measured_x)
      x *= conversion(measured_x.name, computed_x.name);
    for (double &y : c.measured_y)
      y *= conversion(measured_y.name, computed_y.name);
    c.left_out = keep_rising(c.measured_x, c.measured_y);
    keep_rising(c.computed_x, c.computed_y);
    for (const auto &[x, name] : { std::pair{ &c.measured_x, &measured_y.name }, { &c.computed_x, &computed_y.name } })
      if (x->size() < 2)
        throw InputError(describe_error("the curve has fewer than two points with rising abscissa.", "tribodraw compare",
                                        "'" + *name + "'"));
    evaluate(c);
    return c;
  }

  std::vector<CurveComparison>
  compare_with_run(const MeasuredTable &measured, const fs::path &folder,
                   const std::vector<std::pair<std::string, std::string>> &wanted)
  {
    std::set<std::string> seen;
    for (const fs::path &file : tables_of_run(folder))
      {
        const CsvData data = read_csv(file);
        const auto    pairs = wanted.empty() ? common_names(measured, data.columns) : wanted;
        const bool    fits  = pairs.size() >= 2 && std::all_of(pairs.begin(), pairs.end(), [&](const auto &p) { return data.has(p.second); });
        for (const std::string &name : data.columns)
          seen.insert(name);
        if (!fits || data.rows.size() < 2)
          continue;
        std::vector<CurveComparison> curves;
        for (std::size_t k = 1; k < pairs.size(); ++k)
          curves.push_back(compare_curves(measured.column(pairs[0].first), measured.column(pairs[k].first),
                                          { pairs[0].second, data.numbers(pairs[0].second) },
                                          { pairs[k].second, data.numbers(pairs[k].second) }));
        return curves;
      }
    std::string names, known;
    for (const auto &column : measured.columns)
      names += (names.empty() ? "" : ", ") + column.name;
    for (const auto &name : seen)
      known += (known.empty() ? "" : ", ") + name;
    throw InputError(describe_error(wanted.empty() ? "no table of the output folder shares two column names with the measurement."
                                                   : "no table of the output folder has all columns that were named.",
                                    folder.string(), "'" + names + "' of the measurement", known,
                                    "Say which belong together: --columns 'stroke_mm=punch_travel_mm,force_kn=punch_force_n'."));
  }

  std::string
  spoken_column(const std::string &column)
  {
    const Name  name = take_apart(column);
    std::string text = name.stem;
    std::replace(text.begin(), text.end(), '_', ' ');
    if (!text.empty())
      text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return name.unit.empty() ? text : text + " / " + name.unit;
  }

  void
  write_comparison(const std::vector<CurveComparison> &curves, const fs::path &folder)
  {
    CsvTable table({ "quantity", "over", "points", "from", "to", "rms", "relative_rms", "mean", "largest", "largest_at",
                     "measured_peak", "computed_peak", "measured_area", "computed_area" });
    for (const CurveComparison &c : curves)
      {
        table.add_row({ c.quantity, c.abscissa, static_cast<long>(c.points), c.from, c.to, c.rms, c.relative_rms(), c.mean, c.largest, c.largest_at,
                        c.measured_peak, c.computed_peak, c.measured_area, c.computed_area });
        plot::LineChart chart{ "Measured and computed", spoken_column(c.abscissa), spoken_column(c.quantity) };
        chart.series = { { "measured", c.measured_x, c.measured_y, plot::Series::Style::points },
                         { "computed", c.computed_x, c.computed_y, plot::Series::Style::line } };
        plot::draw(chart, folder / ("compare_" + take_apart(c.quantity).stem));
      }
    table.save(folder / "compare.csv");
  }
} // namespace tribodraw
