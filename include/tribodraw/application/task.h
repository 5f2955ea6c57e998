#ifndef tribodraw_application_task_h
#define tribodraw_application_task_h

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// What a task gets to know of the run it is part of.
  struct RunContext
  {
    std::filesystem::path    output_folder;        ///< exists and is writable
    bool                     resume = false;       ///< go on from the newest checkpoint in the output folder
    std::string              effective_parameters; ///< text of effective.prm, defaults included
    std::filesystem::path    parameter_file;
    std::map<std::string, std::string> input_hashes; ///< of the contents of the files that the parameters name, by entry
    std::vector<std::string> settings; ///< `Section/Entry = value` of the command line, which override the file

    /// Path of a file in the output folder.
    std::filesystem::path
    file(const std::string &name) const
    {
      return output_folder / name;
    }
  };

  /// What a parameter file can ask for by its first entry, `set Task = ...`. A task registers itself with
  /// TRIBODRAW_REGISTER. Its constructor reads the top-level sections of the file that belong to it and does no work,
  /// so that `--validate` and the documentation visit it cheaply.
  class Task
  {
  public:
    virtual ~Task() = default;
    static const char *
    kind()
    {
      return "task";
    }

    /// One or two sentences on what run() would do with these parameters, for `--validate` and the log.
    virtual std::string describe() const = 0;

    /// Do the work on all ranks and write the results (rank 0 writes files). Figures, report.html, run_info.txt and
    /// timing.csv are made afterwards by the program from the files in the output folder.
    /// Throws ConvergenceError when a solver gives up, after the last state has been written.
    virtual void run(const RunContext &context) = 0;

    /// Whether run() writes checkpoints and honours RunContext::resume. Other tasks begin again when they are resumed.
    virtual bool
    has_checkpoints() const
    {
      return false;
    }
  };
} // namespace tribodraw

#endif
