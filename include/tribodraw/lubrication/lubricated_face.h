#ifndef tribodraw_lubrication_lubricated_face_h
#define tribodraw_lubrication_lubricated_face_h

#include <tribodraw/fluid/viscosity_law.h>
#include <tribodraw/friction_table/friction_table.h>
#include <tribodraw/lubrication/film_transport.h>
#include <tribodraw/lubrication/lubrication_settings.h>
#include <tribodraw/lubrication/surface_patch.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Archive;

  /// One face of the blank (the die side or the punch side): asperities, film and friction of every node.
  ///
  /// For each increment, as the paper's Fig. 8 and with its inconsistencies resolved: nominal pressure -> cut height s
  /// of the asperities (a state that never rises) -> lubricant pressure, 0 <= P_lub <= P_nom -> shear stress ->
  /// friction coefficient. attempt() finds what an increment makes of the face as often as wanted, accept() keeps it.
  ///
  /// Film transport: every node carries a volume of lubricant. Where a tool touches, FilmTransport finds how it moves
  /// and which pressure it takes: the gap h_avg(s) depends on P_lub through the solid pressure P_nom - P_lub that
  /// flattens, and is found together with it; where P_lub reaches P_nom the tool is lifted off the asperities. Where no
  /// tool touches the lubricant stays on the sheet. What reaches the outer edge of the blank beyond a full gap is lost.
  ///
  /// Paper rule: every material point keeps what it was given. The film it can supply is h_inp A0/A, A0 and A the area
  /// around the node on the undeformed and on the current middle surface (a third of the triangles), so the volume
  /// sum(h A) is conserved; compression that thickens the sheet thickens the film. Flattening sees P_nom minus the
  /// lubricant pressure of the previous film solution; all else the new one.
  ///
  /// Velocities are taken relative to the tool each node touches: the squeeze term may be neglected in that frame only.
  class LubricatedFace
  {
  public:
    enum class Regime
    {
      no_contact = 0,
      boundary   = 1, ///< starved: the lubricant does not fill the valleys, all load on the asperities
      mixed      = 2,
      full       = 3 ///< P_lub has reached P_nom: film transport opens the gap, the paper rule would (see opening_rate)
    };

    /// What the face needs to know of a node for one increment. Velocities are read where the node touches a tool; a
    /// node that does not is given the velocity of its neighbours that do, so that the film meets no false jump there.
    struct Contact
    {
      double nominal_pressure = 0; ///< contact force per current area [MPa]
      /// Friction table of the tool the node touches, -1: none. A node without tool whose neighbours mostly touch one
      /// (a hole of chattering contact) counts as touching too if the smoothed pressure is above the threshold.
      int             table          = -1;
      double          eps_p          = 0;                       ///< equivalent plastic strain
      Eigen::Vector3d sheet_velocity = Eigen::Vector3d::Zero(); ///< mean over the increment [mm/s]
      Eigen::Vector3d tool_velocity  = Eigen::Vector3d::Zero(); ///< of the touched tool, mean over the increment [mm/s]
    };

    struct Increment
    {
      double dt      = 0;     ///< [s]
      double travel  = 0;     ///< of the punch [mm]
      bool   at_rest = false; ///< the blank holder closes, nothing slides: asperities carry all, velocities are ignored
      bool   preliminary = false; ///< another attempt will follow: one film solution does
    };

    /// State and results of a node.
    struct Node
    {
      double cut_height = 0; ///< s [mm]
      double eps_p      = 0; ///< at the last update
      int    table      = 0; ///< last touched
      Regime regime     = Regime::no_contact;

      double          nominal_pressure = 0, solid_pressure = 0, lubricant_pressure = 0; ///< [MPa], nominal smoothed
      double          friction_coefficient = 0;
      double          film_thickness       = 0; ///< h_avg, of a lifted gap as it is [mm]
      double          supplied_film        = 0; ///< lubricant of the node spread over its area [mm]; h_inp A0/A
      double          contact_fraction     = 0;
      double          opening_rate         = 0; ///< paper rule: where P_lub = P_nom [mm/s]
      double          lift                 = 0; ///< film transport: h_avg minus that of touching surfaces [mm]
      Eigen::Matrix2d phi_p = Eigen::Matrix2d::Identity(), phi_s = Eigen::Matrix2d::Zero();

      bool
      in_contact() const
      {
        return regime != Regime::no_contact;
      }
    };

    /// Figures of the last update. Fractions are of the contact area.
    struct Statistics
    {
      double   contact_area          = 0; ///< [mm^2]
      double   load_share            = 0; ///< integral of P_lub / integral of P_nom
      double   starved_area_fraction = 0, capped_area_fraction = 0;
      double   max_lubricant_pressure = 0;  ///< [MPa]
      int      max_node               = -1; ///< where it is (-1: nowhere)
      double   nominal_pressure_there = 0;  ///< [MPa]
      double   mean_friction          = 0;  ///< load-weighted
      double   min_film = 0, max_film = 0;  ///< h_avg over the contact [mm]
      double   opening_volume  = 0; ///< of lifted gaps [mm^3]; paper rule: since the start, lift that the bound hides
      double   oscillation     = 0; ///< int |P_lub(n) - 2 P_lub(n-1) + P_lub(n-2)| / int P_lub; 4: flip-flop
      double   supplied_volume = 0, volume = 0; ///< lubricant at the start and now [mm^3]
      double   left_volume           = 0;       ///< over the outer edge of the blank since the start [mm^3]
      double   volume_error          = 0;       ///< (volume + left_volume - supplied_volume)/supplied_volume
      unsigned n_clamped_friction    = 0;       ///< nodes at the limits of the friction coefficient
      unsigned active_set_iterations = 0, film_iterations = 0;
      double   film_change = 0;    ///< of P_lub in the last film iteration, relative to its maximum
      bool     converged   = true; ///< false: the active set gave up
      unsigned n_unsettled = 0;    ///< updates so far in which film iteration or active set did not settle
    };

    /// @param reference positions in the undeformed blank (in the plane z = constant, x is the rolling direction)
    /// @param free_edge nodes on the outer edge of the blank: lubricant pressure zero. Symmetry planes are not marked.
    /// @param tables one for each tool zone that can touch this face; Contact::table counts in this list
    /// @param supplied_film h_inp of the undeformed face, one value a node [mm]
    LubricatedFace(const std::vector<Eigen::Vector3d> &reference, const std::vector<std::array<unsigned, 3>> &triangles,
                   std::vector<bool> free_edge, std::vector<std::shared_ptr<const FrictionTable>> tables,
                   std::shared_ptr<const ViscosityLaw> viscosity_law, std::vector<double> supplied_film,
                   const LubricationSettings &settings);

    /// What the increment from the accepted state to this contact makes of the face; the accepted state stays. Motion
    /// is accumulated over increments until the punch has travelled Settings::smallest_travel; until then the last film
    /// and coefficients stay (elastic slip and rebound make the velocity of a tiny increment meaningless). Increments
    /// at rest always count.
    /// @return whether film and coefficients are new
    bool attempt(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts,
                 const Increment &increment);
    /// Keep the last attempt. Every increment that is accepted must come here, however small.
    void accept();
    /// Both at once.
    bool update(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts,
                const Increment &increment);
    /// Forget the last attempt, from which the next one would start its iteration.
    void forget_attempt();

    /// Of the accepted state.
    const std::vector<Node> &
    nodes() const
    {
      return accepted.nodes;
    }
    const Statistics &
    statistics() const
    {
      return accepted.figures;
    }
    /// Of the last attempt that has not been accepted.
    const std::vector<Node> &
    attempted_nodes() const
    {
      return attempted.nodes;
    }
    /// One line for the log.
    std::string report() const;

    /// All state under names that start with @p name.
    void save(Archive &archive, const std::string &name) const;
    void load(const Archive &archive, const std::string &name);

  private:
    std::vector<bool>                                 edge;
    std::vector<std::shared_ptr<const FrictionTable>> tables;
    std::shared_ptr<const ViscosityLaw>               viscosity_law;
    LubricationSettings                               settings;
    std::unique_ptr<AverageReynolds>                  reynolds;  ///< paper rule
    std::unique_ptr<FilmTransport>                    transport; ///< film transport
    SurfacePatch                                      patch;

    std::vector<double> supply;         ///< h_inp per node on the undeformed face [mm]
    std::vector<double> reference_area; ///< per node

    struct State
    {
      std::vector<Node>   nodes;
      std::vector<double> volume; ///< film transport: lubricant per node [mm^3]
      Statistics          figures;
      // motion since the last update of the film
      double                       elapsed = 0, travelled = 0;
      std::vector<Eigen::Vector3d> slid;    ///< sheet minus tool while touching [mm]
      std::vector<double>          touched; ///< time of touching [s]
      // lubricant pressures of the last two updates
      std::array<std::vector<double>, 2> earlier_pressure;
      unsigned                           n_updates = 0;

      void forget_motion();
    };
    State accepted, attempted; ///< `attempted` has no nodes while there is none

    const FrictionTable &
    table(int index) const
    {
      return *tables[index];
    }
    void check(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts) const;
    std::vector<Eigen::Vector3d> mean_slip_velocity() const;
    std::vector<int>             touched_tables(const std::vector<Contact> &contacts) const;
    bool                         accumulate(const std::vector<Contact> &contacts, const Increment &increment);
    void                         prepare_nodes(std::vector<Node> &nodes, const std::vector<Contact> &contacts) const;
    double advanced_cut_height(const Node &old, const Node &node, const Contact &contact, double lubricant) const;
    void   iterate_film(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts,
                        const std::vector<Eigen::Vector3d> &slip_velocity, std::vector<double> lubricant, double dt);
    /// @param guess nodes with whose state the iteration starts
    void transport_film(const std::vector<Eigen::Vector3d> &positions, const std::vector<Contact> &contacts,
                        const std::vector<Eigen::Vector3d> &slip_velocity, const std::vector<Node> &guess, double dt,
                        unsigned n_iterations);
    FilmTransport::GapCurve gap_curve(std::size_t i, const Node &node, const Contact &contact) const;
    void set_transported_film(std::size_t i, Node &node, const FilmTransport::NodeData &data, const Contact &contact,
                              const FilmTransport::Result *result) const;
    void flatten(std::vector<Node> &nodes, const std::vector<Contact> &contacts,
                 const std::vector<double> &lubricant) const;
    AverageReynolds::Result solve_film(const std::vector<Eigen::Vector3d> &positions, const std::vector<Node> &nodes,
                                       const std::vector<Contact>         &contacts,
                                       const std::vector<Eigen::Vector3d> &slip_velocity,
                                       const std::vector<double> &lubricant, double dt) const;
    void                    add_squeeze(const std::vector<Eigen::Vector3d> &positions, const std::vector<Node> &nodes,
                                        const std::vector<Contact> &contacts, const std::vector<double> &lubricant, double dt,
                                        std::vector<AverageReynolds::NodeData> &data) const;
    void                    find_friction(const std::vector<Eigen::Vector3d> &slip_velocity);
    void                    find_statistics(double time);
    double                  viscosity(const Node &node, const Eigen::Vector3d &slip_velocity, double pressure) const;
    double                  boundary_layer_pressure(const Node &node) const;
    double                  fresh_friction(const Node &node) const;
  };
} // namespace tribodraw

#endif
