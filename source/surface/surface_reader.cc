#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unistd.h>

#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    std::string
    format_names()
    {
      std::string names;
      for (const auto &[name, entry] : Registry<SurfaceReader>::entries())
        names += (names.empty() ? "" : ", ") + name;
      return names;
    }

    RawSurface
    read_with_matching_reader(std::string_view content, const std::string &file, std::string &format)
    {
      Parameters                     no_parameters = Parameters::from_text("");
      std::unique_ptr<SurfaceReader> best;
      auto                           best_match = SurfaceReader::Match::none;
      for (const auto &[name, entry] : Registry<SurfaceReader>::entries())
        {
          auto       reader = entry.create(no_parameters);
          const auto match  = reader->recognises(content);
          if (match > best_match)
            {
              best       = std::move(reader);
              best_match = match;
              format     = name;
            }
        }
      if (!best)
        throw InputError(describe_error(
            content.empty() ? "the surface file is empty." : "the format of the surface file is unknown.", file,
            content.empty() ? "" : "byte 0: `" + excerpt(content, 16) + "`", format_names(),
            "Save the surface in one of these formats; Gwyddion and MountainsMap export SDF or X3P."));
      return best->read(content, file);
    }

    template <class Scale>
    Scale
    settle_scale(const std::string &entry, const std::string &file, const std::optional<Scale> &of_file,
                 const std::optional<Scale> &given)
    {
      if (of_file && given)
        throw InputError(describe_error("`" + entry + "` is given although the surface file states it.", file, "",
                                        "one statement", "Remove `" + entry + "` from the subsection `File`."));
      if (!of_file && !given)
        throw InputError(
            describe_error("the surface file does not state the "
                               + std::string(entry == "Pixel size" ? "pixel size." : "unit of its heights."),
                           file, "", "", "Set `" + entry + "` in the subsection `File`."));
      return of_file ? *of_file : *given;
    }

    bool
    is_positive(double length)
    {
      return std::isfinite(length) && length > 0.;
    }

    void
    check_scales(const std::array<double, 2> &pixel_size, double height_unit, const std::string &file)
    {
      if (!is_positive(pixel_size[0]) || !is_positive(pixel_size[1]))
        throw InputError(
            describe_error("the pixel size is not positive and finite.", file,
                           units::format(pixel_size[0], "um") + " x " + units::format(pixel_size[1], "um")));
      if (const double ratio = pixel_size[0] / pixel_size[1]; !(ratio <= 1000. && ratio >= 1e-3))
        throw InputError(describe_error("a pixel is more than 1000 times as long as it is wide.", file,
                                        units::format(pixel_size[0], "um") + " x " + units::format(pixel_size[1], "um"),
                                        "", "Check the pixel size and its unit."));
      if (!is_positive(height_unit))
        throw InputError(describe_error("the unit of the heights is not positive and finite.", file,
                                        units::format(height_unit, "um")));
    }

    /// A pixel size given by the user must have the proportions of the coordinates in the file.
    void
    check_pitch(const std::array<double, 2> &pitch, const std::array<double, 2> &given, const std::string &file)
    {
      const double of_file = pitch[0] / pitch[1], of_user = given[0] / given[1];
      if (!(std::abs(of_file / of_user - 1.) <= 0.01))
        throw InputError(describe_error("`Pixel size` does not have the proportions of the coordinates in the file.",
                                        file, "x : y = " + units::number(of_user),
                                        units::number(of_file) + " within 1 %", "Give two values, along x and y."));
    }

    void
    check_counts(const RawSurface &raw, const std::string &file)
    {
      const std::string counts = std::to_string(raw.nx) + " x " + std::to_string(raw.ny) + " points";
      if (raw.nx < 2 || raw.ny < 2)
        throw InputError(
            describe_error("the surface file does not hold a map.", file, counts, "at least 2 x 2 points"));
      const double needed = 8. * static_cast<double>(raw.nx) * static_cast<double>(raw.ny);
      const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
      if (needed > memory)
        throw InputError(describe_error("the map is larger than the memory of this machine.", file,
                                        counts + ", " + units::number(std::round(needed / 1e9)) + " GB",
                                        units::number(std::round(memory / 1e9)) + " GB",
                                        "Resample or crop it in the measuring software."));
    }

    std::string
    name_of_point(const RawSurface &raw, const std::string &file, std::size_t ix, std::size_t iy)
    {
      return file + ", " + (raw.place ? raw.place(ix, iy) + ", " : "") + "column " + std::to_string(ix + 1) + ", row "
             + std::to_string(iy + 1) + " from the bottom";
    }

    /// Judge the heights without keeping them.
    void
    survey(const RawSurface &raw, double height_unit, double extent, const std::string &file)
    {
      std::size_t measured = 0;
      double      lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
      raw.heights([&](std::size_t ix, std::size_t iy, double z) {
        if (std::isnan(z))
          return;
        const double height = z * height_unit;
        if (!std::isfinite(height))
          throw InputError(describe_error("a height is not finite.", name_of_point(raw, file, ix, iy), units::number(z),
                                          "finite numbers"));
        ++measured;
        lowest  = std::min(lowest, height);
        highest = std::max(highest, height);
      });
      if (measured == 0)
        throw InputError(describe_error("all points of the surface are missing.", file));
      const double range = highest - lowest;
      if (!(range > 0.))
        throw InputError(describe_error("all heights of the surface are equal.", file, "", "",
                                        "For a smooth surface choose `Model = smooth`."));
      // Numbers in the wrong byte order or unit give heights that no topography has. The lower limit is far below the
      // size of an atom on any map that an instrument measures.
      if (!(range <= extent && range >= 1e-9 * extent))
        throw InputError(describe_error(range > extent
                                            ? "the heights span more than the surface is wide."
                                            : "the heights span less than a thousand-millionth of the width.",
                                        file, units::format(range, "um") + " on " + units::format(extent, "um"), "",
                                        "Check pixel size, height unit and byte order."));
    }

    std::string
    describe(const HeightMap &map, const std::filesystem::path &file, const std::string &format,
             const std::string &remark)
    {
      std::string text = "file " + file.filename().string() + " (" + format + (remark.empty() ? "" : ", " + remark)
                         + "), " + std::to_string(map.nx) + " x " + std::to_string(map.ny) + " pixels of "
                         + units::format(map.dx, "um");
      if (map.dx != map.dy)
        text += " x " + units::format(map.dy, "um");
      if (const std::size_t missing = n_missing(map); missing > 0)
        text += ", " + std::to_string(missing) + " points not measured";
      return text;
    }

    void
    replace_all(std::string &text, const std::string &old, const std::string &replacement)
    {
      for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + replacement.size()))
        text.replace(at, old.size(), replacement);
    }
  } // namespace

  std::optional<double>
  length_unit(std::string text)
  {
    text = std::string(trimmed(text));
    replace_all(text, "\xC2\xB5", "u"); // micro sign in UTF-8
    replace_all(text, "\xCE\xBC", "u"); // Greek mu in UTF-8
    replace_all(text, "\xB5", "u");     // micro sign in Latin-1
    const auto unit = units::parse_unit(text);
    if (!unit || unit->dimension != units::Dimension{ 1., 0., 0., 0. } || !(unit->factor > 0.))
      return {};
    return unit->factor;
  }

  HeightMap
  read_surface_file(const std::filesystem::path &file, const GivenScales &given)
  {
    const std::string name    = file.string();
    const std::string content = read_file(file);
    std::string       format;
    const RawSurface  raw = read_with_matching_reader(content, name, format);
    check_counts(raw, name);
    const auto   pixel_size  = settle_scale("Pixel size", name, raw.pixel_size, given.pixel_size);
    const double height_unit = settle_scale("Height unit", name, raw.height_unit, given.height_unit);
    check_scales(pixel_size, height_unit, name);
    if (raw.pitch && given.pixel_size)
      check_pitch(*raw.pitch, *given.pixel_size, name);

    HeightMap map;
    map.nx              = raw.nx;
    map.ny              = raw.ny;
    map.dx              = pixel_size[0];
    map.dy              = pixel_size[1];
    const double extent = std::max(static_cast<double>(map.nx) * map.dx, static_cast<double>(map.ny) * map.dy);
    survey(raw, height_unit, extent, name);

    map.z.assign(raw.nx * raw.ny, std::numeric_limits<double>::quiet_NaN());
    raw.heights([&](std::size_t ix, std::size_t iy, double z) { map.z[iy * map.nx + ix] = z * height_unit; });
    map.description = describe(map, file, format, raw.remark);
    if (!raw.warning.empty())
      log::warning(describe_error(raw.warning, name));
    return map;
  }
} // namespace tribodraw
