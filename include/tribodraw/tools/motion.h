#ifndef tribodraw_tools_motion_h
#define tribodraw_tools_motion_h

#include <vector>

namespace tribodraw
{
  /// Prescribed displacement of a tool over time, piecewise linear; at rest before the first and after the last point.
  class Motion
  {
  public:
    /// From rest at 0 over @p travel [mm] with @p speed [mm/s] > 0.
    static Motion constant_speed(double speed, double travel);
    /// @param times [s], strictly increasing; @param displacements [mm]. Throws InputError otherwise.
    Motion(std::vector<double> times, std::vector<double> displacements);

    double position(double time) const;
    /// Velocity of the piece that begins at or contains @p time (zero after the end).
    double velocity(double time) const;
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
    /// Times at which the velocity jumps: a step should end there.
    const std::vector<double> &
    breakpoints() const
    {
      return times;
    }

  private:
    std::vector<double> times, displacements;
    std::size_t         piece(double time) const;
  };
} // namespace tribodraw

#endif
