#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/form.h>
#include <tribodraw/surface/gaussian_filter.h>
#include <tribodraw/surface/map_operations.h>
#include <tribodraw/surface/missing_points.h>
#include <tribodraw/surface/processing.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribodraw
{
  namespace
  {
    using Heights = Eigen::Map<Eigen::ArrayXd>;

    Heights
    heights(HeightMap &map)
    {
      return { map.z.data(), static_cast<Eigen::Index>(map.z.size()) };
    }

    std::string
    short_number(double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", value);
      return text;
    }

    std::string
    short_length(double mm)
    {
      return mm < 0.1 ? short_number(1e3 * mm) + " um" : short_number(mm) + " mm";
    }

    std::string
    percent(std::size_t part, std::size_t whole)
    {
      return short_number(100. * static_cast<double>(part) / static_cast<double>(whole)) + " %";
    }

    void
    check_nesting_index(const HeightMap &map, const std::string &entry, double index)
    {
      const double pixel  = std::max(map.dx, map.dy),
                   length = std::min(static_cast<double>(map.nx) * map.dx, static_cast<double>(map.ny) * map.dy);
      if (index < pixel)
        throw InputError(describe_error("the " + entry + " has no effect: its nesting index is below the pixel size.",
                                        map.description, units::format(index, "um"),
                                        "at least " + units::format(pixel, "um")));
      if (index > length)
        throw InputError(describe_error("the " + entry + " is longer than the map.", map.description,
                                        units::format(index, "mm"), "at most " + units::format(length, "mm")));
    }
  } // namespace

  Processing::Processing(Parameters &parameters, bool measured)
  {
    const auto scope = parameters.section("Processing");
    read_orientation(parameters);
    read_missing_points(parameters);
    form = parameters.choice(
        "Form", form_names(),
        "What is subtracted from the heights by least squares: nothing (the mean must be zero), the mean, a plane, a "
        "polynomial of second order, a cylinder (die radius, rod) or a sphere. If absent: a plane for measured maps, "
        "nothing for generated ones.",
        Default{ measured ? "plane" : "none", measured ? "a measured map is tilted as it lay under the instrument"
                                                       : "the map is level by construction" });
    read_filters(parameters);
    read_grid(parameters);
  }

  void
  Processing::read_orientation(Parameters &parameters)
  {
    const Default no{ "false", "the map is used as it is" };
    mirror_x = parameters.flag("Flip x", "Mirror the map along x.", no);
    mirror_y = parameters.flag("Flip y", "Mirror the map along y.", no);
    inverted = parameters.flag(
        "Invert heights", "Change the sign of the heights: for depths, and for a replica (which is mirrored too).", no);
    turned
        = parameters.choice("Rolling direction", { "x", "y" },
                            "Axis of the file along which the sheet was rolled (for a tool: which slides along the "
                            "rolling direction of the sheet). With `y` the map is turned by -90 degrees, so that x is "
                            "the rolling direction in all results.",
                            Default{ "x", "the convention of the program" })
          == "y";
  }

  void
  Processing::read_missing_points(Parameters &parameters)
  {
    if (parameters.has("Outlier threshold"))
      outlier_threshold = parameters.quantity(
          "Outlier threshold", "", Range::positive().usual(2., 100.),
          "A point is an outlier, and then treated as missing, if its distance from the median of its neighbourhood "
          "exceeds this multiple of the robust spread of these distances over the map. If absent, no point is "
          "removed.");
    if (parameters.has("Outlier threshold") || parameters.has("Outlier window"))
      outlier_window = static_cast<unsigned>(parameters.integer(
          "Outlier window", Range::between(3, 31), "Edge of the square neighbourhood in pixels, an odd number.",
          Default{ "5", "a spike of one or two pixels stays in the minority" }));
    if (outlier_window % 2 == 0 && !parameters.documentation_mode())
      parameters.problem("Outlier window", "the window has no central pixel.", "an odd number");
    if (parameters.has("Outlier window") && !parameters.has("Outlier threshold") && !parameters.documentation_mode())
      parameters.problem("Outlier window", "has no effect without `Outlier threshold`.");
    largest_missing = parameters.quantity(
        "Maximum missing fraction", "", Range::between(0., 0.5),
        "Missing points (not measured, or outliers) are filled harmonically from their "
        "surroundings as long as they are at most this share of the map; otherwise the map is refused.",
        Default{ "0.05", "above, the filled area would visibly change heights and flow" });
  }

  void
  Processing::read_filters(Parameters &parameters)
  {
    if (parameters.has("S-filter"))
      s_filter = parameters.quantity("S-filter", "um", Range::positive().usual(0.1, 1000.),
                                     "Nesting index of the Gaussian S-filter of ISO 16610-61, which removes what is "
                                     "shorter. If absent, no such filter is applied.");
    if (parameters.has("L-filter"))
      l_filter = parameters.quantity("L-filter", "mm", Range::positive().usual(0.01, 25.),
                                     "Nesting index of the Gaussian L-filter of ISO 16610-61, which removes what is "
                                     "longer. If absent, no such filter is applied.");
    if (s_filter && l_filter && *s_filter >= *l_filter && !parameters.documentation_mode())
      parameters.problem("S-filter", "nothing is left between S-filter and L-filter.", "below the L-filter");
  }

  void
  Processing::read_grid(Parameters &parameters)
  {
    if (parameters.has("Crop"))
      {
        const auto limits
            = parameters.quantity_list("Crop", "mm", Range::non_negative(),
                                       "Window to keep: x from, x to, y from, y to, from the lower left corner, after "
                                       "the filters (whose values near "
                                       "the border rest on fewer points). If absent, the whole map is kept.");
        if (limits.size() == 4)
          window = { limits[0], limits[1], limits[2], limits[3] };
        else if (!parameters.documentation_mode() && !limits.empty())
          parameters.problem("Crop", std::to_string(limits.size()) + " values are given.",
                             "four: x from, x to, y from, y to");
        if (window && !((*window)[0] < (*window)[1] && (*window)[2] < (*window)[3]) && !parameters.documentation_mode())
          parameters.problem("Crop", "the window is empty.", "from < to for x and y");
      }
    if (parameters.has("Resample to"))
      {
        const auto sizes = parameters.quantity_list("Resample to", "um", Range::positive().usual(0.05, 50.),
                                                    "New pixel size, one value or two (along x and y). Coarser pixels "
                                                    "take the mean over their area, finer ones "
                                                    "are interpolated cubically. If absent, the pixels stay.");
        if (sizes.size() > 2 && !parameters.documentation_mode())
          parameters.problem("Resample to", std::to_string(sizes.size()) + " values are given.",
                             "one value, or two (x, y)");
        if (!sizes.empty())
          pixel_size = { sizes[0], sizes.size() > 1 ? sizes[1] : sizes[0] };
      }
  }

  void
  Processing::orient(HeightMap &map) const
  {
    if (mirror_x)
      {
        flip_x(map);
        map.description += "; mirrored along x";
      }
    if (mirror_y)
      {
        flip_y(map);
        map.description += "; mirrored along y";
      }
    if (inverted)
      {
        invert_heights(map);
        map.description += "; heights inverted";
      }
    if (turned)
      {
        turn_y_to_x(map);
        map.description += "; turned by -90 deg (rolling direction was y)";
      }
  }

  void
  Processing::clean(HeightMap &map) const
  {
    if (outlier_threshold)
      {
        const OutlierReport report = mark_outliers(map, *outlier_threshold, outlier_window);
        map.description += "; " + std::to_string(report.found) + " outliers (" + percent(report.found, map.size())
                           + ") beyond " + short_number(*outlier_threshold) + " x " + short_number(1e3 * report.spread)
                           + " um from the median of " + std::to_string(outlier_window) + " x "
                           + std::to_string(outlier_window) + " pixels";
      }
    const std::size_t filled = fill_missing(map, largest_missing);
    if (filled > 0)
      map.description += "; " + std::to_string(filled) + " missing points (" + percent(filled, map.size())
                         + ") filled harmonically";
  }

  void
  Processing::filter(HeightMap &map) const
  {
    if (s_filter)
      {
        check_nesting_index(map, "S-filter", *s_filter);
        gaussian_low_pass(map, *s_filter);
        map.description += "; Gaussian S-filter " + short_length(*s_filter);
      }
    if (l_filter)
      {
        check_nesting_index(map, "L-filter", *l_filter);
        HeightMap waviness = map;
        gaussian_low_pass(waviness, *l_filter);
        heights(map) -= heights(waviness);
        map.description += "; Gaussian L-filter " + short_length(*l_filter);
      }
  }

  void
  Processing::apply(HeightMap &map) const
  {
    if (map.size() == 0)
      return;
    const timing::Scope scope("surface/process");
    check_memory(static_cast<double>(map.nx), static_cast<double>(map.ny), map.description);
    orient(map);
    clean(map);
    remove_form(map, form);
    filter(map);
    if (window)
      {
        crop(map, *window);
        map.description += "; cropped to " + std::to_string(map.nx) + " x " + std::to_string(map.ny) + " pixels";
      }
    if (pixel_size)
      {
        resample(map, *pixel_size);
        map.description += "; resampled to " + std::to_string(map.nx) + " x " + std::to_string(map.ny) + " pixels of "
                           + short_length(map.dx) + " x " + short_length(map.dy);
      }
    if (s_filter || l_filter || window || pixel_size)
      {
        heights(map) -= heights(map).mean();
        map.description += "; mean subtracted";
      }
  }
} // namespace tribodraw
