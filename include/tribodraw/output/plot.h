#ifndef tribodraw_output_plot_h
#define tribodraw_output_plot_h

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tribodraw
{
  /// Figures, drawn by gnuplot as SVG and PNG. If gnuplot is missing one warning is logged and nothing is drawn:
  /// figures are never a reason for a run to fail. Texts are taken literally (UTF-8).
  namespace plot
  {
    /// One curve. Points with a coordinate that is not finite interrupt it.
    struct Series
    {
      enum class Style
      {
        line,
        dashed_line,
        points,
        dots, ///< small points, for clouds
        line_with_points
      };
      std::string         label; ///< empty: not in the key
      std::vector<double> x, y;
      Style               style = Style::line;
    };

    struct LineChart
    {
      std::string         title, x_label, y_label; ///< labels carry the unit: `Punch travel / mm`
      bool                logarithmic_x = false, logarithmic_y = false;
      bool                y_from_zero = false; ///< start the y axis at 0
      bool                equal_axes  = false; ///< one unit is as long in x as in y
      std::vector<Series> series = {};
    };

    /// Values on a regular grid. NaN has one of two meanings: in the body but without a value (drawn grey) or outside
    /// the body (not drawn), see @p inside.
    struct Raster
    {
      std::size_t         nx = 0, ny = 0;
      double              x_min = 0, x_max = 1, y_min = 0, y_max = 1; ///< outer borders of the grid
      std::vector<double> value;                                      ///< value[iy * nx + ix], y upwards
      std::vector<char>   inside;                                     ///< empty: everywhere
    };

    /// A field in plan view with a perceptually uniform colour scale.
    struct MapChart
    {
      std::string                              title, x_label, y_label, value_label;
      Raster                                   raster;
      std::optional<std::pair<double, double>> range; ///< of the colour scale; default: least and greatest value
      std::vector<std::string> classes; ///< names of the values 1, 2, ..., if they are no quantity; each has one colour
      /// Polylines drawn on top (outlines), in the coordinates of the raster.
      std::vector<std::vector<std::array<double, 2>>> lines;
    };

    /// Least and greatest finite value; (0, 1) if there is none, widened if both are equal.
    std::pair<double, double> value_range(const std::vector<double> &values);

    /// A triangle mesh in plan view.
    struct PlanMesh
    {
      std::vector<std::array<double, 2>>   points;
      std::vector<std::array<unsigned, 3>> triangles;
      /// Closed or open chains of the edges that belong to one triangle only.
      std::vector<std::vector<std::array<double, 2>>> outline() const;
    };
    constexpr std::size_t map_pixels = 600; ///< along the longer side, twice what a page shows
    /// Paint a field that is linear on each triangle (one value a point). Pixels nearest to a NaN corner have no value.
    Raster rasterise_nodal(const PlanMesh &mesh, const std::vector<double> &values, std::size_t pixels = map_pixels);
    /// Each pixel gets the value of the nearest corner of its triangle.
    Raster rasterise_nearest(const PlanMesh &mesh, const std::vector<double> &values, std::size_t pixels = map_pixels);
    /// Paint a field that is constant on each triangle.
    Raster rasterise_cells(const PlanMesh &mesh, const std::vector<double> &values, std::size_t pixels = map_pixels);

    /// Write `<stem>.svg` and `<stem>.png`. Returns false (after a warning) if that was not possible.
    bool draw(const LineChart &chart, const std::filesystem::path &stem);
    bool draw(const MapChart &chart, const std::filesystem::path &stem);

    /// True if a gnuplot can be started.
    bool available();
  } // namespace plot
} // namespace tribodraw

#endif
