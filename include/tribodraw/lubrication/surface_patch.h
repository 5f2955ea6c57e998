#ifndef tribodraw_lubrication_surface_patch_h
#define tribodraw_lubrication_surface_patch_h

#include <Eigen/Core>

#include <array>
#include <vector>

namespace tribodraw
{
  /// Nodal areas and normals of a surface of triangles and the smoothing of nodal values on it.
  class SurfacePatch
  {
  public:
    SurfacePatch(std::size_t n_nodes, std::vector<std::array<unsigned, 3>> triangles);

    /// Take the geometry of the surface at these positions.
    void move_to(const std::vector<Eigen::Vector3d> &positions);

    /// A third of the area of the triangles around each node [mm^2].
    const std::vector<double> &
    nodal_area() const
    {
      return area;
    }
    /// Unit normals, area-weighted.
    const std::vector<Eigen::Vector3d> &
    normal() const
    {
      return normals;
    }
    /// One area-weighted pass: mean of each triangle, then mean of the triangles around each node. Keeps the integral.
    std::vector<double> smooth(const std::vector<double> &values) const;
    /// Gradient in space of nodal values that are linear over the triangles, at the nodes (area-weighted mean).
    std::vector<Eigen::Vector3d> gradient(const std::vector<double> &values) const;
    /// Integral of nodal values.
    double integral(const std::vector<double> &values) const;

    const std::vector<std::array<unsigned, 3>> &
    triangles() const
    {
      return cells;
    }
    /// Nodes joined to each node by an edge.
    const std::vector<std::vector<unsigned>> &
    neighbours() const
    {
      return adjacent;
    }

  private:
    std::vector<std::array<unsigned, 3>>        cells;
    std::vector<std::vector<unsigned>>          adjacent;
    std::vector<double>                         area, cell_area;
    std::vector<std::array<Eigen::Vector3d, 2>> slopes; // area times the gradients of the shape functions 1 and 2
    std::vector<Eigen::Vector3d>                normals;
  };
} // namespace tribodraw

#endif
