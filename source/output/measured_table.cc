#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/output/measured_table.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribodraw
{
  const MeasuredTable::Column &
  MeasuredTable::column(const std::string &name) const
  {
    const auto  at = std::find_if(columns.begin(), columns.end(), [&](const Column &c) { return c.name == name; });
    std::string known;
    if (at != columns.end())
      return *at;
    for (const Column &c : columns)
      known += (known.empty() ? "" : ", ") + c.name;
    throw InputError(describe_error("there is no column '" + name + "'.", source, "", known));
  }

  namespace
  {
    MeasuredTable
    read_csv_table(const std::string &path)
    {
      CsvData       data = read_csv(path);
      MeasuredTable table;
      table.source = path;
      for (auto &row : data.rows)
        for (auto &cell : row)
          if (cell.empty())
            cell = "nan";
      for (const std::string &name : data.columns)
        table.columns.push_back({ name, data.numbers(name) });
      return table;
    }
  } // namespace

  MeasuredTable
  read_measured_table(const std::string &path)
  {
    return hdf5::is_hdf5_path(path) ? hdf5::read_table(path) : read_csv_table(path);
  }
} // namespace tribodraw
