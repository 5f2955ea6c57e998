// The fields behind the bounds are members of deal.II's Q1 and RT0 spaces, and their energies those that deal.II
// integrates.
#include "maps.h"

#include <tribodraw/flow_factors/cell_bounds.h>
#include <tribodraw/flow_factors/cell_flow.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_raviart_thomas.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <limits>

using namespace tribodraw;
using namespace tribodraw::test;

namespace
{
  constexpr double unset = std::numeric_limits<double>::quiet_NaN();

  // Global vectors of one field; fails if cells disagree on a shared vertex or face.
  struct GlobalField
  {
    std::vector<double> q1, rt0;

    static void
    write(double &to, const double value)
    {
      if (std::isnan(to))
        to = value;
      else
        EXPECT_DOUBLE_EQ(to, value);
    }
  };

  struct Mesh
  {
    dealii::Triangulation<2>    triangulation;
    dealii::FE_Q<2>             q1{ 1 };
    dealii::FE_RaviartThomas<2> rt0{ 0 };
    dealii::DoFHandler<2>       q1_dofs{ triangulation }, rt0_dofs{ triangulation };
    const CellGrid             &grid;

    explicit Mesh(const CellGrid &g) : grid(g)
    {
      dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, { unsigned(g.nx), unsigned(g.ny) },
                                                        dealii::Point<2>(0, 0),
                                                        dealii::Point<2>(double(g.nx) * g.dx, double(g.ny) * g.dy));
      q1_dofs.distribute_dofs(q1);
      rt0_dofs.distribute_dofs(rt0);
    }

    template <class Cell>
    int
    pixel(const Cell &cell) const
    {
      return int(cell->center()[1] / grid.dy) * int(grid.nx) + int(cell->center()[0] / grid.dx);
    }

    GlobalField
    field(const CellTrialFields &fields, const int number) const
    {
      GlobalField result{ std::vector<double>(q1_dofs.n_dofs(), unset), std::vector<double>(rt0_dofs.n_dofs(), unset) };
      std::vector<dealii::types::global_dof_index> index(4);
      dealii::FEFaceValues<2>                      face_values(rt0, dealii::QMidpoint<1>(),
                                                               dealii::update_values | dealii::update_normal_vectors);
      const dealii::FEValuesExtractors::Vector     flux(0);
      for (const auto &cell : q1_dofs.active_cell_iterators())
        if (fields.open(pixel(cell)))
          {
            cell->get_dof_indices(index);
            for (unsigned v = 0; v < 4; ++v)
              GlobalField::write(result.q1[index[v]], fields.potential(pixel(cell), int(v), number));
          }
      for (const auto &cell : rt0_dofs.active_cell_iterators())
        if (fields.open(pixel(cell)))
          {
            cell->get_dof_indices(index);
            for (unsigned f = 0; f < 4; ++f)
              {
                face_values.reinit(cell, f);
                // deal.II numbers faces left, right, bottom, top; the axis direction of the flux density at its middle
                for (unsigned i = 0; i < 4; ++i)
                  {
                    const double component = face_values[flux].value(i, 0)[f / 2];
                    if (std::abs(component) > 1e-8)
                      GlobalField::write(result.rt0[index[i]],
                                         fields.flux(pixel(cell), CellTrialFields::Face(f), number)
                                             / ((f < 2 ? grid.dy : grid.dx) * component));
                  }
              }
          }
      return result;
    }
  };
}

