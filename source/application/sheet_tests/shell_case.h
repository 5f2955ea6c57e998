#ifndef source_application_sheet_tests_shell_case_h
#define source_application_sheet_tests_shell_case_h

#include <tribodraw/base/parameters.h>
#include <tribodraw/shell/static_analysis.h>
#include <tribodraw/shell/static_analysis_mesh.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  /// A shell with supports, loads and quantities to be measured, as a parameter file describes it. read() visits the
  /// entries of the current subsection; the other functions build what they say.
  struct ShellCase
  {
    using Side = SurfaceMesh::Side;

    struct Surface
    {
      std::array<std::string, 3> expression; ///< x, y, z in mm from u, v
      std::array<double, 2>      u_range{}, v_range{};
      unsigned                   n_u = 1, n_v = 1;
      GridPattern                pattern = GridPattern::alternating;
    };
    struct HeldPoint
    {
      Eigen::Vector3d     position;
      std::array<bool, 3> axes;
    };
    struct MovedSide
    {
      Side     side;
      unsigned component;
      double   displacement;
    };
    struct TurnedSide
    {
      Side   side;
      double angle; ///< about the direction of the side [rad]
    };
    struct PointForce
    {
      Eigen::Vector3d position, force;
    };
    struct SideLoad
    {
      Side            side;
      Eigen::Vector3d value; ///< force [N/mm] or moment [N] per undeformed length
    };
    struct Measure
    {
      std::string         name;
      Eigen::Vector3d     position;
      unsigned            component = 0;
      double              weight    = 1;
      std::vector<double> reference_factor, reference_displacement;
    };

    double                                        thickness = 0;
    unsigned                                      n_points  = 0;
    Shell::ThicknessPoints                        rule      = Shell::ThicknessPoints::gauss;
    Surface                                       surface;
    std::array<SideSupport, SurfaceMesh::n_sides> supports;
    std::vector<HeldPoint>                        held_points;
    std::vector<MovedSide>                        moved_sides;
    std::vector<TurnedSide>                       turned_sides;
    std::vector<PointForce>                       point_forces;
    std::vector<SideLoad>                         side_forces, side_moments;
    Eigen::Vector3d                               surface_force = Eigen::Vector3d::Zero();
    double                                        pressure      = 0;
    std::vector<Measure>                          measures;

    static ShellCase read(Parameters &parameters);

    SurfaceMesh mesh() const;
    /// @param with_motion also moved and turned sides; otherwise they are as free as without them
    Supports make_supports(Shell &shell, const SurfaceMesh &mesh, bool with_motion) const;
    Loads    make_loads(const SurfaceMesh &mesh) const;
    /// Forces and moments that hold the moved and turned sides in equilibrium, from the reactions of an analysis.
    Loads holding_loads(const Shell &shell, const SurfaceMesh &mesh, const Eigen::VectorXd &reactions) const;
    DisplacementMeasure measure(const Measure &quantity, const SurfaceMesh &mesh) const;
    /// Undeformed length of a side.
    static double length(const SurfaceMesh &mesh, Side side);
  };
} // namespace tribodraw

#endif
