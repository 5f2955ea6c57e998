#include <tribodraw/tools/smooth_patch.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector3d;

    /// Number of the control point with the powers (i, j, k), i + j + k = 4.
    constexpr unsigned
    number(const unsigned j, const unsigned k)
    {
      return (j + k) * (j + k + 1) / 2 + k;
    }

    /// The same with the powers given from corner a on.
    unsigned
    number_from(const unsigned a, const std::array<unsigned, 3> &powers)
    {
      std::array<unsigned, 3> p{};
      for (unsigned m = 0; m < 3; ++m)
        p[(a + m) % 3] = powers[m];
      return number(p[1], p[2]);
    }
  } // namespace

  SmoothPatch::SmoothPatch(const std::array<Vector3d, 3> &corners, const std::array<Vector3d, 3> &normals,
                           const std::array<Border, 3> &borders)
  {
    std::array<std::array<Vector3d, 4>, 3> cubic;
    for (unsigned a = 0; a < 3; ++a)
      {
        const unsigned next   = (a + 1) % 3;
        const Vector3d chord  = corners[next] - corners[a];
        const double   length = chord.norm();
        // 2/3 c/(1 + cos) is 4/3 r tan(angle/4) for an arc: its middle lies on the circle.
        const auto reach = [&](const Vector3d &t) { return 2. / 3 * length / (1 + t.dot(chord) / length); };
        cubic[a]         = { corners[a], corners[a] + reach(borders[a].start) * borders[a].start,
                             corners[next] - reach(borders[a].end) * borders[a].end, corners[next] };
        const auto &c    = cubic[a];
        b[number_from(a, { 4, 0, 0 })] = c[0];
        b[number_from(a, { 3, 1, 0 })] = (c[0] + 3 * c[1]) / 4;
        b[number_from(a, { 2, 2, 0 })] = (c[1] + c[2]) / 2;
        b[number_from(a, { 1, 3, 0 })] = (3 * c[2] + c[3]) / 4;
      }
    for (unsigned a = 0; a < 3; ++a)
      {
        const auto    &c    = cubic[a];
        const Vector3d s[3] = { c[1] - c[0], c[2] - c[1], c[3] - c[2] };
        // Across the border: perpendicular to it and in the tangent plane at both ends, their mean between.
        Vector3d across[3];
        across[0]              = normals[a].cross(s[0]).normalized();
        across[2]              = normals[(a + 1) % 3].cross(s[2]).normalized();
        across[1]              = (across[0] + across[2]).normalized();
        const auto     q       = [&](const unsigned i) { return b[number_from(a, { 4 - i, i, 0 })]; };
        const Vector3d first   = b[number_from(a, { 3, 0, 1 })] - 0.5 * (q(0) + q(1));
        const Vector3d last    = b[number_from(a, { 0, 3, 1 })] - 0.5 * (q(3) + q(4));
        const double   along_0 = first.dot(s[0]) / s[0].squaredNorm(), across_0 = first.dot(across[0]);
        const double   along_1 = last.dot(s[2]) / s[2].squaredNorm(), across_1 = last.dot(across[2]);
        const Vector3d near_start
            = 0.5 * (q(1) + q(2))
              + (along_1 * s[0] + 2 * along_0 * s[1] + across_1 * across[0] + 2 * across_0 * across[1]) / 3;
        const Vector3d near_end
            = 0.5 * (q(2) + q(3))
              + (2 * along_1 * s[1] + along_0 * s[2] + 2 * across_1 * across[1] + across_0 * across[2]) / 3;
        b[number_from(a, { 2, 1, 1 })] = near_start;
        difference[(a + 1) % 3]        = near_end;
      }
    for (unsigned a = 0; a < 3; ++a)
      difference[a] -= b[number_from(a, { 2, 1, 1 })];
  }

  SmoothPatch::Point
  SmoothPatch::evaluate(const double u, const double v) const
  {
    const double w = 1 - u - v;
    // De Casteljau: two steps down to the second derivatives, two more to the point.
    const auto step = [&](const Vector3d *from, const unsigned rows, Vector3d *to) {
      for (unsigned row = 0, i = 0; row < rows; ++row)
        for (unsigned k = 0; k <= row; ++k, ++i)
          to[i] = w * from[i] + u * from[i + row + 1] + v * from[i + row + 2];
    };
    Vector3d c[10], q[6], l[3];
    step(b.data(), 4, c);
    step(c, 3, q);
    step(q, 2, l);
    Point p{ w * l[0] + u * l[1] + v * l[2],
             4 * (l[1] - l[0]),
             4 * (l[2] - l[0]),
             12 * (q[0] - 2 * q[1] + q[3]),
             12 * (q[0] - q[1] - q[2] + q[4]),
             12 * (q[0] - 2 * q[2] + q[5]) };

    // The blend of the inner control points: 12 a^2 g(b, c) with g = b c^2/(b + c), a, b, c from each corner on.
    const double coordinate[3] = { w, u, v };
    for (unsigned k = 0; k < 3; ++k)
      {
        const double a = coordinate[k], f = coordinate[(k + 1) % 3], h = coordinate[(k + 2) % 3], s = f + h;
        if (s < 1e-12)
          continue; // in the corner, where the terms and their first derivatives vanish
        const double r = 1 / s, r2 = r * r, r3 = r2 * r;
        const double g = f * h * h * r, g_f = h * h * h * r2, g_h = f * h * (2 * f + h) * r2;
        const double g_ff = -2 * h * h * h * r3, g_hh = 2 * f * f * f * r3, g_fh = h * h * (3 * f + h) * r3;
        // Derivatives by the coordinates (a, f, h), put to their corners.
        double         d[3], dd[3][3];
        const unsigned i = k, j = (k + 1) % 3, m = (k + 2) % 3;
        d[i]     = 2 * a * g;
        d[j]     = a * a * g_f;
        d[m]     = a * a * g_h;
        dd[i][i] = 2 * g;
        dd[i][j] = dd[j][i] = 2 * a * g_f;
        dd[i][m] = dd[m][i] = 2 * a * g_h;
        dd[j][j]            = a * a * g_ff;
        dd[m][m]            = a * a * g_hh;
        dd[j][m] = dd[m][j] = a * a * g_fh;
        const Vector3d e    = 12 * difference[k];
        p.x += a * a * g * e;
        p.u += (d[1] - d[0]) * e;
        p.v += (d[2] - d[0]) * e;
        p.uu += (dd[1][1] - 2 * dd[0][1] + dd[0][0]) * e;
        p.uv += (dd[1][2] - dd[0][1] - dd[0][2] + dd[0][0]) * e;
        p.vv += (dd[2][2] - 2 * dd[0][2] + dd[0][0]) * e;
      }
    return p;
  }

  std::array<Vector3d, SmoothPatch::n_control_points>
  SmoothPatch::control_points() const
  {
    std::array<Vector3d, n_control_points> points;
    std::copy(b.begin(), b.end(), points.begin());
    for (unsigned a = 0; a < 3; ++a)
      points[15 + a] = b[number_from(a, { 2, 1, 1 })] + difference[a];
    return points;
  }

  double
  SmoothPatch::largest_deviation() const
  {
    // The flat triangle is the patch with these control points on it, and both have the same positive weights.
    double     largest = 0;
    const auto flat    = [&](const unsigned j, const unsigned k) {
      return ((4. - j - k) * corner(0) + j * corner(1) + k * corner(2)) / 4;
    };
    for (unsigned row = 0, i = 0; row < 5; ++row)
      for (unsigned k = 0; k <= row; ++k, ++i)
        largest = std::max(largest, (b[i] - flat(row - k, k)).norm());
    constexpr unsigned inner[3][2] = { { 1, 1 }, { 2, 1 }, { 1, 2 } };
    for (unsigned a = 0; a < 3; ++a)
      {
        const unsigned *p = inner[a];
        largest           = std::max(largest, (b[number(p[0], p[1])] + difference[a] - flat(p[0], p[1])).norm());
      }
    return largest;
  }
} // namespace tribodraw
