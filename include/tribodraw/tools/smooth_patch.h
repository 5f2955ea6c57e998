#ifndef tribodraw_tools_smooth_patch_h
#define tribodraw_tools_smooth_patch_h

#include <Eigen/Core>

#include <array>

namespace tribodraw
{
  /// A curved triangle through three corners with given normals. Neighbours that share the normals of the common edge
  /// join with a common tangent plane all along it (G1).
  ///
  /// Quartic Bezier triangle with cubic borders. The cross derivative at a border lies in the plane of the border's
  /// tangent and of a direction that only depends on the border; two borders ask different things of an inner control
  /// point, which is blended between them (D. Walton, D. Meek, Comput. Aided Des. 28 (1996) 113-123; J. Gregory). The
  /// length of the borders' end tangents is chosen such that arcs of circles are met to sixth order.
  class SmoothPatch
  {
  public:
    /// What a border needs at its two ends: tangent directions, unit vectors along the border.
    struct Border
    {
      Eigen::Vector3d start, end;
    };

    SmoothPatch() = default;
    /// @param corners counter-clockwise; @param borders k leads from corner k to the next; its directions must be
    /// perpendicular to the normals of its ends.
    SmoothPatch(const std::array<Eigen::Vector3d, 3> &corners, const std::array<Eigen::Vector3d, 3> &normals,
                const std::array<Border, 3> &borders);

    /// Position and derivatives by the barycentric coordinates u of corner 1 and v of corner 2.
    struct Point
    {
      Eigen::Vector3d x, u, v, uu, uv, vv;
    };
    Point evaluate(double u, double v) const;

    const Eigen::Vector3d &
    corner(const unsigned k) const
    {
      return b[k == 0 ? 0 : k == 1 ? 10 : 14];
    }
    /// No point is further from the point of the flat triangle with the same coordinates [mm].
    double largest_deviation() const;
    /// Every point of the patch lies in the convex hull of these.
    static constexpr unsigned       n_control_points = 18;
    std::array<Eigen::Vector3d, 18> control_points() const;

  private:
    /// Control points by the powers (i, j, k) of the barycentric coordinates of corners 0, 1, 2: index of row j + k
    /// and place k. The three inner ones are those that the border to the next corner wants.
    std::array<Eigen::Vector3d, 15> b;
    /// At corner a: what the border from the previous corner wants less that.
    std::array<Eigen::Vector3d, 3> difference;
  };
} // namespace tribodraw

#endif
