// The equations on the arrays of the map are those of FE_DGQ(0) with face terms on a deal.II mesh.
#include "maps.h"

#include <tribodraw/flow_factors/cell_flow.h>

#include <deal.II/base/function.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  // Pressure and shear fluctuation along x from a system assembled face by face on the mesh, with positions, face
  // measures and neighbours of deal.II. Pixels without film keep a unit diagonal.
  struct DealIISystem
  {
    dealii::Triangulation<2>     mesh;
    dealii::FE_DGQ<2>            element{ 0 };
    dealii::DoFHandler<2>        dofs{ mesh };
    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;
    dealii::Vector<double>       rhs[2];
    const CellGrid              &grid;
    const CellGap               &gap;

    using Cell = dealii::DoFHandler<2>::active_cell_iterator;

    DealIISystem(const CellGrid &grid_in, const CellGap &gap_in) : grid(grid_in), gap(gap_in)
    {
      dealii::GridGenerator::subdivided_hyper_rectangle(
          mesh, { unsigned(grid.nx), unsigned(grid.ny) }, dealii::Point<2>(0, 0),
          dealii::Point<2>(double(grid.nx) * grid.dx, double(grid.ny) * grid.dy), true);
      if (grid.periodic)
        {
          std::vector<dealii::GridTools::PeriodicFacePair<dealii::Triangulation<2>::cell_iterator>> pairs;
          dealii::GridTools::collect_periodic_faces(mesh, 0, 1, 0, pairs);
          dealii::GridTools::collect_periodic_faces(mesh, 2, 3, 1, pairs);
          mesh.add_periodicity(pairs);
        }
      dofs.distribute_dofs(element);
      dealii::DynamicSparsityPattern sparsity(dofs.n_dofs());
      dealii::DoFTools::make_flux_sparsity_pattern(dofs, sparsity);
      pattern.copy_from(sparsity);
      matrix.reinit(pattern);
      for (auto &b : rhs)
        b.reinit(dofs.n_dofs());
      for (const auto &cell : dofs.active_cell_iterators())
        for (const unsigned f : cell->face_indices())
          add_face(cell, f);
      for (unsigned i = 0; i < dofs.n_dofs(); ++i)
        if (matrix.diag_element(i) == 0)
          matrix.set(i, i, 1);
      if (grid.periodic) // one region: its pressure is held in one pixel
        for (const auto &cell : dofs.active_cell_iterators())
          if (gap.open(pixel(cell)))
            {
              matrix.set(dof(cell), dof(cell), 2 * matrix.diag_element(dof(cell)));
              break;
            }
    }

    static unsigned
    dof(const Cell &cell)
    {
      std::vector<dealii::types::global_dof_index> index(1);
      cell->get_dof_indices(index);
      return unsigned(index[0]);
    }
    int
    pixel(const Cell &cell) const
    {
      return int(cell->center()[1] / grid.dy) * int(grid.nx) + int(cell->center()[0] / grid.dx);
    }

    // The half of the face's flux that belongs to this cell's equation: flux out of it along the outer normal.
    void
    add_face(const Cell &cell, const unsigned f)
    {
      const int    a      = pixel(cell);
      const auto   face   = cell->face(f);
      const double normal = f == 1 ? 1. : f == 0 ? -1. : 0.; // x-component
      if (!gap.open(a))
        return;
      const bool periodic_face = cell->at_boundary(f) && cell->has_periodic_neighbor(f);
      if (cell->at_boundary(f) && !periodic_face)
        {
          if (f >= 2)
            return; // no flow through the sides
          const double distance = (face->center() - cell->center()).norm(), h = gap.gap[a] / gap.mean_gap;
          const double k = h * h * h * face->measure() / distance;
          matrix.add(dof(cell), dof(cell), k);
          rhs[0](dof(cell)) += k * distance * normal;
          rhs[1](dof(cell)) -= gap.carried[a] / gap.mean_gap * face->measure() * normal;
          return;
        }
      const Cell neighbour = periodic_face ? Cell(cell->periodic_neighbor(f)) : Cell(cell->neighbor(f));
      const int  b         = pixel(neighbour);
      if (!gap.open(b))
        return;
      const double distance = 2 * (face->center() - cell->center()).norm();
      const double h        = 0.5 * (gap.gap[a] + gap.gap[b]) / gap.mean_gap;
      const double k        = h * h * h * face->measure() / distance;
      matrix.add(dof(cell), dof(cell), k);
      matrix.add(dof(cell), dof(neighbour), -k);
      rhs[0](dof(cell)) += k * distance * normal;
      rhs[1](dof(cell)) -= 0.5 * (gap.carried[a] + gap.carried[b]) / gap.mean_gap * face->measure() * normal;
    }

    // By pixel
    std::array<std::vector<double>, 2>
    solve()
    {
      dealii::SparseDirectUMFPACK factors;
      factors.initialize(matrix);
      std::array<std::vector<double>, 2> result;
      for (const int i : { 0, 1 })
        {
          dealii::Vector<double> x;
          x.reinit(dofs.n_dofs());
          factors.vmult(x, rhs[i]);
          result[i].resize(grid.size());
          for (const auto &cell : dofs.active_cell_iterators())
            result[i][pixel(cell)] = x(dof(cell));
        }
      return result;
    }
  };
}

TEST(CellsWithDealII, same_pressures)
{
  // Contact in two corners of the map and in its middle, so that every kind of face occurs and all open pixels belong
  // to one region; both solvers.
  HeightMap map = map_of_gap(33, 26, [](const double x, const double y) {
    const double r = std::hypot(x - .45, y - .5);
    return r < .2 || x + y < .3 || (x > .8 && y > .85) ? 0. : .6 + .5 * std::sin(7 * x + 2) * std::cos(5 * y) + .2 * x;
  });
  map.dx        = .7;
  map.dy        = 1.1;
  for (const bool periodic_cell : { true, false })
    {
      const CellGrid grid = make_cell_grid(map.nx, map.ny, map.dx, map.dy, periodic_cell);
      const CellGap  gap  = make_cell_gap(map, {}, 0, 0);
      ASSERT_GT(gap.contact_fraction, .1);
      const std::vector<int> region = CellConnectivity(grid, gap).conducting_regions(0);
      for (std::size_t i = 0; i < grid.size(); ++i)
        ASSERT_EQ(region[i], gap.open(static_cast<int>(i)) ? 0 : -1);
      const auto expected = DealIISystem(grid, gap).solve();
      for (const auto choice : { CellSolverChoice::direct, CellSolverChoice::multigrid })
        {
          const CellFlow flow(grid, gap, CellDiscretisation::mean_gap, 0, choice, 1e-13);
          const auto     solutions = flow.solve({ { 0, false }, { 0, true } });
          for (const std::size_t s : { 0, 1 })
            {
              // on a periodic grid up to a constant
              const std::vector<double> &p = solutions[s].pressure, &q = expected[s];
              double                     shift = 0, n_open = 0, largest = 0;
              for (std::size_t i = 0; i < grid.size() && periodic_cell; ++i)
                if (region[i] == 0)
                  {
                    shift += q[i] - p[i];
                    n_open += 1;
                  }
              shift /= periodic_cell ? n_open : 1;
              for (std::size_t i = 0; i < grid.size(); ++i)
                if (region[i] == 0)
                  {
                    largest = std::max(largest, std::abs(q[i]));
                    EXPECT_NEAR(p[i] + shift, q[i], 1e-9) << i;
                  }
              EXPECT_GT(largest, .1);
            }
        }
    }
}
