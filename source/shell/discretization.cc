#include "discretization.h"

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
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

  Discretization::Discretization(const BlankMesh &mesh, const bool smoothed)
      : finite_elements(std::make_unique<FiniteElements>())
  {
    using namespace shell_element;
    if (smoothed)
      opposite = mesh.opposite_nodes();
    else
      opposite.assign(mesh.triangles.size(), { -1, -1, -1 });
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
                node_dofs[node][c] = static_cast<unsigned>(cell->vertex_dof_index(v, c));
                if (node_dofs[node][c] != node_dofs[node][0] + c)
                  throw std::logic_error("The unknowns of a node do not follow each other.");
              }
          }
      }
    for (const bool s : seen)
      if (!s)
        throw std::logic_error("The blank mesh has a node without an element.");

    for (std::size_t element = 0; element < dofs.size(); ++element)
      for (unsigned v = 0; v < n_nodes; ++v)
        {
          const auto &of_node = node_dofs[mesh.triangles[element][v]];
          for (unsigned c = 0; c < n_displacement; ++c)
            {
              const int node                        = opposite[element][v];
              dofs[element][displacement_dof(v, c)] = static_cast<int>(of_node[c]);
              dofs[element][opposite_dof(v, c)]     = node < 0 ? -1 : static_cast<int>(node_dofs[node][c]);
            }
          for (unsigned t = 0; t < 2; ++t)
            dofs[element][director_dof(v, t)] = static_cast<int>(of_node[n_displacement + t]);
        }
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
    // Not DoFTools::make_sparsity_pattern, which visits only the cells of this rank and knows no opposite nodes.
    using namespace shell_element;
    const unsigned                 n = n_dofs();
    dealii::DynamicSparsityPattern pattern(n + n_extra);
    for (const std::array<int, shell_element::n_dofs> &element : dofs)
      for (unsigned i = 0; i < n_own_dofs; ++i)
        for (unsigned j = 0; j < shell_element::n_dofs; ++j)
          if (element[j] >= 0)
            {
              pattern.add(element[i], element[j]);
              pattern.add(element[j], element[i]);
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
