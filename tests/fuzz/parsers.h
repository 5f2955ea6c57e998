#ifndef tribodraw_tests_fuzz_parsers_h
#define tribodraw_tests_fuzz_parsers_h

#include <functional>
#include <string>
#include <vector>

/// Something that reads what a user hands in. Whatever the content is, it must return or throw InputError.
struct FuzzedParser
{
  std::string                             name;
  bool                                    is_text;
  std::function<void(const std::string &)> read;
  std::vector<std::string>                seeds; ///< valid contents, made by the program itself or shipped with it
};

/// Those of files that need the modules base, surface and tools only.
const std::vector<FuzzedParser> &file_parsers();

/// Those of tables and meshes, which need a few source files of other modules.
const std::vector<FuzzedParser> &table_parsers();

/// All parsers of the program. (test_surface_formats and test_tools damage files of every surface and tool format in addition.)
const std::vector<FuzzedParser> &fuzzed_parsers();

#endif
