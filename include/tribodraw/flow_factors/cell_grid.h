#ifndef tribodraw_flow_factors_cell_grid_h
#define tribodraw_flow_factors_cell_grid_h

#include <array>
#include <cstddef>
#include <vector>

namespace tribodraw
{
  /// The finite-volume mesh of a height map: one cell per pixel, numbered like HeightMap::z, iy * nx + ix. These are the
  /// cells of deal.II's subdivided_hyper_rectangle and the degrees of freedom of FE_DGQ(0) on it; the neighbour
  /// relation follows from the numbers, so that no mesh needs to be kept (some hundred bytes a cell). A test compares the
  /// solution with that of the system assembled on the deal.II mesh.
  struct CellGrid
  {
    std::size_t nx = 0, ny = 0;
    double      dx = 0, dy = 0; ///< [mm]
    bool        periodic = false;
    /// Cells at the lower and at the upper boundary of each axis; empty on a periodic grid.
    std::array<std::vector<int>, 2> lower_boundary, upper_boundary;
    std::size_t
    size() const
    {
      return nx * ny;
    }
    std::size_t
    n(int axis) const
    {
      return axis == 0 ? nx : ny;
    }
    /// Pixel size along @p axis [mm].
    double
    spacing(int axis) const
    {
      return axis == 0 ? dx : dy;
    }
    double
    area() const
    {
      return size() * dx * dy;
    }
    /// Position of a cell along @p axis, counted in pixels.
    std::size_t
    coordinate(int cell, int axis) const
    {
      return axis == 0 ? cell % nx : cell / nx;
    }
  };

  /// Throws InputError for fewer than 3 x 3 pixels, 2^31 - 1 pixels or more, or no pixel size.
  CellGrid make_cell_grid(std::size_t nx, std::size_t ny, double dx, double dy, bool periodic);
} // namespace tribodraw

#endif
