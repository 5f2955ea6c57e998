#include <tribodraw/lubrication/surface_patch.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace tribodraw
{
  SurfacePatch::SurfacePatch(const std::size_t n_nodes, std::vector<std::array<unsigned, 3>> triangles)
      : cells(std::move(triangles)), adjacent(n_nodes), area(n_nodes, 0.), cell_area(cells.size(), 0.),
        slopes(cells.size()), normals(n_nodes, Eigen::Vector3d::Zero())
  {
    for (const auto &t : cells)
      for (unsigned k = 0; k < 3; ++k)
        {
          adjacent[t[k]].push_back(t[(k + 1) % 3]);
          adjacent[t[k]].push_back(t[(k + 2) % 3]);
        }
    for (auto &list : adjacent)
      {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
      }
  }

  void
  SurfacePatch::move_to(const std::vector<Eigen::Vector3d> &x)
  {
    area.assign(area.size(), 0.);
    normals.assign(normals.size(), Eigen::Vector3d::Zero());
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto           &t = cells[c];
        const Eigen::Vector3d a = x[t[1]] - x[t[0]], b = x[t[2]] - x[t[0]], n = 0.5 * a.cross(b);
        cell_area[c] = n.norm();
        slopes[c]    = { b.cross(n) / (2. * cell_area[c]), n.cross(a) / (2. * cell_area[c]) };
        for (const unsigned i : t)
          {
            area[i] += cell_area[c] / 3.;
            normals[i] += n;
          }
      }
    for (auto &n : normals)
      n.normalize();
  }

  std::vector<double>
  SurfacePatch::smooth(const std::vector<double> &values) const
  {
    std::vector<double> sum(values.size(), 0.);
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto  &t    = cells[c];
        const double mean = (values[t[0]] + values[t[1]] + values[t[2]]) / 3.;
        for (const unsigned i : t)
          sum[i] += cell_area[c] / 3. * mean;
      }
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] /= area[i];
    return sum;
  }

  std::vector<Eigen::Vector3d>
  SurfacePatch::gradient(const std::vector<double> &values) const
  {
    std::vector<Eigen::Vector3d> sum(values.size(), Eigen::Vector3d::Zero());
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto           &t = cells[c];
        const double          a = values[t[1]] - values[t[0]], b = values[t[2]] - values[t[0]];
        const Eigen::Vector3d share = (a * slopes[c][0] + b * slopes[c][1]) / 3.;
        if (a != 0 || b != 0)
          for (const unsigned i : t)
            sum[i] += share;
      }
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] /= area[i];
    return sum;
  }

  double
  SurfacePatch::integral(const std::vector<double> &values) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum += values[i] * area[i];
    return sum;
  }
} // namespace tribodraw
