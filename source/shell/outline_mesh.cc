#include <tribodraw/base/errors.h>
#include <tribodraw/shell/blank_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "delaunay.h"

namespace tribodraw
{
  using Eigen::Vector2d;

  namespace
  {
    /// Points closer than this share of the local size are not set.
    constexpr double least_distance = 0.8;
    /// Candidates for points; more would take minutes and gigabytes.
    constexpr double most_candidates = 2e7;
    /// Smallest quality (see Delaunay::quality) of a mesh that is handed out: angles of some 15 degrees.
    constexpr double least_quality = 0.3;

    std::string
    print(const Vector2d &x)
    {
      std::ostringstream text;
      text << "(" << x[0] << ", " << x[1] << ") mm";
      return text.str();
    }

    [[noreturn]] void
    refuse(const std::string &what, const std::string &value, const std::string &allowed = "",
           const std::string &hint = "")
    {
      throw InputError(describe_error(what, "blank mesh", value, allowed, hint));
    }

    double
    signed_area(const std::vector<Vector2d> &outline)
    {
      double area = 0;
      for (std::size_t i = 0; i < outline.size(); ++i)
        {
          const Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
          area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        }
      return area;
    }

    double
    cross(const Vector2d &o, const Vector2d &a, const Vector2d &b)
    {
      return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    }

    void
    check_outline(const std::vector<Vector2d> &outline)
    {
      const std::size_t n = outline.size();
      if (n < 3)
        refuse("An outline needs at least three corners.", std::to_string(n));
      for (const Vector2d &x : outline)
        if (!x.allFinite())
          refuse("A corner of the outline is not a number.", print(x));
      for (std::size_t i = 0; i < n; ++i)
        if ((outline[(i + 1) % n] - outline[i]).norm() == 0)
          refuse("Two neighbouring corners of the outline are equal.", print(outline[i]));
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j)
          {
            if (i == 0 && j + 1 == n)
              continue;
            const Vector2d &a = outline[i], &b = outline[i + 1], &c = outline[j], &d = outline[(j + 1) % n];
            if (cross(a, b, c) * cross(a, b, d) <= 0 && cross(c, d, a) * cross(c, d, b) <= 0
                && (std::min(a[0], b[0]) <= std::max(c[0], d[0]) && std::min(c[0], d[0]) <= std::max(a[0], b[0])
                    && std::min(a[1], b[1]) <= std::max(c[1], d[1]) && std::min(c[1], d[1]) <= std::max(a[1], b[1])))
              refuse("The outline crosses or touches itself.",
                     "sides from " + print(a) + " to " + print(b) + " and from " + print(c) + " to " + print(d));
          }
      if (signed_area(outline) <= 0)
        refuse("The outline runs clockwise or has no area.", "area " + std::to_string(signed_area(outline)) + " mm^2",
               "corners counter-clockwise");
    }

    /// Before anything is allocated.
    void
    check_number(const std::vector<Vector2d> &outline, const double step)
    {
      Vector2d low = outline[0], high = low;
      for (const Vector2d &x : outline)
        {
          low  = low.cwiseMin(x);
          high = high.cwiseMax(x);
        }
      const double n_candidates = (high - low).prod() / (std::sqrt(0.75) * step * step);
      if (n_candidates > most_candidates)
        refuse("The elements are too small for this blank.", std::to_string(step) + " mm",
               "at least " + std::to_string(step * std::sqrt(n_candidates / most_candidates)) + " mm");
    }

