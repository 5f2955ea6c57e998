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
  /// Each node carries a film fraction theta = (lubricant volume)/(volume of the gap) and a pressure. One of three
  /// holds:
  ///   starved : 0 <= theta < 1, p = 0         the gap is partly filled;
  ///   full    : theta = 1, 0 <= p <= p_limit  the average Reynolds equation;
  ///   lifted  : theta > 1, p = p_limit        the contact carries no more: the gap opens to theta h.
  /// The volume balance of the dual cell (a third of the triangles around the node) holds in all of them,
  ///   (A h theta - V_old)/dt + sum over neighbours of theta_upwind F.n - M grad p.n + outflow - inflow = 0,
  ///   F = h (U1 + U2)/2 + Sq PhiS (U1 - U2)/2 - h W,   M = h^3/(12 eta) PhiP,
  /// W being the velocity of the mesh (that of the sheet where the mesh is fixed to it). Pressure flow as in linear
  /// elements, transport by fluxes between the dual cells, hence conservative to round-off; with theta = 1
  /// everywhere it is the equation of AverageReynolds. Not to be used by two threads at a time.
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

    /// `fixed` and `squeeze` of the base are not used: `kind` says what holds, and closing gaps show in the volume. A
    /// `carried` node needs no film and no viscosity.
    struct NodeData : AverageReynolds::NodeData
    {
      Kind   kind   = Kind::film;
      double inflow = 0; ///< volume supplied from outside [mm^3/s]
      double old_volume
          = 0; ///< lubricant at the node at the start of the time step [mm^3]; not used in the steady state
    };

    struct Result
    {
      std::vector<double> pressure; ///< [MPa]
      std::vector<double> fill;     ///< theta; of a carried node the thickness of its film [mm]
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
