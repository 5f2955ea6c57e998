#ifndef tribodraw_application_command_line_h
#define tribodraw_application_command_line_h

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tribodraw
{
  /// What the user typed, checked.
  struct CommandLine
  {
    std::string              verb; ///< empty: run or validate a parameter file
    std::vector<std::string> arguments;
    std::filesystem::path    output; ///< empty: default
    std::vector<std::string> settings;
    std::map<std::string, std::string> verb_options; ///< options of the verb that were given, by name
    bool                     resume = false, validate = false, quiet = false, verbose = false, help = false, version = false;

    /// @param words without the name of the program. Throws InputError with the nearest known word for a mistyped
    /// option or verb, and for options that have no effect together.
    static CommandLine parse(const std::vector<std::string> &words);
    /// The text of `--help`.
    static std::string help_text();
  };
} // namespace tribodraw

#endif
