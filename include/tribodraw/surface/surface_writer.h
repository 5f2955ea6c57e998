#ifndef tribodraw_surface_surface_writer_h
#define tribodraw_surface_surface_writer_h

#include <tribodraw/surface/height_map.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Names of the formats that can be written: `csv`, `gsf`, `npy`, `sdf` (binary), `sdf ascii`.
  const std::vector<std::string> &surface_format_names();

  /// Write a map in the named format, or if @p format is empty in the one that the extension names (`.csv`, `.gsf`,
  /// `.npy`, `.sdf`). Points that were not measured (NaN) are marked as the format does. The file appears complete or
  /// not at all. Throws InputError for an unknown format, an empty map, and where the format cannot hold the map.
  void write_surface_file(const HeightMap &map, const std::filesystem::path &file, const std::string &format = "");

  /// Gwyddion Simple Field: heights as 32-bit floating point numbers in m, relative error 6e-8.
  void write_gsf(const HeightMap &map, const std::filesystem::path &file);

  /// Text matrix in um, with the size of the map in comment lines that the reader understands. Heights read back to
  /// the last bits. The first line is the row with the largest y, as one sees the surface from above.
  void write_ascii_matrix(const HeightMap &map, const std::filesystem::path &file);

  /// NumPy array of 64-bit floating point numbers in um, first row at the largest y. The format has no place for pixel
  /// size and unit.
  void write_npy(const HeightMap &map, const std::filesystem::path &file);

  /// SDF (ISO 25178-71) version 1.0, or 2.0 if a count exceeds 65535, with 64-bit floating point numbers. Heights read
  /// back to the last bit.
  void write_sdf_binary(const HeightMap &map, const std::filesystem::path &file);
  /// SDF version 1.0 as text, shortest decimal numbers. Heights read back to the last bit.
  void write_sdf_text(const HeightMap &map, const std::filesystem::path &file);
} // namespace tribodraw

#endif
