#ifndef tribodraw_surface_surface_reader_h
#define tribodraw_surface_surface_reader_h

#include <tribodraw/surface/height_map.h>

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace tribodraw
{
  /// Scales of a file as far as the parameter file states them: only for what the file itself does not say.
  struct GivenScales
  {
    std::optional<std::array<double, 2>> pixel_size;  ///< along x and y [mm]
    std::optional<double>                height_unit; ///< one unit of height in the file [mm]
  };

  /// Takes one height: column, row counted upwards, value in the file's unit (NaN: the point was not measured).
  using HeightSink = std::function<void(std::size_t ix, std::size_t iy, double z)>;

  /// What a file says before scales, heights and missing points are judged.
  struct RawSurface
  {
    std::size_t nx = 0, ny = 0;

    std::optional<std::array<double, 2>> pixel_size;  ///< [mm], if the file states it
    std::optional<double>                height_unit; ///< [mm], if the file states it
    /// Distance of neighbouring points along x and y in a unit that the file does not state.
    std::optional<std::array<double, 2>> pitch;

    /// Goes through all heights of the file and hands each to the sink; points that are not handed over were not
    /// measured. It may be called several times and needs little memory, so that a file can be judged before memory
    /// for its map is taken. Throws InputError on malformed data. Valid as long as the content is.
    std::function<void(const HeightSink &)> heights;
    /// Where the height of a point stands in the file, such as `byte 123`, for messages; may be empty.
    std::function<std::string(std::size_t ix, std::size_t iy)> place;
    /// What the file tells of itself (instrument, title, date) in one line, for the provenance.
    std::string remark;
    /// What the user should know, such as layers that are left out.
    std::string warning;
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
      likely,    ///< more so than a merely plausible one
      certain    ///< bears the format's mark
    };
    virtual Match recognises(std::string_view content) const = 0;
    /// @param content must outlive the result.
    /// @param file is named in messages. Throws InputError on any malformed header; memory is only taken after
    /// the sizes in the header were compared with the size of the content.
    virtual RawSurface read(std::string_view content, const std::string &file) const = 0;
  };

  /// Reads a file of any registered format, recognised by its content. Points that were not measured are NaN in the
  /// map. Throws InputError unless all others are finite and each scale is stated exactly once: by the file or in
  /// @p given. The file is gone through twice: it is judged first, and only then memory for the map is taken.
  HeightMap read_surface_file(const std::filesystem::path &file, const GivenScales &given = {});

  /// Length of a unit in mm, or nothing if the text is not a unit of length. The micro sign is understood.
  std::optional<double> length_unit(std::string text);
} // namespace tribodraw

#endif
