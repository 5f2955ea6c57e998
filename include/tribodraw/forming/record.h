#ifndef tribodraw_forming_record_h
#define tribodraw_forming_record_h

#include <tribodraw/forming/friction_coupling.h>
#include <tribodraw/forming/necking.h>

namespace tribodraw
{
  /// Figures of a committed increment, of the full part. One row of history.csv.
  struct IncrementRecord
  {
    double   time = 0, punch_travel = 0;
    double   path = 0; ///< punch travel, or what stands for it in a process without a punch [mm]
    double   punch_force = 0, die_force = 0, blank_holder_force = 0; ///< downward positive on the sheet by punch and holder, upward by the die [N]
    double   force_imbalance = 0; ///< |sum of vertical forces on the sheet| / sum of magnitudes
    double   draw_in_x = 0, draw_in_y = 0, draw_in_diagonal = 0;
    double   min_thickness = 0, max_eps_p = 0;
    double   unloaded = 0; ///< share of the tool forces that has been taken away
    FormingLimitState         forming_limit;
    FrictionCoupling::Summary friction;
    unsigned newton_iterations = 0;
    double   increment = 0; ///< of the path [mm]
    double   residual  = 0;
    double   max_penetration = 0;
    // energies of the full part [N mm]
    double external_work = 0, elastic_energy = 0, plastic_work = 0, friction_work = 0, contact_energy = 0, stabilisation_work = 0;
    /// (external - elastic - plastic - friction - contact - stabilisation) / external
    double energy_error() const;
  };
} // namespace tribodraw

#endif
