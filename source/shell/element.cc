#include <tribodraw/material/pack.h>
#include <tribodraw/material/point_batch.h>
#include <tribodraw/shell/element.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>

namespace tribodraw::shell_element
{
  namespace
  {
    using Tangents = std::array<Eigen::Vector3d, 2>; ///< phi_1, phi_2

    // A point of integration feels the unknowns of the element and the displacements of one opposite node. They stand
    // in this order in a row, filled up with zeros to whole packs.
    constexpr unsigned n_own_packs = 4, n_point_packs = n_own_packs + 1, opposite_column = 4 * n_own_packs;
    static_assert(4 * n_own_packs >= n_own_dofs);
    struct alignas(32) PointRow : std::array<double, 4 * n_point_packs>
    {
      TRIBODRAW_INLINE Pack
      pack(const unsigned q) const
      {
        Pack result;
        __builtin_memcpy(&result, data() + 4 * q, sizeof(Pack));
        return result;
      }
    };

    Tangents
    tangents(const Eigen::Matrix<double, n_nodes, 2> &gradient, const Eigen::Vector3d &x0, const Eigen::Vector3d &x1,
             const Eigen::Vector3d &x2)
    {
      return { gradient(0, 0) * x0 + gradient(1, 0) * x1 + gradient(2, 0) * x2,
               gradient(0, 1) * x0 + gradient(1, 1) * x1 + gradient(2, 1) * x2 };
    }

    Tangents
    own_tangents(const Reference &reference, const std::array<Eigen::Vector3d, n_nodes> &x)
    {
      return tangents(reference.gradient, x[0], x[1], x[2]);
    }

