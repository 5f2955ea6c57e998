#include "film_geometry.h"
#include "film_terms.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/lubrication/average_reynolds.h>
#include <tribodraw/lubrication/bounded_system.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  struct AverageReynolds::Implementation
  {
    FilmGeometry                    geometry;
    double                          phi_p_floor;
    std::vector<std::array<int, 9>> positions; // of the entries of each triangle in the values of the matrix
    BoundedSystem                   system;
    BoundedSystem::Matrix           matrix;
    std::vector<FilmCoefficient>    coefficient; // of the nodes; kept for its memory

    Implementation(const std::vector<Eigen::Vector3d> &reference, const std::vector<std::array<unsigned, 3>> &triangles,
                   const double floor)
        : geometry(reference, triangles), phi_p_floor(floor)
    {
      make_pattern();
    }

    void
    make_pattern()
    {
      const int                           n = static_cast<int>(geometry.n_nodes());
      const std::vector<std::vector<int>> columns = geometry.node_columns();
      std::vector<int>                    start{ 0 }, column;
      for (const auto &list : columns)
        {
          column.insert(column.end(), list.begin(), list.end());
          start.push_back(static_cast<int>(column.size()));
        }
      const std::vector<double> ones(column.size(), 1.);
      matrix = Eigen::Map<const BoundedSystem::Matrix>(n, n, start.back(), start.data(), column.data(), ones.data());
      for (const auto &cell : geometry.cells())
        {
          std::array<int, 9> position;
          for (unsigned i = 0; i < 3; ++i)
            for (unsigned j = 0; j < 3; ++j)
              {
                // The pattern is symmetric: column j lists the nodes around node j.
                const int  node  = static_cast<int>(cell.node[j]);
                const auto begin = column.begin() + start[node], end = column.begin() + start[node + 1];
                position[3 * i + j] = static_cast<int>(std::lower_bound(begin, end, static_cast<int>(cell.node[i])) - column.begin());
              }
          positions.push_back(position);
        }
      system.analyse(matrix);
    }

    void
    set_coefficients(const std::vector<NodeData> &nodes)
    {
      if (nodes.size() != geometry.n_nodes())
        throw InputError(describe_error("Wrong number of nodal data for the film", "average Reynolds equation",
                                        std::to_string(nodes.size()), std::to_string(geometry.n_nodes())));
      coefficient.clear();
      coefficient.reserve(nodes.size());
      for (const NodeData &node : nodes)
        {
          coefficient.push_back(film_coefficient(node, phi_p_floor));
          if (!coefficient.back().has_film && !node.fixed)
            throw InputError(describe_error(
                "A node that carries lubricant pressure has no film or no viscosity",
                "node " + std::to_string(coefficient.size() - 1) + " of the average Reynolds equation",
                "film " + std::to_string(node.film) + " mm, viscosity " + std::to_string(node.viscosity) + " MPa s",
                "above zero"));
        }
    }

    void
    assemble(const std::vector<NodeData> &nodes, Eigen::VectorXd &rhs)
    {
      set_coefficients(nodes);
      double *value = matrix.valuePtr();
      std::fill(value, value + matrix.nonZeros(), 0.);
      const std::size_t n_nodes = geometry.n_nodes();
      rhs                       = Eigen::VectorXd::Zero(n_nodes);
      // Of a large film each rank needs the rows of its own nodes only.
      const auto [begin, end] = BoundedSystem::needed_range(static_cast<int>(n_nodes));
      const auto needed       = [b = static_cast<unsigned>(begin), e = static_cast<unsigned>(end)](const unsigned i) {
        return i >= b && i < e;
      };
      for (std::size_t c = 0; c < geometry.cells().size(); ++c)
        {
          const FilmGeometry::Cell &cell = geometry.cells()[c];
          if (!needed(cell.node[0]) && !needed(cell.node[1]) && !needed(cell.node[2]))
            continue;
          std::array<const FilmCoefficient *, 3> local;
          unsigned                               n_films = 0, n_free = 0;
          for (unsigned i = 0; i < 3; ++i)
            {
              local[i] = &coefficient[cell.node[i]];
              n_films += local[i]->has_film;
              n_free += !nodes[cell.node[i]].fixed;
            }
          if (n_films == 3 || n_free > 0)
            add_cell(c, local, value, rhs);
        }
      if (std::any_of(nodes.begin(), nodes.end(), [](const NodeData &node) { return node.squeeze_slope > 0; }))
        {
          // As a lumped mass: exact in the sum, and the matrix keeps its sign structure.
          const Eigen::VectorXd area = geometry.nodal_area();
          for (std::size_t i = 0; i < n_nodes; ++i)
            if (!nodes[i].fixed)
              matrix.coeffRef(i, i) += area[i] * nodes[i].squeeze_slope;
        }
      // A node without any film around it is fixed; the unit entry keeps the matrix regular.
      for (int i = begin; i < end; ++i)
        if (double &diagonal = matrix.coeffRef(i, i); diagonal == 0.)
          diagonal = 1.;
    }

    /// int grad N_i . (h^3/(12 eta) PhiP) grad N_j  and  int grad N_i . (h (U1+U2)/2 + Sq PhiS (U1-U2)/2) - N_i
    /// squeeze.
    void
    add_cell(const std::size_t c, const std::array<const FilmCoefficient *, 3> &local, double *value,
             Eigen::VectorXd &rhs) const
    {
      const FilmGeometry::Cell &cell  = geometry.cells()[c];
      const FilmTerms           terms = film_terms(cell, geometry.quadrature(), local);
      const Eigen::Matrix3d     K     = cell.material_gradient.transpose() * terms.mobility * cell.material_gradient;
      const Eigen::Vector3d     b     = cell.material_gradient.transpose() * terms.flux - terms.squeeze;
      for (unsigned i = 0; i < 3; ++i)
        {
          rhs[cell.node[i]] += b[i];
          for (unsigned j = 0; j < 3; ++j)
            value[positions[c][3 * i + j]] += K(i, j);
        }
    }

    Result
    report(const std::vector<NodeData> &nodes, BoundedSystem::Result &&solution) const
    {
      const std::size_t n_nodes = geometry.n_nodes();
      Result            result;
      result.iterations = solution.iterations;
      result.converged  = solution.converged;
      result.pressure.assign(solution.x.data(), solution.x.data() + n_nodes);
      result.outflow.assign(solution.residual.data(), solution.residual.data() + n_nodes);
      result.opening_rate.assign(n_nodes, 0.);
      const Eigen::VectorXd area          = geometry.nodal_area();
      const Eigen::VectorXd pressure_flow = solution.load - solution.residual;
      double                sum = 0, magnitude = 0;
      for (std::size_t i = 0; i < n_nodes; ++i)
        if (solution.set[i] == BoundedSystem::at_upper)
          result.opening_rate[i] = std::max(0., solution.residual[i]) / area[i];
        else if (solution.set[i] == BoundedSystem::free && !nodes[i].fixed)
          {
            sum += solution.residual[i];
            magnitude += std::abs(solution.load[i]) + std::abs(pressure_flow[i]);
          }
      result.flux_imbalance = magnitude > 0 ? std::abs(sum) / magnitude : 0.;
      return result;
    }
  };

  AverageReynolds::AverageReynolds(const std::vector<Eigen::Vector3d>         &reference,
                                   const std::vector<std::array<unsigned, 3>> &triangles, const double phi_p_floor)
      : data(std::make_unique<Implementation>(reference, triangles, phi_p_floor))
  {
  }

  AverageReynolds::~AverageReynolds() = default;

  AverageReynolds::Result
  AverageReynolds::solve(const std::vector<Eigen::Vector3d> &positions, const std::vector<NodeData> &nodes,
                         const std::vector<double> &start) const
  {
    const timing::Scope timer("lubrication/average Reynolds");
    data->geometry.move_to(positions);
    Eigen::VectorXd rhs;
    data->assemble(nodes, rhs);

    const std::size_t n = nodes.size();
    std::vector<char> set(n, BoundedSystem::free);
    Eigen::VectorXd   x    = Eigen::VectorXd::Zero(n), upper(n);
    const bool        warm = start.size() == n && *std::max_element(start.begin(), start.end()) > 0;
    for (std::size_t i = 0; i < n; ++i)
      {
        upper[i] = std::max(0., nodes[i].p_limit);
        if (nodes[i].fixed || upper[i] == 0.)
          {
            set[i] = BoundedSystem::prescribed;
            x[i]   = nodes[i].fixed ? nodes[i].fixed_pressure : 0.;
          }
        else if (warm)
          set[i] = start[i] >= upper[i] ? BoundedSystem::at_upper
                   : start[i] > 0       ? BoundedSystem::free
                                        : BoundedSystem::at_zero;
      }
    return data->report(nodes, data->system.solve(data->matrix, rhs, upper, std::move(set), std::move(x)));
  }

  double
  AverageReynolds::load(const std::vector<Eigen::Vector3d> &positions, const std::vector<double> &pressure) const
  {
    data->geometry.move_to(positions);
    double sum = 0;
    for (const auto &cell : data->geometry.cells())
      sum += cell.area / 3. * (pressure[cell.node[0]] + pressure[cell.node[1]] + pressure[cell.node[2]]);
    return sum;
  }
} // namespace tribodraw
