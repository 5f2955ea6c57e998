#ifndef tribodraw_material_csv_rows_h
#define tribodraw_material_csv_rows_h

#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

namespace tribodraw
{
  /// `FILE:LINE` of a data row (counted from 0) of a CSV file, for messages.
  inline std::string
  place_of_row(const std::string &file, const std::size_t row)
  {
    std::istringstream in(read_file(file));
    std::size_t        line_number = 0, filled = 0;
    for (std::string line; std::getline(in, line);)
      {
        ++line_number;
        if (!line.empty() && line != "\r" && filled++ == row + 1)
          break;
      }
    return file + ":" + std::to_string(line_number);
  }

  /// Read a small table of measured or prescribed values: at most @p max_bytes.
  inline CsvData
  read_small_csv(const std::filesystem::path &file, const std::uintmax_t max_bytes)
  {
    std::error_code error;
    const auto      size = std::filesystem::file_size(file, error);
    if (!error && size > max_bytes)
      throw InputError(describe_error("the file is too large for a table of this kind.", file.string(),
                                      std::to_string(size) + " bytes", "at most " + std::to_string(max_bytes)));
    return read_csv(file);
  }

  /// A column of finite numbers; names the line of one that is not.
  inline std::vector<double>
  finite_numbers(const CsvData &data, const std::string &column)
  {
    const std::vector<double> values = data.numbers(column);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i]))
        throw InputError(describe_error("column '" + column + "' is not finite.", place_of_row(data.file, i)));
    return values;
  }
} // namespace tribodraw

#endif
