#ifndef tribodraw_base_csv_h
#define tribodraw_base_csv_h

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace tribodraw
{
  /// A table with named columns that is written as CSV: one header line, `.` decimal, full precision,
  /// no time stamps. Rows are kept so that every save() is a complete, atomically replaced file.
  class CsvTable
  {
  public:
    using Cell = std::variant<double, long, std::string>;

    explicit CsvTable(std::vector<std::string> columns);
    void add_row(std::vector<Cell> row);
    void save(const std::filesystem::path &file) const;

    std::string                            text() const;
    const std::vector<std::string>        &columns() const { return header; }
    const std::vector<std::vector<Cell>>  &rows() const { return cells; }
    /// Remove all rows after the first @p n (a resumed run cuts its history back).
    void truncate(std::size_t n);

  private:
    std::vector<std::string>       header;
    std::vector<std::vector<Cell>> cells;
  };

  /// A numeric CSV file as read: used by `report`, `compare` and the tests.
  struct CsvData
  {
    std::vector<std::string>              columns;
    std::vector<std::vector<std::string>> rows;
    /// Column by name as numbers. Throws InputError naming file, line and column if missing or not a number.
    std::vector<double> numbers(const std::string &column) const;
    bool                has(const std::string &column) const;
    std::string         file;
  };
  CsvData read_csv(const std::filesystem::path &file);
} // namespace tribodraw

#endif
