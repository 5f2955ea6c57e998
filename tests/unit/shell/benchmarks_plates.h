#ifndef tests_unit_shell_benchmarks_plates_h
#define tests_unit_shell_benchmarks_plates_h

#include <tribodraw/shell/element.h>

#include "benchmarks_support.h"

/// Plates with D = 1, thickness 0.1 and side or radius 10: w D / (q a^4) and w D / (P a^2) are read off directly.
namespace shell_benchmark
{
  constexpr double plate_size = 10, plate_thickness = 0.1;

  inline std::shared_ptr<const SheetMaterial>
  plate_material(double nu)
  {
    return elastic_material(12 * (1 - nu * nu) / std::pow(plate_thickness, 3), nu);
  }

  enum class PlateLoad
  {
    uniform,
    centre
  };

  /// A quarter of a square plate of side 10, w D / (q a^4) or w D / (P a^2) at one.
  inline std::unique_ptr<Model>
  square_plate(unsigned n, bool clamped, PlateLoad load)
  {
    const double      a    = plate_size;
    const SideSupport edge = clamped ? SideSupport::clamped() : SideSupport::supported({ { false, false, true } });
    auto              m    = std::make_unique<Model>(flat(a / 2, a / 2, n, n),
                                     SideSupports{ { Side::u_min, SideSupport::symmetry(0) },
                                                   { Side::v_min, SideSupport::symmetry(1) },
                                                   { Side::u_max, edge },
                                                   { Side::v_max, edge } },
                                     plate_thickness, plate_material(0.3));
    if (load == PlateLoad::uniform)
      m->loads.add_surface_force(m->surface.mesh, { 0, 0, std::pow(a, -4) });
    else
      m->push({ 0, 0, 0 }, { 0, 0, 0.25 * std::pow(a, -2) });
    return m;
  }

  /// A quarter of a circular plate of radius 10, w D / (q R^4) or w D / (P R^2) at one.
  inline std::unique_ptr<Model>
  circular_plate(unsigned n, bool clamped, PlateLoad load)
  {
    const double R = plate_size;
    auto         m = std::make_unique<Model>(
        disc(R, n),
        SideSupports{
            { Side::u_max, clamped ? SideSupport::clamped() : SideSupport::supported({ { false, false, true } }) },
            { Side::v_min, SideSupport::symmetry(1) },
            { Side::v_max, SideSupport::symmetry(0) } },
        plate_thickness, plate_material(0.3));
    if (load == PlateLoad::uniform)
      m->loads.add_surface_force(m->surface.mesh, { 0, 0, std::pow(R, -4) });
    else
      m->push({ 0, 0, 0 }, { 0, 0, 0.25 * std::pow(R, -2) });
    return m;
  }

  /// Razzaque's plate: a rhombus of side 10 with angles of 60 degrees, two opposite sides simply supported, the others
  /// free, uniform load; w D / (q L^4) at one.
  inline std::unique_ptr<Model>
  skew_plate(unsigned n)
  {
    const SideSupport deflection_held = SideSupport::supported({ { false, false, true } });
    const double      L               = plate_size;
    auto              m               = std::make_unique<Model>(
        surface(0, L, 0, L, n, n, GridPattern::alternating,
                                           [](double u, double v) { return Vector3d(u + v * 0.5, v * std::sqrt(3.) / 2, 0); }),
        SideSupports{ { Side::v_min, deflection_held }, { Side::v_max, deflection_held } }, plate_thickness,
        plate_material(0.31));
    m->supports.fix(m->surface.nearest({ 0, 0, 0 }), 0);
    m->supports.fix(m->surface.nearest({ 0, 0, 0 }), 1);
    m->supports.fix(m->surface.nearest({ L, 0, 0 }), 1);
    m->loads.add_surface_force(m->surface.mesh, { 0, 0, std::pow(L, -4) });
    return m;
  }

  /// A square plate simply supported on two opposite sides, the others free: a quarter. w D / (q L^4) at one.
  inline std::unique_ptr<Model>
  two_sides_supported(unsigned n)
  {
    const double a = plate_size;
    auto         m
        = std::make_unique<Model>(flat(a / 2, a / 2, n, n),
                                  SideSupports{ { Side::u_min, SideSupport::symmetry(0) },
                                                { Side::v_min, SideSupport::symmetry(1) },
                                                { Side::u_max, SideSupport::supported({ { false, false, true } }) } },
                                  plate_thickness, plate_material(0.3));
    m->loads.add_surface_force(m->surface.mesh, { 0, 0, std::pow(a, -4) });
    return m;
  }

  /// Bending moments (xx, yy, xy) per length at a node in the linear solution: linear extrapolation of the curvature of
  /// the adjacent triangles, mean of them. Plates only, D = 1.
  inline Vector3d
  plate_moment(Model &m, const Vector3d &point, double nu)
  {
    const unsigned        node      = m.surface.nearest(point);
    const Eigen::VectorXd u         = m.analysis().linear_response();
    Shell::Configuration  reference = m.shell.committed();
    const double          small     = 1e-6;
    m.shell.move(small * u);
    Vector3d sum   = Vector3d::Zero();
    unsigned count = 0;
    for (const std::array<unsigned, 3> &t : m.surface.mesh.triangles)
      for (unsigned corner = 0; corner < 3; ++corner)
        if (t[corner] == node)
          {
            shell_element::NodeState before, now;
            for (unsigned i = 0; i < 3; ++i)
              {
                before.position[i] = reference.position[t[i]];
                before.director[i] = reference.director[t[i]];
                before.frame[i]    = reference.frame[t[i]];
                now.position[i]    = m.shell.trial().position[t[i]];
                now.director[i]    = m.shell.trial().director[t[i]];
                now.frame[i]       = m.shell.trial().frame[t[i]];
              }
            const shell_element::Reference r = shell_element::make_reference(before);
            std::array<Vector3d, 3>        k;
            for (unsigned p = 0; p < 3; ++p)
              k[p] = (shell_element::curvature(r, now, p) - r.initial_curvature[p]) / small;
            // Point p lies in the middle of the side from node p to p + 1.
            sum += k[corner] + k[(corner + 2) % 3] - k[(corner + 1) % 3];
            ++count;
          }
    m.shell.revert();
    const Vector3d k = sum / count;
    // The director is the upper side's normal: M = D (w_xx + nu w_yy) with the curvature -w_xx of the director.
    return { k[0] + nu * k[1], k[1] + nu * k[0], (1 - nu) * k[2] };
  }
} // namespace shell_benchmark

#endif
