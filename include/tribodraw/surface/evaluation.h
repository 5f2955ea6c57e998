#ifndef tribodraw_surface_evaluation_h
#define tribodraw_surface_evaluation_h

#include <tribodraw/surface/closed_voids.h>
#include <tribodraw/surface/profile_parameters.h>
#include <tribodraw/surface/roughness.h>

#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// At which heights, ratios and cut-offs a surface is evaluated.
  struct EvaluationSettings
  {
    double          smr_height            = 0;   ///< c of Smr(c), above the mean [mm]
    double          void_contact_fraction = 0.5; ///< at which Vcl is given
    ProfileSettings profiles;
  };

  /// Reads the subsection `Evaluation`; every entry has a default with its reason.
  EvaluationSettings read_evaluation(Parameters &parameters);

  /// One line of surface.csv: `parameter,value,unit`.
  struct ParameterRow
  {
    std::string parameter;
    double      value;
    std::string unit; ///< `1`: dimensionless
  };

  struct Evaluation
  {
    std::vector<ParameterRow> rows;
    std::vector<std::string>  notes; ///< which values are missing, and why
    std::vector<VoidState>    voids; ///< at contact fractions 0.01 to 0.99

    /// Value of a row, NaN if it does not exist.
    double value(const std::string &parameter) const;
  };

  /// All parameters of a map with finite heights: size, height, spatial, hybrid, functional and volume parameters,
  /// closed voids, profile parameters. Throws InputError if the map is empty or all heights are equal.
  Evaluation evaluate_surface(const HeightMap &map, const EvaluationSettings &settings);
} // namespace tribodraw

#endif
