#ifndef tribodraw_surface_surface_writer_h
#define tribodraw_surface_surface_writer_h

#include <tribodraw/surface/height_map.h>

#include <filesystem>

namespace tribodraw
{
  /// Gwyddion Simple Field: heights as 32-bit floating point numbers in m, relative error 6e-8.
  void write_gsf(const HeightMap &map, const std::filesystem::path &file);

  /// Text matrix in um, with the size of the map in comment lines that the reader understands. Heights read back to
  /// the last bits. The first line is the row with the largest y, as one sees the surface from above.
  void write_ascii_matrix(const HeightMap &map, const std::filesystem::path &file);
} // namespace tribodraw

#endif
