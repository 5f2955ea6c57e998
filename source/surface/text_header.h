#ifndef tribodraw_source_surface_text_header_h
#define tribodraw_source_surface_text_header_h

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace tribodraw
{
  /// What the lines before and between the numbers of a text file say about the map: comments (`#`) and lines
  /// `key = value` or `key: value` in several dialects. Unknown keys are ignored.
  class TextHeader
  {
  public:
    /// Read one such line. Throws InputError if a known key has a bad value or is stated twice.
    void read(std::string_view line, const std::string &where);

    /// True if the line, without `#`, states a known key: files may begin so.
    static bool states_known_key(std::string_view line);
    /// True if the line states the size of a matrix, which a list of points does not have.
    static bool states_size_of_matrix(std::string_view line);

    /// Pixel size [mm] of a map of nx times ny points, if the header states it. Throws InputError where the header
    /// contradicts itself or the numbers counted.
    std::optional<std::array<double, 2>> pixel_size(std::size_t nx, std::size_t ny, const std::string &file) const;
    std::optional<double>                height_unit() const;
    /// Units of coordinates along x and y [mm], if both are stated.
    std::optional<std::array<double, 2>> coordinate_units() const;

    /// Units in the title line of a table of points, `X[um];Y[um];Z[nm]`. @return false if the line is none.
    bool read_point_titles(std::string_view line, const std::string &where);

  private:
    struct Length
    {
      double                value;
      std::optional<double> unit;
    };

    void set(std::string key, std::string_view value, const std::string &where);
    void set_length(std::optional<Length> &entry, std::string_view value, const std::string &where, bool needs_unit);

    std::array<std::optional<Length>, 2>      lengths;
    std::array<std::optional<double>, 2>      axis_units;
    std::array<std::optional<std::size_t>, 2> counts;
    std::optional<Length>                     pixel;
    std::optional<double>                     value_unit;
  };
} // namespace tribodraw

#endif
