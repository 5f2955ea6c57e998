#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <mutex>
#include <string>

namespace tribodraw
{
  namespace
  {
    struct State
    {
      std::mutex    mutex;
      log::Level    level = log::Level::normal;
      std::ofstream file;
      std::string   early;  // messages before the file was opened
      unsigned      warnings = 0;
      bool          line_open = false; // a progress line stands on the terminal
    };

    State &state()
    {
      static State instance;
      return instance;
    }

    void emit(const std::string &text, const bool to_terminal)
    {
      if (parallel::rank() != 0)
        return;
      auto                             &s = state();
      const std::lock_guard<std::mutex> lock(s.mutex);
      if (to_terminal)
        {
          if (s.line_open)
            std::cerr << "\r\033[K" << std::flush;
          s.line_open = false;
          std::cout << text << std::endl;
        }
      if (s.file.is_open())
        s.file << text << std::endl;
      else
        s.early += text + "\n";
    }
  } // namespace

  namespace log
  {
    void set_level(const Level level) { state().level = level; }

    void open_file(const std::filesystem::path &file, const bool append)
    {
      if (parallel::rank() != 0)
        return;
      auto &s = state();
      s.file.open(file, append ? std::ios::app : std::ios::trunc);
      s.file << s.early << std::flush;
      s.early.clear();
    }

    void close_file() { state().file.close(); }

    void info(const std::string &text) { emit(text, state().level != Level::quiet); }

    void step(const std::string &text)
    {
      static const bool terminal = isatty(STDOUT_FILENO);
      const Level       level    = state().level;
      emit(text, level == Level::verbose || (level == Level::normal && terminal));
    }

    void to_file(const std::string &text) { emit(text, false); }

    void warning(const std::string &text)
    {
      ++state().warnings;
      emit("Warning: " + text, true);
    }

    unsigned n_warnings() { return state().warnings; }

    bool interactive()
    {
      static const bool terminal = isatty(STDERR_FILENO);
      return terminal && state().level != Level::quiet && parallel::rank() == 0;
    }
  } // namespace log

  std::string
  format_duration(const double seconds)
  {
    if (!(seconds < 1e8))
      return "-";
    const long total = std::lround(seconds);
    char       text[64];
    if (total >= 3600)
      std::snprintf(text, sizeof(text), "%ld h %02ld min", total / 3600, (total % 3600) / 60);
    else if (total >= 60)
      std::snprintf(text, sizeof(text), "%ld min %02ld s", total / 60, total % 60);
    else
      std::snprintf(text, sizeof(text), "%ld s", total);
    return text;
  }

  Progress::Progress(std::string what, const double amount, const double done_before)
    : label(std::move(what))
    , total(amount > 0 ? amount : 1)
    , before(done_before)
    , start(std::chrono::steady_clock::now())
    , last_draw(start - std::chrono::hours(1))
  {}

  Progress::~Progress() = default;

  std::string
  Progress::times(const double done) const
  {
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double to_go   = done > before ? elapsed * std::fmax(0., total - done) / (done - before) : NAN;
    return format_duration(elapsed) + " elapsed, " + format_duration(to_go) + " to go";
  }

  void
  Progress::update(const double done, const std::string &detail)
  {
    const auto        now      = std::chrono::steady_clock::now();
    const double      fraction = std::fmin(1., std::fmax(0., done / total));
    const double      elapsed  = std::chrono::duration<double>(now - start).count();
    const std::string text = label + ": " + std::to_string(std::lround(100 * fraction)) + " %, " + times(done) + (detail.empty() ? "" : ", " + detail);
    if (log::interactive())
      {
        if (now - last_draw < std::chrono::milliseconds(200))
          return;
        last_draw = now;
        auto                             &s = state();
        const std::lock_guard<std::mutex> lock(s.mutex);
        std::cerr << "\r\033[K" << text << std::flush;
        s.line_open = true;
      }
    else if (const int decile = static_cast<int>(10 * fraction); decile > last_decile && elapsed > 2)
      {
        last_decile = decile;
        log::info(text);
      }
  }

  void
  Progress::finish(const std::string &detail)
  {
    if (finished)
      return;
    finished             = true;
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    log::info(label + ": done in " + format_duration(elapsed) + (detail.empty() ? "" : ", " + detail));
  }
} // namespace tribodraw
