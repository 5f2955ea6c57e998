#include <tribodraw/base/errors.h>
#include <tribodraw/base/own_process.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace tribodraw
{
  namespace
  {
    // First byte of what the process sends.
    constexpr char sends_result = 'R', sends_input_error = 'E', sends_exception = 'X';

    std::size_t
    address_space()
    {
      std::ifstream statm("/proc/self/statm");
      std::size_t   pages = 0;
      statm >> pages;
      return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    }

    void
    lower_limit(const int resource, const rlim_t value)
    {
      rlimit limit{};
      getrlimit(resource, &limit);
      limit.rlim_cur = std::min(limit.rlim_cur, value);
      setrlimit(resource, &limit);
    }

    /// Dies silently and at once; libraries that catch signals to print a trace are not asked.
    void
    confine(const ProcessLimits &limits)
    {
      for (const int signal : { SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGALRM })
        std::signal(signal, SIG_DFL);
      alarm(limits.seconds);
      lower_limit(RLIMIT_CORE, 0);
      lower_limit(RLIMIT_AS, address_space() + limits.memory);
      const int nothing = open("/dev/null", O_RDWR);
      for (const int stream : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
        dup2(nothing, stream);
    }

    void
    send(const int channel, const char kind, const std::string &text)
    {
      const auto put = [channel](const char *data, std::size_t left) {
        while (left > 0)
          {
            const ssize_t n = write(channel, data, left);
            if (n < 0 && errno != EINTR)
              _exit(exit_code::internal);
            data += std::max<ssize_t>(n, 0);
            left -= static_cast<std::size_t>(std::max<ssize_t>(n, 0));
          }
      };
      put(&kind, 1);
      put(text.data(), text.size());
    }

    [[noreturn]] void
    run_and_send(const std::function<std::string()> &work, const ProcessLimits &limits, const int channel)
    {
      try
        {
          confine(limits);
          send(channel, sends_result, work());
        }
      catch (const InputError &e)
        {
          send(channel, sends_input_error, e.what());
        }
      catch (const std::exception &e)
        {
          send(channel, sends_exception, e.what());
        }
      _exit(exit_code::success); // nobody's destructors: files and MPI belong to the other process
    }

    /// Everything that comes, up to @p limit bytes.
    std::string
    receive(const int channel, const std::size_t limit)
    {
      std::string               text;
      std::array<char, 1 << 16> part;
      while (text.size() < limit)
        {
          const ssize_t n = read(channel, part.data(), part.size());
          if (n == 0 || (n < 0 && errno != EINTR))
            break;
          text.append(part.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
        }
      return text;
    }

    std::string
    how_it_ended(const int status)
    {
      if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        return "it found no end";
      return WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                 : "exit code " + std::to_string(WEXITSTATUS(status));
    }
  } // namespace

  std::string
  in_own_process(const std::function<std::string()> &work, const std::string &failure, const ProcessLimits &limits)
  {
    std::array<int, 2> channel{};
    if (pipe2(channel.data(), O_CLOEXEC) != 0)
      throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
    const pid_t child = fork();
    if (child == 0)
      {
        close(channel[0]);
        run_and_send(work, limits, channel[1]);
      }
    close(channel[1]);
    std::string text = child > 0 ? receive(channel[0], limits.memory) : "";
    close(channel[0]);
    if (child < 0)
      throw std::runtime_error(std::string("no new process: ") + std::strerror(errno));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      continue;
    if (text.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != exit_code::success)
      throw InputError(failure + " (" + how_it_ended(status) + ")");
    const char kind = text.front();
    text.erase(0, 1);
    if (kind == sends_input_error)
      throw InputError(text);
    if (kind == sends_exception)
      throw InputError(failure + " (" + text + ")");
    return text;
  }
} // namespace tribodraw
