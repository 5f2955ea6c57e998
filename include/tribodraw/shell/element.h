#ifndef tribodraw_shell_element_h
#define tribodraw_shell_element_h

#include <tribodraw/material/sheet_material.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace tribodraw::shell_element
{
  // The Kirchhoff triangle with nodal directors: edge-smoothed membrane and discrete-Kirchhoff bending
  // (J.-L. Batoz, K.-J. Bathe, L.-W. Ho, Int. J. Numer. Meth. Engng 15 (1980) 1771), total Lagrangian.
  //
  // Membrane: C_ab = phi_a . phi_b with the tangent vectors phi_a = sum_i g_{i,a} x_i of the flat triangle. At a side
  // the metric is the mean of the two triangles that share it, weighted by their undeformed areas and with the
  // neighbour's axes turned about the side into the plane of this triangle (edge-based smoothing: G. R. Liu,
  // T. Nguyen-Thoi, K. Y. Lam, J. Sound Vib. 320 (2009) 1100). At a free edge it is the triangle's own, at a plane of
  // symmetry the mean with its mirror image.
  // Bending: the director d_i of a node has the covariant components b_{a,i} = phi_a . d_i, which vanish if it is
  // normal to the triangle. Along a side the deflection is cubic, hence at mid-side with unit direction s
  //   b_k = (1/2 I - 3/4 s s^T)(b_i + b_j);
  // quadratic interpolation gives the curvature kappa_ab = 1/2 (d_b b_a + d_a b_b).
  // At the height z (in the undeformed sheet) C(z) = C + 2 z lambda (kappa - kappa_0); lambda is the thickness stretch.
  // Integration over the triangle: the three mid-sides (exact to degree 2), each with the metric of its side.

  constexpr unsigned n_nodes     = 3;
  constexpr unsigned n_sides     = 3; ///< side k goes from node k to node (k + 1) % 3
  constexpr unsigned n_own_dofs  = 15;
  constexpr unsigned n_dofs      = 24; ///< own_dofs, then the displacements of the nodes opposite to the sides
  constexpr unsigned n_in_plane  = n_sides;
  constexpr unsigned n_covariant = 6; ///< b_{a,i}, at index 2 i + a

  /// Numbers of the unknowns of an element.
  constexpr unsigned
  displacement_dof(const unsigned node, const unsigned component)
  {
    return 3 * node + component;
  }
  constexpr unsigned
  director_dof(const unsigned node, const unsigned increment)
  {
    return 9 + 2 * node + increment;
  }
  /// Displacement of the neighbour's node that lies opposite to a side.
  constexpr unsigned
  opposite_dof(const unsigned side, const unsigned component)
  {
    return n_own_dofs + 3 * side + component;
  }

  using ForceVector   = Eigen::Matrix<double, n_dofs, 1>;
  using TangentMatrix = Eigen::Matrix<double, n_dofs, n_dofs, Eigen::RowMajor>;
  using BendingMatrix
      = Eigen::Matrix<double, 3, n_covariant, Eigen::RowMajor>; ///< (kappa_11, kappa_22, kappa_12) from b

  /// Quadrature over the thickness on [-1, 1]; the weights sum to one.
  struct ThicknessRule
  {
    std::vector<double> point, weight;
  };
  ThicknessRule make_thickness_rule(unsigned n, bool lobatto = false);
  /// Gauss points in each half of the thickness; @p n even, 4 to 10. The stress of bending has a kink at the
  /// mid-surface: the moment of a plastic section is 20 to 50 times more exact than with as many points in one rule.
  ThicknessRule make_halved_thickness_rule(unsigned n);

  /// Position, director and its two tangents e_1, e_2 of the three nodes.
  struct NodeState
  {
    /// Nodes of the neighbours opposite to the sides; of use only where Neighbours names one.
    std::array<Eigen::Vector3d, n_sides>                opposite{};
    std::array<Eigen::Vector3d, n_nodes>                position, director;
    std::array<std::array<Eigen::Vector3d, 2>, n_nodes> frame;
  };

  /// Turn director and frame by the director increments w_1, w_2: d moves by |w| along a great circle in the direction
  /// w_1 e_1 + w_2 e_2, and the frame with it.
  void turn(Eigen::Vector3d &director, std::array<Eigen::Vector3d, 2> &frame, double w1, double w2);
  /// Tangents of a director, e_1 along the projection of @p axis.
  std::array<Eigen::Vector3d, 2> frame_along(const Eigen::Vector3d &axis, const Eigen::Vector3d &director);

  /// What lies beyond the sides.
  struct Neighbours
  {
    std::array<bool, n_sides> present{};
    /// No neighbour, but the side lies in a plane of symmetry.
    std::array<bool, n_sides> mirrored{};
  };

  /// The metric at a side: own C + share C_neighbour.
  struct Side
  {
    Matrix3                           own   = Matrix3::Identity();
    double                            share = 0; ///< 0: no neighbour
    Eigen::Matrix<double, n_nodes, 2> gradient;  ///< of the neighbour: side's first and second node, opposite node
  };

  /// What stays constant during the computation.
  struct Reference
  {
    Eigen::Matrix<double, n_nodes, 2>     gradient; ///< g_{i,a}, along the axes of the material [1/mm]
    double                                area = 0; ///< [mm^2]
    std::array<Side, n_sides>             side;
    std::array<BendingMatrix, n_in_plane> bending;
    std::array<Vector3, n_in_plane>       initial_curvature; ///< [1/mm]
  };
  /// @p nodes the undeformed state; the first axis of the material is the x direction projected on the triangle (y,
  /// where x is normal to it).
  Reference make_reference(const NodeState &nodes, const Neighbours &neighbours = {});

  struct Section
  {
    double               thickness         = 0; ///< undeformed [mm]
    double               thickness_stretch = 1; ///< lambda
    const ThicknessRule *rule              = nullptr;
    const SheetMaterial *material          = nullptr;
  };

  struct Options
  {
    double time_increment  = 1;     ///< [s]
    bool   tangent         = true;  ///< also compute the stiffness
    bool   tension_only    = false; ///< geometric membrane stiffness from the tensile part of the membrane forces
    double elastic_blend   = 0;     ///< share of the elastic in the plastic tangent
    bool   loading_tangent = false;
  };

  /// Results of an element beside forces and stiffness.
  struct Summary
  {
    bool    valid            = false;           ///< not inverted and all points converged
    Vector3 mean_stress      = Vector3::Zero(); ///< logarithmic stress, mean over the volume [MPa]
    double  thickness_strain = 0;               ///< logarithmic, mean
    double  elastic_energy   = 0;               ///< [N mm]
    double  plastic_work     = 0;               ///< of the increment [N mm]
  };

  /// Integrate the element.
  /// @param old_states,new_states plastic states of the n_in_plane * rule.size() points, thickness points fastest
  /// @param force internal forces [N, N mm/rad], overwritten; zero for opposite nodes that do not exist
  /// @param tangent derivative of the forces by the degrees of freedom, overwritten if options.tangent; exact if
  ///        neither tension_only, elastic_blend nor loading_tangent are in use
  Summary integrate(const Reference &reference, const NodeState &nodes, const Section &section, const Options &options,
                    const PlasticState *old_states, PlasticState *new_states, ForceVector &force,
                    TangentMatrix &tangent);

  /// A point of integration in space: components xx, yy, zz, xy, yz, zx along the axes of the model.
  struct PointInSpace
  {
    std::array<double, 6> stress; ///< Cauchy stress [MPa]
    std::array<double, 6> strain; ///< logarithmic (shear: tensor components)
  };
  /// Stresses and strains of all points (thickness points fastest) that belong to @p states. The layers turn with the
  /// mid-surface.
  std::vector<PointInSpace> points_in_space(const Reference &reference, const NodeState &nodes, const Section &section,
                                            const PlasticState *states);

  /// Metric (C_11, C_22, C_12) of the mid-surface.
  Vector3 mid_surface_metric(const Reference &reference, const std::array<Eigen::Vector3d, n_nodes> &position);
  /// Metric at a side, of this triangle and its neighbour.
  Vector3 side_metric(const Reference &reference, const NodeState &nodes, unsigned side);
  /// Curvature (kappa_11, kappa_22, kappa_12) at an in-plane point.
  Vector3 curvature(const Reference &reference, const NodeState &nodes, unsigned in_plane_point);
} // namespace tribodraw::shell_element

#endif
