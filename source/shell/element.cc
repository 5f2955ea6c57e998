#include <tribodraw/shell/element.h>

#include <Eigen/Geometry>

#include <cmath>

namespace tribodraw::shell_element
{
  namespace
  {
    using Tangents = std::array<Eigen::Vector3d, 2>; ///< phi_1, phi_2
    using Strains  = Eigen::Matrix<double, 9, 1>;    ///< C_v and b, or forces conjugate to them
    using Moduli   = Eigen::Matrix<double, 9, 9>;

    Tangents
    surface_tangents(const Reference &reference, const std::array<Eigen::Vector3d, n_nodes> &position)
    {
      Tangents phi;
      for (int a = 0; a < 2; ++a)
        phi[a] = reference.gradient(0, a) * position[0] + reference.gradient(1, a) * position[1]
                 + reference.gradient(2, a) * position[2];
      return phi;
    }

    Vector3
    metric(const Tangents &phi)
    {
      return { phi[0].squaredNorm(), phi[1].squaredNorm(), phi[0].dot(phi[1]) };
    }

    Eigen::Matrix<double, n_covariant, 1>
    covariant_components(const Tangents &phi, const NodeState &nodes)
    {
      Eigen::Matrix<double, n_covariant, 1> b;
      for (unsigned i = 0; i < n_nodes; ++i)
        for (unsigned a = 0; a < 2; ++a)
          b[2 * i + a] = phi[a].dot(nodes.director[i]);
      return b;
    }

    /// Gradient of the quadratic interpolation of b with the mid-side values eliminated (see the header).
    BendingMatrix
    make_bending_matrix(const Eigen::Matrix<double, n_nodes, 2>    &gradient,
                        const std::array<Eigen::Vector2d, n_nodes> &plane_position,
                        const std::array<double, n_nodes>          &barycentric)
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
              const Eigen::Vector2d s        = (plane_position[j] - plane_position[i]).normalized();
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

    /// Membrane forces, moments and moduli of one in-plane point.
    struct SectionResponse
    {
      Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
      Matrix3 membrane = Matrix3::Zero(), coupling = Matrix3::Zero(), bending = Matrix3::Zero();
    };

    /// Integrate the material over the thickness; adds to @p summary, weighted by @p area.
    SectionResponse
    integrate_thickness(const Vector3 &C, const Vector3 &curvature_change, const double area, const Section &section,
                        const Options &options, const PlasticState *old_states, PlasticState *new_states,
                        Summary &summary)
    {
      SectionResponse      response;
      const SheetMaterial &material = *section.material;
      for (std::size_t l = 0; l < section.rule->point.size(); ++l)
        {
          const double  weight = section.thickness * section.rule->weight[l];
          const double  lever  = section.rule->point[l] * section.thickness * section.thickness_stretch; // 2 z lambda
          const Vector3 Cz     = C + lever * curvature_change;
          if (!(Cz[0] > 0 && Cz[0] * Cz[1] - Cz[2] * Cz[2] > 0))
            {
              summary.valid = false;
              return response;
            }
          CauchyGreenResponse point = evaluate_in_cauchy_green(material, Cz, old_states[l], options.time_increment,
                                                               new_states[l], options.loading_tangent);
          if (!point.update.converged)
            {
              summary.valid = false;
              return response;
            }
          response.force += weight * point.stress;
          response.moment += weight * lever * point.stress;
          summary.mean_stress += area * weight * point.update.stress;
          summary.thickness_strain += area * weight * material.thickness_strain(point.strain, new_states[l]);
          summary.elastic_energy += area * weight * point.update.elastic_energy;
          summary.plastic_work += area * weight * point.update.plastic_work;
          if (options.tangent)
            {
              if (options.elastic_blend > 0 && (point.update.plastic || options.loading_tangent))
                {
                  const Matrix3 P = LogarithmicStrain(Cz).derivative();
                  point.tangent.noalias()
                      += options.elastic_blend * P.transpose() * (material.elasticity() - point.update.tangent) * P;
                }
              response.membrane += weight * point.tangent;
              response.coupling += weight * lever * point.tangent;
              response.bending += weight * lever * lever * point.tangent;
            }
        }
      return response;
    }

