#include "film_geometry.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/lubrication/average_reynolds.h>
#include <tribodraw/lubrication/bounded_system.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Symmetric part of PhiP with eigenvalues not below the floor.
    Eigen::Matrix2d
    bounded_from_below(const Eigen::Matrix2d &phi, const double floor)
    {
      const double    mean = 0.5 * (phi(0, 0) + phi(1, 1)), half = 0.5 * (phi(0, 0) - phi(1, 1));
      const double    off    = 0.5 * (phi(0, 1) + phi(1, 0));
      const double    radius = std::hypot(half, off);
      Eigen::Matrix2d symmetric;
      symmetric << phi(0, 0), off, off, phi(1, 1);
      if (mean - radius >= floor)
        return symmetric;
      const double upper = std::max(mean + radius, floor), lower = floor;
      const double c = radius > 0 ? half / radius : 0., s = radius > 0 ? off / radius : 0.;
      const double m = 0.5 * (upper + lower), d = 0.5 * (upper - lower);
      symmetric << m + d * c, d * s, d * s, m - d * c;
      return symmetric;
    }

    /// The nodal data as they are integrated.
    struct Coefficient
    {
      double          film = 0, fluidity = 0, squeeze = 0;     // fluidity: 1/(12 eta)
      Eigen::Vector3d phi_p         = Eigen::Vector3d::Zero(); // xx, yy, xy
      Eigen::Matrix2d sq_phi_s      = Eigen::Matrix2d::Zero();
      Eigen::Vector3d mean_velocity = Eigen::Vector3d::Zero(), half_slip = Eigen::Vector3d::Zero();

      Coefficient &
      operator+=(const Coefficient &other)
      {
        film += other.film;
        fluidity += other.fluidity;
        squeeze += other.squeeze;
        phi_p += other.phi_p;
        sq_phi_s += other.sq_phi_s;
        return *this;
      }
      void
      scale(const double factor)
      {
        film *= factor;
        fluidity *= factor;
        squeeze *= factor;
        phi_p *= factor;
        sq_phi_s *= factor;
      }
    };
  } // namespace

  struct AverageReynolds::Implementation
  {
    FilmGeometry                    geometry;
    double                          phi_p_floor;
    std::vector<std::array<int, 9>> positions; // of the entries of each triangle in the values of the matrix
    BoundedSystem                   system;
    BoundedSystem::Matrix           matrix;

    Implementation(const std::vector<Eigen::Vector3d> &reference, const std::vector<std::array<unsigned, 3>> &triangles,
                   const double floor)
        : geometry(reference, triangles), phi_p_floor(floor)
    {
      make_pattern();
    }

    void
    make_pattern()
    {
      std::vector<Eigen::Triplet<double>> entries;
      const std::size_t                   n_nodes = geometry.n_nodes();
      for (const auto &cell : geometry.cells())
        for (const unsigned i : cell.node)
          for (const unsigned j : cell.node)
            entries.emplace_back(i, j, i == j ? 1. : 0.);
      matrix.resize(n_nodes, n_nodes);
      matrix.setFromTriplets(entries.begin(), entries.end());
      matrix.makeCompressed();
      for (const auto &cell : geometry.cells())
        {
          std::array<int, 9> position;
          for (unsigned i = 0; i < 3; ++i)
            for (unsigned j = 0; j < 3; ++j)
              position[3 * i + j] = static_cast<int>(&matrix.coeffRef(cell.node[i], cell.node[j]) - matrix.valuePtr());
          positions.push_back(position);
        }
      system.analyse(matrix);
    }

    static bool
    has_film(const NodeData &node)
    {
      return node.film > 0 && node.viscosity > 0;
    }

    std::vector<Coefficient>
    coefficients(const std::vector<NodeData> &nodes) const
    {
      const std::size_t n_nodes = geometry.n_nodes();
      if (nodes.size() != n_nodes)
        throw InputError(describe_error("Wrong number of nodal data for the film", "average Reynolds equation",
                                        std::to_string(nodes.size()), std::to_string(n_nodes)));
      std::vector<Coefficient> result(n_nodes);
      for (std::size_t i = 0; i < n_nodes; ++i)
        {
          const NodeData &node = nodes[i];
          Coefficient    &c    = result[i];
          c.mean_velocity      = 0.5 * (node.sheet_velocity + node.tool_velocity);
          c.half_slip          = 0.5 * (node.sheet_velocity - node.tool_velocity);
          if (has_film(node))
            {
              const Eigen::Matrix2d phi = bounded_from_below(node.phi_p, phi_p_floor);
              c.film                    = node.film;
              c.fluidity                = 1. / (12. * node.viscosity);
              c.squeeze                 = node.squeeze;
              c.phi_p                   = { phi(0, 0), phi(1, 1), phi(0, 1) };
              c.sq_phi_s                = node.sq_phi_s;
            }
          else if (!node.fixed)
            throw InputError(describe_error("A node that carries lubricant pressure has no film or no viscosity",
                                            "node " + std::to_string(i) + " of the average Reynolds equation",
                                            "film " + std::to_string(node.film) + " mm, viscosity "
                                                + std::to_string(node.viscosity) + " MPa s",
                                            "above zero"));
        }
      return result;
    }

    void
    assemble(const std::vector<NodeData> &nodes, Eigen::VectorXd &rhs)
    {
      const std::vector<Coefficient> coefficient = coefficients(nodes);
      double                        *value       = matrix.valuePtr();
      std::fill(value, value + matrix.nonZeros(), 0.);
      const std::size_t n_nodes = geometry.n_nodes();
      rhs                       = Eigen::VectorXd::Zero(n_nodes);
      for (std::size_t c = 0; c < geometry.cells().size(); ++c)
        {
          const FilmGeometry::Cell          &cell = geometry.cells()[c];
          std::array<const Coefficient *, 3> local;
          unsigned                           n_films = 0, n_free = 0;
          for (unsigned i = 0; i < 3; ++i)
            {
              local[i] = &coefficient[cell.node[i]];
              n_films += has_film(nodes[cell.node[i]]);
              n_free += !nodes[cell.node[i]].fixed;
            }
          if (n_films == 3)
            add_cell(c, local, value, rhs);
          else if (n_free > 0)
            add_cell_at_rim(c, nodes, local, value, rhs);
        }
      // A node without any film around it is fixed; the unit entry keeps the matrix regular.
      for (std::size_t i = 0; i < n_nodes; ++i)
        if (matrix.coeff(i, i) == 0.)
          matrix.coeffRef(i, i) = 1.;
    }

    /// Nodes without film take the mean of the others.
    void
    add_cell_at_rim(const std::size_t c, const std::vector<NodeData> &nodes, std::array<const Coefficient *, 3> local,
                    double *value, Eigen::VectorXd &rhs) const
    {
      const FilmGeometry::Cell &cell = geometry.cells()[c];
      Coefficient               mean;
      unsigned                  n = 0;
      for (unsigned i = 0; i < 3; ++i)
        if (has_film(nodes[cell.node[i]]))
          {
            mean += *local[i];
            ++n;
          }
      mean.scale(1. / n);
      std::array<Coefficient, 3> filled;
      for (unsigned i = 0; i < 3; ++i)
        if (!has_film(nodes[cell.node[i]]))
          {
            filled[i]               = mean;
            filled[i].mean_velocity = local[i]->mean_velocity;
            filled[i].half_slip     = local[i]->half_slip;
            local[i]                = &filled[i];
          }
      add_cell(c, local, value, rhs);
    }

    /// int grad N_i . (h^3/(12 eta) PhiP) grad N_j  and  int grad N_i . (h (U1+U2)/2 + Sq PhiS (U1-U2)/2) - N_i
    /// squeeze.
    void
    add_cell(const std::size_t c, const std::array<const Coefficient *, 3> &local, double *value,
             Eigen::VectorXd &rhs) const
    {
      const FilmGeometry::Cell      &cell = geometry.cells()[c];
      std::array<Eigen::Vector2d, 3> velocity, slip;
      for (unsigned i = 0; i < 3; ++i)
        {
          velocity[i] = cell.axes.transpose() * local[i]->mean_velocity;
          slip[i]     = cell.axes.transpose() * local[i]->half_slip;
        }
      Eigen::Vector3d mobility = Eigen::Vector3d::Zero(), squeeze = Eigen::Vector3d::Zero();
      Eigen::Vector2d flux = Eigen::Vector2d::Zero();
      for (const auto &point : geometry.quadrature())
        {
          const auto           &N = point.shape_value;
          const double          w = point.weight * cell.area;
          const double          h = N[0] * local[0]->film + N[1] * local[1]->film + N[2] * local[2]->film;
          const double          f = N[0] * local[0]->fluidity + N[1] * local[1]->fluidity + N[2] * local[2]->fluidity;
          const double          s = N[0] * local[0]->squeeze + N[1] * local[1]->squeeze + N[2] * local[2]->squeeze;
          const Eigen::Vector2d v = N[0] * velocity[0] + N[1] * velocity[1] + N[2] * velocity[2];
          const Eigen::Vector2d u = N[0] * slip[0] + N[1] * slip[1] + N[2] * slip[2];
          mobility += (w * h * h * h * f) * (N[0] * local[0]->phi_p + N[1] * local[1]->phi_p + N[2] * local[2]->phi_p);
          const Eigen::Matrix2d sheared
              = N[0] * local[0]->sq_phi_s + N[1] * local[1]->sq_phi_s + N[2] * local[2]->sq_phi_s;
          flux += w * (h * v + sheared * u);
          squeeze += (w * s) * Eigen::Vector3d(N[0], N[1], N[2]);
        }
      Eigen::Matrix2d tensor;
      tensor << mobility[0], mobility[2], mobility[2], mobility[1];
      const Eigen::Matrix3d K = cell.material_gradient.transpose() * tensor * cell.material_gradient;
      const Eigen::Vector3d b = cell.material_gradient.transpose() * flux - squeeze;
      for (unsigned i = 0; i < 3; ++i)
        {
          rhs[cell.node[i]] += b[i];
          for (unsigned j = 0; j < 3; ++j)
            value[positions[c][3 * i + j]] += K(i, j);
        }
    }

    Result
    report(const std::vector<NodeData> &nodes, const Eigen::VectorXd &rhs, BoundedSystem::Result &&solution) const
    {
      const std::size_t n_nodes = geometry.n_nodes();
      Result            result;
      result.iterations = solution.iterations;
      result.converged  = solution.converged;
      result.pressure.assign(solution.x.data(), solution.x.data() + n_nodes);
      result.outflow.assign(solution.residual.data(), solution.residual.data() + n_nodes);
      result.opening_rate.assign(n_nodes, 0.);
      const Eigen::VectorXd area          = geometry.nodal_area();
      const Eigen::VectorXd pressure_flow = matrix * solution.x;
      double                sum = 0, magnitude = 0;
      for (std::size_t i = 0; i < n_nodes; ++i)
        if (solution.set[i] == BoundedSystem::at_upper)
          result.opening_rate[i] = std::max(0., solution.residual[i]) / area[i];
        else if (solution.set[i] == BoundedSystem::free && !nodes[i].fixed)
          {
            sum += solution.residual[i];
            magnitude += std::abs(rhs[i]) + std::abs(pressure_flow[i]);
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
    return data->report(nodes, rhs, data->system.solve(data->matrix, rhs, upper, std::move(set), std::move(x)));
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

  std::vector<Eigen::Vector3d>
  AverageReynolds::nodal_gradient(const std::vector<Eigen::Vector3d> &positions,
                                  const std::vector<double>          &pressure) const
  {
    data->geometry.move_to(positions);
    std::vector<Eigen::Vector3d> sum(positions.size(), Eigen::Vector3d::Zero());
    const Eigen::VectorXd        area = data->geometry.nodal_area();
    for (const auto &cell : data->geometry.cells())
      {
        const Eigen::Vector3d local(pressure[cell.node[0]], pressure[cell.node[1]], pressure[cell.node[2]]);
        for (const unsigned i : cell.node)
          sum[i] += cell.area / 3. * (cell.gradient * local);
      }
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] /= area[i];
    return sum;
  }
} // namespace tribodraw
