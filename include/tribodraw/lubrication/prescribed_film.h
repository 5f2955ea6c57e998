#ifndef tribodraw_lubrication_prescribed_film_h
#define tribodraw_lubrication_prescribed_film_h

#include <tribodraw/base/csv.h>
#include <tribodraw/fluid/viscosity_law.h>
#include <tribodraw/lubrication/film_transport.h>
#include <tribodraw/lubrication/gap_shape.h>

#include <Eigen/Core>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// The average Reynolds equation on a prescribed gap (task `film`): the solvers of the blank on cases with closed
  /// forms. The lower surface (1, "sheet") is the plane z = 0 and slides along +x, the upper one (2, "tool") carries
  /// the shape of the gap and may approach; at x = 0, x = length and open sides the pressure is the ambient one.
  class PrescribedFilm
  {
  public:
    /// What happens where the pressure would be negative.
    enum class Cavitation
    {
      none,           ///< negative pressure is carried (Sommerfeld)
      cut_off,        ///< the same, then negative pressure is set to zero (half Sommerfeld)
      reynolds,       ///< p >= 0, no pressure gradient where the film ruptures (Swift, Stieber)
      mass_conserving ///< FilmTransport, steady (Jakobsson, Floberg, Olsson; Elrod)
    };

    struct Result
    {
      double   load         = 0;                          ///< resultant of the pressure [N]
      double   attitude     = 0;                          ///< its direction from the narrowest gap of a journal [rad]
      double   max_pressure = 0;                          ///< [MPa], at a node
      double   x_max = 0, y_max = 0;                      ///< where [mm]
      double   rupture_x = 0;                             ///< the film ends here behind the greatest pressure [mm]
      double   flow_in = 0, flow_out = 0, flow_sides = 0; ///< through x = 0, x = length, y = 0 and y = width [mm^3/s]
      double   friction_sheet        = 0;                 ///< shear force against the motion of the lower surface [N]
      double   friction_tool         = 0;                 ///< shear force on the upper surface along +x [N]
      double   cavitated_fraction    = 0;                 ///< of the free nodes
      double   flux_imbalance        = 0;
      double   volume_error          = 0; ///< mass conserving: |inflow - outflow| over the flow through all dual cells
      double   fall_time             = 0; ///< under the given load to the final gap [s]
      unsigned active_set_iterations = 0, viscosity_iterations = 0;

      std::vector<Eigen::Vector3d>         nodes;
      std::vector<std::array<unsigned, 3>> triangles;
      std::vector<double>                  pressure, film; ///< at the nodes [MPa], [mm]
      std::vector<double>                  fill;           ///< of the gap by lubricant, at the nodes
      std::vector<bool>                    open;           ///< nodes of ambient pressure
    };

    /// One solution for the pressure at one gap. There are several where the viscosity depends on the pressure.
    struct Pass
    {
      unsigned gap = 0, n_gaps = 1;               ///< the gap given is number 0, those of the fall follow
      double   least_gap             = 0;         ///< [mm]
      unsigned number                = 1;         ///< of the pass, counted from 1
      unsigned active_set_iterations = 0;
      double   change                = 0;         ///< of the pressure since the pass before, by the largest pressure
      bool     settled               = false;     ///< the last one at this gap
    };
    /// Sees every pass and the film as it is then, without load and friction.
    using Watcher = std::function<void(const Pass &, const Result &)>;

    /// Reads the sections `Gap`, `Process` and `Lubricant`; call at the top level of the file.
    explicit PrescribedFilm(Parameters &parameters);

    /// Throws ConvergenceError if active set or viscosity do not settle.
    Result solve(const Watcher &watcher = {}) const;
    /// Rows of results.csv: `quantity,value,unit`.
    CsvTable    table(const Result &result) const;
    std::string describe() const;

  private:
    std::shared_ptr<const GapShape>     shape;
    std::shared_ptr<const ViscosityLaw> viscosity_law;
    double                              sheet_speed = 0, tool_speed = 0; ///< [mm/s]
    unsigned                            n_along = 1, n_across = 1;
    bool                                open_sides = true;
    std::vector<double>                 pressure_factor;  ///< xx, yy
    double                              sheared_film = 0; ///< Sq PhiS_xx [mm]

    double              smallest_element = 1; ///< at jumps of the gap, in parts of the others
    Cavitation          cavitation       = Cavitation::reynolds;
    double              ambient = 0, approach = 0; ///< pressure [MPa], speed of the upper surface [mm/s]
    double              fall_load = 0, final_gap = 0; ///< zero: no fall asked for

    struct Solver;
    void                read_cavitation(Parameters &parameters);
    std::vector<double> lines_along() const;
    void                make_mesh(Result &result) const;
    void                make_rectangle(Result &result) const;
    std::vector<FilmTransport::NodeData> make_data(const Result &result) const;
    void                                 solve_film(const Solver &solver, Result &result, Pass pass, const Watcher &watcher) const;
    double                               pressure_shift(const Result &result) const;
    void                                 find_flow(Result &result, const std::vector<double> &outflow) const;
    void                                 find_load(Result &result) const;
    void                                 find_friction(Result &result) const;
    double                               find_fall_time(const Solver &solver, Result film, const Watcher &watcher) const;
  };
} // namespace tribodraw

#endif
