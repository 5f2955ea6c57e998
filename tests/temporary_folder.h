#ifndef tribodraw_tests_temporary_folder_h
#define tribodraw_tests_temporary_folder_h

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

/// A fresh folder for the files of one test.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "tribodraw-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error("no temporary folder");
    folder = pattern;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(folder); }
  TemporaryFolder(const TemporaryFolder &)            = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

  std::filesystem::path
  operator/(const std::string &name) const
  {
    return folder / name;
  }
  const std::filesystem::path &
  path() const
  {
    return folder;
  }

  /// Exit status of Python's XML parser on files: 0 if all are well-formed.
  static int
  parse_xml(const std::vector<std::filesystem::path> &files)
  {
    std::string command = "python3 -c \"import sys, xml.dom.minidom as x; [x.parse(f) for f in sys.argv[1:]]\"";
    for (const auto &file : files)
      command += " '" + file.string() + "'";
    return std::system(command.c_str());
  }

private:
  std::filesystem::path folder;
};

#endif
