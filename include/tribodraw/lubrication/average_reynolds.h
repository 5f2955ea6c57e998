#ifndef tribodraw_lubrication_average_reynolds_h
#define tribodraw_lubrication_average_reynolds_h

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace tribodraw
{
  /// The average Reynolds equation (paper, Eq. 2) on a surface of triangles in space:
  ///   div( h^3/(12 eta) PhiP grad p ) = div( h (U1+U2)/2 + Sq PhiS (U1-U2)/2 ) + squeeze
  /// with linear elements for the pressure (FE_SimplexP<2,3>(1)), no flow through the border of the mesh unless the
  /// pressure is prescribed, and 0 <= p <= p_limit as an obstacle problem (primal-dual active set). Tensors are given
  /// in the axes of the undeformed blank and turn with the material (rotation part of the element's deformation
  /// gradient). PhiP is symmetric by its definition (homogenisation); its symmetric part is used.
  ///
  /// Film, 1/viscosity, tensors and velocities vary linearly between the nodes, and the products are integrated
  /// exactly. A node without film (film or viscosity 0; it must be fixed) takes the mean of the other nodes of the
  /// triangle; a triangle of fixed nodes only is skipped if one of them has no film. Not to be used by two threads at a
  /// time (the geometry of the last positions is kept).
  class AverageReynolds
  {
  public:
    /// What the equation needs at a node. All in mm, N, s.
    struct NodeData
    {
      bool            fixed          = true; ///< pressure prescribed (out of contact, starved, border)
      double          fixed_pressure = 0;
      double          film           = 0; ///< h_avg [mm]
      double          viscosity      = 0; ///< [MPa s]
      Eigen::Matrix2d phi_p          = Eigen::Matrix2d::Identity();
      Eigen::Matrix2d sq_phi_s       = Eigen::Matrix2d::Zero(); ///< Sq PhiS [mm]
      Eigen::Vector3d sheet_velocity = Eigen::Vector3d::Zero(); ///< U1 [mm/s]
      Eigen::Vector3d tool_velocity  = Eigen::Vector3d::Zero(); ///< U2 [mm/s]
      /// W [mm/s]: the flow is taken relative to a mesh that moves so; zero in the frame in which the gap is steady.
      Eigen::Vector3d mesh_velocity = Eigen::Vector3d::Zero();
      double          squeeze        = 0;                       ///< d h_avg / d t at fixed tool point [mm/s]
      double          squeeze_slope  = 0; ///< d squeeze / d pressure >= 0, `squeeze` being that at p = 0 [mm/s/MPa]
      double          p_limit        = 1e300;                   ///< largest pressure the contact can carry [MPa]
    };
    struct Result
    {
      std::vector<double> pressure; ///< [MPa]
      std::vector<double>
               opening_rate; ///< multiplier of p <= p_limit per node area [mm/s]: how fast the gap would open there
      unsigned iterations     = 0; ///< of the active set
      bool     converged      = true;
      double   flux_imbalance = 0; ///< |sum of residuals| / sum of |source| + |pressure flow| over free nodes
      /// Flow that leaves the film at a node [mm^3/s]: through the border or a node of prescribed pressure; at a node
      /// on p_limit the volume that opens the gap, at a cavitating node (negative) the volume that is missing.
      /// Consistent with the weak form, so that its sum plus the squeezed volume per time is zero to round-off.
      std::vector<double> outflow;
    };

    /// @param reference positions of the nodes in the undeformed blank (plane), for the material axes.
    ///                  Only x and y are used; the blank's axes are the axes x and y of space.
    /// @param phi_p_floor smallest eigenvalue of PhiP (numerical control): below percolation PhiP is zero and trapped
    ///                    pockets would carry an undefined pressure. 1e-2 to 1e-4 gave the same drawing force.
    AverageReynolds(const std::vector<Eigen::Vector3d>         &reference,
                    const std::vector<std::array<unsigned, 3>> &triangles, double phi_p_floor = 1e-3);
    ~AverageReynolds();

    /// Solve on the surface with nodes at @p positions.
    /// @param start pressures from which the active sets start (may be empty).
    Result solve(const std::vector<Eigen::Vector3d> &positions, const std::vector<NodeData> &nodes,
                 const std::vector<double> &start = {}) const;

    /// Load (integral of p) for given positions.
    double load(const std::vector<Eigen::Vector3d> &positions, const std::vector<double> &pressure) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };
} // namespace tribodraw

#endif
