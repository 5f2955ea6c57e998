#ifndef tribodraw_tests_fuzz_scratch_file_h
#define tribodraw_tests_fuzz_scratch_file_h

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

/// A file in memory where there is one, with the content of the moment.
class ScratchFile
{
public:
  explicit ScratchFile(const std::string &content, const std::string &extension = "")
  {
    static const std::filesystem::path folder
        = std::filesystem::exists("/dev/shm") ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
    file = folder / ("tribodraw_fuzz_" + std::to_string(::getpid()) + extension);
    std::ofstream(file, std::ios::binary) << content;
  }
  ~ScratchFile()
  {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
  const std::filesystem::path &
  path() const
  {
    return file;
  }

private:
  std::filesystem::path file;
};

#endif
