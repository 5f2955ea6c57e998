#ifndef tribodraw_base_timing_h
#define tribodraw_base_timing_h

#include <filesystem>
#include <string>

namespace tribodraw
{
  /// Time spent by section, named `module/action`, on deal.II's TimerOutput.
  namespace timing
  {
    class Scope
    {
    public:
      explicit Scope(const char *section);
      ~Scope();
      Scope(const Scope &)            = delete;
      Scope &operator=(const Scope &) = delete;

    private:
      std::string section;
    };

    /// Write `section,calls,wall_s,share` of this process.
    void write(const std::filesystem::path &file);
    /// A table for the log.
    std::string summary();
    /// Wall time since the program started, in s.
    double wall_time();
  } // namespace timing
} // namespace tribodraw

#endif