TEST(BoundsWithDealII, energies_of_Q1_and_RT0)
{
  HeightMap map = gaussian_map(12, 2, 31);
  map.ny        = 9;
  map.dx        = .7;
  map.dy        = 1.1;
  map.z.resize(map.nx * map.ny);
  for (const bool periodic_cell : { true, false })
    {
      const CellGrid grid = make_cell_grid(map.nx, map.ny, map.dx, map.dy, periodic_cell);
      const CellGap  gap  = make_cell_gap(map, {}, 1.2, 3e-4);
      ASSERT_GT(gap.contact_fraction, .02);
      const CellConnectivity connectivity(grid, gap);
      const CellFlow         flow(grid, gap, CellDiscretisation::mean_gap, 0);
      CellTrialFields        fields(grid, gap, connectivity.conducting_regions(0), 0);
      std::vector<int>       numbers;
      for (const int axis : { 0, 1 })
        if (periodic_cell || axis == 0)
          {
            const auto p = flow.pressure_flow(axis), s = flow.shear_flow(axis);
            fields.start(CellTrialFields::pressure_field(axis), p.pressure, p.upper_flux);
            fields.start(CellTrialFields::shear_field(axis), s.pressure, s.upper_flux);
            numbers.push_back(CellTrialFields::pressure_field(axis));
            numbers.push_back(CellTrialFields::shear_field(axis));
          }
      fields.improve(2);
      fields.balance();
      const CellEnergies energies = fields.energies();

      // no round-off in the balance, no flow into contact
      for (int c = 0; c < int(grid.size()); ++c)
        for (const int f : numbers)
          {
            using F = CellTrialFields::Face;
            if (fields.open(c))
              {
                EXPECT_EQ((fields.flux(c, F::right, f) - fields.flux(c, F::left, f))
                              + (fields.flux(c, F::top, f) - fields.flux(c, F::bottom, f)),
                          0);
              }
            else
              for (const F face : { F::left, F::right, F::bottom, F::top })
                EXPECT_EQ(fields.flux(c, face, f), 0);
          }

      const Mesh               mesh(grid);
      std::vector<GlobalField> global(4);
      for (const int f : numbers)
        global[f] = mesh.field(fields, f);
      const dealii::QGauss<2> quadrature(3);
      dealii::FEValues<2>     q1(mesh.q1, quadrature, dealii::update_gradients | dealii::update_JxW_values),
          rt0(mesh.rt0, quadrature, dealii::update_values | dealii::update_gradients);
      const dealii::FEValuesExtractors::Vector     flux(0);
      std::vector<dealii::types::global_dof_index> q1_index(4), rt0_index(4);
      CellEnergies::Matrix                         primal{}, missing{};
      std::array<double, 4>                        complementary{};
      auto                                         rt0_cell = mesh.rt0_dofs.begin_active();
      for (auto cell = mesh.q1_dofs.begin_active(); cell != mesh.q1_dofs.end(); ++cell, ++rt0_cell)
        {
          const int pixel = mesh.pixel(cell);
          if (!fields.open(pixel))
            continue;
          q1.reinit(cell);
          rt0.reinit(rt0_cell);
          cell->get_dof_indices(q1_index);
          rt0_cell->get_dof_indices(rt0_index);
          const double h = gap.gap[pixel] / gap.mean_gap, k = h * h * h, c = gap.carried[pixel] / gap.mean_gap;
          for (unsigned q = 0; q < quadrature.size(); ++q)
            {
              std::array<dealii::Tensor<1, 2>, 4> p, tau;
              for (const int f : numbers)
                {
                  p[f][f % 2] = f < 2 ? k : -c;
                  dealii::Tensor<1, 2> value;
                  double               divergence = 0;
                  for (unsigned i = 0; i < 4; ++i)
                    {
                      p[f] += k * global[f].q1[q1_index[i]] * q1.shape_grad(i, q);
                      value += global[f].rt0[rt0_index[i]] * rt0[flux].value(i, q);
                      divergence += global[f].rt0[rt0_index[i]] * rt0[flux].divergence(i, q);
                    }
                  EXPECT_NEAR(divergence, 0, 1e-13);
                  tau[f] = value - p[f];
                  complementary[f] += value * value / k * q1.JxW(q) / grid.area();
                }
              for (const int a : numbers)
                for (const int b : numbers)
                  {
                    primal[a][b] += p[a] * p[b] / k * q1.JxW(q) / grid.area();
                    missing[a][b] += tau[a] * tau[b] / k * q1.JxW(q) / grid.area();
                  }
            }
        }
      for (const int a : numbers)
        {
          EXPECT_NEAR(energies.complementary[a], complementary[a], 1e-12 * complementary[a]);
          for (const int b : numbers)
            {
              EXPECT_NEAR(energies.gap[a][b], missing[a][b], 1e-12 * std::sqrt(complementary[a] * complementary[b]));
              if (a < 2 || b < 2)
                {
                  EXPECT_NEAR(energies.primal[a][b], primal[a][b],
                              1e-12 * std::sqrt(complementary[a] * complementary[b]));
                }
            }
        }
    }
}
