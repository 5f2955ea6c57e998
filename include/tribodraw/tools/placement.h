#ifndef tribodraw_tools_placement_h
#define tribodraw_tools_placement_h

#include <tribodraw/tools/tool_geometry.h>

#include <optional>
#include <string>
#include <vector>

namespace tribodraw
{
  /// A tool shape at a place, as contact sees it.
  struct PlacedTool
  {
    const ToolGeometry *shape    = nullptr;
    Eigen::Vector3d     place    = Eigen::Vector3d::Zero(); ///< origin of the shape's frame [mm]
    bool                mirrored = false;                   ///< the shape is turned upside down (z -> -z)

    /// In the blank's frame.
    ToolDistance distance(const Eigen::Vector3d &x) const;
  };

  /// Smallest signed distance [mm] of @p points from the tool, with the point.
  struct NearestPoint
  {
    double      distance;
    std::size_t index;
  };
  NearestPoint nearest_point(const PlacedTool &tool, const std::vector<Eigen::Vector3d> &points);

  /// How deep the faces of a sheet with the nodes @p middle_surface are inside the tool [mm]; negative: the gap that
  /// is left. @p half_thickness [mm].
  double initial_penetration(const PlacedTool &tool, const std::vector<Eigen::Vector3d> &middle_surface,
                             double half_thickness);

  /// Place of the shape's frame at which a tool that comes along the unit vector @p direction first touches the sheet,
  /// that is the nearest of the nodes @p middle_surface has the distance @p half_thickness. @p tool is any place on
  /// its way. Nothing if the tool passes beside the sheet. Throws InputError if the sheet lies inside the tool's body
  /// even far away: the tool faces the other way.
  std::optional<Eigen::Vector3d> touching_place(PlacedTool tool, const Eigen::Vector3d &direction,
                                                const std::vector<Eigen::Vector3d> &middle_surface,
                                                double                              half_thickness);

  /// Gap between two tools, where it is smallest.
  struct Clearance
  {
    double          gap;   ///< [mm], negative if the tools overlap: by so much in the direction of least overlap
    Eigen::Vector3d place; ///< a point between the tools
    std::size_t     n_points = 0; ///< at which both distances were asked
  };
  /// Smallest gap between two tools inside the box @p low to @p high. The box is searched to cells of edge @p spacing,
  /// or a 250th of its longest side where that is more (so that the work is bounded for tools of every size), from the
  /// best of them by descent. The true gap is at most the given one, and at least the given one less 1.8 of these
  /// edges; at smooth surfaces the error is of second order in the edge.
  Clearance smallest_clearance(const PlacedTool &a, const PlacedTool &b, const Eigen::Vector3d &low,
                               const Eigen::Vector3d &high, double spacing);

  /// What is wrong with the size of a tool whose surface has bounds, compared with the larger side of the blank [mm]:
  /// in plan it is a thirtieth of it or less, or thirty times it or more. Empty if nothing is.
  std::string implausible_size(const ToolGeometry &shape, double blank_side);

  /// Number of elements of a given size [mm] along the quarter circle of the tool's smallest convex radius;
  /// infinity for a plane.
  double elements_on_smallest_radius(const ToolGeometry &shape, double element_size);
} // namespace tribodraw

#endif
