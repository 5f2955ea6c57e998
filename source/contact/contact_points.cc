#include <tribodraw/contact/contact_points.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace tribodraw
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  namespace
  {
    constexpr unsigned n_node_dofs = Shell::dofs_per_node;
    constexpr double   sagitta     = 1. / 16; // see the class

    /// The two nodes of a side, their directors and what follows from them.
    struct Chord
    {
      const Shell::Configuration &c;
      unsigned                    i, j;
      Vector3d                    along, turn, normals; // x_j - x_i, d_j - d_i, d_i + d_j
      double                      rise;

      Chord(const Shell::Configuration &configuration, const std::array<unsigned, 2> &ends)
        : c(configuration)
        , i(ends[0])
        , j(ends[1])
        , along(c.position[j] - c.position[i])
        , turn(c.director[j] - c.director[i])
        , normals(c.director[i] + c.director[j])
        , rise(turn.dot(along))
      {}
    };
  } // namespace

  ContactPoints::ContactPoints(const Shell &sheet)
    : shell(sheet)
  {
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      end.push_back({node, node});
    std::map<std::array<unsigned, 2>, unsigned> known;
    for (const auto &triangle : shell.mesh().triangles)
      {
        side.emplace_back();
        for (unsigned k = 0; k < 3; ++k)
          {
            const unsigned                a = triangle[k], b = triangle[(k + 1) % 3];
            const std::array<unsigned, 2> ends{std::min(a, b), std::max(a, b)};
            const auto [found, is_new] = known.emplace(ends, size());
            if (is_new)
              end.push_back(ends);
            side.back()[k] = found->second;
          }
      }
  }

  Vector3d
  ContactPoints::position(const Shell::Configuration &configuration, const unsigned point) const
  {
    if (is_node(point))
      return configuration.position[end[point][0]];
    const Chord chord(configuration, end[point]);
    return 0.5 * (configuration.position[chord.i] + configuration.position[chord.j]) + sagitta * chord.rise * chord.normals;
  }

  std::vector<double>
  ContactPoints::areas(const std::vector<Vector3d> &x) const
  {
    std::vector<double> area(size(), 0.);
    for (std::size_t e = 0; e < side.size(); ++e)
      {
        const auto  &t     = shell.mesh().triangles[e];
        const double whole = 0.5 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).norm();
        for (unsigned k = 0; k < 3; ++k)
          {
            area[t[k]] += whole / 12;
            area[side[e][k]] += whole / 4;
          }
      }
    return area;
  }

  ContactPoints::Derivative
  ContactPoints::derivative(const Shell::Configuration &configuration, const unsigned point) const
  {
    Derivative G = Derivative::Zero();
    if (is_node(point))
      {
        G.leftCols<3>().setIdentity();
        return G;
      }
    const Chord    chord(configuration, end[point]);
    const Matrix3d lift = sagitta * chord.normals * chord.turn.transpose();
    G.leftCols<3>()     = 0.5 * Matrix3d::Identity() - lift;
    G.middleCols<3>(n_node_dofs) = 0.5 * Matrix3d::Identity() + lift;
    for (unsigned t = 0; t < 2; ++t)
      {
        const Vector3d &e = configuration.frame[chord.i][t], &g = configuration.frame[chord.j][t];
        G.col(3 + t)               = sagitta * (chord.rise * e - e.dot(chord.along) * chord.normals);
        G.col(n_node_dofs + 3 + t) = sagitta * (chord.rise * g + g.dot(chord.along) * chord.normals);
      }
    return G;
  }

  void
  ContactPoints::add_force(const Derivative &G, const unsigned point, const Vector3d &force, const double factor, Eigen::Ref<Eigen::VectorXd> to) const
  {
    if (is_node(point))
      {
        to.segment<3>(shell.dof(end[point][0], 0)) += factor * force;
        return;
      }
    const Eigen::Matrix<double, n_point_dofs, 1> generalised = factor * G.transpose() * force;
    for (unsigned m = 0; m < 2; ++m)
      to.segment<n_node_dofs>(shell.dof(end[point][m], 0)) += generalised.segment<n_node_dofs>(m * n_node_dofs);
  }

  void
  ContactPoints::find_positions(const SparseMatrix &tangent)
  {
    place.resize(size());
    for (unsigned point = 0; point < size(); ++point)
      for (unsigned i = 0; i < n_point_dofs; ++i)
        for (unsigned m = 0; m < 2; ++m)
          place[point][2 * i + m] = tangent.position(static_cast<int>(shell.dof(end[point][i / n_node_dofs], i % n_node_dofs)),
                                                     static_cast<int>(shell.dof(end[point][m], 0)));
    known_entries = tangent.values().size();
  }

  void
  ContactPoints::add_tangent(const Shell::Configuration &configuration,
                             const Derivative           &G,
                             const unsigned              point,
                             const Vector3d             &force,
                             const Matrix3d             &stiffness,
                             SparseMatrix               &tangent)
  {
    if (known_entries != tangent.values().size())
      find_positions(tangent);
    auto &value = tangent.values();
    if (is_node(point))
      {
        for (unsigned i = 0; i < 3; ++i)
          for (unsigned j = 0; j < 3; ++j)
            value[place[point][2 * i] + j] += stiffness(i, j);
        return;
      }
    Eigen::Matrix<double, n_point_dofs, n_point_dofs> K = G.transpose() * stiffness * G;

    // less the second derivative of the position along the force
    const Chord                                  chord(configuration, end[point]);
    const double                                 up = sagitta * force.dot(chord.normals);
    Eigen::Matrix<double, n_point_dofs, 1>       rise = Eigen::Matrix<double, n_point_dofs, 1>::Zero(), tilt = rise;
    rise.head<3>()               = -chord.turn;
    rise.segment<3>(n_node_dofs) = chord.turn;
    for (unsigned m = 0; m < 2; ++m)
      {
        const double   sign = m == 0 ? -1 : 1;
        const unsigned node = end[point][m], first = m * n_node_dofs + 3;
        for (unsigned t = 0; t < 2; ++t)
          {
            const Vector3d &e = configuration.frame[node][t];
            rise[first + t]   = sign * e.dot(chord.along);
            tilt[first + t]   = sagitta * force.dot(e);
            for (unsigned n = 0; n < 2; ++n)
              for (unsigned c = 0; c < 3; ++c)
                {
                  const double mixed = up * sign * (n == 0 ? -1 : 1) * e[c];
                  K(n * n_node_dofs + c, first + t) -= mixed;
                  K(first + t, n * n_node_dofs + c) -= mixed;
                }
            // a director moves along a great circle
            K(first + t, first + t) += (up * sign * chord.along + sagitta * chord.rise * force).dot(configuration.director[node]);
          }
      }
    K -= rise * tilt.transpose() + tilt * rise.transpose();
    for (unsigned i = 0; i < n_point_dofs; ++i)
      for (unsigned m = 0; m < 2; ++m)
        {
          double *const to = &value[place[point][2 * i + m]];
          for (unsigned j = 0; j < n_node_dofs; ++j)
            to[j] += K(i, m * n_node_dofs + j);
        }
  }
} // namespace tribodraw
