#include <tribodraw/application/provenance.h>
#include <tribodraw/application/verbs.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/units.h>
#include <tribodraw/output/plot.h>

#include <mpi.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    std::string
    line(const bool good, const std::string &what, const std::string &finding, const std::string &advice)
    {
      return std::string(good ? "ok    " : "warn  ") + what + ": " + finding
             + (good || advice.empty() ? "" : ". " + advice) + "\n";
    }

    std::string
    examine_mpi()
    {
      char text[MPI_MAX_LIBRARY_VERSION_STRING];
      int  length = 0, threads = 0;
      MPI_Get_library_version(text, &length);
      MPI_Query_thread(&threads);
      const std::string version(text, length);
      return line(threads >= MPI_THREAD_SERIALIZED, "MPI", version.substr(0, version.find_first_of(",\n")),
                  "It does not allow calls from threads");
    }

    /// The files of this process tell which BLAS the dynamic linker has chosen.
    std::string
    examine_blas()
    {
      std::ifstream         maps("/proc/self/maps");
      std::set<std::string> found;
      for (std::string text; std::getline(maps, text);)
        if (const auto path = text.find('/'); path != std::string::npos)
          if (const std::string file = text.substr(path);
              file.find("blas") != std::string::npos || file.find("mkl") != std::string::npos)
            found.insert(file);
      bool        fast = false;
      std::string names;
      for (const auto &file : found)
        {
          for (const char *known : { "openblas", "mkl", "blis", "atlas" })
            fast = fast || file.find(known) != std::string::npos;
          names += (names.empty() ? "" : ", ") + file;
        }
      return line(fast, "BLAS", names.empty() ? "not found" : names,
                  "This is the reference BLAS, or an unknown one: factorisations take about four times as long as with "
                  "OpenBLAS "
                  "(Debian: libopenblas0-pthread)");
    }

    std::string
    examine_memory()
    {
      std::ifstream info("/proc/meminfo");
      double        available = NAN; // kB
      for (std::string text; std::getline(info, text);)
        if (text.rfind("MemAvailable:", 0) == 0)
          std::istringstream(text.substr(13)) >> available;
      constexpr double  needed = 4; // GB: the largest shipped case with room to spare
      const double      gb     = available / 1048576;
      const std::string amount
          = std::isfinite(gb) ? units::number(std::round(10 * gb) / 10) + " GB available" : "unknown";
      return line(gb >= needed, "memory", amount, "Large cases need " + units::number(needed) + " GB");
    }

    std::string
    examine_folder()
    {
      const auto        folder = std::filesystem::current_path();
      const bool        good   = access(folder.c_str(), W_OK | X_OK) == 0;
      std::error_code   error;
      const auto        space = std::filesystem::space(folder, error);
      const double      gb    = static_cast<double>(space.available) / (1ull << 30);
      const std::string finding
          = folder.string() + (good ? ", writable, " : ", not writable, ")
            + (error ? "free space unknown" : units::number(std::round(10 * gb) / 10) + " GB free");
      return line(good && (error || gb >= 1), "current folder", finding, "Go to another folder or use --output");
    }

    std::string
    examine_cores()
    {
      const unsigned threads = parallel::n_threads();
      return line(true, "cores",
                  std::to_string(sysconf(_SC_NPROCESSORS_ONLN)) + " online, " + std::to_string(threads)
                      + (threads == 1 ? " thread" : " threads") + " used by one rank",
                  "");
    }
  } // namespace

  std::string
  examine_machine()
  {
    std::string libraries = library_versions();
    for (auto at = libraries.find('\n'); at != std::string::npos && at + 1 < libraries.size();
         at      = libraries.find('\n', at))
      libraries.replace(at, 1, ", ");
    if (!libraries.empty())
      libraries.pop_back();
    return line(true, "program", version_text(), "") + line(true, "libraries", libraries, "") + examine_mpi()
           + examine_blas()
           + line(plot::available(), "gnuplot", plot::available() ? "found" : "not found",
                  "Figures are not drawn without it (Debian: gnuplot-nox)")
           + examine_cores() + examine_memory() + examine_folder();
  }
} // namespace tribodraw
