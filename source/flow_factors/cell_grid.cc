#include <tribodraw/base/errors.h>
#include <tribodraw/flow_factors/cell_grid.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <cmath>
#include <limits>

namespace tribodraw
{
  namespace
  {
    using Cell = dealii::DoFHandler<2>::active_cell_iterator;

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

    // Rectangle with one mesh cell per pixel. Boundary ids: 0, 1 lower and upper end in x; 2, 3 in y. Lengths are in
    // pixels: only the neighbour relation is taken from the mesh, and whole numbers make the cell centres exact.
    void
    make_mesh(const CellGrid &grid, dealii::Triangulation<2> &mesh)
    {
      const std::vector<unsigned> pixels{ static_cast<unsigned>(grid.nx), static_cast<unsigned>(grid.ny) };
      dealii::GridGenerator::subdivided_hyper_rectangle(mesh, pixels, dealii::Point<2>(0, 0),
                                                        dealii::Point<2>(double(grid.nx), double(grid.ny)), true);
      if (!grid.periodic)
        return;
      std::vector<dealii::GridTools::PeriodicFacePair<dealii::Triangulation<2>::cell_iterator>> pairs;
      dealii::GridTools::collect_periodic_faces(mesh, 0, 1, 0, pairs);
      dealii::GridTools::collect_periodic_faces(mesh, 2, 3, 1, pairs);
      mesh.add_periodicity(pairs);
    }

    int
    dof_of(const Cell &cell)
    {
      std::vector<dealii::types::global_dof_index> index(1);
      cell->get_dof_indices(index);
      return static_cast<int>(index[0]);
    }

    std::vector<int>
    pixel_of_each_dof(const CellGrid &grid, const dealii::DoFHandler<2> &dofs)
    {
      std::vector<int> pixel(grid.size());
      for (const auto &cell : dofs.active_cell_iterators())
        {
          const dealii::Point<2> centre = cell->center();
          pixel[dof_of(cell)]           = static_cast<int>(std::floor(centre[1])) * static_cast<int>(grid.nx)
                                + static_cast<int>(std::floor(centre[0]));
        }
      return pixel;
    }

    // Each face is visited once, from the cell below it; lower boundaries from the cell above.
    void
    collect_faces(CellGrid &grid, const dealii::DoFHandler<2> &dofs)
    {
      const std::vector<int> pixel = pixel_of_each_dof(grid, dofs);
      for (const auto &cell : dofs.active_cell_iterators())
        for (int axis = 0; axis < 2; ++axis)
          {
            const unsigned low = 2 * axis, high = low + 1;
            const int      here = pixel[dof_of(cell)];
            if (!cell->at_boundary(high))
              grid.faces[axis].push_back({ here, pixel[dof_of(cell->neighbor(high))] });
            else if (cell->has_periodic_neighbor(high))
              grid.faces[axis].push_back({ here, pixel[dof_of(cell->periodic_neighbor(high))] });
            else
              grid.upper_boundary[axis].push_back(here);
            if (cell->at_boundary(low) && !cell->has_periodic_neighbor(low))
              grid.lower_boundary[axis].push_back(here);
          }
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
    for (int axis = 0; axis < 2; ++axis)
      grid.faces[axis].reserve(grid.size());

    dealii::Triangulation<2> mesh;
    make_mesh(grid, mesh);
    const dealii::FE_DGQ<2> constant_per_cell(0);
    dealii::DoFHandler<2>   dofs(mesh);
    dofs.distribute_dofs(constant_per_cell);
    collect_faces(grid, dofs);
    return grid;
  }
} // namespace tribodraw
