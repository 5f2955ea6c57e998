#ifndef tribodraw_base_own_process_h
#define tribodraw_base_own_process_h

#include <cstddef>
#include <functional>
#include <string>

namespace tribodraw
{
  struct ProcessLimits
  {
    std::size_t memory  = 1u << 30; ///< address space beyond what this process has taken [bytes]
    unsigned    seconds = 30;
  };

  /// Text that @p work returns, which runs in a copy of this process: for libraries that crash, hang or leak when they
  /// read a damaged file. An InputError of @p work is thrown here with the same text. Whatever else ends the process
  /// (a crash, the limits, another exception) gives an InputError with @p failure and the way it ended. What the
  /// process writes to its standard streams is lost.
  std::string in_own_process(const std::function<std::string()> &work, const std::string &failure,
                             const ProcessLimits &limits);
} // namespace tribodraw

#endif
