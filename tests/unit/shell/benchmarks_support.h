#ifndef tests_unit_shell_benchmarks_support_h
#define tests_unit_shell_benchmarks_support_h

#include <tribodraw/shell/static_analysis.h>
#include <tribodraw/shell/static_analysis_mesh.h>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>

#include "support.h"

/// The published shell benchmarks as models with a given number of elements.
namespace shell_benchmark
{
  using namespace shell_test;
  using Eigen::Vector3d;

  constexpr double pi = 3.14159265358979323846;

  /// A shell with supports and loads.
  struct Model
  {
    SurfaceMesh surface;
    Shell       shell;
    Supports    supports;
    Loads       loads, constant;

    Model(SurfaceMesh mesh, double thickness, std::shared_ptr<const SheetMaterial> material, unsigned n_points = 3,
          Shell::ThicknessPoints rule = Shell::ThicknessPoints::gauss)
        : surface(std::move(mesh)), shell(surface.mesh, thickness, std::move(material), n_points, rule), supports(shell)
    {
    }

    void
    hold(SurfaceMesh::Side side, const SideSupport &support)
    {
      apply_support(supports, surface, side, support);
    }
    void
    push(const Vector3d &point, const Vector3d &force)
    {
      loads.add_point_force(surface.nearest(point), force);
    }
    StaticAnalysis
    analysis(const StaticAnalysis::Settings &settings = {})
    {
      return StaticAnalysis(shell, supports, loads, constant, settings);
    }
    /// Displacement component of the node at @p point in the linear solution for load factor one.
    double
    linear(const Vector3d &point, unsigned component)
    {
      return analysis().linear_response()[shell.dof(surface.nearest(point), component)];
    }
    DisplacementMeasure
    at(const Vector3d &point, unsigned component, double weight = 1)
    {
      return DisplacementMeasure::at(surface.nearest(point), component, weight);
    }
  };

  inline SurfaceMesh
  surface(double u0, double u1, double v0, double v1, unsigned n_u, unsigned n_v, GridPattern pattern,
          std::function<Vector3d(double, double)> position)
  {
    return make_surface_mesh({ std::move(position), u0, u1, v0, v1 }, n_u, n_v, pattern);
  }

  inline SurfaceMesh
  flat(double lx, double ly, unsigned n_x, unsigned n_y, GridPattern pattern = GridPattern::alternating)
  {
    return surface(0, lx, 0, ly, n_x, n_y, pattern, [](double u, double v) { return Vector3d(u, v, 0); });
  }

  /// Quarter of a disc in n rings.
  inline SurfaceMesh
  disc(double radius, unsigned n)
  {
    return surface(0, radius, 0, pi / 2, n, 1, GridPattern::polar,
                   [](double r, double a) { return Vector3d(r * std::cos(a), r * std::sin(a), 0); });
  }

  /// Cylinder about the x axis; u: axial, v: angle from the z axis towards y.
  inline SurfaceMesh
  cylinder(double radius, double x0, double x1, double a0, double a1, unsigned n_x, unsigned n_a,
           GridPattern pattern = GridPattern::alternating)
  {
    return surface(x0, x1, a0, a1, n_x, n_a, pattern,
                   [radius](double x, double a) { return Vector3d(x, radius * std::sin(a), radius * std::cos(a)); });
  }

  using Side = SurfaceMesh::Side;

  // ---- linear obstacle course ----

  /// Scordelis-Lo roof, a quarter. R = 25, L = 50, 40 degrees, t = 0.25, E = 4.32e8, nu = 0, 90 per area.
  inline std::unique_ptr<Model>
  scordelis_lo(unsigned n, GridPattern pattern)
  {
    auto m = std::make_unique<Model>(cylinder(25, 0, 25, 0, 40 * pi / 180, n, n, pattern), 0.25,
                                     elastic_material(4.32e8, 0));
    m->hold(Side::u_min, SideSupport::symmetry(0));
    m->hold(Side::u_max, SideSupport::diaphragm(0));
    m->hold(Side::v_min, SideSupport::symmetry(1));
    m->loads.add_surface_force(m->surface.mesh, { 0, 0, -90 });
    return m;
  }

  /// Pinched cylinder with diaphragms, an octant. R = 300, L = 600, t = 3, E = 3e6, nu = 0.3, P = 1.
  inline std::unique_ptr<Model>
  pinched_cylinder(unsigned n, GridPattern pattern, double t = 3)
  {
    auto m = std::make_unique<Model>(cylinder(300, 0, 300, 0, pi / 2, n, n, pattern), t, elastic_material(3e6, 0.3));
    m->hold(Side::u_min, SideSupport::symmetry(0));
    m->hold(Side::u_max, SideSupport::diaphragm(0));
    m->hold(Side::v_min, SideSupport::symmetry(1));
    m->hold(Side::v_max, SideSupport::symmetry(2));
    m->push({ 0, 0, 300 }, { 0, 0, -0.25 });
    return m;
  }

