#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_writer.h>

#include "number_bytes.h"

namespace tribodraw
{
  void
  write_npy(const HeightMap &map, const std::filesystem::path &file)
  {
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(map.ny) + ", "
                         + std::to_string(map.nx) + "), }";
    // The data begin at a multiple of 64 bytes; the header ends with a line end.
    constexpr std::size_t before = 10, alignment = 64;
    header.append(alignment - (before + header.size() + 1) % alignment, ' ');
    header += '\n';
    std::string content("\x93NUMPY\1\0", 8);
    content.reserve(before + header.size() + 8 * map.size());
    append_number(content, static_cast<std::uint16_t>(header.size()));
    content += header;
    const double um = units::factor("um");
    for (std::size_t row = 0; row < map.ny; ++row)
      for (std::size_t ix = 0; ix < map.nx; ++ix)
        append_number(content, map(ix, map.ny - 1 - row) / um);
    write_file(file, content);
  }
} // namespace tribodraw
