#ifndef tribodraw_contact_contact_points_h
#define tribodraw_contact_contact_points_h

#include <tribodraw/shell/shell.h>

#include <array>
#include <cstddef>
#include <vector>

namespace tribodraw
{
  /// The points of the sheet's middle surface that feel the tools: the nodes and the middles of the sides. The middle of a
  /// side lies on the curved sheet, not on the chord: along a side the deflection of the discrete Kirchhoff element is a
  /// cubic with the slopes of the directors d at its ends, hence
  ///   x = 1/2 (x_i + x_j) + 1/16 ((d_j - d_i) . (x_j - x_i)) (d_i + d_j)
  /// (for a circle the sagitta L^2/(8R)). A force at the middle therefore acts on directors too.
  class ContactPoints
  {
  public:
    static constexpr unsigned n_point_dofs = 2 * Shell::dofs_per_node;

    explicit ContactPoints(const Shell &shell);

    unsigned size() const { return static_cast<unsigned>(end.size()); }
    /// The nodes to which a point belongs: twice the same for a node.
    const std::array<unsigned, 2> &nodes(const unsigned point) const { return end[point]; }
    bool                           is_node(const unsigned point) const { return end[point][0] == end[point][1]; }

    Eigen::Vector3d position(const Shell::Configuration &configuration, unsigned point) const;
    /// Area of the sheet that belongs to each point [mm^2]: of every triangle 1/12 to each node and 1/4 to each side.
    std::vector<double> areas(const std::vector<Eigen::Vector3d> &position) const;
    /// Mean of the values at the two nodes.
    double mean(const std::vector<double> &nodal, const unsigned point) const
    {
      return 0.5 * (nodal[end[point][0]] + nodal[end[point][1]]);
    }

    /// Derivative of the position by the unknowns of the two nodes (5 each; of a node only its displacements).
    using Derivative = Eigen::Matrix<double, 3, n_point_dofs>;
    Derivative derivative(const Shell::Configuration &configuration, unsigned point) const;
    /// Work-conjugate forces on the unknowns: @p to += @p factor derivative^T @p force.
    void add_force(const Derivative &derivative, unsigned point, const Eigen::Vector3d &force, double factor, Eigen::Ref<Eigen::VectorXd> to) const;
    /// Add the derivative of - derivative^T force to @p tangent, where @p stiffness = - d force / d position.
    void add_tangent(const Shell::Configuration &configuration,
                     const Derivative           &derivative,
                     unsigned                    point,
                     const Eigen::Vector3d      &force,
                     const Eigen::Matrix3d      &stiffness,
                     SparseMatrix               &tangent);

  private:
    void find_positions(const SparseMatrix &tangent);

    const Shell                          &shell;
    std::vector<std::array<unsigned, 2>>  end;
    std::vector<std::array<unsigned, 3>>  side; // points in the middles of the sides of each triangle
    std::vector<std::array<std::size_t, 2 * n_point_dofs>> place; // of the first entry of each row and node in the tangent
    std::size_t                           known_entries = 0;
  };
} // namespace tribodraw

#endif
