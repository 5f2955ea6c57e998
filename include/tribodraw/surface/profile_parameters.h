#ifndef tribodraw_surface_profile_parameters_h
#define tribodraw_surface_profile_parameters_h

#include <tribodraw/surface/height_map.h>

#include <optional>
#include <string>

namespace tribodraw
{
  /// How profiles are evaluated. Lengths in mm.
  struct ProfileSettings
  {
    bool   along_x     = false;  ///< direction of the profiles
    double cut_off     = 2.5;    ///< of the roughness profile
    double peak_height = 0.5e-3; ///< section levels of the peak count, above and below the mean line
  };

  /// Parameters that the sheet industry quotes, from all profiles of the map in one direction (Gaussian profile filters
  /// of ISO 16610-21). A value that the map is too short for does not exist; the reason is then stated.
  struct ProfileParameters
  {
    std::optional<double>      ra;  ///< mean of |r| over the roughness profiles [mm]
    std::optional<double>      rpc; ///< peaks per length [1/mm]
    std::optional<double>      wsa; ///< mean of |w| over the waviness profiles, Wsa(1-5) [mm]
    std::optional<std::string> no_roughness, no_waviness;
    double noise_cut_off = 0; ///< of the short-wave filter [mm]; 0: none, as it is below the pixel size
  };

  /// - Roughness profile: what lies between the short-wave cut-off (2.5 um for cut-offs to 0.8 mm, 8 um to 2.5 mm, 25
  /// um
  ///   above; ISO 3274) and the cut-off. It must be evaluated over at least five cut-offs; of an open map half a
  ///   cut-off at either end is for the run-in of the filter.
  /// - A peak of RPc (EN 10049) rises above the upper section level after the profile was below the lower one.
  /// - Waviness profile Wsa(1-5) (SEP 1941): what lies between 1 mm and 5 mm, over at least 25 mm plus 2.5 mm at either
  ///   end.
  ProfileParameters profile_parameters(const HeightMap &map, const ProfileSettings &settings);

  /// Short-wave cut-off that belongs to a cut-off (ISO 3274), in mm.
  double short_wave_cut_off(double cut_off);
} // namespace tribodraw

#endif
