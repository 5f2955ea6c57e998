#include "discretization.h"

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <stdexcept>

namespace tribodraw
{
  namespace
  {
    constexpr unsigned n_components   = 5;
    constexpr unsigned n_displacement = 3;

    using SharedTriangulation = dealii::parallel::shared::Triangulation<2, 3>;

    void
    create_triangulation(const BlankMesh &mesh, SharedTriangulation &triangulation)
    {
      std::vector<dealii::Point<3>> vertices;
      vertices.reserve(mesh.nodes.size());
      for (const Eigen::Vector3d &x : mesh.nodes)
        vertices.emplace_back(x[0], x[1], x[2]);
      std::vector<dealii::CellData<2>> cells(mesh.triangles.size(), dealii::CellData<2>(3));
      for (std::size_t e = 0; e < cells.size(); ++e)
        cells[e].vertices.assign(mesh.triangles[e].begin(), mesh.triangles[e].end());
      triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
    }
  } // namespace

  struct Discretization::FiniteElements
  {
    SharedTriangulation      triangulation;
    dealii::FESystem<2, 3>   fe;
    dealii::DoFHandler<2, 3> dof_handler;

    FiniteElements()
        // All cells of all ranks are kept as full cells: positions are known everywhere.
        : triangulation(MPI_COMM_WORLD, dealii::Triangulation<2, 3>::none, false, SharedTriangulation::partition_metis),
          fe(dealii::FE_SimplexP<2, 3>(1), n_components), dof_handler(triangulation)
    {
    }
  };

  Discretization::Discretization(const BlankMesh &mesh) : finite_elements(std::make_unique<FiniteElements>())
  {
    FiniteElements &f = *finite_elements;
    create_triangulation(mesh, f.triangulation);
    f.dof_handler.distribute_dofs(f.fe);

    node_dofs.resize(mesh.nodes.size());
    dofs.resize(mesh.triangles.size());
    std::vector<bool> seen(mesh.nodes.size(), false);
    for (const auto &cell : f.dof_handler.active_cell_iterators())
      {
        const unsigned element = cell->active_cell_index();
        if (cell->is_locally_owned())
          owned.push_back(element);
        for (unsigned v = 0; v < shell_element::n_nodes; ++v)
          {
            const unsigned node = cell->vertex_index(v);
            if (node != mesh.triangles[element][v])
              throw std::logic_error("The triangulation numbers its cells otherwise than the blank mesh.");
            seen[node] = true;
            for (unsigned c = 0; c < n_components; ++c)
              {
                node_dofs[node][c]                  = static_cast<unsigned>(cell->vertex_dof_index(v, c));
                dofs[element][n_components * v + c] = static_cast<int>(node_dofs[node][c]);
              }
          }
      }
    for (const bool s : seen)
      if (!s)
        throw std::logic_error("The blank mesh has a node without an element.");
  }

  Discretization::~Discretization() = default;

  unsigned
  Discretization::n_dofs() const
  {
    return static_cast<unsigned>(finite_elements->dof_handler.n_dofs());
  }

  std::vector<std::vector<int>>
  Discretization::columns(const unsigned n_extra) const
  {
    // Not DoFTools::make_sparsity_pattern, which visits only the cells of this rank.
    const unsigned                               n = n_dofs();
    dealii::DynamicSparsityPattern               pattern(n + n_extra);
    const dealii::AffineConstraints<double>      no_constraints;
    std::vector<dealii::types::global_dof_index> cell_dofs(shell_element::n_dofs);
    for (const auto &cell : finite_elements->dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(cell_dofs);
        no_constraints.add_entries_local_to_global(cell_dofs, pattern);
      }
    for (unsigned extra = n; extra < n + n_extra; ++extra)
      {
        for (const std::array<unsigned, n_components> &node : node_dofs)
          for (unsigned c = 0; c < n_displacement; ++c)
            {
              pattern.add(node[c], extra);
              pattern.add(extra, node[c]);
            }
        for (unsigned other = n; other < n + n_extra; ++other)
          pattern.add(extra, other);
      }
    std::vector<std::vector<int>> result(n + n_extra);
    for (unsigned row = 0; row < n + n_extra; ++row)
      for (unsigned k = 0; k < pattern.row_length(row); ++k)
        result[row].push_back(static_cast<int>(pattern.column_number(row, k)));
    return result;
  }
} // namespace tribodraw
