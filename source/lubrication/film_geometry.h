#ifndef tribodraw_source_lubrication_film_geometry_h
#define tribodraw_source_lubrication_film_geometry_h

#include <Eigen/Core>

#include <array>
#include <vector>

namespace tribodraw
{
  /// Linear elements on the triangles of the blank, and what the weak form needs of them for given positions of the
  /// nodes. Unknowns are numbered as the nodes. Shape functions and quadrature are those of deal.II; its triangulation
  /// would be built at ten times the cost of a solution and then only be asked for what is given here.
  class FilmGeometry
  {
  public:
    /// A triangle in the frame of its material: columns of axes are the turned axes of the blank.
    struct Cell
    {
      std::array<unsigned, 3>     node;
      Eigen::Matrix2d             reference_inverse; // of the edges in the undeformed blank
      double                      area = 0;
      Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Zero();
      Eigen::Matrix<double, 2, 3> material_gradient
          = Eigen::Matrix<double, 2, 3>::Zero(); // of the shape functions along axes, one column each
    };

    /// A point of the quadrature that is exact for degree 5 (the product h^3 PhiP / eta of linear functions).
    struct QuadraturePoint
    {
      double                weight; // parts of the area
      std::array<double, 3> shape_value;
    };

    FilmGeometry(const std::vector<Eigen::Vector3d> &reference, const std::vector<std::array<unsigned, 3>> &triangles);

    void            move_to(const std::vector<Eigen::Vector3d> &positions);
    Eigen::VectorXd nodal_area() const; ///< a third of the triangles around

    std::size_t
    n_nodes() const
    {
      return n;
    }
    const std::vector<Cell> &
    cells() const
    {
      return triangles;
    }
    /// For each node the sorted nodes of the triangles around it, itself included.
    std::vector<std::vector<int>> node_columns() const;
    const std::vector<QuadraturePoint> &
    quadrature() const
    {
      return points;
    }

  private:
    std::size_t                  n;
    std::vector<Cell>            triangles;
    std::vector<QuadraturePoint> points;
    std::vector<Eigen::Vector3d> last_positions;
  };
} // namespace tribodraw

#endif
