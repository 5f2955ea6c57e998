#include <tribodraw/output/plot.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace tribodraw::plot
{
  namespace
  {
    using Point = std::array<double, 2>;

    /// An empty raster with square pixels around the points.
    Raster
    empty_raster(const PlanMesh &mesh, const std::size_t pixels)
    {
      Raster raster;
      if (mesh.points.empty())
        return raster;
      Point low = mesh.points.front(), high = low;
      for (const Point &p : mesh.points)
        for (const int d : { 0, 1 })
          {
            low[d]  = std::min(low[d], p[d]);
            high[d] = std::max(high[d], p[d]);
          }
      const double longer = std::max(high[0] - low[0], high[1] - low[1]);
      if (!(longer > 0))
        return raster;
      const double size = longer / pixels;
      raster.nx         = std::max<std::size_t>(1, std::ceil((high[0] - low[0]) / size - 1e-9));
      raster.ny         = std::max<std::size_t>(1, std::ceil((high[1] - low[1]) / size - 1e-9));
      raster.x_min      = low[0];
      raster.x_max      = low[0] + raster.nx * size;
      raster.y_min      = low[1];
      raster.y_max      = low[1] + raster.ny * size;
      raster.value.assign(raster.nx * raster.ny, std::numeric_limits<double>::quiet_NaN());
      raster.inside.assign(raster.nx * raster.ny, 0);
      return raster;
    }

    /// Call set(pixel, barycentric coordinates) for each pixel whose centre lies in the triangle (borders included).
    template <class Set>
    void
    paint(const Raster &raster, const Point &a, const Point &b, const Point &c, const Set &set)
    {
      const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
      if (area == 0 || !std::isfinite(area))
        return;
      const double dx = (raster.x_max - raster.x_min) / raster.nx, dy = (raster.y_max - raster.y_min) / raster.ny;
      const auto   pixel = [](const double coordinate, const double origin, const double size, const std::size_t n) {
        return static_cast<std::size_t>(std::clamp((coordinate - origin) / size, 0., n - 1.));
      };
      const std::size_t ix0 = pixel(std::min({ a[0], b[0], c[0] }), raster.x_min, dx, raster.nx);
      const std::size_t ix1 = pixel(std::max({ a[0], b[0], c[0] }), raster.x_min, dx, raster.nx);
      const std::size_t iy0 = pixel(std::min({ a[1], b[1], c[1] }), raster.y_min, dy, raster.ny);
      const std::size_t iy1 = pixel(std::max({ a[1], b[1], c[1] }), raster.y_min, dy, raster.ny);
      // Centres on a common edge belong to both triangles, so that round-off leaves no gap.
      constexpr double tolerance = -1e-9;
      for (std::size_t iy = iy0; iy <= iy1; ++iy)
        for (std::size_t ix = ix0; ix <= ix1; ++ix)
          {
            const double x = raster.x_min + (ix + 0.5) * dx, y = raster.y_min + (iy + 0.5) * dy;
            const double wb = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
            const double wc = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
            const double wa = 1 - wb - wc;
            if (wa >= tolerance && wb >= tolerance && wc >= tolerance)
              set(iy * raster.nx + ix, wa, wb, wc);
          }
    }

    /// Linear where all corners have a value. Where some have none, a point belongs to its nearest corner: it has no
    /// value if that one has none, else the weighted mean of the corners that have one.
    double
    interpolate(const std::array<double, 3> &corner, const std::array<double, 3> &weight)
    {
      const auto nearest_corner = std::max_element(weight.begin(), weight.end()) - weight.begin();
      if (!std::isfinite(corner[nearest_corner]))
        return std::numeric_limits<double>::quiet_NaN();
      double sum = 0, weights = 0;
      for (const int i : { 0, 1, 2 })
        if (std::isfinite(corner[i]))
          {
            sum += weight[i] * corner[i];
            weights += weight[i];
          }
      return sum / weights;
    }
  } // namespace

  namespace
  {
    /// @p value gives a pixel's value from those of the corners and its barycentric coordinates.
    template <class Value>
    Raster
    rasterise_corners(const PlanMesh &mesh, const std::vector<double> &values, const std::size_t pixels,
                      const Value &value)
    {
      Raster raster = empty_raster(mesh, pixels);
      if (raster.value.empty())
        return raster;
      for (const auto &[a, b, c] : mesh.triangles)
        {
          const std::array<double, 3> corner = { values.at(a), values.at(b), values.at(c) };
          paint(raster, mesh.points[a], mesh.points[b], mesh.points[c],
                [&](const std::size_t i, const double wa, const double wb, const double wc) {
                  raster.value[i]  = value(corner, { wa, wb, wc });
                  raster.inside[i] = 1;
                });
        }
      return raster;
    }
  } // namespace

  Raster
  rasterise_nodal(const PlanMesh &mesh, const std::vector<double> &values, const std::size_t pixels)
  {
    return rasterise_corners(mesh, values, pixels, interpolate);
  }

  Raster
  rasterise_nearest(const PlanMesh &mesh, const std::vector<double> &values, const std::size_t pixels)
  {
    return rasterise_corners(mesh, values, pixels,
                             [](const std::array<double, 3> &corner, const std::array<double, 3> &weight) {
                               return corner[std::max_element(weight.begin(), weight.end()) - weight.begin()];
                             });
  }

  Raster
  rasterise_cells(const PlanMesh &mesh, const std::vector<double> &values, const std::size_t pixels)
  {
    Raster raster = empty_raster(mesh, pixels);
    if (raster.value.empty())
      return raster;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      {
        const auto &[a, b, c] = mesh.triangles[t];
        paint(raster, mesh.points[a], mesh.points[b], mesh.points[c], [&](const std::size_t i, double, double, double) {
          raster.value[i]  = values.at(t);
          raster.inside[i] = 1;
        });
      }
    return raster;
  }

  std::vector<std::vector<Point>>
  PlanMesh::outline() const
  {
    std::set<std::pair<unsigned, unsigned>> border; // directed edges whose opposite does not exist
    for (const auto &t : triangles)
      for (const int e : { 0, 1, 2 })
        {
          const unsigned from = t[e], to = t[(e + 1) % 3];
          if (border.erase({ to, from }) == 0)
            border.insert({ from, to });
        }
    std::multimap<unsigned, unsigned> next(border.begin(), border.end());
    std::vector<std::vector<Point>>   chains;
    while (!next.empty())
      {
        const unsigned     start = next.begin()->first;
        unsigned           here  = start;
        std::vector<Point> chain{ points.at(here) };
        for (auto edge = next.begin(); edge != next.end(); edge = here == start ? next.end() : next.find(here))
          {
            here = edge->second;
            next.erase(edge);
            chain.push_back(points.at(here));
          }
        chains.push_back(chain);
      }
    return chains;
  }
} // namespace tribodraw::plot
