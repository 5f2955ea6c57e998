#ifndef tribodraw_base_log_h
#define tribodraw_base_log_h

#include <chrono>
#include <filesystem>
#include <string>

namespace tribodraw
{
  /// Messages of the run: to the terminal (rank 0 only) and, once a file is opened, to log.txt.
  namespace log
  {
    enum class Level { quiet, normal, debug };

    void set_level(Level level);
    /// Start writing to @p file as well (earlier messages are copied there). @param append keep what is there (resumed runs)
    void open_file(const std::filesystem::path &file, bool append = false);
    void close_file();

    void info(const std::string &text);
    void debug(const std::string &text);
    /// Printed even when quiet, and counted.
    void warning(const std::string &text);
    unsigned n_warnings();

    /// True if standard error is a terminal and the level is not quiet: progress lines are drawn.
    bool interactive();
  } // namespace log

  /// A progress line with percentage and estimated time to the end. On a terminal it overwrites itself;
  /// otherwise it logs at most one line every ten per cent. Only rank 0 prints.
  class Progress
  {
  public:
    Progress(std::string label, double total);
    ~Progress();
    void update(double done, const std::string &detail = "");
    void finish(const std::string &detail = "");

  private:
    std::string                           label;
    double                                total;
    std::chrono::steady_clock::time_point start, last_draw;
    int                                   last_decile = -1;
    bool                                  finished    = false;
  };

  /// `1 h 02 min`, `3 min 20 s`, `12 s`.
  std::string format_duration(double seconds);
} // namespace tribodraw

#endif