    Tangents
    neighbour_tangents(const Side &side, const NodeState &nodes, const unsigned k)
    {
      return tangents(side.gradient, nodes.position[k], nodes.position[(k + 1) % n_nodes], nodes.opposite[k]);
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

    /// Symmetric 3x3 moduli: (11,11), (22,22), (12,12), (11,22), (11,12), (22,12), the order of PointBatch.
    struct Moduli
    {
      std::array<double, 6> value{};

      /// Add the product with a vector, four vectors at once.
      TRIBODRAW_INLINE void
      add_product(const Pack &x, const Pack &y, const Pack &z, std::array<Pack, 3> &result) const
      {
        result[0] = result[0] + value[0] * x + value[3] * y + value[4] * z;
        result[1] = result[1] + value[3] * x + value[1] * y + value[5] * z;
        result[2] = result[2] + value[4] * x + value[5] * y + value[2] * z;
      }
    };

    /// Membrane forces, moments and moduli of one in-plane point, times its area.
    struct SectionResponse
    {
      Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
      Moduli  membrane, coupling, bending;
    };

    /// Lever of a thickness point: 2 z lambda.
    double
    lever(const Section &section, const std::size_t layer)
    {
      return section.rule->point[layer] * section.thickness * section.thickness_stretch;
    }

    SectionResponse
    integrate_thickness(const PointBatch &batch, const unsigned first, const Section &section, const double area,
                        const bool with_tangent)
    {
      SectionResponse response;
      for (std::size_t l = 0; l < section.rule->point.size(); ++l)
        {
          const std::size_t i      = first + l;
          const double      weight = area * section.thickness * section.rule->weight[l], arm = lever(section, l);
          for (unsigned c = 0; c < 3; ++c)
            {
              response.force[c] += weight * batch.stress[c][i];
              response.moment[c] += weight * arm * batch.stress[c][i];
            }
          if (with_tangent)
            for (unsigned c = 0; c < 6; ++c)
              {
                const double modulus = weight * batch.tangent[c][i];
                response.membrane.value[c] += modulus;
                response.coupling.value[c] += arm * modulus;
                response.bending.value[c] += arm * arm * modulus;
              }
        }
      return response;
    }

    void
    add_to_summary(const PointBatch &batch, const Section &section, const double area, Summary &summary)
    {
      const std::size_t n_layers = section.rule->point.size();
      for (unsigned i = 0; i < batch.n; ++i)
        {
          const double share = section.rule->weight[i % n_layers] / n_in_plane;
          for (unsigned c = 0; c < 3; ++c)
            summary.mean_stress[c] += share * batch.logarithmic_stress[c][i];
          summary.thickness_strain += share * batch.thickness_strain[i];
          summary.elastic_energy += share * batch.elastic_energy[i];
          summary.plastic_work += share * batch.plastic_work[i];
        }
      summary.elastic_energy *= area * section.thickness;
      summary.plastic_work *= area * section.thickness;
    }

    /// Derivatives of the metric and the curvature of a point by the unknowns it feels.
    struct PointDerivative
    {
      std::array<PointRow, 3> metric{}, curvature{};
    };

    /// Derivative of the metric (C_11, C_22, C_12) by the positions of three nodes, nine numbers a row.
    std::array<std::array<double, 9>, 3>
    metric_derivative(const Eigen::Matrix<double, n_nodes, 2> &gradient, const Tangents &phi)
    {
      std::array<std::array<double, 9>, 3> B;
      for (unsigned i = 0; i < n_nodes; ++i)
        for (unsigned c = 0; c < 3; ++c)
          {
            const double g1 = gradient(i, 0), g2 = gradient(i, 1);
            B[0][3 * i + c] = 2 * g1 * phi[0][c];
            B[1][3 * i + c] = 2 * g2 * phi[1][c];
            B[2][3 * i + c] = g1 * phi[1][c] + g2 * phi[0][c];
          }
      return B;
    }

    void
    set_metric_derivative(const Side &side, const unsigned k, const std::array<std::array<double, 9>, 3> &own,
                          const Tangents &neighbour, PointDerivative &derivative)
    {
      for (unsigned r = 0; r < 3; ++r)
        for (unsigned j = 0; j < 9; ++j)
          derivative.metric[r][j]
              = side.own(r, 0) * own[0][j] + side.own(r, 1) * own[1][j] + side.own(r, 2) * own[2][j];
      if (side.share == 0)
        return;
      const auto     other = metric_derivative(side.gradient, neighbour);
      const unsigned first = 3 * k, second = 3 * ((k + 1) % n_nodes);
      for (unsigned r = 0; r < 3; ++r)
        for (unsigned c = 0; c < 3; ++c)
          {
            derivative.metric[r][first + c] += side.share * other[r][c];
            derivative.metric[r][second + c] += side.share * other[r][3 + c];
            derivative.metric[r][opposite_column + c] = side.share * other[r][6 + c];
          }
    }

    void
    set_curvature_derivative(const Reference &reference, const unsigned k, const NodeState &nodes,
                             const Eigen::Matrix<double, n_covariant, 2> &turning, PointDerivative &derivative)
    {
      const BendingMatrix &bending = reference.bending[k];
      for (unsigned r = 0; r < 3; ++r)
        {
          PointRow &row = derivative.curvature[r];
          for (unsigned a = 0; a < 2; ++a)
            {
              const Eigen::Vector3d v = bending(r, a) * nodes.director[0] + bending(r, 2 + a) * nodes.director[1]
                                        + bending(r, 4 + a) * nodes.director[2];
              for (unsigned i = 0; i < n_nodes; ++i)
                for (unsigned c = 0; c < 3; ++c)
                  row[displacement_dof(i, c)] += reference.gradient(i, a) * v[c];
            }
          for (unsigned i = 0; i < n_nodes; ++i)
            for (unsigned t = 0; t < 2; ++t)
              row[director_dof(i, t)]
                  = bending(r, 2 * i) * turning(2 * i, t) + bending(r, 2 * i + 1) * turning(2 * i + 1, t);
        }
    }

    /// B^T D B of the points of an element: the part of its own unknowns, summed over the points. Only the packs on and
    /// right of the diagonal are in use.
    using OwnStiffness = std::array<std::array<Pack, n_own_packs>, n_own_dofs>;

    /// Add B^T D B of point @p k to @p own and write the part of its opposite node to @p K.
    TRIBODRAW_INLINE inline void
    add_material_stiffness(const PointDerivative &B, const SectionResponse &section, const unsigned k,
                           const bool shared, OwnStiffness &own, TangentMatrix &K)
    {
      std::array<std::array<Pack, 3>, n_point_packs> force, moment; // derivatives
      for (unsigned q = 0; q < n_point_packs; ++q)
        {
          const Pack m0 = B.metric[0].pack(q), m1 = B.metric[1].pack(q), m2 = B.metric[2].pack(q);
          const Pack c0 = B.curvature[0].pack(q), c1 = B.curvature[1].pack(q), c2 = B.curvature[2].pack(q);
          force[q] = moment[q] = { Pack(0.), Pack(0.), Pack(0.) };
          section.membrane.add_product(m0, m1, m2, force[q]);
          section.coupling.add_product(c0, c1, c2, force[q]);
          section.coupling.add_product(m0, m1, m2, moment[q]);
          section.bending.add_product(c0, c1, c2, moment[q]);
        }
      for (unsigned i = 0; i < n_own_dofs; ++i)
        {
          const double m0 = B.metric[0][i], m1 = B.metric[1][i], m2 = B.metric[2][i];
          const double c0 = B.curvature[0][i], c1 = B.curvature[1][i], c2 = B.curvature[2][i];
          for (unsigned q = i / 4; q < n_own_packs; ++q)
            own[i][q] = own[i][q] + m0 * force[q][0] + m1 * force[q][1] + m2 * force[q][2] + c0 * moment[q][0]
                        + c1 * moment[q][1] + c2 * moment[q][2];
          if (!shared)
            continue;
          constexpr unsigned q    = n_own_packs;
          const Pack         pack = m0 * force[q][0] + m1 * force[q][1] + m2 * force[q][2] + c0 * moment[q][0]
                            + c1 * moment[q][1] + c2 * moment[q][2];
          for (unsigned c = 0; c < 3; ++c)
            K(i, opposite_dof(k, c)) = K(opposite_dof(k, c), i) = pack[c];
        }
      if (shared)
        for (unsigned c = 0; c < 3; ++c)
          {
            const auto &column = force[n_own_packs];
            const Pack  pack   = B.metric[0][opposite_column + c] * column[0]
                              + B.metric[1][opposite_column + c] * column[1]
                              + B.metric[2][opposite_column + c] * column[2];
            for (unsigned d = 0; d < 3; ++d)
              K(opposite_dof(k, c), opposite_dof(k, d)) = pack[d];
          }
    }

    void
    write_own_stiffness(const OwnStiffness &own, TangentMatrix &K)
    {
      for (unsigned i = 0; i < n_own_dofs; ++i)
        for (unsigned j = i; j < n_own_dofs; ++j)
          K(i, j) = K(j, i) = own[i][j / 4][j % 4];
    }

    /// Tensor 2 N of the second variation of the metric under the forces N conjugate to (C_11, C_22, C_12).
    Eigen::Matrix2d
    membrane_tensor(const Vector3 &force, const bool tension_only)
    {
      Eigen::Matrix2d N;
      N << 2 * force[0], force[2], force[2], 2 * force[1];
      if (!tension_only)
        return N;
      const double mean = 0.5 * (N(0, 0) + N(1, 1)), half = 0.5 * (N(0, 0) - N(1, 1));
      const double radius = std::hypot(half, N(0, 1));
      const double n1 = mean + radius, n2 = mean - radius;
      if (n2 >= 0)
        return N;
      if (n1 <= 0)
        return Eigen::Matrix2d::Zero();
      return n1 / (n1 - n2) * (N - n2 * Eigen::Matrix2d::Identity());
    }

    /// Second variation of the metric of one triangle, whose nodes have their displacements at @p first_dof.
    void
    add_membrane_geometry(const Eigen::Matrix<double, n_nodes, 2> &gradient, const Eigen::Matrix2d &N,
                          const std::array<unsigned, n_nodes> &first_dof, TangentMatrix &K)
    {
      for (unsigned i = 0; i < n_nodes; ++i)
        {
          const double n1 = gradient(i, 0) * N(0, 0) + gradient(i, 1) * N(1, 0);
          const double n2 = gradient(i, 0) * N(0, 1) + gradient(i, 1) * N(1, 1);
          for (unsigned j = 0; j < n_nodes; ++j)
            {
              const double k = n1 * gradient(j, 0) + n2 * gradient(j, 1);
              for (unsigned c = 0; c < 3; ++c)
                K(first_dof[i] + c, first_dof[j] + c) += k;
            }
        }
    }

    /// Second variation of the covariant components of the directors under the forces @p m conjugate to them.
    void
    add_director_geometry(const Reference &reference, const NodeState &nodes,
                          const Eigen::Matrix<double, n_covariant, 1> &b,
                          const Eigen::Matrix<double, n_covariant, 1> &m, TangentMatrix &K)
    {
      for (unsigned i = 0; i < n_nodes; ++i)
        {
          const double m1 = m[2 * i], m2 = m[2 * i + 1];
          for (unsigned s = 0; s < n_nodes; ++s)
            {
              const double k = m1 * reference.gradient(s, 0) + m2 * reference.gradient(s, 1);
              for (unsigned t = 0; t < 2; ++t)
                for (unsigned c = 0; c < 3; ++c)
                  {
                    K(displacement_dof(s, c), director_dof(i, t)) += k * nodes.frame[i][t][c];
                    K(director_dof(i, t), displacement_dof(s, c)) += k * nodes.frame[i][t][c];
                  }
            }
          // The director stays a unit vector: its second variation is -(dd . dd) d.
          const double k = m1 * b[2 * i] + m2 * b[2 * i + 1];
          for (unsigned t = 0; t < 2; ++t)
            K(director_dof(i, t), director_dof(i, t)) -= k;
        }
    }

    /// Kinematics of an element: everything that the points need.
    struct Kinematics
    {
      Tangents                              phi;
      std::array<Tangents, n_sides>         neighbour;
      Eigen::Matrix<double, n_covariant, 1> b;
      Eigen::Matrix<double, n_covariant, 2> turning; ///< derivative of b by the increments of its director

      Kinematics(const Reference &reference, const NodeState &nodes)
          : phi(own_tangents(reference, nodes.position)), b(covariant_components(phi, nodes))
      {
        for (unsigned k = 0; k < n_sides; ++k)
          if (reference.side[k].share != 0)
            neighbour[k] = neighbour_tangents(reference.side[k], nodes, k);
        for (unsigned i = 0; i < n_nodes; ++i)
          for (unsigned a = 0; a < 2; ++a)
            for (unsigned t = 0; t < 2; ++t)
              turning(2 * i + a, t) = phi[a].dot(nodes.frame[i][t]);
      }

      Vector3
      metric_at(const Side &side, const unsigned k) const
      {
        Vector3 C = side.own * metric(phi);
        if (side.share != 0)
          C += side.share * metric(neighbour[k]);
        return C;
      }
    };

    void
    fill(const Reference &reference, const Kinematics &kinematics, const Section &section, PointBatch &batch)
    {
      const std::size_t n_layers = section.rule->point.size();
      batch.n                    = static_cast<unsigned>(n_in_plane * n_layers);
      for (unsigned k = 0; k < n_in_plane; ++k)
        {
          const Vector3 C      = kinematics.metric_at(reference.side[k], k);
          const Vector3 change = reference.bending[k] * kinematics.b - reference.initial_curvature[k];
          for (std::size_t l = 0; l < n_layers; ++l)
            for (unsigned c = 0; c < 3; ++c)
              batch.C[c][k * n_layers + l] = C[c] + lever(section, l) * change[c];
        }
    }
  } // namespace

