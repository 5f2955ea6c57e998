#ifndef tribodraw_lubrication_lubrication_settings_h
#define tribodraw_lubrication_lubrication_settings_h

#include <string>

namespace tribodraw
{
  class Parameters;

  /// Decisions and numerical controls of the mixed-lubrication model. Sections `Coupling` and `Lubricant`.
  struct LubricationSettings
  {
    /// Which pressure the boundary layer feels (law tau_BL(P0)).
    enum class BoundaryLayerPressure
    {
      solid_plus_lubricant, ///< P0 = P_sol/alpha + P_lub: force balance on an asperity top
      nominal               ///< P0 = P_nom/alpha: as printed in the paper
    };
    /// What decides whether there is enough lubricant.
    enum class Supply
    {
      paper_rule,    ///< h_inp A0/A < h_avg: boundary friction, no lubricant pressure
      film_transport ///< lubricant is a state: carried, pushed and conserved (FilmTransport)
    };

    BoundaryLayerPressure boundary_layer_pressure = BoundaryLayerPressure::solid_plus_lubricant;
    Supply                supply                  = Supply::paper_rule;
    bool                  squeeze         = false;   ///< the gap closes on the lubricant; always with film transport
    bool                  memory          = true;    ///< the cut height never rises
    bool                  thinning        = true;    ///< the supplied film of the paper's rule is h_inp A0/A, else h_inp
    unsigned              smoothing       = 1;       ///< passes over the nominal pressure
    unsigned              film_iterations = 1;       ///< film solutions per increment at most
    double                film_relaxation = 1;       ///< part of the new lubricant pressure taken over
    double                contact_threshold       = 0.05; ///< smallest nominal pressure that counts as contact [MPa]
    double                fresh_contact_pressure  = 3;   ///< for the coefficient of nodes that are not in contact [MPa]
    double                smallest_travel         = 0.2; ///< punch travel between film solutions [mm]
    double                min_friction = 0.005, max_friction = 0.3;
    unsigned              friction_loops = 0; ///< equilibria sought again in an increment at most; 0: staggered
    double                friction_tolerance = 0; ///< change of the friction force at which the loop ends, relative
    double                phi_p_floor = 1e-3; ///< smallest eigenvalue of PhiP

    /// Reads `Coupling` and `Lubricant/Supply`; call at the top level of the file.
    static LubricationSettings read(Parameters &parameters);
    /// Reads the two entries of the current subsection (`Coupling`) that every contact with asperities needs:
    /// `Boundary layer pressure` and `Smallest pressure factor`.
    void read_micro_settings(Parameters &parameters);

  private:
    void read_friction_loop(Parameters &parameters);
  };
} // namespace tribodraw

#endif
