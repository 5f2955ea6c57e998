#include "gnuplot.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/log.h>
#include <tribodraw/output/plot.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char **environ;

namespace tribodraw::gnuplot
{
  namespace
  {
    /// No figure of ours takes more than a few seconds; a gnuplot that hangs must not hang the run.
    constexpr double time_limit = 120;

    /// Wait for a child, ending it after the time limit. Returns its exit status or -1.
    int
    wait_for(const pid_t child)
    {
      const auto start  = std::chrono::steady_clock::now();
      int        status = 0;
      while (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < time_limit)
        {
          const pid_t ended = waitpid(child, &status, WNOHANG);
          if (ended == child)
            return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
          if (ended < 0)
            return -1;
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return -1;
    }

    /// Start gnuplot without a shell, its messages going to @p message_file. Returns 127 if there is no gnuplot.
    int
    start(const char *argument, const std::filesystem::path &message_file)
    {
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      for (const int stream : { STDOUT_FILENO, STDERR_FILENO })
        posix_spawn_file_actions_addopen(&actions, stream, message_file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
      std::string program = "gnuplot", arg = argument;
      char       *arguments[] = { program.data(), arg.data(), nullptr };
      pid_t       child;
      const int   error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
      posix_spawn_file_actions_destroy(&actions);
      return error == 0 ? wait_for(child) : 127;
    }
  } // namespace

  TemporaryFolder::TemporaryFolder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "tribodraw-plot-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw InputError(describe_error("A temporary folder for a figure cannot be made.", pattern, "", "",
                                      "Set TMPDIR to a writable folder."));
    folder = pattern;
  }

  TemporaryFolder::~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  std::string
  quote(const std::string &text)
  {
    std::string result = "'";
    for (const char c : text)
      if (c == '\'')
        result += "''";
      else if (c != '\n')
        result += c;
    return result + "'";
  }

  bool
  draw(const TemporaryFolder &folder, const std::string &plot, const unsigned width, const unsigned height,
       const std::filesystem::path &stem)
  {
    if (!plot::available())
      return false;
    const auto         in = [&](const char *name) { return folder.path() / name; };
    std::ostringstream script;
    // The SVG has no background, so that the report can show it on light and dark pages.
    script << "set encoding utf8\n"
           << "set terminal svg size " << width << ',' << height << " dynamic noenhanced font 'Helvetica,14' name "
           << quote(stem.filename().string()) << "\nset output " << quote(in("out.svg").string()) << '\n'
           << plot << "\nset output\nset terminal pngcairo size " << 2 * width << ',' << 2 * height
           << " noenhanced background 'white' font 'Helvetica,14' fontscale 1.6 linewidth 2 pointscale 2\nset output "
           << quote(in("out.png").string()) << "\nreplot\nset output\n";
    write_file(in("plot.gp"), script.str());

    const int status = start(in("plot.gp").c_str(), in("messages"));
    if (status != 0 || !std::filesystem::exists(in("out.svg")) || !std::filesystem::exists(in("out.png")))
      {
        std::string messages = read_file(in("messages")).substr(0, 400);
        std::replace(messages.begin(), messages.end(), '\n', ' ');
        log::warning("gnuplot could not draw " + stem.filename().string() + " (exit status " + std::to_string(status)
                     + "): " + messages);
        return false;
      }
    write_file(stem.string() + ".svg", read_file(in("out.svg")));
    write_file(stem.string() + ".png", read_file(in("out.png")));
    return true;
  }
} // namespace tribodraw::gnuplot

namespace tribodraw::plot
{
  bool
  available()
  {
    static const bool found = [] {
      const bool ok = gnuplot::start("--version", "/dev/null") == 0;
      if (!ok)
        log::warning("gnuplot was not found: no figures are drawn. Install it (Debian: gnuplot-nox) and run "
                     "`tribodraw report` on the output folder.");
      return ok;
    }();
    return found;
  }
} // namespace tribodraw::plot
