#ifndef tribodraw_flow_factors_cell_grid_h
#define tribodraw_flow_factors_cell_grid_h

#include <array>
#include <cstddef>
#include <vector>

namespace tribodraw
{
  /// Cells and faces of the finite-volume mesh of a height map: what a local Reynolds cell needs to know of
  /// deal.II's Triangulation<2> and DoFHandler with FE_DGQ(0). It is extracted once per map; a separation only changes
  /// the coefficients of the faces. One cell is one pixel; cells are numbered like HeightMap::z, iy * nx + ix.
  struct CellGrid
  {
    /// Face between two cells; `upper` lies beyond the face in positive direction of the axis. On a periodic grid
    /// the faces at the end lead back to the beginning, and there upper < lower.
    struct Face
    {
      int lower, upper;
    };

    std::size_t nx = 0, ny = 0;
    double      dx = 0, dy = 0; ///< [mm]
    bool        periodic = false;
    /// Inner faces, by the axis of their normal.
    std::array<std::vector<Face>, 2> faces;
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

  /// Make the mesh with deal.II and take its neighbour relation. Throws InputError for fewer than 3 x 3 pixels,
  /// or more than 2^31 - 1.
  CellGrid make_cell_grid(std::size_t nx, std::size_t ny, double dx, double dy, bool periodic);
} // namespace tribodraw

#endif