  std::vector<PointInSpace>
  points_in_space(const Reference &reference, const NodeState &nodes, const Section &section,
                  const PlasticState *states)
  {
    const Kinematics kinematics(reference, nodes);
    PointBatch       batch;
    fill(reference, kinematics, section, batch);
    // Rotation of the mid-surface: tangents times the inverse root of their metric.
    const Vector3   C = metric(kinematics.phi);
    Eigen::Matrix2d metric_of_surface;
    metric_of_surface << C[0], C[2], C[2], C[1];
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << kinematics.phi[0], kinematics.phi[1];
    Eigen::Matrix3d rotation;
    rotation.leftCols<2>()
        = tangents * Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(metric_of_surface).operatorInverseSqrt();
    rotation.col(2) = rotation.col(0).cross(rotation.col(1));
    const auto in_space = [&rotation](const double a11, const double a22, const double a33, const double a12) {
      Eigen::Matrix3d local;
      local << a11, a12, 0, a12, a22, 0, 0, 0, a33;
      const Eigen::Matrix3d a = rotation * local * rotation.transpose();
      return std::array<double, 6>{ a(0, 0), a(1, 1), a(2, 2), a(0, 1), a(1, 2), a(2, 0) };
    };
    std::vector<PointInSpace> points(batch.n);
    for (unsigned q = 0; q < batch.n; ++q)
      {
        const Vector3 E          = LogarithmicStrain(Vector3(batch.C[0][q], batch.C[1][q], batch.C[2][q])).strain();
        const Vector3 elastic    = E - states[q].plastic_strain;
        const double  E33        = section.material->thickness_strain(E, states[q]);
        // Kirchhoff stress over the change of volume.
        const Vector3 stress = section.material->elasticity() * elastic / std::exp(E[0] + E[1] + E33);
        points[q].stress     = in_space(stress[0], stress[1], 0, stress[2]);
        points[q].strain     = in_space(E[0], E[1], E33, 0.5 * E[2]);
      }
    return points;
  }

