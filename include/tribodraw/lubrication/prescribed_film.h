#ifndef tribodraw_lubrication_prescribed_film_h
#define tribodraw_lubrication_prescribed_film_h

#include <tribodraw/base/csv.h>
#include <tribodraw/fluid/viscosity_law.h>
#include <tribodraw/lubrication/gap_shape.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// The average Reynolds equation on a prescribed gap (task `film`): the solver of the blank on cases with closed
  /// forms. The lower surface (1, "sheet") is the plane z = 0 and slides along +x, the upper one (2, "tool") carries
  /// the shape of the gap; the pressure is zero at x = 0 and x = length and never negative.
  class PrescribedFilm
  {
  public:
    struct Result
    {
      double   load         = 0;                          ///< [N]
      double   max_pressure = 0;                          ///< [MPa], at a node
      double   x_max = 0, y_max = 0;                      ///< where [mm]
      double   flow_in = 0, flow_out = 0, flow_sides = 0; ///< through x = 0, x = length, y = 0 and y = width [mm^3/s]
      double   friction_sheet        = 0;                 ///< shear force against the motion of the lower surface [N]
      double   friction_tool         = 0;                 ///< shear force on the upper surface along +x [N]
      double   cavitated_fraction    = 0;                 ///< of the free nodes
      double   flux_imbalance        = 0;
      unsigned active_set_iterations = 0, viscosity_iterations = 0;

      std::vector<Eigen::Vector3d>         nodes;
      std::vector<std::array<unsigned, 3>> triangles;
      std::vector<double>                  pressure, film; ///< at the nodes [MPa], [mm]
    };

    /// Reads the sections `Gap`, `Process` and `Lubricant`; call at the top level of the file.
    explicit PrescribedFilm(Parameters &parameters);

    /// Throws ConvergenceError if active set or viscosity do not settle.
    Result solve() const;
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

    std::vector<double> lines_along() const;
    void                make_mesh(Result &result) const;
    void                find_flow(Result &result, const std::vector<double> &outflow) const;
    void                find_friction(Result &result) const;
  };
} // namespace tribodraw

#endif
