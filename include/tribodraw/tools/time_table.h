#ifndef tribodraw_tools_time_table_h
#define tribodraw_tools_time_table_h

#include <tribodraw/base/parameters.h>

#include <string>
#include <vector>

namespace tribodraw
{
  /// A quantity over time, piecewise linear, constant before the first and after the last point: the displacement of
  /// a tool or a force on it.
  class TimeTable
  {
  public:
    /// What the values of a table in a file are.
    struct Quantity
    {
      std::string name;  ///< of the column in a CSV file, before the unit: `displacement` in `displacement_mm`
      std::string unit;  ///< names the dimension, and is the unit of the range
      Range       range; ///< allowed values
    };

    /// @param times [s], strictly increasing; @param values in internal units. Throws InputError otherwise.
    TimeTable(std::vector<double> times, std::vector<double> values);
    /// Entry @p entry: pairs of time and value, each with its unit (`0 s, 0 mm, 1 s, 10 mm`), or the name of a CSV file
    /// with the columns `time_<unit>` and `<name>_<unit>`. Mistakes are recorded as problems of the entry; the table
    /// is then that of zero.
    static TimeTable read(Parameters &parameters, const std::string &entry, const Quantity &quantity,
                          const std::string &documentation);

    double value(double time) const;
    /// Rate of the piece that begins at or contains @p time (zero after the end).
    double rate(double time) const;
    double
    start_time() const
    {
      return times.front();
    }
    double
    end_time() const
    {
      return times.back();
    }
    /// Times at which the rate jumps: a step should end there.
    const std::vector<double> &
    breakpoints() const
    {
      return times;
    }

  private:
    std::vector<double> times, values;
    std::size_t         piece(double time) const;
  };

  /// Prescribed displacement of a tool [mm].
  class Motion : public TimeTable
  {
  public:
    using TimeTable::TimeTable;
    /// From rest at 0 over @p travel [mm] with @p speed [mm/s] > 0.
    static Motion constant_speed(double speed, double travel);
    /// A table of `displacement` [mm].
    static Motion read(Parameters &parameters, const std::string &entry, const std::string &documentation);

    double
    position(const double time) const
    {
      return value(time);
    }
    double
    velocity(const double time) const
    {
      return rate(time);
    }

  private:
    explicit Motion(TimeTable table) : TimeTable(std::move(table)) {}
  };

  /// A table of `force` [kN], not negative: of a blank holder.
  TimeTable read_force_table(Parameters &parameters, const std::string &entry, const std::string &documentation);
} // namespace tribodraw

#endif
