#include "film_geometry.h"

#include <tribodraw/base/errors.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    void
    check_connectivity(const std::vector<std::array<unsigned, 3>> &triangles, const std::size_t n_nodes)
    {
      std::vector<char> used(n_nodes, 0);
      for (std::size_t c = 0; c < triangles.size(); ++c)
        for (const unsigned node : triangles[c])
          {
            if (node >= n_nodes)
              throw InputError(describe_error("A triangle of the film mesh names a node that does not exist",
                                              "triangle " + std::to_string(c), std::to_string(node),
                                              "below " + std::to_string(n_nodes)));
            used[node] = 1;
          }
      for (std::size_t i = 0; i < n_nodes; ++i)
        if (!used[i])
          throw InputError(
              describe_error("A node of the film mesh belongs to no triangle", "node " + std::to_string(i)));
    }

    /// Axes of the blank turned with the material: R of the polar decomposition F = R U of the 3x2 deformation
    /// gradient.
    void
    turn_axes(FilmGeometry::Cell &cell, const std::vector<Eigen::Vector3d> &x)
    {
      Eigen::Matrix<double, 3, 2> edges;
      for (unsigned v = 0; v < 2; ++v)
        edges.col(v) = x[cell.node[v + 1]] - x[cell.node[0]];
      const Eigen::Matrix<double, 3, 2> F = edges * cell.reference_inverse;
      const Eigen::Matrix2d             C = F.transpose() * F;
      // Closed form of the square root of a symmetric positive 2x2 matrix.
      const double          J = std::sqrt(C.determinant());
      const Eigen::Matrix2d U = (C + J * Eigen::Matrix2d::Identity()) / std::sqrt(C.trace() + 2. * J);
      if (!(J > 0) || !std::isfinite(J))
        throw ConvergenceError(
            describe_error("A triangle of the film mesh has collapsed", "nodes " + std::to_string(cell.node[0]) + ", "
                                                                            + std::to_string(cell.node[1]) + ", "
                                                                            + std::to_string(cell.node[2])));
      cell.axes = F * U.inverse();
    }
  } // namespace

  FilmGeometry::FilmGeometry(const std::vector<Eigen::Vector3d>         &reference,
                             const std::vector<std::array<unsigned, 3>> &connectivity)
      : n(reference.size())
  {
    check_connectivity(connectivity, n);
    triangles.reserve(connectivity.size());
    for (const auto &nodes : connectivity)
      {
        Cell            c;
        Eigen::Matrix2d edges;
        c.node = nodes;
        for (unsigned v = 0; v < 2; ++v)
          edges.col(v) = (reference[nodes[v + 1]] - reference[nodes[0]]).head<2>();
        const double longest = edges.colwise().norm().maxCoeff();
        if (!(std::abs(edges.determinant()) > 1e-12 * longest * longest))
          throw InputError(describe_error("A triangle of the film mesh has no area in the plane of the blank",
                                          "triangle " + std::to_string(triangles.size())));
        c.reference_inverse = edges.inverse();
        triangles.push_back(c);
      }

    const dealii::FE_SimplexP<2, 3> element(1);
    const dealii::QGaussSimplex<2>  rule(3);
    for (unsigned q = 0; q < rule.size(); ++q)
      {
        QuadraturePoint point;
        point.weight = 2. * rule.weight(q); // the reference triangle has area 1/2
        for (unsigned i = 0; i < 3; ++i)
          point.shape_value[i] = element.shape_value(i, rule.point(q));
        points.push_back(point);
      }
  }

  void
  FilmGeometry::move_to(const std::vector<Eigen::Vector3d> &positions)
  {
    if (positions.size() != n)
      throw InputError(describe_error("Wrong number of positions for the film mesh", "average Reynolds equation",
                                      std::to_string(positions.size()), std::to_string(n)));
    if (positions == last_positions)
      return;
    // Gradients of linear shape functions are constant and known in closed form: the normal to the opposite side over
    // the height. (FEValues on moved vertices gives the same at ten times the cost.)
    for (Cell &cell : triangles)
      {
        const Eigen::Vector3d &a = positions[cell.node[0]], &b = positions[cell.node[1]], &c = positions[cell.node[2]];
        const Eigen::Vector3d  normal = (b - a).cross(c - a);
        const double           twice  = normal.norm();
        cell.area                     = 0.5 * twice;
        turn_axes(cell, positions);
        const Eigen::Vector3d       n = normal / (twice * twice);
        Eigen::Matrix<double, 3, 3> gradient;
        gradient.col(0)        = n.cross(c - b);
        gradient.col(1)        = n.cross(a - c);
        gradient.col(2)        = n.cross(b - a);
        cell.material_gradient = cell.axes.transpose() * gradient;
      }
    last_positions = positions;
  }

  std::vector<std::vector<int>>
  FilmGeometry::node_columns() const
  {
    std::vector<std::vector<int>> columns(n);
    for (const Cell &cell : triangles)
      for (const unsigned i : cell.node)
        for (const unsigned j : cell.node)
          columns[i].push_back(static_cast<int>(j));
    for (auto &list : columns)
      {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
      }
    return columns;
  }

  Eigen::VectorXd
  FilmGeometry::nodal_area() const
  {
    Eigen::VectorXd area = Eigen::VectorXd::Zero(n);
    for (const Cell &cell : triangles)
      for (const unsigned i : cell.node)
        area[i] += cell.area / 3.;
    return area;
  }
} // namespace tribodraw
