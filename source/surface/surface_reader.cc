#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    read_with_matching_reader(const std::string &content, const std::string &file)
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
            }
        }
      if (!best)
        throw InputError(describe_error(content.empty() ? "the surface file is empty."
                                                        : "the format of the surface file is unknown.",
                                        file, "", format_names(), "Save the surface in one of these formats."));
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

    void
    check_points(const RawSurface &raw, const std::string &file)
    {
      if (raw.nx < 2 || raw.ny < 2 || raw.z.size() / raw.nx != raw.ny || raw.z.size() % raw.nx != 0)
        throw InputError(describe_error("the surface file does not hold a map.", file,
                                        std::to_string(raw.nx) + " x " + std::to_string(raw.ny) + " points, "
                                            + std::to_string(raw.z.size()) + " heights",
                                        "at least 2 x 2 points"));
      if (std::all_of(raw.z.begin(), raw.z.end(), [](double z) { return std::isnan(z); }))
        throw InputError(describe_error("all points of the surface are missing.", file));
      const auto infinite = std::count_if(raw.z.begin(), raw.z.end(), [](double z) { return std::isinf(z); });
      if (infinite > 0)
        throw InputError(describe_error("heights of the surface are infinite.", file,
                                        std::to_string(infinite) + " of " + std::to_string(raw.z.size()), "none"));
    }

    /// Numbers in the wrong byte order or unit give heights that no topography has.
    void
    check_proportions(const HeightMap &map, const std::string &file)
    {
      double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
      for (const double z : map.z)
        if (!std::isnan(z))
          {
            lowest  = std::min(lowest, z);
            highest = std::max(highest, z);
          }
      const double range = highest - lowest, extent = std::max(map.nx * map.dx, map.ny * map.dy);
      if (!(range <= extent))
        throw InputError(describe_error("the heights span more than the surface is wide.", file,
                                        units::format(range, "um") + " on " + units::format(extent, "um"), "",
                                        "Check pixel size, height unit and byte order."));
      if (!(range > 0.))
        throw InputError(describe_error("all heights of the surface are equal.", file, "", "",
                                        "For a smooth surface choose `Model = smooth`."));
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
    const std::string name = file.string();
    RawSurface        raw  = read_with_matching_reader(read_file(file), name);
    check_points(raw, name);
    const auto   pixel_size  = settle_scale("Pixel size", name, raw.pixel_size, given.pixel_size);
    const double height_unit = settle_scale("Height unit", name, raw.height_unit, given.height_unit);

    HeightMap map;
    map.nx = raw.nx;
    map.ny = raw.ny;
    map.dx = pixel_size[0];
    map.dy = pixel_size[1];
    map.z  = std::move(raw.z);
    for (double &height : map.z)
      height *= height_unit;
    check_proportions(map, name);
    map.description = "file " + file.filename().string() + ", " + std::to_string(map.nx) + " x "
                      + std::to_string(map.ny) + " pixels of " + units::format(map.dx, "um")
                      + (map.dx == map.dy ? "" : " x " + units::format(map.dy, "um"));
    return map;
  }
} // namespace tribodraw
