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

  using Side         = SurfaceMesh::Side;
  using SideSupports = std::vector<std::pair<Side, SideSupport>>;

  /// Membranes see their mirror images at the sides of symmetry.
  inline SurfaceMesh
  mirrored(SurfaceMesh mesh, const SideSupports &held)
  {
    for (const auto &[side, support] : held)
      if (support.mirror >= 0)
        mesh.mirror(side, static_cast<unsigned>(support.mirror));
    return mesh;
  }

  /// A shell with supports and loads.
  struct Model
  {
    SurfaceMesh surface;
    Shell       shell;
    Supports    supports;
    Loads       loads, constant;

    Model(SurfaceMesh mesh, const SideSupports &held, double thickness, std::shared_ptr<const SheetMaterial> material,
          unsigned n_points = 3, Shell::ThicknessPoints rule = Shell::ThicknessPoints::gauss)
        : surface(mirrored(std::move(mesh), held)), shell(surface.mesh, thickness, std::move(material), n_points, rule),
          supports(shell)
    {
      for (const auto &[side, support] : held)
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
    /// Strain energy of the linear solution for load factor one.
    double
    linear_energy()
    {
      StaticAnalysis a = analysis();
      return a.linear_energy(a.linear_response());
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

  // ---- linear obstacle course ----

  /// Scordelis-Lo roof, a quarter. R = 25, L = 50, 40 degrees, t = 0.25, E = 4.32e8, nu = 0, 90 per area.
  inline std::unique_ptr<Model>
  scordelis_lo(unsigned n, GridPattern pattern)
  {
    auto m = std::make_unique<Model>(cylinder(25, 0, 25, 0, 40 * pi / 180, n, n, pattern),
                                     SideSupports{ { Side::u_min, SideSupport::symmetry(0) },
                                                   { Side::u_max, SideSupport::diaphragm(0) },
                                                   { Side::v_min, SideSupport::symmetry(1) } },
                                     0.25, elastic_material(4.32e8, 0));
    m->loads.add_surface_force(m->surface.mesh, { 0, 0, -90 });
    return m;
  }

  /// Pinched cylinder with diaphragms, an octant. R = 300, L = 600, t = 3, E = 3e6, nu = 0.3, P = 1.
  inline std::unique_ptr<Model>
  pinched_cylinder(unsigned n, GridPattern pattern, double t = 3)
  {
    auto m = std::make_unique<Model>(cylinder(300, 0, 300, 0, pi / 2, n, n, pattern),
                                     SideSupports{ { Side::u_min, SideSupport::symmetry(0) },
                                                   { Side::u_max, SideSupport::diaphragm(0) },
                                                   { Side::v_min, SideSupport::symmetry(1) },
                                                   { Side::v_max, SideSupport::symmetry(2) } },
                                     t, elastic_material(3e6, 0.3));
    m->push({ 0, 0, 300 }, { 0, 0, -0.25 });
    return m;
  }

  /// Hemisphere with a hole of 18 degrees, a quarter: pulled along x, pushed along y, each force per quarter.
  inline std::unique_ptr<Model>
  hemisphere_with_hole(unsigned n, GridPattern pattern, double force)
  {
    const double R = 10;
    // u: latitude from the equator, v: longitude
    auto m = std::make_unique<Model>(
        surface(0, 72 * pi / 180, 0, pi / 2, n, n, pattern,
                [R](double b, double a) {
                  return Vector3d(R * std::cos(b) * std::cos(a), R * std::cos(b) * std::sin(a), R * std::sin(b));
                }),
        SideSupports{ { Side::v_min, SideSupport::symmetry(1) }, { Side::v_max, SideSupport::symmetry(0) } }, 0.04,
        elastic_material(6.825e7, 0.3));
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
    auto         m = std::make_unique<Model>(
        surface(0, pi / 2, 0, pi / 2, n, 1, GridPattern::polar,
                        [R](double b, double a) {
                  return Vector3d(R * std::sin(b) * std::cos(a), R * std::sin(b) * std::sin(a), R * std::cos(b));
                }),
        SideSupports{ { Side::v_min, SideSupport::symmetry(1) }, { Side::v_max, SideSupport::symmetry(0) } }, 0.04,
        elastic_material(6.825e7, 0.3));
    m->supports.fix(m->surface.nearest({ 0, 0, R }), 2);
    m->push({ R, 0, 0 }, { force, 0, 0 });
    m->push({ 0, R, 0 }, { 0, -force, 0 });
    return m;
  }

  /// Raasch's hook: a strip of width 20 and thickness 2 bent to an arc of 60 degrees, R = 14, and one of 150 degrees
  /// the other way, R = 46; clamped at the small arc, shear of 0.05 per length along the width at the other end. E =
  /// 3300. 9 n x n_w squares; z is the width, the strip begins at the origin along x.
  inline std::unique_ptr<Model>
  raasch_hook(unsigned n, unsigned n_w, double nu, double t = 2)
  {
    const auto position = [](double u, double z) {
      const double a = std::min(u, 1.) * pi / 3, b = pi / 6 + std::max(u - 1, 0.) * 150. / 8 * pi / 180;
      if (u <= 1)
        return Vector3d(14 * std::sin(a), 14 * (1 - std::cos(a)), z);
      return Vector3d((14 + 46) * std::sin(pi / 3) - 46 * std::cos(b), 14 - (14 + 46) * 0.5 + 46 * std::sin(b), z);
    };
    auto m = std::make_unique<Model>(surface(0, 9, 0, 20, 9 * n, n_w, GridPattern::alternating, position),
                                     SideSupports{ { Side::u_min, SideSupport::clamped() } }, t,
                                     elastic_material(3300, nu));
    m->loads.add_edge_force(m->surface.mesh, boundary_edges(m->surface.mesh, m->surface.side[Side::u_max]),
                            { 0, 0, 0.05 });
    return m;
  }

  /// Clamped hyperbolic paraboloid z = x^2 - y^2 over a square of side 1, a half; weight 8000 t. E = 2e11, nu = 0.3.
  inline std::unique_ptr<Model>
  clamped_hypar(unsigned n, double t)
  {
    auto m = std::make_unique<Model>(
        surface(-0.5, 0.5, 0, 0.5, 2 * n, n, GridPattern::alternating,
                [](double x, double y) { return Vector3d(x, y, x * x - y * y); }),
        SideSupports{ { Side::u_min, SideSupport::clamped() }, { Side::v_min, SideSupport::symmetry(1) } }, t,
        elastic_material(2e11, 0.3));
    m->loads.add_surface_force(m->surface.mesh, { 0, 0, -8000 * t });
    return m;
  }

  /// Strip of length 12 and width 1.1 along x, twisted by 90 degrees, clamped at x = 0; unit force along @p axis at the
  /// other end, where the width is along z. E = 29e6, nu = 0.22.
  inline std::unique_ptr<Model>
  twisted_beam(unsigned n_x, unsigned n_w, double t, unsigned axis)
  {
    auto m = std::make_unique<Model>(surface(0, 12, -0.55, 0.55, n_x, n_w, GridPattern::alternating,
                                             [](double x, double s) {
                                               const double a = x / 12 * pi / 2;
                                               return Vector3d(x, s * std::cos(a), s * std::sin(a));
                                             }),
                                     SideSupports{ { Side::u_min, SideSupport::clamped() } }, t,
                                     elastic_material(29e6, 0.22));
    m->loads.add_edge_force(m->surface.mesh, boundary_edges(m->surface.mesh, m->surface.side[Side::u_max]),
                            Vector3d::Unit(axis) / 1.1);
    return m;
  }

  /// Pinched cylinder with free ends, an octant; P = 100. R = 4.953, L = 10.35, E = 10.5e6, nu = 0.3125.
  inline std::unique_ptr<Model>
  pinched_free_cylinder(unsigned n, double t)
  {
    auto m = std::make_unique<Model>(cylinder(4.953, 0, 10.35 / 2, 0, pi / 2, n, n),
                                     SideSupports{ { Side::u_min, SideSupport::symmetry(0) },
                                                   { Side::v_min, SideSupport::symmetry(1) },
                                                   { Side::v_max, SideSupport::symmetry(2) } },
                                     t, elastic_material(10.5e6, 0.3125));
    m->push({ 0, 0, 4.953 }, { 0, 0, -25 });
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
        SideSupports{ { Side::v_min, SideSupport::clamped() } }, 0.03, elastic_material(21e6, 0));
    m->loads.add_edge_force(m->surface.mesh, boundary_edges(m->surface.mesh, m->surface.side[Side::v_max]),
                            { 0, 0, 0.8 });
    return m;
  }

  /// Pull-out of an open cylinder, an octant; P = 40000 at factor one.
  inline std::unique_ptr<Model>
  open_cylinder(unsigned n_x, unsigned n_a, GridPattern pattern)
  {
    auto m = std::make_unique<Model>(cylinder(4.953, 0, 10.35 / 2, 0, pi / 2, n_x, n_a, pattern),
                                     SideSupports{ { Side::u_min, SideSupport::symmetry(0) },
                                                   { Side::v_min, SideSupport::symmetry(1) },
                                                   { Side::v_max, SideSupport::symmetry(2) } },
                                     0.094, elastic_material(10.5e6, 0.3125));
    m->push({ 0, 0, 4.953 }, { 0, 0, 10000 });
    return m;
  }

  /// Pinched cylinder with rigid diaphragms, large displacement, an octant; P = 12000 at factor one.
  inline std::unique_ptr<Model>
  pinched_cylinder_large(unsigned n, GridPattern pattern)
  {
    auto m = std::make_unique<Model>(cylinder(100, 0, 100, 0, pi / 2, n, n, pattern),
                                     SideSupports{ { Side::u_min, SideSupport::symmetry(0) },
                                                   { Side::u_max, SideSupport::diaphragm(0) },
                                                   { Side::v_min, SideSupport::symmetry(1) },
                                                   { Side::v_max, SideSupport::symmetry(2) } },
                                     1, elastic_material(30e3, 0.3));
    m->push({ 0, 0, 100 }, { 0, 0, -3000 });
    return m;
  }

  /// Cylindrical roof hinged along its straight sides, a quarter; P = 3000 at factor one.
  inline std::unique_ptr<Model>
  hinged_roof(unsigned n, double thickness, GridPattern pattern)
  {
    auto m = std::make_unique<Model>(cylinder(2540, 0, 254, 0, 0.1, n, n, pattern),
                                     SideSupports{ { Side::u_min, SideSupport::symmetry(0) },
                                                   { Side::v_min, SideSupport::symmetry(1) },
                                                   { Side::v_max, SideSupport::hinged() } },
                                     thickness, elastic_material(3102.75, 0.3));
    m->push({ 0, 0, 2540 }, { 0, 0, -750 });
    return m;
  }
} // namespace shell_benchmark

#endif
