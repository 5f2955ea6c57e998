#ifndef tribodraw_surface_form_h
#define tribodraw_surface_form_h

#include <tribodraw/surface/height_map.h>

#include <string>
#include <vector>

namespace tribodraw
{
  /// Names of the forms that can be removed (F-operation of ISO 25178-2): `none`, `mean`, `plane`, `second order`,
  /// `cylinder`, `sphere`.
  const std::vector<std::string> &form_names();

  /// Subtract the least-squares form and append to the description what was subtracted. All heights must be finite.
  /// - `none` changes nothing and throws InputError if the mean is not zero already (1e-6 of Sq), because every user of
  ///   a map relies on it;
  /// - `mean`, `plane`, `second order`: polynomials of degree 0, 1, 2 in x and y;
  /// - `cylinder`: z = c + t a - k w^2 / (1 + sqrt(1 - k^2 w^2)) with a the coordinate along the axis, w the distance
  ///   from it in plan and k = 1/R (negative: a hollow). The axis has any direction in plan; its tilt t must be small
  ///   (the radius is then wrong by the factor 1 + O(t^2));
  /// - `sphere`: the same with w the distance from a point.
  /// The sum of the squares of vertical distances is minimal (Levenberg-Marquardt for the last two, at most 50 steps).
  /// After a form other than the mean a periodic map is no longer called periodic. An empty map stays as it is. Throws
  /// InputError if the map has too few points or no measurable curvature.
  void remove_form(HeightMap &map, const std::string &form);

  /// Curved form as found by least squares, in mm, with the origin at the centre of the map.
  struct CurvedForm
  {
    double curvature = 0;  ///< k = 1/R, positive for a hill [1/mm]
    double x0 = 0, y0 = 0; ///< top of the sphere; for a cylinder the foot of the axis from the centre of the map
    double angle  = 0;     ///< of the axis of a cylinder against x [rad]
    double tilt   = 0;     ///< slope of the axis of a cylinder
    double height = 0;     ///< of the top above the mean
    double operator()(double x, double y) const;
    bool   is_cylinder = false;
  };
  CurvedForm fit_cylinder(const HeightMap &map);
  CurvedForm fit_sphere(const HeightMap &map);
} // namespace tribodraw

#endif
