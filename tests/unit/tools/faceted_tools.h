#ifndef tribodraw_tests_tools_faceted_tools_h
#define tribodraw_tests_tools_faceted_tools_h

#include <tribodraw/tools/triangle_mesh.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

/// Triangle meshes of tools, written down from their drawings and independently of the product's distance functions.
namespace faceted
{
  using Eigen::Vector2d;
  using Eigen::Vector3d;
  using tribodraw::TriangleMesh;

  /// A point of a plane curve with its normal.
  struct Sample
  {
    Vector2d point, normal;
  };
  using Curve = std::vector<Sample>;

  inline void
  add_arc(Curve &curve, const Vector2d &centre, const double radius, const double from, const double to, const int n)
  {
    for (int i = 0; i <= n; ++i)
      {
        const double   angle = from + (to - from) * i / n;
        const Vector2d e(std::cos(angle), std::sin(angle));
        curve.push_back({ centre + radius * e, e });
      }
  }

  /// Closed outline of a rectangle with rounded corners, counter-clockwise; the straight sides in @p n_side pieces.
  inline Curve
  rounded_rectangle(const double a, const double b, const double corner, const int n_corner, const int n_side)
  {
    Curve          curve;
    const Vector2d centres[4] = {
      { a - corner, b - corner }, { corner - a, b - corner }, { corner - a, corner - b }, { a - corner, corner - b }
    };
    for (int k = 0; k < 4; ++k)
      {
        add_arc(curve, centres[k], corner, k * M_PI / 2, (k + 1) * M_PI / 2, n_corner);
        const Sample   end = curve.back();
        const Vector2d to  = centres[(k + 1) % 4] + corner * end.normal;
        for (int i = 1; i < n_side; ++i)
          curve.push_back({ end.point + (to - end.point) * i / n_side, end.normal });
      }
    curve.push_back(curve.front());
    return curve;
  }

  inline Curve
  circle(const double radius, const int n)
  {
    Curve curve;
    add_arc(curve, { 0, 0 }, radius, 0, 2 * M_PI, n);
    return curve;
  }

  /// Section of a die: (outwards from the wall, height) from the bottom of the wall over the edge to the flange's end.
  inline std::vector<Vector2d>
  die_section(const double edge, const double depth, const double flange, const int n_edge, const int n_flat)
  {
    std::vector<Vector2d> section;
    for (int i = 0; i < n_flat; ++i)
      section.emplace_back(0, -depth + (depth - edge) * i / n_flat);
    for (int i = 0; i <= n_edge; ++i)
      {
        const double angle = M_PI / 2 * i / n_edge;
        section.emplace_back(edge - edge * std::cos(angle), -edge + edge * std::sin(angle));
      }
    for (int i = 1; i <= n_flat; ++i)
      section.emplace_back(edge + (flange - edge) * i / n_flat, 0);
    return section;
  }

  /// The section along the curve, in triangles with normals to the right of the section's direction (out of a die).
  /// @p jitter moves the diagonals: 0 all one way, 1 alternating.
  inline TriangleMesh
  sweep(const Curve &curve, const std::vector<Vector2d> &section, const bool alternate)
  {
    TriangleMesh mesh;
    mesh.name          = "faceted tool";
    const auto columns = static_cast<unsigned>(section.size());
    for (const Sample &s : curve)
      for (const Vector2d &q : section)
        {
          const Vector2d x = s.point + q[0] * s.normal;
          mesh.vertices.emplace_back(x[0], x[1], q[1]);
        }
    for (unsigned i = 0; i + 1 < curve.size(); ++i)
      for (unsigned j = 0; j + 1 < columns; ++j)
        {
          const unsigned a = i * columns + j, b = a + 1, c = a + columns, d = c + 1;
          if (alternate && (i + j) % 2)
            {
              mesh.triangles.push_back({ a, b, c });
              mesh.triangles.push_back({ b, d, c });
            }
          else
            {
              mesh.triangles.push_back({ a, b, d });
              mesh.triangles.push_back({ a, d, c });
            }
        }
    tribodraw::weld(mesh, 1e-7);
    return mesh;
  }

  /// A die with a circular opening whose rows and columns do not follow the lines where its edge begins and ends.
  inline TriangleMesh
  irregular_die(const double radius, const double edge, const double size)
  {
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> shift(-0.25, 0.25);
    const double                           arc = 0.5 * M_PI * edge, flat = 10;
    const auto                             n_around = static_cast<unsigned>(std::ceil(2 * M_PI * radius / size));
    const auto                             n_along  = static_cast<unsigned>(std::ceil((arc + 2 * flat) / size));
    TriangleMesh                           mesh;
    mesh.name = "irregular die";
    for (unsigned i = 0; i < n_around; ++i)
      for (unsigned j = 0; j <= n_along; ++j)
        {
          const double angle = 2 * M_PI * (i + shift(random)) / n_around;
          const double s     = (j + (j == 0 || j == n_along ? 0 : shift(random))) / n_along * (arc + 2 * flat) - flat;
          const double turn  = std::min(std::max(s, 0.), arc) / edge;
          const double out   = edge * (1 - std::cos(turn)) + std::max(0., s - arc);
          const double z     = -edge + edge * std::sin(turn) + std::min(0., s);
          mesh.vertices.emplace_back((radius + out) * std::cos(angle), (radius + out) * std::sin(angle), z);
        }
    const unsigned columns = n_along + 1;
    for (unsigned i = 0; i < n_around; ++i)
      for (unsigned j = 0; j < n_along; ++j)
        {
          const unsigned a = i * columns + j, b = a + 1, c = (i + 1) % n_around * columns + j, d = c + 1;
          if (random() % 2)
            {
              mesh.triangles.push_back({ a, b, c });
              mesh.triangles.push_back({ b, d, c });
            }
          else
            {
              mesh.triangles.push_back({ a, b, d });
              mesh.triangles.push_back({ a, d, c });
            }
        }
    return mesh;
  }

  /// An octahedron blown up to a sphere about @p centre.
  inline TriangleMesh
  sphere(const double radius, const int n, const Vector3d &centre = Vector3d::Zero())
  {
    TriangleMesh mesh;
    mesh.name = "faceted sphere";
    for (const double sx : { -1., 1. })
      for (const double sy : { -1., 1. })
        for (const double sz : { -1., 1. })
          {
            const auto node = [&](const int i, const int j) {
              const double a = 0.5 * M_PI * i / n, b = 0.5 * M_PI * j / n, c = 0.5 * M_PI * (n - i - j) / n;
              return (radius * Vector3d(sx * std::sin(a), sy * std::sin(b), sz * std::sin(c)).normalized()).eval();
            };
            const auto add = [&](const Vector3d &a, const Vector3d &b, const Vector3d &c) {
              const auto first = static_cast<unsigned>(mesh.vertices.size());
              mesh.vertices.insert(mesh.vertices.end(), { centre + a, centre + b, centre + c });
              if (sx * sy * sz > 0)
                mesh.triangles.push_back({ first, first + 1, first + 2 });
              else
                mesh.triangles.push_back({ first, first + 2, first + 1 });
            };
            for (int i = 0; i < n; ++i)
              for (int j = 0; i + j < n; ++j)
                {
                  add(node(i, j), node(i + 1, j), node(i, j + 1));
                  if (i + j < n - 1)
                    add(node(i + 1, j + 1), node(i, j + 1), node(i + 1, j));
                }
          }
    tribodraw::weld(mesh, 1e-7);
    return mesh;
  }
} // namespace faceted

#endif
