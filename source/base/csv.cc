#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace tribodraw
{
  namespace
  {
    std::vector<std::string> split(const std::string &line)
    {
      std::vector<std::string> cells;
      std::size_t              start = 0;
      for (;;)
        {
          const auto comma = line.find(',', start);
          cells.push_back(line.substr(start, comma == std::string::npos ? std::string::npos : comma - start));
          if (comma == std::string::npos)
            return cells;
          start = comma + 1;
        }
    }

    std::string cell_text(const CsvTable::Cell &cell)
    {
      if (const auto *number = std::get_if<double>(&cell))
        return units::number(*number);
      if (const auto *integer = std::get_if<long>(&cell))
        return std::to_string(*integer);
      return std::get<std::string>(cell);
    }
  } // namespace

  CsvTable::CsvTable(std::vector<std::string> columns)
    : header(std::move(columns))
  {}

  void
  CsvTable::add_row(std::vector<Cell> row)
  {
    if (row.size() != header.size())
      throw std::logic_error("A CSV row has " + std::to_string(row.size()) + " cells, the header " + std::to_string(header.size()) + ".");
    cells.push_back(std::move(row));
  }

  std::string
  CsvTable::text() const
  {
    std::string out;
    for (std::size_t i = 0; i < header.size(); ++i)
      out += (i ? "," : "") + header[i];
    out += '\n';
    for (const auto &row : cells)
      {
        for (std::size_t i = 0; i < row.size(); ++i)
          out += (i ? "," : "") + cell_text(row[i]);
        out += '\n';
      }
    return out;
  }

  void
  CsvTable::save(const std::filesystem::path &file) const
  {
    write_file(file, text());
  }

  void
  CsvTable::truncate(const std::size_t n)
  {
    cells.resize(std::min(n, cells.size()));
  }

  CsvData
  read_csv(const std::filesystem::path &file)
  {
    const std::string content = read_file(file);
    CsvData           data;
    data.file         = file.string();
    std::size_t start = 0, line_number = 0;
    while (start < content.size())
      {
        auto        end  = content.find('\n', start);
        end              = end == std::string::npos ? content.size() : end;
        std::string line = content.substr(start, end - start);
        if (!line.empty() && line.back() == '\r')
          line.pop_back();
        ++line_number;
        start = end + 1;
        if (line.empty())
          continue;
        auto cells = split(line);
        if (data.columns.empty())
          data.columns = std::move(cells);
        else if (cells.size() != data.columns.size())
          throw InputError(describe_error("the line has " + std::to_string(cells.size()) + " cells, the header " + std::to_string(data.columns.size()) + ".",
                                          data.file + ":" + std::to_string(line_number)));
        else
          data.rows.push_back(std::move(cells));
      }
    if (data.columns.empty())
      throw InputError(describe_error("the CSV file is empty.", data.file));
    return data;
  }

  bool
  CsvData::has(const std::string &column) const
  {
    return std::find(columns.begin(), columns.end(), column) != columns.end();
  }

  std::vector<double>
  CsvData::numbers(const std::string &column) const
  {
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end())
      {
        std::string known;
        for (const auto &name : columns)
          known += (known.empty() ? "" : ", ") + name;
        throw InputError(describe_error("there is no column '" + column + "'.", file, "", known));
      }
    const auto          index = static_cast<std::size_t>(found - columns.begin());
    std::vector<double> values;
    values.reserve(rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      {
        const std::string &text  = rows[r][index];
        char              *after = nullptr;
        values.push_back(std::strtod(text.c_str(), &after));
        if (after == text.c_str() || *after != '\0')
          throw InputError(describe_error("column '" + column + "' is not a number.", file + ", row " + std::to_string(r + 1), "'" + text + "'"));
      }
    return values;
  }
} // namespace tribodraw
