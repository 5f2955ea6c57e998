#ifndef tribodraw_application_verbs_h
#define tribodraw_application_verbs_h

#include <functional>
#include <string>
#include <vector>

namespace tribodraw
{
  /// A command beside running a parameter file, such as `tribodraw list`.
  struct Verb
  {
    std::string                                            name;
    std::string                                            argument; ///< what it takes, for the help; empty: nothing
    std::string                                            description;
    std::function<void(const std::string &argument_value)> run;
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
