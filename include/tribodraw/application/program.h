#ifndef tribodraw_application_program_h
#define tribodraw_application_program_h

#include <tribodraw/application/task.h>
#include <tribodraw/base/parameters.h>

#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  /// The whole program: start MPI, parse the command line, do it, and translate errors into a message (printed once) and
  /// the exit code. In parallel, if some ranks fail and others do not, the run is aborted.
  int run_program(int argc, char **argv);

  /// Read the entry `Task` and create that task, which reads its sections. Problems are recorded in @p parameters; the
  /// result is then possibly nullptr.
  std::unique_ptr<Task> create_task(Parameters &parameters);

  /// Every entry of every task, in the order in which the tasks ask for them.
  struct TaskEntries
  {
    std::string            task;
    std::vector<EntryInfo> entries;
  };
  std::vector<TaskEntries> document_all_tasks();
} // namespace tribodraw

#endif
