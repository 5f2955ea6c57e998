#include <tribodraw/shell/element.h>

#include <Eigen/Geometry>

#include <cmath>

namespace tribodraw::shell_element
{
  namespace
  {
    using Gradient      = Eigen::Matrix<double, n_nodes, 2>;
    using PlanePosition = std::array<Eigen::Vector2d, n_nodes>;

    /// Gradients of the linear shape functions of a triangle; either sense of rotation.
    Gradient
    shape_gradients(const PlanePosition &plane)
    {
      const Eigen::Vector2d u = plane[1] - plane[0], v = plane[2] - plane[0];
      const double          twice_area = u[0] * v[1] - u[1] * v[0];
      Gradient              gradient;
      for (unsigned i = 0; i < n_nodes; ++i)
        {
          const Eigen::Vector2d opposite = plane[(i + 2) % 3] - plane[(i + 1) % 3];
          gradient.row(i) << -opposite[1] / twice_area, opposite[0] / twice_area;
        }
      return gradient;
    }

    /// Gradient of the quadratic interpolation of b with the mid-side values eliminated (see the header).
    BendingMatrix
    make_bending_matrix(const Gradient &gradient, const PlanePosition &plane,
                        const std::array<double, n_nodes> &barycentric)
    {
      BendingMatrix bending;
      for (unsigned i = 0; i < n_nodes; ++i)
        {
          // slope[b](a, c) = d (d_b b_a) / d b_{c,i}
          std::array<Eigen::Matrix2d, 2> slope;
          for (unsigned b = 0; b < 2; ++b)
            slope[b] = (4 * barycentric[i] - 1) * gradient(i, b) * Eigen::Matrix2d::Identity();
          for (unsigned side = 1; side < n_nodes; ++side)
            {
              const unsigned        j        = (i + side) % n_nodes;
              const Eigen::Vector2d s        = (plane[j] - plane[i]).normalized();
              const Eigen::Matrix2d mid_side = 0.5 * Eigen::Matrix2d::Identity() - 0.75 * s * s.transpose();
              for (unsigned b = 0; b < 2; ++b)
                slope[b] += 4 * (barycentric[j] * gradient(i, b) + barycentric[i] * gradient(j, b)) * mid_side;
            }
          for (unsigned c = 0; c < 2; ++c)
            {
              bending(0, 2 * i + c) = slope[0](0, c);
              bending(1, 2 * i + c) = slope[1](1, c);
              bending(2, 2 * i + c) = 0.5 * (slope[1](0, c) + slope[0](1, c));
            }
        }
      return bending;
    }

    /// Takes the shear between the direction @p s and its normal out of a metric (C_11, C_22, C_12).
    Matrix3
    without_shear(const Eigen::Vector2d &s)
    {
      const Vector3 shear(-s[0] * s[1], s[0] * s[1], s[0] * s[0] - s[1] * s[1]);        // C_sm of (C_11, C_22, C_12)
      const Vector3 part(-2 * s[0] * s[1], 2 * s[0] * s[1], s[0] * s[0] - s[1] * s[1]); // s m^T + m s^T
      return Matrix3::Identity() - part * shear.transpose();
    }

    Side
    make_side(const NodeState &nodes, const unsigned k, const PlanePosition &plane, const double area,
              const Neighbours &neighbours)
    {
      Side                  side;
      const unsigned        first = k, second = (k + 1) % n_nodes;
      const Eigen::Vector2d along = (plane[second] - plane[first]).normalized();
      if (neighbours.mirrored[k])
        side.own = without_shear(along);
      if (!neighbours.present[k])
        return side;
      // The neighbour, turned about the side until it lies in the plane of this triangle.
      const Eigen::Vector3d direction = (nodes.position[second] - nodes.position[first]).normalized();
      const Eigen::Vector3d arm       = nodes.opposite[k] - nodes.position[first];
      const double          distance = arm.dot(direction), height = (arm - distance * direction).norm();
      const Eigen::Vector2d outward(along[1], -along[0]);
      const Eigen::Vector2d opposite       = plane[first] + distance * along + height * outward;
      const double          neighbour_area = 0.5 * height * (plane[second] - plane[first]).norm();
      side.gradient                        = shape_gradients({ plane[first], plane[second], opposite });
      side.share                           = neighbour_area / (area + neighbour_area);
      side.own                             = (1 - side.share) * Matrix3::Identity();
      return side;
    }
  } // namespace

  std::array<Eigen::Vector3d, 2>
  frame_along(const Eigen::Vector3d &axis, const Eigen::Vector3d &director)
  {
    const Eigen::Vector3d first = (axis - axis.dot(director) * director).normalized();
    return { first, director.cross(first) };
  }

  void
  turn(Eigen::Vector3d &director, std::array<Eigen::Vector3d, 2> &frame, const double w1, const double w2)
  {
    const double angle = std::hypot(w1, w2);
    if (angle == 0)
      return;
    const Eigen::Vector3d along  = (w1 * frame[0] + w2 * frame[1]) / angle;
    const Eigen::Vector3d turned = std::cos(angle) * along - std::sin(angle) * director;
    const Eigen::Vector3d first  = frame[0] + frame[0].dot(along) * (turned - along);
    director                     = (std::cos(angle) * director + std::sin(angle) * along).normalized();
    // Orthonormal anew: round-off would grow over thousands of turns.
    frame = frame_along(first, director);
  }

  Reference
  make_reference(const NodeState &nodes, const Neighbours &neighbours)
  {
    const Eigen::Vector3d u = nodes.position[1] - nodes.position[0], v = nodes.position[2] - nodes.position[0];
    const Eigen::Vector3d area_vector = 0.5 * u.cross(v);
    const Eigen::Vector3d normal      = area_vector.normalized();
    Eigen::Vector3d       axis        = Eigen::Vector3d::UnitX();
    if (std::abs(normal.x()) > 0.99)
      axis = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d first  = (axis - normal.dot(axis) * normal).normalized();
    const Eigen::Vector3d second = normal.cross(first);

    Reference     reference;
    PlanePosition plane;
    reference.area = area_vector.norm();
    for (unsigned i = 0; i < n_nodes; ++i)
      {
        const Eigen::Vector3d r = nodes.position[i] - nodes.position[0];
        plane[i]                = { r.dot(first), r.dot(second) };
      }
    reference.gradient = shape_gradients(plane);
    for (unsigned k = 0; k < n_sides; ++k)
      {
        reference.side[k] = make_side(nodes, k, plane, reference.area, neighbours);
        std::array<double, n_nodes> barycentric{ 0.5, 0.5, 0.5 };
        barycentric[(k + 2) % n_nodes] = 0;
        reference.bending[k]           = make_bending_matrix(reference.gradient, plane, barycentric);
        reference.initial_curvature[k] = curvature(reference, nodes, k);
      }
    return reference;
  }
} // namespace tribodraw::shell_element
