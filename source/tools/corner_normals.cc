#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/corner_normals.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>

#include <cmath>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    using Eigen::Matrix2d;
    using Eigen::Vector2d;
    using Eigen::Vector3d;

    class Groups
    {
    public:
      explicit Groups(const std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0u); }
      unsigned
      find(unsigned i)
      {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      }
      void
      join(const unsigned i, const unsigned j)
      {
        parent[find(i)] = find(j);
      }

    private:
      std::vector<unsigned> parent;
    };

    /// Number the groups of corners joined by smooth edges.
    void
    join_corners(const TriangleMesh &mesh, const MeshTopology &topology, const double feature_angle,
                 CornerNormals &result)
    {
      const std::size_t n = mesh.triangles.size();
      Groups            groups(3 * n);
      const auto       &facet = topology.facet_normals();
      result.sharp.assign(n, { false, false, false });
      for (std::size_t t = 0; t < n; ++t)
        for (unsigned k = 0; k < 3; ++k)
          {
            const auto &other = topology.opposite(t, k);
            if (other.triangle < 0)
              continue;
            const Vector3d &a = facet[t], &b = facet[other.triangle];
            if (std::atan2(a.cross(b).norm(), a.dot(b)) > feature_angle)
              result.sharp[t][k] = true;
            else
              {
                const auto start = static_cast<unsigned>(3 * other.triangle);
                groups.join(static_cast<unsigned>(3 * t + k), start + (other.edge + 1) % 3);
                groups.join(static_cast<unsigned>(3 * t + (k + 1) % 3), start + other.edge);
              }
          }
      std::vector<int> number(3 * n, -1);
      unsigned         n_groups = 0;
      result.index.resize(n);
      for (std::size_t t = 0; t < n; ++t)
        for (unsigned k = 0; k < 3; ++k)
          {
            int &group = number[groups.find(static_cast<unsigned>(3 * t + k))];
            if (group < 0)
              group = static_cast<int>(n_groups++);
            result.index[t][k] = static_cast<unsigned>(group);
          }
      result.normals.assign(n_groups, Vector3d::Zero());
    }

    void
    take_given_normals(const TriangleMesh &mesh, const MeshTopology &topology, CornerNormals &result)
    {
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (unsigned k = 0; k < 3; ++k)
          {
            if (!(mesh.normals[t][k].dot(topology.facet_normals()[t]) > 0.5))
              throw InputError(describe_error("A normal of the tool's surface does not fit its triangle.",
                                              mesh.name + ", triangle " + std::to_string(t + 1),
                                              "more than 60 degrees between them", "",
                                              "Is the order of the corners that of the normals?"));
            result.normals[result.index[t][k]] += mesh.normals[t][k];
          }
      for (Vector3d &n : result.normals)
        n.normalize();
    }

    /// Facet normals weighted as is exact on spheres: the start of the refinement.
    void
    average_facets(const TriangleMesh &mesh, const MeshTopology &topology, CornerNormals &result)
    {
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (unsigned k = 0; k < 3; ++k)
          {
            const Vector3d a = mesh.corner(t, k + 1) - mesh.corner(t, k), b = mesh.corner(t, k + 2) - mesh.corner(t, k);
            result.normals[result.index[t][k]]
                += a.cross(b).norm() / (a.squaredNorm() * b.squaredNorm()) * topology.facet_normals()[t];
          }
      for (Vector3d &n : result.normals)
        n.normalize();
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (unsigned k = 0; k < 3; ++k)
          if (!(result.of(t, k).dot(topology.facet_normals()[t]) > 0.1))
            throw InputError(describe_error("The tool's surface is folded at a corner.",
                                            mesh.name + ", triangle " + std::to_string(t + 1), "", "",
                                            "Lower `Feature angle`, or repair the surface."));
    }

    /// Sum of squares by the tilts of all normals, two for each.
    class TiltEquations
    {
    public:
      explicit TiltEquations(const std::vector<Vector3d> &normals_now)
          : normals(normals_now), diagonal(normals.size(), Matrix2d::Zero()), right(normals.size(), Vector2d::Zero())
      {
        for (const Vector3d &n : normals)
          {
            int k = 0;
            n.cwiseAbs().minCoeff(&k);
            Eigen::Matrix<double, 3, 2> t;
            t.col(0) = n.cross(Vector3d::Unit(k)).normalized();
            t.col(1) = n.cross(t.col(0));
            tangents.push_back(t);
          }
      }

      /// weight (e.(n - target))^2
      void
      add(const double weight, const Vector3d &e, const unsigned i, const Vector3d &target)
      {
        const Vector2d a = tangents[i].transpose() * e;
        diagonal[i] += weight * a * a.transpose();
        right[i] -= weight * e.dot(normals[i] - target) * a;
      }
      /// weight (e.(n1 + n2))^2
      void
      add(const double weight, const Vector3d &e, const unsigned i, const unsigned j)
      {
        const Vector2d a = tangents[i].transpose() * e, b = tangents[j].transpose() * e;
        const double   error = weight * e.dot(normals[i] + normals[j]);
        right[i] -= error * a;
        right[j] -= error * b;
        diagonal[i] += weight * a * a.transpose();
        diagonal[j] += weight * b * b.transpose();
        couplings.push_back({ i, j, weight * a * b.transpose() });
      }

      /// The normals turned by the tilts that make the sum smallest.
      std::vector<Vector3d>
      solve() const
      {
        // Conjugate gradients with scaled unknowns: every block of the diagonal becomes the identity. Long and short
        // edges at one corner would spoil the condition otherwise; so it is that of the weights, and some 40 steps do.
        const auto            n = static_cast<Eigen::Index>(normals.size());
        std::vector<Matrix2d> scale;
        Eigen::VectorXd       b(2 * n);
        for (std::size_t i = 0; i < normals.size(); ++i)
          {
            scale.push_back(diagonal[i].llt().matrixL().solve(Matrix2d::Identity()));
            b.segment<2>(2 * static_cast<Eigen::Index>(i)) = scale[i] * right[i];
          }
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(2 * normals.size() + 8 * couplings.size());
        for (int i = 0; i < 2 * n; ++i)
          entries.emplace_back(i, i, 1.);
        for (const Coupling &c : couplings)
          {
            const Matrix2d block = scale[c.i] * c.block * scale[c.j].transpose();
            for (unsigned k = 0; k < 2; ++k)
              for (unsigned m = 0; m < 2; ++m)
                {
                  entries.emplace_back(static_cast<int>(2 * c.i + k), static_cast<int>(2 * c.j + m), block(k, m));
                  entries.emplace_back(static_cast<int>(2 * c.j + m), static_cast<int>(2 * c.i + k), block(k, m));
                }
          }
        Eigen::SparseMatrix<double> matrix(2 * n, 2 * n);
        matrix.setFromTriplets(entries.begin(), entries.end());
        Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper,
                                 Eigen::IdentityPreconditioner>
            solver(matrix);
        solver.setTolerance(1e-10);
        solver.setMaxIterations(1000);
        const Eigen::VectorXd tilt = solver.solve(b);
        std::vector<Vector3d> result;
        for (std::size_t i = 0; i < normals.size(); ++i)
          {
            const Vector2d own = scale[i].transpose() * tilt.segment<2>(2 * static_cast<Eigen::Index>(i));
            result.push_back((normals[i] + tangents[i] * own).normalized());
          }
        return result;
      }

    private:
      const std::vector<Vector3d>             &normals;
      std::vector<Eigen::Matrix<double, 3, 2>> tangents;
      std::vector<Matrix2d>                    diagonal;
      std::vector<Vector2d>                    right;

      struct Coupling
      {
        unsigned i, j;
        Matrix2d block;
      };
      std::vector<Coupling> couplings;
    };

    /// The condition of all edges, and that the normals stay near those of the facets around them or, with
    /// @p stay, near what they are.
    TiltEquations
    equations(const TriangleMesh &mesh, const MeshTopology &topology, const bool stay, const CornerNormals &result)
    {
      // A tenth: chords across the line from a fillet to a flat break the condition, and must not carry that far away.
      constexpr double weight_of_target = 0.1;
      TiltEquations    sum(result.normals);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (unsigned k = 0; k < 3; ++k)
          {
            const Vector3d e     = mesh.corner(t, k + 1) - mesh.corner(t, k);
            const int      other = topology.opposite(t, k).triangle;
            // An edge counts for each of its triangles.
            if (other < 0 || result.sharp[t][k] || other > static_cast<int>(t))
              sum.add(other < 0 || result.sharp[t][k] ? 1 : 2, e, result.index[t][k], result.index[t][(k + 1) % 3]);
            for (const unsigned i : result.index[t])
              sum.add(weight_of_target, e, i, stay ? result.normals[i] : topology.facet_normals()[t]);
          }
      return sum;
    }
  } // namespace

  CornerNormals
  estimate_normals(const TriangleMesh &mesh, const MeshTopology &topology, const double feature_angle)
  {
    CornerNormals result;
    join_corners(mesh, topology, feature_angle, result);
    if (!mesh.normals.empty())
      {
        take_given_normals(mesh, topology, result);
        return result;
      }
    average_facets(mesh, topology, result);
    // Large facets know their normal best, because the surface is nowhere far from them: sums of squares in mm. That
    // sets what the edges leave free. Three steps from there on remove nine tenths of what is wrong on curved places.
    for (int step = 0; step < 5; ++step)
      result.normals = equations(mesh, topology, step >= 2, result).solve();
    return result;
  }
} // namespace tribodraw
