#ifndef tribodraw_base_archive_h
#define tribodraw_base_archive_h

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Named arrays of numbers and texts in one checksummed binary file: the checkpoint format.
  /// Layout: `TRIBODRAW-ARCHIVE 1\n`, CRC-32 and size of the body, then for each item
  /// name, type, count, data (little endian).
  class Archive
  {
  public:
    void put(const std::string &name, std::vector<double> values);
    void put(const std::string &name, double value);
    void put(const std::string &name, const std::string &text);

    bool                       has(const std::string &name) const;
    /// Throw InputError naming the item if it is missing (or its size differs from @p expected_size, if given).
    const std::vector<double> &numbers(const std::string &name, std::size_t expected_size = SIZE_MAX) const;
    double                     number(const std::string &name) const;
    const std::string         &text(const std::string &name) const;

    void           save(const std::filesystem::path &file) const;
    /// Throws InputError if the file is truncated, altered (checksum) or of another version.
    static Archive load(const std::filesystem::path &file);

  private:
    std::map<std::string, std::vector<double>> arrays;
    std::map<std::string, std::string>         texts;
  };
} // namespace tribodraw

#endif
