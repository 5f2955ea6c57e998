#include "regular_axis.h"

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    constexpr double tolerance = 0.01; // of a pitch
    // More columns than any instrument gives, so that hostile lists take little memory.
    constexpr std::size_t most_values = 1u << 18;

    /// Axis through ascending values, gaps of several pitches allowed; nothing if one is off it.
    std::optional<RegularAxis>
    fit(const std::vector<double> &values)
    {
      if (values.size() < 2)
        return {};
      double pitch = values.back() - values.front();
      for (std::size_t i = 1; i < values.size(); ++i)
        pitch = std::min(pitch, values[i] - values[i - 1]);
      // The smallest gap is rounded as the numbers are: walk along and refine it with the length walked.
      double steps = 0;
      for (std::size_t i = 1; i < values.size(); ++i)
        {
          steps += std::max(1., std::round((values[i] - values[i - 1]) / pitch));
          pitch = (values[i] - values.front()) / steps;
        }
      if (!(pitch > 0.) || !(steps < 1e9))
        return {};
      const RegularAxis axis{ values.front(), pitch, static_cast<std::size_t>(steps) + 1 };
      for (const double value : values)
        if (!(axis.deviation(value) <= tolerance))
          return {};
      return axis;
    }

    /// One value for each group of values that lie close together, if the gaps between neighbours fall into small and
    /// large ones.
    std::vector<double>
    centres_of_groups(const std::vector<double> &values)
    {
      std::vector<double> gaps;
      for (std::size_t i = 1; i < values.size(); ++i)
        gaps.push_back(values[i] - values[i - 1]);
      std::sort(gaps.begin(), gaps.end());
      double      largest_ratio = 10.; // within a group at most 2 % of a pitch, so 49 and more to the next
      std::size_t first_large   = 0;
      for (std::size_t i = 1; i < gaps.size(); ++i)
        if (gaps[i] > largest_ratio * gaps[i - 1])
          {
            largest_ratio = gaps[i] / gaps[i - 1];
            first_large   = i;
          }
      if (first_large == 0)
        return values;
      std::vector<double> centres;
      for (std::size_t begin = 0, end; begin < values.size(); begin = end)
        {
          for (end = begin + 1; end < values.size() && values[end] - values[end - 1] < gaps[first_large];)
            ++end;
          centres.push_back(0.5 * (values[begin] + values[end - 1]));
        }
      return centres;
    }
  } // namespace

  std::size_t
  RegularAxis::index(double coordinate) const
  {
    const double i = std::round((coordinate - first) / pitch);
    return static_cast<std::size_t>(std::clamp(i, 0., static_cast<double>(n - 1)));
  }

  double
  RegularAxis::deviation(double coordinate) const
  {
    return std::abs((coordinate - first) / pitch - static_cast<double>(index(coordinate)));
  }

  void
  AxisFinder::add(double coordinate)
  {
    // Points come row by row or column by column: most repeat the one before.
    if (too_many || (!values.empty() && !sorted && values.back() == coordinate))
      return;
    values.push_back(coordinate);
    sorted = false;
    if (values.size() >= 2 * most_values)
      {
        compact();
        too_many = values.size() > most_values;
      }
  }

  void
  AxisFinder::compact()
  {
    if (sorted || values.empty())
      return;
    std::sort(values.begin(), values.end());
    const double smallest = 1e-8 * (values.back() - values.front());
    values.erase(
        std::unique(values.begin(), values.end(), [smallest](double a, double b) { return b - a <= smallest; }),
        values.end());
    sorted = true;
  }

  std::size_t
  AxisFinder::n_different()
  {
    compact();
    return values.size();
  }

  std::optional<RegularAxis>
  AxisFinder::find()
  {
    compact();
    if (too_many)
      return {};
    if (const auto axis = fit(values))
      return axis;
    const auto axis = fit(centres_of_groups(values));
    if (!axis)
      return {};
    for (const double value : values)
      if (!(axis->deviation(value) <= tolerance))
        return {};
    return axis;
  }
} // namespace tribodraw
