#ifndef tribodraw_shell_static_analysis_mesh_h
#define tribodraw_shell_static_analysis_mesh_h

#include <tribodraw/shell/blank_mesh.h>
#include <tribodraw/shell/loads.h>

#include <array>
#include <functional>

namespace tribodraw
{
  /// A surface X(u, v) over a rectangle of parameters.
  struct ParametricSurface
  {
    /// Must be smooth and defined a little beyond the rectangle: tangents are central differences.
    std::function<Eigen::Vector3d(double u, double v)> position;
    double                                             u_min = 0, u_max = 1, v_min = 0, v_max = 1;

    Eigen::Vector3d u_tangent(double u, double v) const;
    Eigen::Vector3d v_tangent(double u, double v) const;
  };

  /// How the rectangle of parameters is cut into triangles.
  enum class GridPattern
  {
    alternating, ///< squares cut by diagonals of alternating direction
    parallel,    ///< squares cut by the diagonals from (u_min, v_min) towards (u_max, v_max)
    crossed,     ///< squares cut in four, with a node in the middle
    polar        ///< the side u = u_min is one point: ring k of n_u has k n_v squares' worth of sides
  };

  /// A meshed surface with the nodes of its four sides.
  struct SurfaceMesh
  {
    enum Side
    {
      u_min,
      u_max,
      v_min,
      v_max
    };
    static constexpr unsigned n_sides = 4;

    BlankMesh                    mesh; ///< normals along X_u x X_v
    std::array<NodeSet, n_sides> side; ///< ascending node numbers
    /// Unit tangent along the side, for each of its nodes (zero at a pole).
    std::array<std::vector<Eigen::Vector3d>, n_sides> tangent;

    /// Let the membrane of the triangles at a side see their mirror images in a plane of symmetry with normal @p axis.
    /// To be done before the shell is made, together with SideSupport::symmetry.
    void mirror(Side at, unsigned axis);
    /// The node nearest to a point.
    unsigned nearest(const Eigen::Vector3d &point) const;
  };

  /// Mesh a surface with n_u x n_v squares (or n_u rings of n_v, 2 n_v ... sides with the pattern polar).
  /// Throws InputError if the numbers are zero or the surface is not regular somewhere.
  SurfaceMesh make_surface_mesh(const ParametricSurface &surface, unsigned n_u, unsigned n_v,
                                GridPattern pattern = GridPattern::alternating);

  /// What holds a side of a surface.
  struct SideSupport
  {
    std::array<bool, 3> displacement{ { false, false, false } }; ///< x, y, z held
    bool                hold_along  = false; ///< the director does not turn towards the ends of the side
    bool                hold_across = false; ///< nor across the side
    int                 mirror      = -1;    ///< normal of a plane of symmetry (0, 1, 2), or -1

    static SideSupport clamped();
    /// No displacement; the sheet turns about the side.
    static SideSupport hinged();
    /// Displacements along the axes in @p axes held; the sheet turns about the side (hard support).
    static SideSupport supported(const std::array<bool, 3> &axes);
    /// Stiff in its plane with normal @p axis, free to warp.
    static SideSupport diaphragm(unsigned axis);
    static SideSupport symmetry(unsigned axis);
  };

  void apply_support(Supports &supports, const SurfaceMesh &surface, SurfaceMesh::Side side,
                     const SideSupport &support);
} // namespace tribodraw

#endif
