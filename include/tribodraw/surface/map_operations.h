#ifndef tribodraw_surface_map_operations_h
#define tribodraw_surface_map_operations_h

#include <tribodraw/surface/height_map.h>

#include <array>
#include <string>

namespace tribodraw
{
  /// Mirror the map: the point at x (y) moves to the same distance from the other side.
  void flip_x(HeightMap &map);
  void flip_y(HeightMap &map);
  /// Hills become valleys, as between a surface and its replica (which is also mirrored).
  void invert_heights(HeightMap &map);
  /// Turn the map by -90 degrees: what ran along y runs along x, what ran along x runs along -y.
  void turn_y_to_x(HeightMap &map);

  /// Keep the pixels whose centres lie in the window {x_min, x_max, y_min, y_max} [mm], measured from the lower left
  /// corner of the map. Throws InputError if the window is not within the map or keeps less than 2 x 2 pixels.
  void crop(HeightMap &map, const std::array<double, 4> &window);

  /// Give the map another pixel size [mm]. To coarser pixels: the mean over the area of each new pixel, which keeps the
  /// mean height. To finer ones: cubic convolution (R. Keys, IEEE Trans. Acoust. Speech Signal Process. 29 (1981)
  /// 1153-1160), which reproduces polynomials of second order away from the border; values at an open border are
  /// continued linearly. A periodic map keeps its size exactly, the pixel size is then the one nearest to the wanted
  /// one; of an open map less than one pixel is lost, half of it at either side. Missing points must have been filled.
  /// Throws InputError if fewer than 2 or more than 16384 pixels along an axis, or more than fit in the memory, result.
  void resample(HeightMap &map, const std::array<double, 2> &pixel_size);

  /// Throws InputError if work on a map of that many pixels (48 bytes each: heights, copies and transforms) would need
  /// more than the physical memory of the machine.
  void check_memory(double nx, double ny, const std::string &where);
  /// The same as a sentence; empty if there is enough.
  std::string memory_problem(double nx, double ny);
} // namespace tribodraw

#endif
