#ifndef tribodraw_base_files_h
#define tribodraw_base_files_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace tribodraw
{
  /// Files of these names are being written: `NAME.partial` becomes `NAME`.
  constexpr const char *partial_file_extension = ".partial";

  /// Write @p content to a temporary name beside @p file and rename it, so that a reader sees
  /// the old or the new file, never half of one. Throws InputError if the folder is not writable or the disk is full; the
  /// old file is left then. @param durable wait until the content is on the disk before the file gets its name, so that
  /// this holds for a power failure too
  void write_file(const std::filesystem::path &file, const std::string &content, bool durable = false);

  /// Whole content of a file; throws InputError (with path and reason) if it cannot be read or is
  /// larger than @p max_bytes.
  std::string read_file(const std::filesystem::path &file, std::uintmax_t max_bytes = 4ull << 30);

  /// Create the folder (and its parents), prove that a file can be written in it, and remove what a killed run has left half
  /// written.
  void prepare_output_folder(const std::filesystem::path &folder);

  /// 64-bit FNV-1a hash as 16 hexadecimal digits: names of cached files and provenance. Not for security.
  std::string hash_text(const std::string &content);
  std::string hash_bytes(const void *data, std::size_t size);
} // namespace tribodraw

#endif
