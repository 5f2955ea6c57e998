#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/motion.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  Motion
  Motion::constant_speed(const double speed, const double travel)
  {
    if (!(speed > 0) || !std::isfinite(speed))
      throw InputError(describe_error("Motion: the speed must be positive.", "", units::number(speed) + " mm/s",
                                      "more than 0 mm/s"));
    if (travel == 0)
      throw InputError(describe_error("Motion: the travel must not be zero.", "", "0 mm"));
    return Motion({ 0, std::abs(travel) / speed }, { 0, travel });
  }

  Motion::Motion(std::vector<double> time_points, std::vector<double> displacement_points)
      : times(std::move(time_points)), displacements(std::move(displacement_points))
  {
    if (times.size() < 2 || times.size() != displacements.size())
      throw InputError(describe_error(
          "Motion: a table needs at least two points and as many displacements as times.", "",
          std::to_string(times.size()) + " times, " + std::to_string(displacements.size()) + " displacements"));
    for (std::size_t i = 0; i < times.size(); ++i)
      {
        if (!std::isfinite(times[i]) || !std::isfinite(displacements[i]))
          throw InputError("Motion: point " + std::to_string(i + 1) + " of the table is not a finite number.");
        if (i > 0 && !(times[i] > times[i - 1]))
          throw InputError(describe_error("Motion: the times must increase.", "point " + std::to_string(i + 1),
                                          units::number(times[i]) + " s",
                                          "more than " + units::number(times[i - 1]) + " s"));
      }
  }

  std::size_t
  Motion::piece(const double time) const
  {
    // The first point later than the time ends the piece.
    const auto end = std::upper_bound(times.begin() + 1, times.end() - 1, time);
    return static_cast<std::size_t>(end - times.begin()) - 1;
  }

  double
  Motion::position(const double time) const
  {
    if (time <= times.front())
      return displacements.front();
    if (time >= times.back())
      return displacements.back();
    const std::size_t i      = piece(time);
    const double      weight = (time - times[i]) / (times[i + 1] - times[i]);
    return (1 - weight) * displacements[i] + weight * displacements[i + 1];
  }

  double
  Motion::velocity(const double time) const
  {
    if (time < times.front() || time >= times.back())
      return 0;
    const std::size_t i = piece(time);
    return (displacements[i + 1] - displacements[i]) / (times[i + 1] - times[i]);
  }
} // namespace tribodraw
