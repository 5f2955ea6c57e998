#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/shell/shell.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "implementation.h"

namespace tribodraw
{
  using namespace shell_element;

  namespace
  {
    /// Elements that are worth a thread: some 0.3 ms of work.
    constexpr std::size_t elements_per_thread = 32;

    /// Nodes that are worth a thread.
    constexpr std::size_t nodes_per_thread = 128;
  } // namespace

  void
  Shell::Implementation::make_contributions()
  {
    const auto for_each = [&](const auto &action) {
      for (unsigned k = 0; k < owned().size(); ++k)
        for (unsigned i = 0; i < shell_element::n_nodes; ++i)
          {
            action(mesh.triangles[owned()[k]][i], Contribution{ k, i });
            const int opposite = discretization.opposite_nodes(owned()[k])[i];
            if (opposite >= 0)
              action(static_cast<unsigned>(opposite), Contribution{ k, shell_element::n_nodes + i });
          }
    };
    contribution_start.assign(mesh.nodes.size() + 1, 0);
    for_each([&](const unsigned node, const Contribution &) { ++contribution_start[node + 1]; });
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
      contribution_start[node + 1] += contribution_start[node];
    contributions.resize(contribution_start.back());
    std::vector<std::size_t> next = contribution_start;
    for_each([&](const unsigned node, const Contribution &c) { contributions[next[node]++] = c; });
  }

  void
  Shell::Implementation::make_offsets()
  {
    const SparseMatrix pattern(discretization.columns(0));
    offset.resize(owned().size());
    for (std::size_t k = 0; k < owned().size(); ++k)
      {
        const auto &dofs = discretization.element_dofs(owned()[k]);
        offset[k].fill(absent);
        for (unsigned i = 0; i < shell_element::n_dofs; ++i)
          for (unsigned node = 0; node < n_element_nodes; ++node)
            {
              const unsigned j             = node < shell_element::n_nodes ? displacement_dof(node, 0)
                                                                           : opposite_dof(node - shell_element::n_nodes, 0);
              const bool     two_opposites = i >= n_own_dofs && node >= shell_element::n_nodes && i / 3 != j / 3;
              if (dofs[i] < 0 || dofs[j] < 0 || two_opposites)
                continue;
              const std::size_t distance = pattern.position(dofs[i], dofs[j]) - pattern.row_start()[dofs[i]];
              if (distance >= absent)
                throw std::logic_error("A row of the tangent is too long: too many elements meet at a node.");
              offset[k][i * n_element_nodes + node] = static_cast<std::uint16_t>(distance);
            }
      }
  }

  void
  Shell::Implementation::gather_forces(const unsigned node, std::vector<double> &force) const
  {
    double *const to = &force[discretization.dof(node, 0)];
    for (std::size_t n = contribution_start[node]; n < contribution_start[node + 1]; ++n)
      {
        const Contribution &c   = contributions[n];
        const ForceVector  &f   = forces[c.element];
        const bool          own = c.role < shell_element::n_nodes;
        const unsigned first    = own ? displacement_dof(c.role, 0) : opposite_dof(c.role - shell_element::n_nodes, 0);
        for (unsigned i = 0; i < 3; ++i)
          to[i] += f[first + i];
        if (own)
          for (unsigned t = 0; t < 2; ++t)
            to[3 + t] += f[director_dof(c.role, t)];
      }
  }