  /// Hemisphere with a hole of 18 degrees, a quarter: pulled along x, pushed along y, each force per quarter.
  inline std::unique_ptr<Model>
  hemisphere_with_hole(unsigned n, GridPattern pattern, double force)
  {
    const double R = 10;
    // u: latitude from the equator, v: longitude
    auto m = std::make_unique<Model>(surface(0, 72 * pi / 180, 0, pi / 2, n, n, pattern,
                                             [R](double b, double a) {
                                               return Vector3d(R * std::cos(b) * std::cos(a),
                                                               R * std::cos(b) * std::sin(a), R * std::sin(b));
                                             }),
                                     0.04, elastic_material(6.825e7, 0.3));
    m->hold(Side::v_min, SideSupport::symmetry(1));
    m->hold(Side::v_max, SideSupport::symmetry(0));
    m->supports.fix(m->surface.nearest({ R * std::cos(72 * pi / 180), 0, R * std::sin(72 * pi / 180) }), 2);
    m->push({ R, 0, 0 }, { force, 0, 0 });
    m->push({ 0, R, 0 }, { 0, -force, 0 });
    return m;
  }

  /// The closed hemisphere.
  inline std::unique_ptr<Model>
  closed_hemisphere(unsigned n, double force)
  {
    const double R = 10;
    auto         m = std::make_unique<Model>(surface(0, pi / 2, 0, pi / 2, n, 1, GridPattern::polar,
                                                     [R](double b, double a) {
                                               return Vector3d(R * std::sin(b) * std::cos(a),
                                                                       R * std::sin(b) * std::sin(a), R * std::cos(b));
                                             }),
                                     0.04, elastic_material(6.825e7, 0.3));
    m->hold(Side::v_min, SideSupport::symmetry(1));
    m->hold(Side::v_max, SideSupport::symmetry(0));
    m->supports.fix(m->surface.nearest({ 0, 0, R }), 2);
    m->push({ R, 0, 0 }, { force, 0, 0 });
    m->push({ 0, R, 0 }, { 0, -force, 0 });
    return m;
  }

  // ---- Sze, Liu, Lo (2004) ----

  inline std::unique_ptr<Model>
  slit_annulus(unsigned n_r, unsigned n_a, GridPattern pattern)
  {
    // u: radius, v: angle; clamped at angle 0, the other side of the slit is lifted
    auto m = std::make_unique<Model>(
        surface(6, 10, 0, 2 * pi, n_r, n_a, pattern,
                [](double r, double a) { return Vector3d(r * std::cos(a), r * std::sin(a), 0); }),
        0.03, elastic_material(21e6, 0));
    m->hold(Side::v_min, SideSupport::clamped());
    m->loads.add_edge_force(m->surface.mesh, boundary_edges(m->surface.mesh, m->surface.side[Side::v_max]),
                            { 0, 0, 0.8 });
    return m;
  }

  /// Pull-out of an open cylinder, an octant; P = 40000 at factor one.
  inline std::unique_ptr<Model>
  open_cylinder(unsigned n_x, unsigned n_a, GridPattern pattern)
  {
    auto m = std::make_unique<Model>(cylinder(4.953, 0, 10.35 / 2, 0, pi / 2, n_x, n_a, pattern), 0.094,
                                     elastic_material(10.5e6, 0.3125));
    m->hold(Side::u_min, SideSupport::symmetry(0));
    m->hold(Side::v_min, SideSupport::symmetry(1));
    m->hold(Side::v_max, SideSupport::symmetry(2));
    m->push({ 0, 0, 4.953 }, { 0, 0, 10000 });
    return m;
  }

  /// Pinched cylinder with rigid diaphragms, large displacement, an octant; P = 12000 at factor one.
  inline std::unique_ptr<Model>
  pinched_cylinder_large(unsigned n, GridPattern pattern)
  {
    auto m = std::make_unique<Model>(cylinder(100, 0, 100, 0, pi / 2, n, n, pattern), 1, elastic_material(30e3, 0.3));
    m->hold(Side::u_min, SideSupport::symmetry(0));
    m->hold(Side::u_max, SideSupport::diaphragm(0));
    m->hold(Side::v_min, SideSupport::symmetry(1));
    m->hold(Side::v_max, SideSupport::symmetry(2));
    m->push({ 0, 0, 100 }, { 0, 0, -3000 });
    return m;
  }

  /// Cylindrical roof hinged along its straight sides, a quarter; P = 3000 at factor one.
  inline std::unique_ptr<Model>
  hinged_roof(unsigned n, double thickness, GridPattern pattern)
  {
    auto m = std::make_unique<Model>(cylinder(2540, 0, 254, 0, 0.1, n, n, pattern), thickness,
                                     elastic_material(3102.75, 0.3));
    m->hold(Side::u_min, SideSupport::symmetry(0));
    m->hold(Side::v_min, SideSupport::symmetry(1));
    m->hold(Side::v_max, SideSupport::hinged());
    m->push({ 0, 0, 2540 }, { 0, 0, -750 });
    return m;
  }
} // namespace shell_benchmark

#endif