    /// Derivative of the strains (C_v, b) by the degrees of freedom.
    Eigen::Matrix<double, 9, n_dofs>
    strain_derivative(const Reference &reference, const Tangents &phi, const NodeState &nodes)
    {
      Eigen::Matrix<double, 9, n_dofs> B = Eigen::Matrix<double, 9, n_dofs>::Zero();
      for (unsigned i = 0; i < n_nodes; ++i)
        {
          const double g1 = reference.gradient(i, 0), g2 = reference.gradient(i, 1);
          B.block<1, 3>(0, 5 * i) = 2 * g1 * phi[0].transpose();
          B.block<1, 3>(1, 5 * i) = 2 * g2 * phi[1].transpose();
          B.block<1, 3>(2, 5 * i) = g1 * phi[1].transpose() + g2 * phi[0].transpose();
          for (unsigned j = 0; j < n_nodes; ++j)
            {
              B.block<1, 3>(3 + 2 * j, 5 * i) = g1 * nodes.director[j].transpose();
              B.block<1, 3>(4 + 2 * j, 5 * i) = g2 * nodes.director[j].transpose();
            }
          for (unsigned a = 0; a < 2; ++a)
            for (unsigned t = 0; t < 2; ++t)
              B(3 + 2 * i + a, 5 * i + 3 + t) = phi[a].dot(nodes.frame[i][t]);
        }
      return B;
    }

    /// Positive part of the symmetric 2x2 membrane force tensor.
    Eigen::Matrix2d
    tensile_part(const Eigen::Matrix2d &N)
    {
      const double mean = 0.5 * (N(0, 0) + N(1, 1)), half = 0.5 * (N(0, 0) - N(1, 1));
      const double radius = std::hypot(half, N(0, 1));
      const double n1 = mean + radius, n2 = mean - radius;
      if (n2 >= 0)
        return N;
      if (n1 <= 0)
        return Eigen::Matrix2d::Zero();
      return n1 / (n1 - n2) * (N - n2 * Eigen::Matrix2d::Identity());
    }

