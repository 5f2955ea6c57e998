#ifndef tribodraw_lubrication_strip_contact_h
#define tribodraw_lubrication_strip_contact_h

#include <tribodraw/fluid/viscosity_law.h>
#include <tribodraw/friction_table/friction_table.h>
#include <tribodraw/lubrication/lubrication_settings.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// A flat rigid tool on a strip that is drawn along x beneath it: the contact of a strip-drawing tribometer.
  ///
  /// The tool has a land of the stated length, rounded edges and possibly a slight inclination. It is loaded by a force
  /// and finds its own height: the distance d(x) of the mean planes follows from height and profile. Where the distance
  /// falls, the asperities are flattened until their tops meet the tool, h_avg(s) = d, and carry the solid pressure
  /// that flattens them so far at the stated strain; where it rises again they carry nothing. The gap h_avg = d is
  /// filled by what the strip brings (mass-conserving film transport, steady in the frame of the tool). The height is
  /// found such that solid and lubricant pressure carry the load.
  class StripContact
  {
  public:
    struct Geometry
    {
      double   length      = 0;     ///< of the land along the drawing direction [mm]
      double   width       = 0;     ///< [mm]
      double   edge_radius = 0;     ///< of the rounded edges at inlet and outlet [mm]
      double   inclination = 0;     ///< how much wider the gap is at the start of the land than at its end [mm]
      bool     open_sides  = false; ///< pressure zero at the sides; else no flow there, as in a wide contact
      unsigned n_along     = 0;     ///< elements
      unsigned n_across    = 1;

      /// Reads the current subsection.
      static Geometry read(Parameters &parameters);
    };

    /// One operating point.
    struct Conditions
    {
      double pressure      = 0; ///< nominal: load over length times width [MPa]
      double speed         = 0; ///< of the strip [mm/s]
      double strain        = 0; ///< equivalent plastic strain of the strip, reached under the tool
      double supplied_film = 0; ///< lubricant on the face of the strip, as a film [mm]
    };

    struct Result
    {
      double   friction_coefficient = 0;                 ///< force on one face over load
      double   solid_friction = 0, viscous_friction = 0; ///< its parts
      double   solid_share = 0, lubricant_share = 0;     ///< of the load
      double   mean_film = 0, contact_fraction = 0;      ///< mean over the land [mm]
      double   film_ratio             = 0;               ///< mean film over Sq
      double   max_lubricant_pressure = 0;               ///< [MPa]
      double   starved_fraction       = 0;               ///< of the land's area
      double   tool_height            = 0;               ///< distance of the mean planes at the end of the land [mm]
      double   flow_in = 0, rejected = 0, flow_out = 0, flow_sides = 0; ///< of lubricant [mm^3/s]
      double   flow_error      = 0; ///< |in - rejected - out - sides| / flow through all elements
      double   load_error      = 0; ///< carried load against the stated one
      unsigned load_iterations = 0, film_iterations = 0;

      enum class Regime
      {
        boundary, ///< the lubricant carries less than a hundredth of the load
        mixed,
        full_film ///< the asperities carry less than a hundredth of the load
      };
      Regime regime = Regime::boundary;

      /// Along the middle of the contact, one value a station.
      struct Profile
      {
        std::vector<double> x, gap, solid_pressure, lubricant_pressure, fill, contact_fraction;
      } profile;
    };

    /// @param table of the pair of surfaces; @param law with its reference viscosity set
    StripContact(const Geometry &geometry, std::shared_ptr<const FrictionTable> table,
                 std::shared_ptr<const ViscosityLaw>        law,
                 LubricationSettings::BoundaryLayerPressure boundary_layer_pressure, double phi_p_floor);
    ~StripContact();

    /// Throws InputError if the table's pressures do not reach as far as the conditions ask for, ConvergenceError if
    /// film or load do not settle.
    Result solve(const Conditions &conditions) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };

  /// `boundary`, `mixed` or `full film`.
  std::string regime_name(StripContact::Result::Regime regime);

  /// Film of a gap that is wider than the touching asperities leave, h_avg > film.h_avg. Beyond the table PhiP - 1
  /// falls as h^-2 and PhiS as h^-1, as for small roughness in a wide gap (J. H. Tripp, J. Lubr. Technol. 105 (1983)
  /// 458).
  FrictionTable::Film lifted_film(const FrictionTable::Film &film, double h_avg);
} // namespace tribodraw

#endif
