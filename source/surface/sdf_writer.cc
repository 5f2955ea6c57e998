#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_writer.h>

#include <cmath>
#include <limits>

#include "number_bytes.h"

namespace tribodraw
{
  namespace
  {
    // The heights are stored in mm with this scale, so that they read back to the last bit.
    constexpr double z_scale = 1e-3;
    // A valid date (DDMMYYYYHHMM) and always the same: files carry no time stamps.
    const std::string date = "010120000000", manufacturer = "tribodraw ";

    /// Lengths of a file are in m.
    double
    in_metres(double length)
    {
      return length / units::factor("m");
    }
  } // namespace

  void
  write_sdf_binary(const HeightMap &map, const std::filesystem::path &file)
  {
    // Counts of version 1.0 have 16 bits.
    const bool  wide    = map.nx > 65535 || map.ny > 65535;
    std::string content = (wide ? "bISO-2.0" : "bISO-1.0") + manufacturer + date + date;
    content.reserve(85 + 8 * map.size());
    for (const std::size_t n : { map.nx, map.ny })
      if (wide)
        append_number(content, static_cast<std::uint32_t>(n));
      else
        append_number(content, static_cast<std::uint16_t>(n));
    for (const double scale : { in_metres(map.dx), in_metres(map.dy), z_scale, -1. }) // resolution unknown: -1
      append_number(content, scale);
    content += std::string("\0\7\0", 3); // not compressed, 64-bit floating point numbers, no check sum
    for (const double z : map.z)
      append_number(content, std::isnan(z) ? std::numeric_limits<double>::lowest() : z);
    write_file(file, content);
  }

  void
  write_sdf_text(const HeightMap &map, const std::filesystem::path &file)
  {
    const std::string end     = "\r\n";
    std::string       content = "aISO-1.0" + end + "ManufacID   = " + manufacturer + end + "CreateDate  = " + date + end
                          + "ModDate     = " + date + end + "NumPoints   = " + std::to_string(map.nx) + end
                          + "NumProfiles = " + std::to_string(map.ny) + end;
    const auto add = [&](const char *name, double value) {
      content += name;
      append_text(content, value);
      content += end;
    };
    add("Xscale      = ", in_metres(map.dx));
    add("Yscale      = ", in_metres(map.dy));
    add("Zscale      = ", z_scale);
    content += "Zresolution = -1" + end + "Compression = 0" + end + "DataType    = 7" + end + "CheckType   = 0" + end
               + "*" + end;
    for (std::size_t iy = 0; iy < map.ny; ++iy)
      for (std::size_t ix = 0; ix < map.nx; ++ix)
        {
          if (std::isnan(map(ix, iy)))
            content += "BAD";
          else
            append_text(content, map(ix, iy));
          content += ix + 1 < map.nx ? std::string(" ") : end;
        }
    content += "*" + end;
    write_file(file, content);
  }
} // namespace tribodraw
