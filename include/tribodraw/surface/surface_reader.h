#ifndef tribodraw_surface_surface_reader_h
#define tribodraw_surface_surface_reader_h

#include <tribodraw/surface/height_map.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Scales of a file as far as the parameter file states them: only for what the file itself does not say.
  struct GivenScales
  {
    std::optional<std::array<double, 2>> pixel_size;  ///< along x and y [mm]
    std::optional<double>                height_unit; ///< one unit of height in the file [mm]
  };

  /// What a file contains, before scales and missing points are judged.
  struct RawSurface
  {
    std::size_t         nx = 0, ny = 0;
    std::vector<double> z; ///< in the file's unit, z[iy * nx + ix], y upwards; NaN: point is missing

    std::optional<std::array<double, 2>> pixel_size;  ///< [mm], if the file states it
    std::optional<double>                height_unit; ///< [mm], if the file states it
  };

  /// A file format of surface topographies. A new format is one new file that registers itself; readers have no
  /// parameters of their own.
  class SurfaceReader
  {
  public:
    virtual ~SurfaceReader() = default;
    static const char *
    kind()
    {
      return "surface file format";
    }

    enum class Match
    {
      none,
      plausible, ///< could be read (text that looks like numbers)
      certain    ///< bears the format's mark
    };
    virtual Match recognises(const std::string &content) const = 0;
    /// @param file is named in messages. Throws InputError on any malformed content; memory is only taken after
    /// the sizes in the header were compared with the size of the content.
    virtual RawSurface read(const std::string &content, const std::string &file) const = 0;
  };

  /// Reads a file of any registered format, recognised by its content. Points that were not measured are NaN in the
  /// map. Throws InputError unless all others are finite and each scale is stated exactly once: by the file or in
  /// @p given.
  HeightMap read_surface_file(const std::filesystem::path &file, const GivenScales &given = {});

  /// Length of a unit in mm, or nothing if the text is not a unit of length. The micro sign is understood.
  std::optional<double> length_unit(std::string text);
} // namespace tribodraw

#endif