    /// Stiffness from the second variation of the strains under the forces q conjugate to (C_v, b).
    void
    add_geometric_stiffness(const Reference &reference, const NodeState &nodes,
                            const Eigen::Matrix<double, n_covariant, 1> &b, const Strains &q, const bool tension_only,
                            TangentMatrix &K)
    {
      Eigen::Matrix2d N;
      N << 2 * q[0], q[2], q[2], 2 * q[1];
      if (tension_only)
        N = tensile_part(N);
      for (unsigned i = 0; i < n_nodes; ++i)
        for (unsigned j = 0; j < n_nodes; ++j)
          {
            const double k = reference.gradient.row(i) * N * reference.gradient.row(j).transpose();
            for (unsigned c = 0; c < 3; ++c)
              K(5 * i + c, 5 * j + c) += k;
          }
      for (unsigned i = 0; i < n_nodes; ++i)
        {
          const double m1 = q[3 + 2 * i], m2 = q[4 + 2 * i];
          for (unsigned s = 0; s < n_nodes; ++s)
            {
              const double k = m1 * reference.gradient(s, 0) + m2 * reference.gradient(s, 1);
              for (unsigned t = 0; t < 2; ++t)
                for (unsigned c = 0; c < 3; ++c)
                  {
                    K(5 * s + c, 5 * i + 3 + t) += k * nodes.frame[i][t][c];
                    K(5 * i + 3 + t, 5 * s + c) += k * nodes.frame[i][t][c];
                  }
            }
          // The director stays a unit vector: its second variation is -(dd . dd) d.
          const double k = m1 * b[2 * i] + m2 * b[2 * i + 1];
          for (unsigned t = 0; t < 2; ++t)
            K(5 * i + 3 + t, 5 * i + 3 + t) -= k;
        }
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
  make_reference(const NodeState &nodes)
  {
    const Eigen::Vector3d u = nodes.position[1] - nodes.position[0], v = nodes.position[2] - nodes.position[0];
    const Eigen::Vector3d area_vector = 0.5 * u.cross(v);
    const Eigen::Vector3d normal      = area_vector.normalized();
    Eigen::Vector3d       axis        = Eigen::Vector3d::UnitX();
    if (std::abs(normal.x()) > 0.99)
      axis = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d first  = (axis - normal.dot(axis) * normal).normalized();
    const Eigen::Vector3d second = normal.cross(first);

    Reference                            reference;
    std::array<Eigen::Vector2d, n_nodes> plane;
    reference.area = area_vector.norm();
    for (unsigned i = 0; i < n_nodes; ++i)
      {
        const Eigen::Vector3d r = nodes.position[i] - nodes.position[0];
        plane[i]                = { r.dot(first), r.dot(second) };
      }
    for (unsigned i = 0; i < n_nodes; ++i)
      {
        const Eigen::Vector2d opposite = plane[(i + 2) % 3] - plane[(i + 1) % 3];
        reference.gradient.row(i) << -opposite[1] / (2 * reference.area), opposite[0] / (2 * reference.area);
      }
    for (unsigned p = 0; p < n_in_plane; ++p)
      {
        std::array<double, n_nodes> barycentric{ 1. / 6, 1. / 6, 1. / 6 };
        barycentric[p]                 = 2. / 3;
        reference.bending[p]           = make_bending_matrix(reference.gradient, plane, barycentric);
        reference.initial_curvature[p] = curvature(reference, nodes, p);
      }
    return reference;
  }

  Vector3
  mid_surface_metric(const Reference &reference, const std::array<Eigen::Vector3d, n_nodes> &position)
  {
    return metric(surface_tangents(reference, position));
  }

  Vector3
  curvature(const Reference &reference, const NodeState &nodes, const unsigned in_plane_point)
  {
    return reference.bending[in_plane_point] * covariant_components(surface_tangents(reference, nodes.position), nodes);
  }

  Summary
  integrate(const Reference &reference, const NodeState &nodes, const Section &section, const Options &options,
            const PlasticState *old_states, PlasticState *new_states, ForceVector &force, TangentMatrix &tangent)
  {
    Summary               summary;
    const Tangents        phi    = surface_tangents(reference, nodes.position);
    const Eigen::Vector3d normal = phi[0].cross(phi[1]);
    // Turned inside out against its own directors.
    summary.valid = normal.dot(nodes.director[0] + nodes.director[1] + nodes.director[2]) > 0;
    if (!summary.valid)
      return summary;

    const Vector3     C          = metric(phi);
    const auto        b          = covariant_components(phi, nodes);
    const double      point_area = reference.area / n_in_plane;
    const std::size_t n_layers   = section.rule->point.size();
    Strains           q          = Strains::Zero();
    Moduli            D          = Moduli::Zero();
    for (unsigned p = 0; p < n_in_plane; ++p)
      {
        const BendingMatrix  &bending  = reference.bending[p];
        const Vector3         change   = bending * b - reference.initial_curvature[p];
        const SectionResponse response = integrate_thickness(
            C, change, point_area, section, options, old_states + p * n_layers, new_states + p * n_layers, summary);
        if (!summary.valid)
          return summary;
        q.head<3>() += point_area * response.force;
        q.tail<n_covariant>() += point_area * bending.transpose() * response.moment;
        if (options.tangent)
          {
            D.topLeftCorner<3, 3>() += point_area * response.membrane;
            D.topRightCorner<3, n_covariant>() += point_area * response.coupling * bending;
            D.bottomRightCorner<n_covariant, n_covariant>()
                += point_area * bending.transpose() * response.bending * bending;
          }
      }
    const double volume = reference.area * section.thickness;
    summary.mean_stress /= volume;
    summary.thickness_strain /= volume;

    const Eigen::Matrix<double, 9, n_dofs> B = strain_derivative(reference, phi, nodes);
    force                                    = B.transpose() * q;
    if (options.tangent)
      {
        D.bottomLeftCorner<n_covariant, 3>()      = D.topRightCorner<3, n_covariant>().transpose();
        const Eigen::Matrix<double, 9, n_dofs> DB = D * B;
        tangent                                   = B.transpose().lazyProduct(DB);
        add_geometric_stiffness(reference, nodes, b, q, options.tension_only, tangent);
      }
    return summary;
  }
} // namespace tribodraw::shell_element
