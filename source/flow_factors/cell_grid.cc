#include <tribodraw/base/errors.h>
#include <tribodraw/flow_factors/cell_grid.h>

#include <limits>

namespace tribodraw
{
  namespace
  {
    void
    check_size(const CellGrid &grid)
    {
      if (grid.nx < 3 || grid.ny < 3 || grid.size() > std::size_t(std::numeric_limits<int>::max() - 1))
        throw InputError(describe_error("The height map cannot be used for flow factors", "local Reynolds cell",
                                        std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " pixels",
                                        "at least 3 x 3 and fewer than 2^31 pixels"));
      if (!(grid.dx > 0 && grid.dy > 0))
        throw InputError(describe_error("The height map has no pixel size", "local Reynolds cell"));
    }
  } // namespace

  CellGrid
  make_cell_grid(const std::size_t nx, const std::size_t ny, const double dx, const double dy, const bool periodic)
  {
    CellGrid grid;
    grid.nx       = nx;
    grid.ny       = ny;
    grid.dx       = dx;
    grid.dy       = dy;
    grid.periodic = periodic;
    check_size(grid);
    if (periodic)
      return grid;
    for (int iy = 0; iy < static_cast<int>(ny); ++iy)
      {
        grid.lower_boundary[0].push_back(iy * static_cast<int>(nx));
        grid.upper_boundary[0].push_back((iy + 1) * static_cast<int>(nx) - 1);
      }
    for (int ix = 0; ix < static_cast<int>(nx); ++ix)
      {
        grid.lower_boundary[1].push_back(ix);
        grid.upper_boundary[1].push_back(static_cast<int>(ny - 1) * static_cast<int>(nx) + ix);
      }
    return grid;
  }
} // namespace tribodraw
