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

/// All parsers of the program but those of instruments' files, which test_surface_formats treats.
const std::vector<FuzzedParser> &fuzzed_parsers();

#endif
