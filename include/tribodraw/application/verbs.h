#ifndef tribodraw_application_verbs_h
#define tribodraw_application_verbs_h

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tribodraw
{
  /// An option that only one verb understands, such as `--format` of `tribodraw export`.
  struct VerbOption
  {
    std::string name, argument, description;
  };

  /// What was typed after a verb.
  struct VerbCall
  {
    std::vector<std::string>           arguments; ///< as many as the verb takes
    std::map<std::string, std::string> options;   ///< by name, those that were given
  };

  /// A command beside running a parameter file, such as `tribodraw list`.
  struct Verb
  {
    std::string                           name;
    std::vector<std::string>              arguments; ///< what it takes, for the help
    std::string                           description;
    std::function<void(const VerbCall &)> run;
    std::vector<VerbOption>               options = {};
  };

  /// All verbs in the order of the help.
  const std::vector<Verb> &verbs();

  /// A parameter file that the program carries along for `tribodraw init`.
  struct ShippedFile
  {
    std::string name; ///< without `.prm`
    std::string content;
  };
  /// Sorted by name; generated from prm/ when the program is built.
  const std::vector<ShippedFile> &shipped_files();

  /// The lines of `tribodraw doctor`.
  std::string examine_machine();
} // namespace tribodraw

#endif