    bool
    is_inside(const std::vector<Vector2d> &outline, const Vector2d &x)
    {
      bool inside = false;
      for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++)
        {
          const Vector2d &a = outline[i], &b = outline[j];
          if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]) + a[0])
            inside = !inside;
        }
      return inside;
    }

    /// The outline with points on its sides at the distance of the local size.
    std::vector<Vector2d>
    divide_sides(const std::vector<Vector2d> &outline, const SizeField &size)
    {
      std::vector<Vector2d> result;
      for (std::size_t i = 0; i < outline.size(); ++i)
        {
          const Vector2d &a = outline[i], b = outline[(i + 1) % outline.size()];
          const double    length = (b - a).norm();
          // Number of elements up to a position along the side, by the midpoint rule.
          const auto          n_steps = static_cast<std::size_t>(std::ceil(8 * length / size.smallest()));
          std::vector<double> count{ 0 };
          for (std::size_t k = 0; k < n_steps; ++k)
            count.push_back(
                count.back()
                + length / static_cast<double>(n_steps)
                      / size.at(a + (static_cast<double>(k) + 0.5) / static_cast<double>(n_steps) * (b - a)));
          const double elements = std::max(1., std::round(count.back()));
          std::size_t  k        = 0;
          for (double e = 0; e < elements - 0.5; ++e)
            {
              const double wanted = e / elements * count.back();
              while (k + 1 < n_steps && count[k + 1] < wanted)
                ++k;
              const double part = (static_cast<double>(k) + (wanted - count[k]) / (count[k + 1] - count[k]))
                                  / static_cast<double>(n_steps);
              result.push_back(e == 0 ? a : Vector2d(a + part * (b - a)));
            }
        }
      return result;
    }

    /// Points in square bins of the smallest size, for the question whether another one is near.
    class Bins
    {
    public:
      Bins(const Vector2d &lower, const double bin_width) : low(lower), width(bin_width) {}

      void
      add(const Vector2d &x)
      {
        bins[index(x)].push_back(x);
      }
      bool
      has_near(const Vector2d &x, const double distance) const
      {
        const auto at    = index(x);
        const int  reach = static_cast<int>(std::ceil(distance / width));
        for (int i = -reach; i <= reach; ++i)
          for (auto bin = bins.lower_bound({ at.first + i, at.second - reach });
               bin != bins.end() && bin->first <= std::make_pair(at.first + i, at.second + reach); ++bin)
            for (const Vector2d &y : bin->second)
              if ((x - y).squaredNorm() < distance * distance)
                return true;
        return false;
      }

    private:
      Vector2d                                             low;
      double                                               width;
      std::map<std::pair<int, int>, std::vector<Vector2d>> bins;

      std::pair<int, int>
      index(const Vector2d &x) const
      {
        return { static_cast<int>(std::floor((x[0] - low[0]) / width)),
                 static_cast<int>(std::floor((x[1] - low[1]) / width)) };
      }
    };

    /// Boundary points first, then points of a triangular lattice of the smallest size, left out where the wanted size
    /// is larger.
    std::vector<Vector2d>
    spread_points(const std::vector<Vector2d> &boundary, const SizeField &size)
    {
      Vector2d low = boundary[0], high = low;
      for (const Vector2d &x : boundary)
        {
          low  = low.cwiseMin(x);
          high = high.cwiseMax(x);
        }
      const double          step = size.smallest(), row_height = std::sqrt(0.75) * step;
      std::vector<Vector2d> points = boundary;
      Bins                  bins(low, step);
      for (const Vector2d &x : boundary)
        bins.add(x);
      const auto n_rows    = static_cast<long>((high[1] - low[1]) / row_height),
                 n_columns = static_cast<long>((high[0] - low[0]) / step) + 1;
      for (long j = 0; j <= n_rows; ++j)
        for (long i = 0; i <= n_columns; ++i)
          {
            // Back and forth, so that the next point is near the last one.
            const auto     column = static_cast<double>(j % 2 == 0 ? i : n_columns - i);
            const Vector2d x(low[0] + step * (column + (j % 2 == 0 ? 0.25 : -0.25)),
                             low[1] + row_height * (static_cast<double>(j) + 0.5));
            if (!is_inside(boundary, x) || bins.has_near(x, least_distance * size.at(x)))
              continue;
            points.push_back(x);
            bins.add(x);
          }
      return points;
    }

    void
    check_mesh(const Delaunay &mesh, const std::size_t n_boundary)
    {
      std::vector<bool> found(n_boundary, false);
      std::size_t       n_outer = 0;
      for (const Delaunay::Triangle &t : mesh.triangle)
        {
          for (unsigned k = 0; k < 3; ++k)
            if (t.neighbour[k] < 0)
              {
                const auto a = static_cast<std::size_t>(t.vertex[(k + 1) % 3]);
                ++n_outer;
                if (a < n_boundary && static_cast<std::size_t>(t.vertex[(k + 2) % 3]) == (a + 1) % n_boundary)
                  found[a] = true;
              }
          const double quality = mesh.quality(t.vertex);
          if (quality < least_quality)
            refuse("The mesh has a needle-shaped triangle.", "at " + print(mesh.point[t.vertex[0]]), "",
                   "Use smaller elements where the outline has narrow or pointed parts.");
        }
      for (std::size_t a = 0; a < n_boundary; ++a)
        if (!found[a] || n_outer != n_boundary)
          refuse("The elements are too large for a narrow part of the outline.", "near " + print(mesh.point[a]), "",
                 "Use smaller elements there.");
    }
  } // namespace

  double
  SizeField::at(const Vector2d &x) const
  {
    double result = size;
    for (const Zone &zone : zones)
      {
        const double dx = std::max({ zone.low[0] - x[0], 0., x[0] - zone.high[0] });
        const double dy = std::max({ zone.low[1] - x[1], 0., x[1] - zone.high[1] });
        result          = std::min(result, zone.size + growth * std::hypot(dx, dy));
      }
    return result;
  }

  double
  SizeField::smallest() const
  {
    double result = size;
    for (const Zone &zone : zones)
      result = std::min(result, zone.size);
    return result;
  }

  std::vector<Vector2d>
  circular_arc(const Vector2d &centre, const double radius, const double from, const double to, const SizeField &size)
  {
    // Steps of equal angle, with the smallest size found along the arc where it is graded only slightly; else local.
    std::vector<Vector2d> points;
    double                angle = from;
    std::vector<double>   angles{ from };
    while (angle < to && angles.size() < 1000000)
      {
        angle += size.at(centre + radius * Vector2d(std::cos(angle), std::sin(angle))) / radius;
        angles.push_back(angle);
      }
    // Stretch so that the last step ends at the end.
    const double last = angles.back(), before = angles[angles.size() - 2];
    if (angles.size() > 2 && to - before < 0.5 * (last - before))
      angles.pop_back();
    const double factor = (to - from) / (angles.back() - from);
    for (const double a : angles)
      {
        const double at = from + factor * (a - from);
        points.push_back(centre + radius * Vector2d(std::cos(at), std::sin(at)));
      }
    return points;
  }

  BlankMesh
  make_outline_mesh(const std::vector<Vector2d> &outline, const SizeField &size, const bool quarter)
  {
    if (!(size.smallest() > 0))
      refuse("The element size must be positive.", std::to_string(size.smallest()) + " mm");
    check_outline(outline);
    check_number(outline, size.smallest());
    const std::vector<Vector2d> boundary = divide_sides(outline, size);
    Delaunay                    mesh(spread_points(boundary, size));
    mesh.keep([&](const Vector2d &x) { return is_inside(boundary, x); });
    mesh.smooth(static_cast<unsigned>(boundary.size()), [&](const Vector2d &x) { return size.at(x); });
    check_mesh(mesh, boundary.size());

    BlankMesh result;
    for (std::size_t i = 0; i + 3 < mesh.point.size(); ++i)
      {
        const Vector2d &x    = mesh.point[i];
        const bool      edge = i < boundary.size();
        result.nodes.emplace_back(x[0], x[1], 0.);
        result.on_x_plane.push_back(quarter && edge && x[0] == 0);
        result.on_y_plane.push_back(quarter && edge && x[1] == 0);
        result.on_outer_edge.push_back(edge);
      }
    for (const Delaunay::Triangle &t : mesh.triangle)
      result.triangles.push_back({ static_cast<unsigned>(t.vertex[0]), static_cast<unsigned>(t.vertex[1]),
                                   static_cast<unsigned>(t.vertex[2]) });
    result.symmetry_factor = quarter ? 4 : 1;
    result.mark_outer_edge();
    return result;
  }

  BlankMesh
  make_disc(const double radius, const SizeField &size, const bool quarter)
  {
    if (!(radius > 0))
      refuse("The size of the blank must be positive.", std::to_string(radius) + " mm", "> 0");
    std::vector<Vector2d> outline = circular_arc(Vector2d::Zero(), radius, 0, quarter ? 0.5 * M_PI : 2 * M_PI, size);
    if (!quarter)
      outline.pop_back(); // the end is the beginning
    else
      {
        outline.front()[1] = outline.back()[0] = 0; // on the planes of symmetry, exactly
        outline.emplace_back(0., 0.);
      }
    return make_outline_mesh(outline, size, quarter);
  }
} // namespace tribodraw
