#ifndef tribodraw_tests_bench_bench_h
#define tribodraw_tests_bench_bench_h

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <optional>
#include <string>

/// What every benchmark program measures and prints. Use:
///   bench::Timer timer;  work();  const bench::Measurement m = timer.stop();
///   bench::print_row("micro", "666x666", m, bench::Reference{"CHOLMOD", reference.cpu_s});
namespace bench
{
  struct Measurement
  {
    double cpu_s;   ///< CPU time of all threads of this process [s]
    double wall_s;  ///< [s]
    double peak_mb; ///< largest resident memory of the process since the timer started [MB]
  };

  /// Another program or method, measured in the same run.
  struct Reference
  {
    std::string name;
    double      cpu_s;
  };

  class Timer
  {
  public:
    Timer()
    {
      // Writing 5 resets the high-water mark of the resident memory (man 5 proc), so that each case shows its own.
      std::ofstream("/proc/self/clear_refs") << "5";
      cpu  = cpu_time();
      wall = std::chrono::steady_clock::now();
    }

    Measurement stop() const
    {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - wall;
      return {cpu_time() - cpu, elapsed.count(), peak_memory()};
    }

  private:
    double                                cpu;
    std::chrono::steady_clock::time_point wall;

    static double cpu_time()
    {
      timespec t;
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
      return t.tv_sec + 1e-9 * t.tv_nsec;
    }

    static double peak_memory()
    {
      std::ifstream status("/proc/self/status");
      std::string   word;
      while (status >> word)
        if (word == "VmHWM:")
          {
            double kib;
            status >> kib;
            return kib * 1024 / 1e6;
          }
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return usage.ru_maxrss * 1024 / 1e6;
    }
  };

  /// One row of bench.csv on standard output. The ratio says how many times less CPU time than the reference.
  inline void
  print_row(const std::string              &name,
            const std::string              &case_name,
            const Measurement              &m,
            const std::optional<Reference> &reference = {})
  {
    std::printf("%s,%s,%.6g,%.6g,%.4g,", name.c_str(), case_name.c_str(), m.cpu_s, m.wall_s, m.peak_mb);
    if (reference)
      std::printf("%s,%.6g,%.4g\n", reference->name.c_str(), reference->cpu_s, reference->cpu_s / m.cpu_s);
    else
      std::printf(",,\n");
    std::fflush(stdout);
  }
} // namespace bench

#endif
