#include <tribodraw/base/parallel.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/gaussian_filter.h>
#include <tribodraw/surface/profile_parameters.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace tribodraw
{
  namespace
  {
    std::string
    short_number(double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", value);
      return text;
    }

    /// The profiles of a map in one direction.
    struct Profiles
    {
      const HeightMap &map;
      bool             along_x;

      std::size_t
      count() const
      {
        return along_x ? map.ny : map.nx;
      }
      std::size_t
      points() const
      {
        return along_x ? map.nx : map.ny;
      }
      double
      step() const
      {
        return along_x ? map.dx : map.dy;
      }
      double
      length() const
      {
        return static_cast<double>(points()) * step();
      }
      void
      get(std::size_t profile, std::vector<double> &values) const
      {
        for (std::size_t i = 0; i < points(); ++i)
          values[i] = along_x ? map(i, profile) : map(profile, i);
      }
      /// Points at either end that are not evaluated.
      std::size_t
      run_in(double length) const
      {
        return map.periodic ? 0 : static_cast<std::size_t>(std::ceil(length / step() - 1e-9));
      }
      /// Why there are less than @p needed mm between the run-ins, or nothing.
      std::optional<std::string>
      too_short(double needed, double run_in_length) const
      {
        const double total = needed + (map.periodic ? 0. : 2. * run_in_length);
        if (length() >= total * (1. - 1e-9))
          return {};
        return "needs profiles of " + short_number(total) + " mm, the map has " + short_number(length()) + " mm along "
               + (along_x ? "x" : "y");
      }
    };

    struct Sums
    {
      double absolute = 0, points = 0, peaks = 0;
    };

    /// Peaks between two levels at +-height; a periodic profile is counted around, an open one from its first point.
    std::size_t
    count_peaks(const std::vector<double> &r, std::size_t begin, std::size_t end, double height, bool periodic)
    {
      bool was_low = false;
      if (periodic) // the state at the end of the profile is that before its beginning
        for (std::size_t i = end; i-- > begin;)
          if (std::abs(r[i]) > height)
            {
              was_low = r[i] < 0.;
              break;
            }
      std::size_t peaks = 0;
      for (std::size_t i = begin; i < end; ++i)
        if (r[i] < -height)
          was_low = true;
        else if (r[i] > height && was_low)
          {
            ++peaks;
            was_low = false;
          }
      return peaks;
    }

    /// Evaluate the band between two cut-offs (short = 0: no lower one) over all profiles.
    Sums
    evaluate(const Profiles &profiles, double short_cut_off, double long_cut_off, std::size_t run_in,
             double peak_height)
    {
      const std::size_t n = profiles.points(), count = profiles.count();
      std::vector<Sums> sums(count); // added in a fixed order, whatever the number of threads
      const bool        periodic = profiles.map.periodic;
      parallel::for_range((count + 1) / 2, 8, [&](std::size_t begin, std::size_t end) {
        LineFilter long_filter(n, long_cut_off / profiles.step(), periodic),
            short_filter(n, std::max(short_cut_off / profiles.step(), 1.), periodic);
        std::vector<double> band[2], mean_line[2];
        for (auto *lines : { band, mean_line })
          for (int i = 0; i < 2; ++i)
            lines[i].resize(n);
        for (std::size_t pair = begin; pair < end; ++pair)
          {
            for (std::size_t i = 0; i < 2; ++i)
              profiles.get(std::min(2 * pair + i, count - 1), band[i]);
            if (short_cut_off > 0.)
              short_filter.apply(band[0].data(), band[1].data());
            for (std::size_t i = 0; i < 2; ++i)
              mean_line[i] = band[i];
            long_filter.apply(mean_line[0].data(), mean_line[1].data());
            for (std::size_t i = 0; i < 2 && 2 * pair + i < count; ++i)
              {
                Sums &s = sums[2 * pair + i];
                for (std::size_t k = 0; k < n; ++k)
                  band[i][k] -= mean_line[i][k];
                for (std::size_t k = run_in; k < n - run_in; ++k)
                  s.absolute += std::abs(band[i][k]);
                s.points = static_cast<double>(n - 2 * run_in);
                s.peaks  = static_cast<double>(count_peaks(band[i], run_in, n - run_in, peak_height, periodic));
              }
          }
      });
      Sums total;
      for (const Sums &s : sums)
        {
          total.absolute += s.absolute;
          total.points += s.points;
          total.peaks += s.peaks;
        }
      return total;
    }
  } // namespace

  double
  short_wave_cut_off(double cut_off)
  {
    const double um = units::factor("um"), slack = 1. + 1e-9;
    return (cut_off <= 0.8 * slack ? 2.5 : cut_off <= 2.5 * slack ? 8. : 25.) * um;
  }

  ProfileParameters
  profile_parameters(const HeightMap &map, const ProfileSettings &settings)
  {
    ProfileParameters result;
    const Profiles    profiles{ map, settings.along_x };
    result.no_roughness = profiles.too_short(5. * settings.cut_off, 0.5 * settings.cut_off);
    if (!result.no_roughness && settings.cut_off < 3. * profiles.step())
      result.no_roughness = "the cut-off " + short_number(1e3 * settings.cut_off) + " um is below three pixels";
    if (!result.no_roughness)
      {
        const double short_wave = short_wave_cut_off(settings.cut_off);
        result.noise_cut_off    = short_wave >= profiles.step() ? short_wave : 0.;
        const Sums sums         = evaluate(profiles, result.noise_cut_off, settings.cut_off,
                                           profiles.run_in(0.5 * settings.cut_off), settings.peak_height);
        result.ra               = sums.absolute / sums.points;
        result.rpc              = sums.peaks / (sums.points * profiles.step());
      }
    constexpr double shortest = 1., longest = 5.; // mm, the band that gives Wsa(1-5) its name
    result.no_waviness = profiles.too_short(5. * longest, 0.5 * longest);
    if (!result.no_waviness && profiles.step() > shortest / 3.)
      result.no_waviness = "the pixels are above a third of the shortest waves";
    if (!result.no_waviness)
      {
        const Sums sums = evaluate(profiles, shortest, longest, profiles.run_in(0.5 * longest), INFINITY);
        result.wsa      = sums.absolute / sums.points;
      }
    return result;
  }
} // namespace tribodraw
