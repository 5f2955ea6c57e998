#include "fuzz/parsers.h"

#include <tribodraw/application/program.h>
#include <tribodraw/base/files.h>

#include <algorithm>
#include <filesystem>

using namespace tribodraw;
namespace fs = std::filesystem;

namespace
{
  std::vector<std::string>
  shipped_parameter_files()
  {
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(TRIBODRAW_SOURCE_DIR "/prm"))
      if (entry.path().extension() == ".prm")
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> contents;
    for (const auto &file : files)
      contents.push_back(read_file(file));
    return contents;
  }

  void
  read_parameters(const std::string &text)
  {
    Parameters parameters = Parameters::from_text(text);
    const auto task       = create_task(parameters);
    parameters.finish();
    if (task)
      task->describe();
  }
} // namespace

const std::vector<FuzzedParser> &
fuzzed_parsers()
{
  static const std::vector<FuzzedParser> parsers = [] {
    std::vector<FuzzedParser> all = file_parsers();
    all.insert(all.end(), table_parsers().begin(), table_parsers().end());
    all.push_back({ "parameters", true, read_parameters, shipped_parameter_files() });
    return all;
  }();
  return parsers;
}