  void
  Shell::Implementation::gather_tangents(const unsigned node, SparseMatrix &tangent) const
  {
    for (std::size_t n = contribution_start[node]; n < contribution_start[node + 1]; ++n)
      {
        const Contribution &contribution = contributions[n];
        const bool          own          = contribution.role < shell_element::n_nodes;
        for (unsigned component = 0; component < (own ? dofs_per_node : 3); ++component)
          {
            const unsigned i    = !own            ? opposite_dof(contribution.role - shell_element::n_nodes, component)
                                  : component < 3 ? displacement_dof(contribution.role, component)
                                                  : director_dof(contribution.role, component - 3);
            double        *row  = tangent.values().data() + tangent.row_start()[discretization.dof(node, component)];
            const double  *from = tangents[contribution.element].data() + i * shell_element::n_dofs;
            const std::uint16_t *const where = offset[contribution.element].data() + i * n_element_nodes;
            for (unsigned m = 0; m < shell_element::n_nodes; ++m)
              {
                double *to = row + where[m];
                for (unsigned c = 0; c < 3; ++c)
                  to[c] += from[displacement_dof(m, c)];
                for (unsigned t = 0; t < 2; ++t)
                  to[3 + t] += from[director_dof(m, t)];
              }
            for (unsigned m = 0; m < n_sides; ++m)
              if (where[shell_element::n_nodes + m] != absent)
                for (unsigned c = 0; c < 3; ++c)
                  row[where[shell_element::n_nodes + m] + c] += from[opposite_dof(m, c)];
          }
      }
  }

  bool
  Shell::assemble(const double time_increment, const AssemblyOptions &options, Eigen::VectorXd &internal_force,
                  SparseMatrix *tangent)
  {
    const timing::Scope timer("shell/assemble");
    Implementation     &d = *data;
    if (tangent && tangent->size() < static_cast<int>(n_dofs()))
      throw std::logic_error("Shell::assemble: the matrix was not made by make_matrix().");

    Options element_options;
    element_options.time_increment  = time_increment;
    element_options.tangent         = tangent != nullptr;
    element_options.tension_only    = options.tension_only;
    element_options.elastic_blend   = options.elastic_blend;
    element_options.loading_tangent = options.loading_tangent;

    std::atomic<bool> valid{ true };
    parallel::for_range(d.owned().size(), elements_per_thread, [&](const std::size_t begin, const std::size_t end) {
      for (std::size_t k = begin; k < end && valid; ++k)
        {
          const Section section{ d.thickness, d.stretch[k], &d.rule, d.material.get() };
          d.new_summary[k]
              = integrate(d.reference[k], d.node_state(d.owned()[k], d.trial), section, element_options,
                          &d.old_points[k * d.n_points()], &d.new_points[k * d.n_points()], d.forces[k], d.tangents[k]);
          if (!d.new_summary[k].valid)
            valid = false;
        }
    });
    d.assembled = !parallel::any(!valid);
    if (!d.assembled)
      return false;

    // Sums at a node in the order of the elements, whatever thread computes them: the same bits each time.
    std::vector<double> force(n_dofs(), 0.);
    parallel::for_range(n_nodes(), nodes_per_thread, [&](const std::size_t begin, const std::size_t end) {
      for (unsigned node = static_cast<unsigned>(begin); node < end; ++node)
        {
          d.gather_forces(node, force);
          if (tangent)
            d.gather_tangents(node, *tangent);
        }
    });
    parallel::sum(force);
    internal_force.setZero(tangent ? tangent->size() : static_cast<Eigen::Index>(n_dofs()));
    internal_force.head(n_dofs()) = Eigen::Map<const Eigen::VectorXd>(force.data(), n_dofs());
    return true;
  }

  void
  Shell::commit()
  {
    Implementation &d = *data;
    if (!d.assembled)
      throw std::logic_error("Shell::commit: the trial configuration was not assembled (or not successfully).");
    d.committed = d.trial;
    std::swap(d.old_points, d.new_points);
    d.old_summary = d.new_summary;
    double work   = 0;
    for (std::size_t k = 0; k < d.owned().size(); ++k)
      {
        d.stretch[k] = std::exp(d.new_summary[k].thickness_strain);
        work += d.new_summary[k].plastic_work;
      }
    d.plastic_work += parallel::sum(work);
    d.assembled = false;
    d.update_derived();
  }
} // namespace tribodraw
