#ifndef tribodraw_forming_friction_coupling_h
#define tribodraw_forming_friction_coupling_h

#include <tribodraw/contact/contact.h>
#include <tribodraw/shell/shell.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Where the friction coefficient of each node comes from. Each accepted increment gives new coefficients, with which
  /// the next one starts (staggered, paper Fig. 8); a coupling may also change them within the increment (iterated).
  class FrictionCoupling
  {
  public:
    /// The increment at hand.
    struct Increment
    {
      double dt      = 0;     ///< [s]
      double travel  = 0;     ///< punch travel in the increment [mm]
      bool   closing = false; ///< blank holder closes, punch at rest
    };
    /// Figures for history.csv and the screen; index 0: punch side, 1: die side.
    struct Summary
    {
      std::array<double, n_faces> max_lubricant_pressure{{0, 0}}; ///< [MPa]
      std::array<double, n_faces> mean_mu{{0, 0}};                ///< load-weighted
      double                      starved_area_fraction  = 0;     ///< of the contact area
      double                      lubricant_volume_error = 0;     ///< relative
    };

    virtual ~FrictionCoupling() = default;
    /// Coefficients at the start.
    virtual void start(const Shell &shell, Contact &contact) = 0;
    /// At trial states of shell and contact that are close to equilibrium or in it: whether the coefficients that belong to
    /// them differ from those that act. If so they are handed to the contact, and the search goes on. Accepts nothing.
    virtual bool iterate(const Shell &, Contact &, const Increment &, bool /*in_equilibrium*/) { return false; }
    /// The increment has failed: back to the coefficients of the committed state.
    virtual void revert(Contact &) {}
    /// The increment is accepted: new coefficients from the committed states of shell and contact.
    virtual void update(const Shell &shell, Contact &contact, const Increment &increment) = 0;
    virtual Summary summary() const = 0;
    /// Nodal fields for output by their names in the design, NaN where there is no contact.
    virtual std::map<std::string, std::vector<double>> fields() const { return {}; }
    /// Text for the log after each increment (empty: nothing).
    virtual std::string report() const { return ""; }
    /// Lines for the log at the end of the run; may warn.
    virtual void        report_end() const {}
    virtual void        save(Archive &) const {}
    virtual void        load(const Archive &) {}
  };

  /// Friction coefficient of each face, weighted with the normal force, in the committed state; 0 without contact.
  std::array<double, n_faces> mean_coefficients(const Shell &shell, const Contact &contact);
} // namespace tribodraw

#endif
