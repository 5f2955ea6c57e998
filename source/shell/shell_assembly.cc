#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/shell/shell.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "implementation.h"

namespace tribodraw
{
  using namespace shell_element;

  namespace
  {
    /// Elements that are worth a thread: some 0.3 ms of work.
    constexpr std::size_t elements_per_thread = 32;

    void
    scatter(const TangentMatrix &local, const std::array<int, shell_element::n_dofs> &dofs,
            const std::array<std::uint16_t, shell_element::n_dofs * shell_element::n_dofs> &offset,
            SparseMatrix                                                                   &tangent)
    {
      for (unsigned i = 0; i < shell_element::n_dofs; ++i)
        {
          double              *row   = tangent.values().data() + tangent.row_start()[dofs[i]];
          const std::uint16_t *where = offset.data() + i * shell_element::n_dofs;
          for (unsigned j = 0; j < shell_element::n_dofs; ++j)
            row[where[j]] += local(i, j);
        }
    }
  } // namespace

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

    // Sums in the order of the elements, whatever thread computed them: the same bits each time.
    std::vector<double> force(n_dofs(), 0.);
    for (std::size_t k = 0; k < d.owned().size(); ++k)
      {
        const auto &dofs = d.discretization.element_dofs(d.owned()[k]);
        for (unsigned i = 0; i < shell_element::n_dofs; ++i)
          force[dofs[i]] += d.forces[k][i];
        if (tangent)
          scatter(d.tangents[k], dofs, d.offset[k], *tangent);
      }
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