  Vector3
  mid_surface_metric(const Reference &reference, const std::array<Eigen::Vector3d, n_nodes> &position)
  {
    return metric(own_tangents(reference, position));
  }

  Vector3
  side_metric(const Reference &reference, const NodeState &nodes, const unsigned side)
  {
    return Kinematics(reference, nodes).metric_at(reference.side[side], side);
  }

  Vector3
  curvature(const Reference &reference, const NodeState &nodes, const unsigned in_plane_point)
  {
    return reference.bending[in_plane_point] * covariant_components(own_tangents(reference, nodes.position), nodes);
  }

  Summary
  integrate(const Reference &reference, const NodeState &nodes, const Section &section, const Options &options,
            const PlasticState *old_states, PlasticState *new_states, ForceVector &force, TangentMatrix &tangent)
  {
    Summary               summary;
    const Kinematics      kinematics(reference, nodes);
    const Tangents       &phi    = kinematics.phi;
    const Eigen::Vector3d normal = phi[0].cross(phi[1]);
    // Turned inside out against its own directors.
    summary.valid = normal.dot(nodes.director[0] + nodes.director[1] + nodes.director[2]) > 0;
    if (!summary.valid)
      return summary;

    PointBatch batch;
    fill(reference, kinematics, section, batch);
    summary.valid
        = evaluate(*section.material, batch, old_states, new_states,
                   { options.time_increment, options.tangent, options.loading_tangent, options.elastic_blend });
    if (!summary.valid)
      return summary;
    add_to_summary(batch, section, reference.area, summary);

    force.setZero();
    const auto                              own        = metric_derivative(reference.gradient, phi);
    Vector3                                 own_force  = Vector3::Zero();
    Eigen::Matrix<double, n_covariant, 1>   conjugated = Eigen::Matrix<double, n_covariant, 1>::Zero(); // to b
    std::array<PointDerivative, n_in_plane> B;
    std::array<SectionResponse, n_in_plane> response;
    for (unsigned k = 0; k < n_in_plane; ++k)
      {
        const Side &side = reference.side[k];
        response[k]      = integrate_thickness(batch, static_cast<unsigned>(k * section.rule->point.size()), section,
                                               reference.area / n_in_plane, options.tangent);
        set_metric_derivative(side, k, own, kinematics.neighbour[k], B[k]);
        set_curvature_derivative(reference, k, nodes, kinematics.turning, B[k]);
        for (unsigned r = 0; r < 3; ++r)
          {
            for (unsigned j = 0; j < n_own_dofs; ++j)
              force[j] += response[k].force[r] * B[k].metric[r][j] + response[k].moment[r] * B[k].curvature[r][j];
            for (unsigned c = 0; c < 3; ++c)
              force[opposite_dof(k, c)] += response[k].force[r] * B[k].metric[r][opposite_column + c];
          }
        own_force += side.own.transpose() * response[k].force;
        conjugated += reference.bending[k].transpose() * response[k].moment;
      }
    if (!options.tangent)
      return summary;

    tangent.setZero();
    OwnStiffness own_stiffness;
    pack::vectorised([&]() TRIBODRAW_INLINE {
      for (auto &row : own_stiffness)
        row.fill(Pack(0.));
      for (unsigned k = 0; k < n_in_plane; ++k)
        add_material_stiffness(B[k], response[k], k, reference.side[k].share != 0, own_stiffness, tangent);
    });
    write_own_stiffness(own_stiffness, tangent);
    for (unsigned k = 0; k < n_in_plane; ++k)
      if (const Side &side = reference.side[k]; side.share != 0)
        add_membrane_geometry(side.gradient, membrane_tensor(side.share * response[k].force, options.tension_only),
                              { displacement_dof(k, 0), displacement_dof((k + 1) % n_nodes, 0), opposite_dof(k, 0) },
                              tangent);
    add_membrane_geometry(reference.gradient, membrane_tensor(own_force, options.tension_only),
                          { displacement_dof(0, 0), displacement_dof(1, 0), displacement_dof(2, 0) }, tangent);
    add_director_geometry(reference, nodes, kinematics.b, conjugated, tangent);
    return summary;
  }
} // namespace tribodraw::shell_element
