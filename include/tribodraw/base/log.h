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
    enum class Level
    {
      quiet,  ///< warnings and errors only
      normal, ///< steps as well if standard output is a terminal
      verbose ///< steps in any case
    };

    void set_level(Level level);
    /// Start writing to @p file as well (earlier messages are copied there). @param append keep what is there (resumed runs)
    void open_file(const std::filesystem::path &file, bool append = false);
    void close_file();

    void info(const std::string &text);
    /// One of many like it: a line a step. Always in log.txt, on the terminal as the level says.
    void step(const std::string &text);
    /// In log.txt only: what the terminal gets by another way.
    void to_file(const std::string &text);
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
    /// @param done_before what an earlier run had done, for the estimate of a resumed one
    Progress(std::string label, double total, double done_before = 0);
    ~Progress();
    /// `12 s elapsed, 3 min 20 s to go`
    std::string times(double done) const;
    void update(double done, const std::string &detail = "");
    void finish(const std::string &detail = "");

  private:
    std::string                           label;
    double                                total, before;
    std::chrono::steady_clock::time_point start, last_draw;
    int                                   last_decile = -1;
    bool                                  finished    = false;
  };

  /// `1 h 02 min`, `3 min 20 s`, `12 s`.
  std::string format_duration(double seconds);
} // namespace tribodraw

#endif
