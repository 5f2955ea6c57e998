#ifndef tribodraw_surface_processing_h
#define tribodraw_surface_processing_h

#include <tribodraw/surface/height_map.h>

#include <array>
#include <optional>
#include <string>

namespace tribodraw
{
  class Parameters;

  /// What is done to a map after it was read or generated, always in this order: orientation (mirror, sign of the
  /// heights, rolling direction), outliers, filling, form, S-filter, L-filter, crop, resample, zero mean. Each step
  /// that is not asked for is left out. Everything applied is appended to the description of the map, with its numbers.
  class Processing
  {
  public:
    /// Reads the subsection `Processing`. @p measured: the map comes from a file, whose heights contain offset and
    /// tilt; the form is then a plane unless stated otherwise.
    Processing(Parameters &parameters, bool measured);

    /// Throws InputError where a step does not suit the map: all points missing, filter longer than the map or shorter
    /// than a pixel, window outside, result too large.
    void apply(HeightMap &map) const;

  private:
    void read_orientation(Parameters &parameters);
    void read_missing_points(Parameters &parameters);
    void read_filters(Parameters &parameters);
    void read_grid(Parameters &parameters);

    void orient(HeightMap &map) const;
    void clean(HeightMap &map) const;
    void filter(HeightMap &map) const;

    bool                                 mirror_x = false, mirror_y = false, inverted = false, turned = false;
    std::optional<double>                outlier_threshold;
    unsigned                             outlier_window  = 5;
    double                               largest_missing = 0;
    std::string                          form            = "none";
    std::optional<double>                s_filter, l_filter;
    std::optional<std::array<double, 4>> window;
    std::optional<std::array<double, 2>> pixel_size;
  };
} // namespace tribodraw

#endif
