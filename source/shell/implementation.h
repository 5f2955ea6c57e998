#ifndef tribodraw_shell_implementation_h
#define tribodraw_shell_implementation_h

#include <tribodraw/shell/element.h>
#include <tribodraw/shell/shell.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "discretization.h"

namespace tribodraw
{
  /// Data of the shell. Arrays marked "owned" have one entry for each element of this rank.
  struct Shell::Implementation
  {
    Implementation(const BlankMesh &mesh, double thickness, std::shared_ptr<const SheetMaterial> material,
                   shell_element::ThicknessRule rule, Membrane membrane);

    const BlankMesh                            mesh;
    const double                               thickness;
    const std::shared_ptr<const SheetMaterial> material;
    const shell_element::ThicknessRule         rule;
    const Discretization                       discretization;

    // Constant during the computation.
    std::vector<shell_element::Reference> reference; ///< owned
    /// Where the unknowns of the nodes of an element (own, then opposite) begin in the rows of the tangent, relative to
    /// the start of the row; absent: not coupled. Further unknowns stand at the end of the rows and do not change it.
    static constexpr std::uint16_t absent          = 0xffff;
    static constexpr unsigned      n_element_nodes = shell_element::n_nodes + shell_element::n_sides;
    std::vector<std::array<std::uint16_t, shell_element::n_dofs * n_element_nodes>> offset; ///< owned
    /// Elements of this rank to whose forces a node contributes, in ascending order, with its number in them.
    struct Contribution
    {
      unsigned element; ///< number among the owned ones
      unsigned role;    ///< 0..2 own node, 3..5 opposite node
    };
    std::vector<std::size_t>     contribution_start; ///< of each node
    std::vector<Contribution>    contributions;
    std::vector<double>          element_area, node_area; ///< undeformed, of all elements and nodes
    std::vector<Eigen::Vector3d> frame_axis;              ///< zero: free

    // State.
    Configuration                       trial, committed;
    std::vector<double>                 stretch; ///< of the thickness, at the last commit; owned
    std::vector<PlasticState>           old_points, new_points;
    std::vector<shell_element::Summary> old_summary, new_summary; ///< owned
    bool                                assembled = false;        ///< new_points belong to the trial configuration

    // Derived from the committed state.
    std::vector<double> node_thickness, node_eps_p;
    double              elastic_energy = 0, plastic_work = 0;

    // Work space of assemble(); owned.
    std::vector<shell_element::ForceVector>   forces;
    std::vector<shell_element::TangentMatrix> tangents;

    const std::vector<unsigned> &
    owned() const
    {
      return discretization.owned_elements();
    }
    std::size_t
    n_points() const
    {
      return shell_element::n_in_plane * rule.point.size();
    } ///< of an element
    void make_contributions();
    void make_offsets();
    /// Sum of the element forces and tangents at a node; @p force has all unknowns.
    void gather_forces(unsigned node, std::vector<double> &force) const;
    void gather_tangents(unsigned node, SparseMatrix &tangent) const;

    shell_element::NodeState node_state(unsigned element, const Configuration &configuration) const;
    /// Thickness means of the equivalent plastic strain and the largest value of an owned element.
    double mean_eps_p(const std::vector<PlasticState> &points, std::size_t owned_index) const;
    double max_eps_p(std::size_t owned_index) const;
    /// Update what is derived from the committed element states; collective.
    void update_derived();
    /// A value of each owned element, on all ranks; collective.
    template <class Function>
    std::vector<double> gather(const Function &value_of_owned) const;
  };
} // namespace tribodraw

#endif
