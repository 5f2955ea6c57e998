#include <tribodraw/base/csv.h>
#include <tribodraw/base/timing.h>

#include <deal.II/base/timer.h>

#include <chrono>
#include <sstream>

namespace tribodraw::timing
{
  namespace
  {
    const auto program_start = std::chrono::steady_clock::now();

    std::ostringstream &sink()
    {
      static std::ostringstream stream;
      return stream;
    }

    dealii::TimerOutput &timer()
    {
      static dealii::TimerOutput output(sink(), dealii::TimerOutput::never, dealii::TimerOutput::wall_times);
      return output;
    }
  } // namespace

  Scope::Scope(const char *name)
    : section(name)
  {
    timer().enter_subsection(section);
  }

  Scope::~Scope()
  {
    timer().leave_subsection(section);
  }

  double
  wall_time()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - program_start).count();
  }

  void
  write(const std::filesystem::path &file)
  {
    const auto   seconds = timer().get_summary_data(dealii::TimerOutput::total_wall_time);
    const auto   calls   = timer().get_summary_data(dealii::TimerOutput::n_calls);
    const double total   = wall_time();
    CsvTable     table({"section", "calls", "wall_s", "share"});
    for (const auto &[name, time] : seconds)
      table.add_row({name, static_cast<long>(calls.at(name)), time, time / total});
    table.add_row({std::string("total"), 1l, total, 1.});
    table.save(file);
  }

  std::string
  summary()
  {
    const auto         seconds = timer().get_summary_data(dealii::TimerOutput::total_wall_time);
    const double       total   = wall_time();
    std::ostringstream out;
    out.precision(1);
    out << std::fixed << "Time " << total << " s:";
    for (const auto &[name, time] : seconds)
      if (time > 0.02 * total)
        out << "  " << name << " " << 100. * time / total << " %";
    return out.str();
  }
} // namespace tribodraw::timing
