#ifndef tribodraw_shell_loads_h
#define tribodraw_shell_loads_h

#include <tribodraw/base/sparse_system.h>
#include <tribodraw/shell/shell.h>

#include <array>
#include <functional>
#include <vector>

namespace tribodraw
{
  /// Numbers of nodes of a BlankMesh, ascending.
  using NodeSet = std::vector<unsigned>;
  /// The two nodes of a side of a triangle, in the direction in which the triangle goes round.
  using Edge = std::array<unsigned, 2>;

  /// Nodes whose undeformed position fulfils @p condition.
  NodeSet nodes_where(const BlankMesh &mesh, const std::function<bool(const Eigen::Vector3d &)> &condition);
  /// Sides that belong to one triangle only.
  std::vector<Edge> boundary_edges(const BlankMesh &mesh);
  /// Boundary sides with both ends in @p nodes.
  std::vector<Edge> boundary_edges(const BlankMesh &mesh, const NodeSet &nodes);

  /// External loads on a shell, all multiplied by one load factor, with their exact stiffness. Loads with different
  /// factors go into different objects. All forces are distributed with the linear interpolation of the position.
  class Loads
  {
  public:
    /// Dead force [N].
    void add_point_force(unsigned node, const Eigen::Vector3d &force);
    /// Moment of fixed direction [N mm]. Its part along the director does no work. Not conservative in general (the
    /// stiffness has an antisymmetric part moment . director); conservative where the director turns in one plane.
    void add_point_moment(unsigned node, const Eigen::Vector3d &moment);
    /// Dead force per undeformed length [N/mm].
    void add_edge_force(const BlankMesh &mesh, const std::vector<Edge> &edges, const Eigen::Vector3d &force_per_length);
    /// Moment of fixed direction per undeformed length [N mm/mm].
    void add_edge_moment(const BlankMesh &mesh, const std::vector<Edge> &edges,
                         const Eigen::Vector3d &moment_per_length);
    /// Dead force per undeformed area of all elements [N/mm^2], for example weight.
    void add_surface_force(const BlankMesh &mesh, const Eigen::Vector3d &force_per_area);
    /// Pressure [MPa] that acts along the normal of the deformed surface, on its deformed area, in the direction in
    /// which the triangles turn by the right-hand rule. All elements, or those in @p elements.
    void add_pressure(const BlankMesh &mesh, double pressure);
    void add_pressure(double pressure, const std::vector<unsigned> &elements);

    /// Subtract factor times the forces in the trial configuration of @p shell from @p residual (whole on each rank)
    /// and factor times their derivative from @p tangent, if given (on rank 0 only: the matrix is the sum over ranks).
    /// @p residual has n_dofs() or more entries.
    void subtract(const Shell &shell, double factor, Eigen::VectorXd &residual, SparseMatrix *tangent) const;
    /// Forces in the trial configuration at load factor one, n_dofs() entries.
    Eigen::VectorXd forces(const Shell &shell) const;

    /// False if the stiffness has an unsymmetric part (pressure on a surface with free edges, moments).
    bool conservative() const;

  private:
    struct NodeLoad
    {
      unsigned        node;
      Eigen::Vector3d value;
    };
    struct Pressure
    {
      double   value;
      unsigned element;
    };
    std::vector<NodeLoad> point_forces, point_moments;
    std::vector<Pressure> pressures;
  };

  /// Supports and prescribed motion, as marks and values of single unknowns.
  class Supports
  {
  public:
    explicit Supports(Shell &the_shell);

    /// Hold a component 0..4 (x, y, z, director increments along e_1, e_2).
    void fix(unsigned node, unsigned component);
    void fix(const NodeSet &nodes, const std::vector<unsigned> &components);
    /// No displacement and no rotation.
    void clamp(const NodeSet &nodes);
    /// No displacement, free rotation.
    void hinge(const NodeSet &nodes);
    /// No displacement; rotation only about @p edge_direction (hard simple support).
    void hinge(const NodeSet &nodes, const Eigen::Vector3d &edge_direction);
    /// Mirror plane with the normal x, y or z (0, 1, 2): no displacement across and the director stays in the plane.
    /// The directors must lie in the plane now. A node may lie on two planes.
    void mirror(const NodeSet &nodes, unsigned axis);
    /// Hold the director's increment along @p axis (its part perpendicular to the director): no turning in that
    /// direction. Two different directions at one node hold the director altogether.
    void hold_director(unsigned node, const Eigen::Vector3d &axis);
    /// Prescribed motion of a component: @p value at factor one.
    void prescribe(const NodeSet &nodes, unsigned component, double value);

    /// Marks of the unknowns that are held or prescribed, n_dofs() entries.
    const std::vector<bool> &
    fixed() const
    {
      return is_fixed;
    }
    /// Values of the prescribed unknowns at factor one, zero elsewhere.
    const Eigen::VectorXd &
    motion() const
    {
      return value;
    }

  private:
    Shell            &shell;
    std::vector<bool> is_fixed;
    Eigen::VectorXd   value;
  };
} // namespace tribodraw

#endif
