#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/placement.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <queue>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector3d;

    /// Far enough for every press, near enough that double precision leaves 1e-10 mm.
    constexpr double far_away = 2e4;

    /// Into which the longest side of a box is divided at most in the search for a gap: some 1e6 cells lie on a surface
    /// through the box.
    constexpr double most_cells_along = 250;

    struct Cell
    {
      Vector3d centre, half;
      double   larger; ///< of both distances at the centre
      /// Of the gap in the cell. Half way between two bodies both distances are half the gap, elsewhere one of them is
      /// larger; and no distance changes by more than the way.
      double
      lower_bound() const
      {
        return 2 * (larger - half.norm());
      }
      bool
      operator<(const Cell &other) const
      {
        return lower_bound() > other.lower_bound(); // the most promising comes first
      }
    };
  } // namespace

  ToolDistance
  PlacedTool::distance(const Vector3d &x) const
  {
    if (!mirrored)
      return shape->distance(x - place);
    ToolDistance d = shape->distance({ x[0] - place[0], x[1] - place[1], place[2] - x[2] });
    d.normal[2] *= -1;
    d.curvature.row(2) *= -1;
    d.curvature.col(2) *= -1;
    return d;
  }

  NearestPoint
  nearest_point(const PlacedTool &tool, const std::vector<Vector3d> &points)
  {
    NearestPoint nearest{ std::numeric_limits<double>::infinity(), 0 };
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const double d = tool.distance(points[i]).distance;
        if (d < nearest.distance)
          nearest = { d, i };
      }
    return nearest;
  }

  double
  initial_penetration(const PlacedTool &tool, const std::vector<Vector3d> &middle_surface, const double half_thickness)
  {
    return half_thickness - nearest_point(tool, middle_surface).distance;
  }

  std::optional<Vector3d>
  touching_place(PlacedTool tool, const Vector3d &direction, const std::vector<Vector3d> &middle_surface,
                 const double half_thickness)
  {
    const Vector3d on_the_way = tool.place;
    tool.place -= far_away * direction;
    if (nearest_point(tool, middle_surface).distance < 0)
      throw InputError(
          describe_error("The body of a tool lies on the side of the blank.", tool.shape->describe(), "", "",
                         "Turn it round: another `Facing`, or the normals of a surface from a file reversed."));
    // A distance never overestimates how far the tool can move, so that each step ends before the first touch. The
    // steps shrink geometrically where the tool touches beside its deepest point; a steep wall takes the longest.
    for (int i = 0; i < 5000; ++i)
      {
        const double gap = nearest_point(tool, middle_surface).distance - half_thickness;
        if (gap < 1e-9)
          return tool.place;
        tool.place += gap * direction;
        if (direction.dot(tool.place - on_the_way) > far_away)
          return {};
      }
    return {};
  }

  Clearance
  smallest_clearance(const PlacedTool &a, const PlacedTool &b, const Vector3d &low, const Vector3d &high,
                     const double wanted_spacing)
  {
    const double spacing = std::max(wanted_spacing, (high - low).maxCoeff() / most_cells_along);
    // The sum of both distances is nowhere below the gap, and equal to it on the shortest line between the bodies.
    Clearance  best{ std::numeric_limits<double>::infinity(), low };
    const auto consider = [&](const Vector3d &x) {
      const double at_a = a.distance(x).distance, at_b = b.distance(x).distance;
      ++best.n_points;
      if (at_a + at_b < best.gap)
        {
          best.gap   = at_a + at_b;
          best.place = x;
        }
      return std::max(at_a, at_b);
    };
    std::priority_queue<Cell> cells;
    const Vector3d            centre = 0.5 * (low + high);
    cells.push({ centre, 0.5 * (high - low), consider(centre) });
    // Whole boxes are left out at once where their bound is not better than the best so far; what remains are cells
    // on the surface half way between the tools.
    while (!cells.empty() && cells.top().lower_bound() < best.gap)
      {
        const Cell cell = cells.top();
        cells.pop();
        int axis = 0;
        if (cell.half.maxCoeff(&axis) <= 0.5 * spacing)
          continue;
        for (const double sign : { -1., 1. })
          {
            Cell part = cell;
            part.half[axis] *= 0.5;
            part.centre[axis] += sign * part.half[axis];
            part.larger = consider(part.centre);
            if (part.lower_bound() < best.gap)
              cells.push(part);
          }
      }
    // Descent along the axes with a shrinking step.
    for (double step = 0.5 * spacing; step > 1e-3 * spacing;)
      {
        const double before = best.gap;
        const auto   from   = best.place;
        for (int axis = 0; axis < 3; ++axis)
          for (const double sign : { -1., 1. })
            consider((from + sign * step * Vector3d::Unit(axis)).cwiseMax(low).cwiseMin(high));
        if (!(best.gap < before - 1e-9 * spacing))
          step *= 0.5;
      }
    return best;
  }

  std::string
  implausible_size(const ToolGeometry &shape, const double blank_side)
  {
    const Vector3d size   = shape.extent().sizes();
    const double   larger = size.head<2>().maxCoeff(), ratio = larger / blank_side;
    if (std::isinf(larger) || (ratio > 1. / 30 && ratio < 30))
      return "";
    char text[160];
    std::snprintf(text, sizeof(text),
                  "its surface is %.3g x %.3g x %.3g mm, for a blank of %.4g mm: is its unit of length right?", size[0],
                  size[1], size[2], blank_side);
    return text;
  }

  double
  elements_on_smallest_radius(const ToolGeometry &shape, const double element_size)
  {
    return 0.5 * M_PI * shape.smallest_radius() / element_size;
  }
} // namespace tribodraw
