#include "delaunay.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tribodraw
{
  using Eigen::Vector2d;

  double
  Delaunay::twice_area(const int a, const int b, const int c) const
  {
    const Vector2d u = point[b] - point[a], v = point[c] - point[a];
    return u[0] * v[1] - u[1] * v[0];
  }

  double
  Delaunay::quality(const std::array<int, 3> &v) const
  {
    const double squares = (point[v[1]] - point[v[0]]).squaredNorm() + (point[v[2]] - point[v[1]]).squaredNorm()
                           + (point[v[0]] - point[v[2]]).squaredNorm();
    return 2 * std::sqrt(3.) * twice_area(v[0], v[1], v[2]) / squares;
  }

  Delaunay::Delaunay(const std::vector<Vector2d> &points) : point(points)
  {
    Vector2d low = points.at(0), high = low;
    for (const Vector2d &p : points)
      {
        low  = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    const Vector2d centre = 0.5 * (low + high);
    const double   extent = (high - low).norm();
    tolerance             = 1e-10 * extent;
    const int n           = static_cast<int>(points.size());
    for (unsigned k = 0; k < 3; ++k)
      {
        const double angle = 0.3 + 2 * M_PI * k / 3; // no side parallel to an axis
        point.push_back(centre + 50 * extent * Vector2d(std::cos(angle), std::sin(angle)));
      }
    triangle.push_back({ { n, n + 1, n + 2 }, { -1, -1, -1 } });
    int last = 0;
    for (int p = 0; p < n; ++p)
      last = insert(p, last);
  }

  int
  Delaunay::locate(const int p, const int start) const
  {
    int t = start;
    // A walk in a Delaunay triangulation ends; round-off may make it circle, hence the bound.
    for (std::size_t step = 0; step < 4 * triangle.size() + 10; ++step)
      {
        int next = -1;
        for (unsigned i = 0; i < 3 && next < 0; ++i)
          {
            const unsigned k = (i + step) % 3;
            const int      a = triangle[t].vertex[(k + 1) % 3], b = triangle[t].vertex[(k + 2) % 3];
            if (twice_area(a, b, p) < -tolerance * (point[b] - point[a]).norm() && triangle[t].neighbour[k] >= 0)
              next = triangle[t].neighbour[k];
          }
        if (next < 0)
          return t;
        t = next;
      }
    throw std::logic_error("Delaunay: a point was not found in the triangulation.");
  }

  void
  Delaunay::replace_neighbour(const int of, const int old_one, const int new_one)
  {
    if (of >= 0)
      for (int &n : triangle[of].neighbour)
        if (n == old_one)
          {
            n = new_one;
            return;
          }
  }

  int
  Delaunay::insert(const int p, const int start)
  {
    const int      t   = locate(p, start);
    const Triangle old = triangle[t];
    const auto    &v   = old.vertex;
    const auto    &n   = old.neighbour;
    const int      t1 = static_cast<int>(triangle.size()), t2 = t1 + 1;
    // Three triangles with p at their last vertex; one without area is flipped away below if p lies on a side.
    triangle[t] = { { v[0], v[1], p }, { t1, t2, n[2] } };
    triangle.push_back({ { v[1], v[2], p }, { t2, t, n[0] } });
    triangle.push_back({ { v[2], v[0], p }, { t, t1, n[1] } });
    replace_neighbour(n[0], t, t1);
    replace_neighbour(n[1], t, t2);
    std::vector<int> suspects{ t, t1, t2 };
    // A point on a side: its flat triangle must go, whatever the circles say.
    for (const int s : { t, t1, t2 })
      {
        const auto &w = triangle[s].vertex;
        if (w[2] == p && twice_area(w[0], w[1], p) <= tolerance * (point[w[1]] - point[w[0]]).norm())
          flip_if_better(s, 2);
      }
    for (const int s : { t, t1, t2 })
      for (const int k : triangle[s].neighbour)
        if (k >= 0)
          suspects.push_back(k);
    legalise(suspects);
    return t;
  }

  bool
  Delaunay::flip_if_better(const int t, const int side)
  {
    const int other = triangle[t].neighbour[side];
    if (other < 0)
      return false;
    const int back = static_cast<int>(std::find(triangle[other].neighbour.begin(), triangle[other].neighbour.end(), t)
                                      - triangle[other].neighbour.begin());
    const int c = triangle[t].vertex[side], a = triangle[t].vertex[(side + 1) % 3],
              b       = triangle[t].vertex[(side + 2) % 3];
    const int    d    = triangle[other].vertex[back];
    const double here = twice_area(a, b, c), there = twice_area(b, a, d);
    const double first = twice_area(c, a, d), second = twice_area(d, b, c);
    if (!(first > 0 && second > 0))
      return false;
    // In the circle through a, b, c: the angles at c and d together exceed 180 degrees.
    const Vector2d ca = point[a] - point[c], cb = point[b] - point[c], da = point[a] - point[d],
                   db  = point[b] - point[d];
    const double cos_c = ca.dot(cb), cos_d = da.dot(db);
    const double scale = std::sqrt(ca.squaredNorm() * cb.squaredNorm() * da.squaredNorm() * db.squaredNorm());
    const bool   flat  = std::min(here, there) <= tolerance * (point[b] - point[a]).norm();
    if (!(here * cos_d + there * cos_c < -1e-12 * scale) && !(flat && std::min(first, second) > std::min(here, there)))
      return false;
    const int over_a = triangle[t].neighbour[(side + 1) % 3], over_b = triangle[t].neighbour[(side + 2) % 3];
    const int da_side = triangle[other].neighbour[(back + 1) % 3], db_side = triangle[other].neighbour[(back + 2) % 3];
    // triangle[other] is (d, b, a): da_side lies across the side opposite to b, db_side across that opposite to a.
    triangle[t]     = { { c, a, d }, { da_side, other, over_b } };
    triangle[other] = { { d, b, c }, { over_a, t, db_side } };
    replace_neighbour(da_side, other, t);
    replace_neighbour(over_a, t, other);
    return true;
  }

  void
  Delaunay::legalise(std::vector<int> &suspects)
  {
    // Each flip raises the smallest angle lexicographically; the bound is for round-off.
    for (std::size_t n_flips = 0; !suspects.empty() && n_flips < 50 * triangle.size() + 100;)
      {
        const int t = suspects.back();
        suspects.pop_back();
        for (int side = 0; side < 3; ++side)
          {
            const int other = triangle[t].neighbour[side];
            if (flip_if_better(t, side))
              {
                ++n_flips;
                suspects.push_back(t);
                suspects.push_back(other);
                break;
              }
          }
      }
  }

  void
  Delaunay::remove(const std::vector<bool> &marked)
  {
    std::vector<int>      renumbered(triangle.size(), -1);
    std::vector<Triangle> kept;
    for (std::size_t t = 0; t < triangle.size(); ++t)
      if (!marked[t])
        {
          renumbered[t] = static_cast<int>(kept.size());
          kept.push_back(triangle[t]);
        }
    for (Triangle &t : kept)
      for (int &n : t.neighbour)
        n = n < 0 ? -1 : renumbered[n];
    triangle = std::move(kept);
  }

  std::vector<std::vector<int>>
  Delaunay::triangles_of_points() const
  {
    std::vector<std::vector<int>> result(point.size());
    for (std::size_t t = 0; t < triangle.size(); ++t)
      for (const int v : triangle[t].vertex)
        result[v].push_back(static_cast<int>(t));
    return result;
  }
} // namespace tribodraw
