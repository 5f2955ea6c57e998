#ifndef tribodraw_lubrication_film_transport_h
#define tribodraw_lubrication_film_transport_h

#include <tribodraw/lubrication/average_reynolds.h>

#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace tribodraw
{
  /// The average Reynolds equation with transport of lubricant: mass-conserving cavitation and supply (Jakobsson,
  /// Floberg 1957; Olsson 1965; H. G. Elrod, J. Lubr. Technol. 103 (1981) 350), extended by lift-off at a pressure
  /// bound.
  ///
  /// Each node carries a film w = (lubricant volume)/(area) and a pressure. One of three holds, g(p) being the gap of the
  /// touching surfaces, which may yield to the pressure (GapCurve):
  ///   starved : 0 <= w < g(0), p = 0                    the gap is partly filled;
  ///   full    : w = g(p), 0 <= p <= p_limit             the average Reynolds equation;
  ///   lifted  : w > g(p_limit), p = p_limit             the contact carries no more: the gap opens to w.
  /// The volume balance of the dual cell (a third of the triangles around the node) holds in all of them,
  ///   (A w - V_old)/dt + sum over neighbours of (w/h)_upwind F.n - M grad p.n + outflow - inflow = 0,
  ///   F = h (U1 + U2)/2 + Sq PhiS (U1 - U2)/2 - h W,   M = h^3/(12 eta) PhiP,
  /// W being the velocity of the mesh (that of the sheet where the mesh is fixed to it) and h the gap for which the
  /// flow is computed, normally g. Pressure flow as in linear elements, transport by fluxes between the dual cells,
  /// hence conservative to round-off; with w = h everywhere it is the equation of AverageReynolds. Pressure over film
  /// is a monotone curve, so a gap that closes on trapped lubricant needs no damping. Not to be used by two threads at
  /// a time.
  class FilmTransport
  {
  public:
    enum class Kind
    {
      film,      ///< unknown as above
      border,    ///< p = 0 and theta <= 1: what arrives beyond that leaves (edge of the contact or of the sheet)
      reservoir, ///< flooded: theta = 1, p prescribed (fixed_pressure); takes and gives freely
      carried    ///< no tool here: the lubricant stays on the sheet, p = 0, the volume is not bounded
    };

    /// Gap of the touching surfaces over the pressure: straight lines between points that rise from pressure zero to
    /// p_limit.
    struct GapCurve
    {
      static constexpr unsigned       max_points = 6;
      unsigned                        n          = 0;
      std::array<double, max_points> pressure{}, gap{}; ///< [MPa], [mm]

      double   at(double p) const;
      unsigned segment(double p) const; ///< the point at its lower end
    };

    /// `fixed` and `squeeze` of the base are not used: `kind` says what holds, and closing gaps show in the volume. A
    /// `carried` node needs no film and no viscosity.
    struct NodeData : AverageReynolds::NodeData
    {
      Kind   kind   = Kind::film;
      double inflow = 0; ///< volume supplied from outside [mm^3/s]
      double old_volume
          = 0; ///< lubricant at the node at the start of the time step [mm^3]; not used in the steady state
      GapCurve closed;             ///< without points: the gap `film` whatever the pressure
    };

    struct Result
    {
      std::vector<double> pressure; ///< [MPa]
      std::vector<double> fill;     ///< theta = w/g(0); of a carried node the thickness of its film [mm]
      std::vector<double> volume;   ///< lubricant at the node [mm^3]
      std::vector<double> outflow;  ///< leaves at a border (>= 0) or a reservoir (either sign) [mm^3/s]
      unsigned            iterations = 0;
      bool                converged  = true;
      /// |volume now - before - (inflow - outflow) dt| relative to the volume or, in the steady state, |inflow -
      /// outflow| relative to the flow through all dual cells.
      double volume_error = 0;
    };

    static constexpr double steady = std::numeric_limits<double>::infinity();

    FilmTransport(const std::vector<Eigen::Vector3d> &reference, const std::vector<std::array<unsigned, 3>> &triangles,
                  double phi_p_floor = 1e-3);
    ~FilmTransport();

    /// @param dt time step [s], or `steady`.
    /// @param start result from which the active sets start (may be null).
    Result solve(const std::vector<Eigen::Vector3d> &positions, const std::vector<NodeData> &nodes, double dt,
                 const Result *start = nullptr) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };
} // namespace tribodraw

#endif
