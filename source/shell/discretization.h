#ifndef tribodraw_shell_discretization_h
#define tribodraw_shell_discretization_h

#include <tribodraw/shell/blank_mesh.h>
#include <tribodraw/shell/element.h>

#include <array>
#include <memory>
#include <vector>

namespace tribodraw
{
  /// deal.II's part of the shell: triangulation of the blank, distributed over the ranks, and the numbering of
  /// its five unknowns a node.
  class Discretization
  {
  public:
    /// @param smoothed the metric of an element depends on its neighbours
    Discretization(const BlankMesh &mesh, bool smoothed);
    ~Discretization();

    unsigned n_dofs() const;
    unsigned
    dof(unsigned node, unsigned component) const
    {
      return node_dofs[node][component];
    }
    /// Numbers of an element's unknowns in the order of shell_element, for all elements; -1 for those of opposite
    /// nodes that do not exist. The five unknowns of a node follow each other.
    const std::array<int, shell_element::n_dofs> &
    element_dofs(unsigned element) const
    {
      return dofs[element];
    }
    /// Nodes opposite to the sides of an element; -1: none, or the metric is not smoothed.
    const std::array<int, shell_element::n_sides> &
    opposite_nodes(unsigned element) const
    {
      return opposite[element];
    }
    /// Elements this rank integrates, in ascending order.
    const std::vector<unsigned> &
    owned_elements() const
    {
      return owned;
    }

    /// Sorted columns of each row of the tangent of all elements, with @p n_extra unknowns behind that couple with
    /// the displacements of all nodes and with each other. The same on each rank, because contact
    /// may be evaluated on any of them.
    std::vector<std::vector<int>> columns(unsigned n_extra) const;

  private:
    struct FiniteElements;
    std::unique_ptr<FiniteElements>                      finite_elements;
    std::vector<std::array<unsigned, 5>>                 node_dofs;
    std::vector<std::array<int, shell_element::n_dofs>>  dofs;
    std::vector<std::array<int, shell_element::n_sides>> opposite;
    std::vector<unsigned>                                owned;
  };
} // namespace tribodraw

#endif
