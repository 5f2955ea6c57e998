#ifndef tribodraw_application_provenance_h
#define tribodraw_application_provenance_h

#include <tribodraw/base/parameters.h>

#include <filesystem>
#include <map>
#include <string>

namespace tribodraw
{
  /// `tribodraw 0.1.0`
  std::string version_text();
  /// Versions of the libraries, one a line, `name version`.
  std::string library_versions();

  /// `Section/Entry` -> value from the text of effective.prm.
  std::map<std::string, std::string> effective_values(const std::string &effective);

  /// Hashes of the contents of the files that the parameters name, by the path of the entry. Throws InputError if one
  /// cannot be read.
  std::map<std::string, std::string> input_hashes(const Parameters &parameters);

  /// Text of run_info.txt: version, libraries, ranks and hashes of the parameter file and of every file it names. No
  /// times and no names of machines, so that the same run gives the same text.
  std::string run_info(const Parameters &parameters, const std::filesystem::path &parameter_file);

  /// Text of citations.txt: the program, the model it implements and the publications of the laws in use.
  std::string citations(const Parameters &parameters);
} // namespace tribodraw

#endif
