#ifndef tribodraw_contact_contact_h
#define tribodraw_contact_contact_h

#include <tribodraw/base/archive.h>
#include <tribodraw/base/sparse_system.h>
#include <tribodraw/contact/contact_points.h>
#include <tribodraw/shell/loads.h>
#include <tribodraw/shell/shell.h>
#include <tribodraw/tools/tool_geometry.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  /// The two faces of the blank: the upper one (+z at the start, touched by punch and blank holder: "punch side") and
  /// the lower one ("die side").
  enum class Face { punch_side = 0, die_side = 1 };
  constexpr unsigned n_faces = 2;

  /// A rigid tool as the contact sees it: a shape at a place, acting on one face of the blank.
  struct ContactTool
  {
    std::string                         name;
    std::shared_ptr<const ToolGeometry> geometry;
    Eigen::Vector3d                     place    = Eigen::Vector3d::Zero(); ///< trial origin of the shape's frame [mm]
    Face                                face     = Face::die_side;
    bool                                mirrored = false; ///< the shape is turned upside down (z -> -z)
    /// Index of the unknown travel along the axis (force control), or -1 for a prescribed position.
    int             free_index      = -1;
    Eigen::Vector3d axis            = -Eigen::Vector3d::UnitZ(); ///< unit direction in which a free tool is pushed and moves
    Eigen::Vector3d committed_place = Eigen::Vector3d::Zero();   ///< set by Contact

    ToolDistance distance(const Eigen::Vector3d &x) const;
    /// What the tool moved since the committed state [mm].
    Eigen::Vector3d motion() const { return place - committed_place; }
  };

  /// Contact of the blank with rigid tools at its nodes and mid-sides (ContactPoints): penalty with a quadratic transition,
  /// Coulomb friction with an elastic slip. The friction coefficient is a nodal field of each face that comes from outside.
  /// All ranks evaluate all points; the tangent is added on rank 0.
  ///
  /// Pressure over penetration g with stiffness e and transition d:
  ///   0 for g < -d, e (g+d)^2/(4d) for |g| < d, e g beyond.
  /// Friction: elastic slip s (tangential); traction mu p s/dc while |s| < dc, else mu p s/|s|.
  class Contact
  {
  public:
    struct Settings
    {
      double stiffness  = 0; ///< e [MPa/mm]; 0: automatic, see stiffen()
      double transition = 0; ///< d [mm]; 0: 2.5 % of the thickness
      double stick_slip = 0; ///< dc [mm]
      bool   initial_thickness = false; ///< faces stay where half the initial thickness puts them
    };
    /// Penetration above which an automatic stiffness is raised, by the thickness.
    static constexpr double largest_relative_penetration = 0.028;

    /// @param shell its trial state is used for a moment, and left as committed
    Contact(Shell &shell, std::vector<ContactTool> tools, const Settings &settings);

    std::vector<ContactTool>       &tools() { return tool; }
    const std::vector<ContactTool> &tools() const { return tool; }

    /// Friction coefficient of each node on a face. With @p slope, its derivative by the pressure [1/MPa] at the pressure
    /// @p pressure [MPa]: the coefficient follows the pressure on this straight line, not below zero.
    void set_friction(Face face, std::vector<double> coefficient, std::vector<double> slope = {}, std::vector<double> pressure = {});
    const std::vector<double> &friction(Face face) const { return law_of_friction[static_cast<int>(face)].coefficient; }

    /// Derivative of the residual. The travels of the free tools border the matrix of the sheet.
    struct Tangent
    {
      explicit Tangent(const Shell &shell, unsigned n_free_tools);
      void            set_zero();
      SparseMatrix    sheet;       ///< by the sheet's unknowns; this rank's part
      Eigen::MatrixXd column, row; ///< of the sheet's residual by the travels; of the free tools' by the sheet's unknowns, transposed
      Eigen::MatrixXd corner;
    };
    struct Options
    {
      bool frozen = false; ///< predictor: contact status, pressure and direction of sliding as committed
    };
    /// Subtracts contact forces from @p residual (internal minus external forces; entries n_dofs.. are the free tools:
    /// force of the tool on the sheet along its axis) and adds to the tangent. @p tool_sensitivity, if given, gets the
    /// derivative of the residual along the motion @p motion of the prescribed tools (one vector per tool, mm).
    void assemble(Eigen::VectorXd                    &residual,
                  Tangent                            *tangent,
                  const Options                      &options,
                  const std::vector<Eigen::Vector3d> *motion           = nullptr,
                  Eigen::VectorXd                    *tool_sensitivity = nullptr);

    /// Force on each tool from the modelled part of the sheet, of the last assemble() [N].
    const std::vector<Eigen::Vector3d> &tool_forces() const { return tool_force; }
    /// Sum of the magnitudes of all contact forces of the last assemble() [N]: the scale of the residual.
    double force_scale() const { return scale; }
    /// Contact forces of the last assemble() as dead forces on the nodes: to take the tools away by fading them out.
    Loads frozen_forces() const;

    /// Raise an automatic stiffness, at most tenfold, if a penetration of the last assemble() is too large at a point that
    /// is not between two tools. Returns true if it did; then the
    /// state is no longer in equilibrium.
    bool   stiffen();
    double stiffness() const { return settings.stiffness; } ///< [MPa/mm]

    /// Accept the trial state: elastic slips, tool positions, dissipation; lag areas and thickness.
    void commit();

    /// State of a face, per node: mean of what the points around the node feel.
    struct FaceState
    {
      std::vector<double>          pressure; ///< nominal, per current area [MPa]
      std::vector<int>             tool;     ///< index of the touching tool, -1: none
      std::vector<double>          gap;      ///< distance of the face from the tools at the node [mm], negative: penetration
      std::vector<Eigen::Vector3d> slip;     ///< relative sliding of the last increment [mm]
    };
    /// Of the committed state.
    const FaceState &face(Face f) const { return faces[static_cast<int>(f)]; }
    /// As it will be if the state of the last assemble() is accepted.
    std::array<FaceState, n_faces> trial_faces() const;
    /// Count energies from the committed state on: tools that touch before the holder closes already lean on the transition
    /// range, and nobody worked for that.
    void start_energy_balance();
    /// Energy dissipated by friction and stored in the penalty springs so far, modelled part [N mm].
    double friction_work() const { return dissipated; }
    double penalty_energy() const { return stored; }
    /// Largest penetration of the committed state [mm].
    double max_penetration() const { return deepest; }

    void save(Archive &archive) const;
    void load(const Archive &archive);

  private:
    /// A point and a tool.
    struct Pair
    {
      Eigen::Vector3d slip       = Eigen::Vector3d::Zero(); ///< committed elastic slip
      Eigen::Vector3d traction   = Eigen::Vector3d::Zero(); ///< committed friction force [N]
      Eigen::Vector3d normal     = Eigen::Vector3d::Zero(); ///< committed, of a tool in touch
      double          pressure   = 0;                       ///< committed [MPa]
      double          last_slide = 0;                       ///< |sliding| of the last committed increment [mm]
      bool            slid       = false;
      // trial values of the last assemble()
      Eigen::Vector3d trial_slip = Eigen::Vector3d::Zero(), trial_traction = Eigen::Vector3d::Zero(), trial_sliding = Eigen::Vector3d::Zero(), trial_normal = Eigen::Vector3d::Zero();
      double          trial_pressure = 0, trial_penetration = -1e300;
      bool            trial_slides   = false;
      /// Committed traction, turned from the committed tangent plane into that of @p normal.
      Eigen::Vector3d traction_on(const Eigen::Vector3d &end) const;
      // how far the point can go before it may touch
      Eigen::Vector3d seen_at = Eigen::Vector3d::Zero();
      double          reach   = 0;
    };
    struct Law
    {
      double pressure, stiffness;
    };
    struct FrictionLaw
    {
      std::vector<double> coefficient, slope, pressure;
    };
    /// What a tool does to a point: force and - d force / d position.
    struct Response
    {
      bool            touches = false;
      Eigen::Vector3d force;
      Eigen::Matrix3d stiffness;
    };
    Law      law(double penetration) const;
    Law      frozen_law(double pressure) const; ///< the law where it has the pressure @p pressure
    double   energy(double penetration) const;
    /// Coefficient and its derivative by the pressure.
    Law      friction_at(const FrictionLaw &law, unsigned point, double pressure) const;
    Response evaluate(unsigned point, unsigned t, const Eigen::Vector3d &position, const Options &options);
    void     measure_sheet();

    const Shell                          &sheet;
    ContactPoints                         points;
    std::vector<ContactTool>              tool;
    Settings                              settings;
    bool                                  automatic = false;
    std::array<FrictionLaw, n_faces>      law_of_friction;
    std::vector<double>                   area, half_thickness; // of the points, lagged
    std::vector<Eigen::Vector3d>          committed_position;   // of the points
    std::vector<std::vector<Pair>>        pair;                 // [tool][point]
    std::array<FaceState, n_faces>        faces;
    std::vector<Eigen::Vector3d>          tool_force; // of the last assemble()
    Eigen::VectorXd                       sheet_force;
    double                                scale = 0, dissipated = 0, stored = 0, energy_at_start = 0, deepest = 0, deepest_allowed = 0, stiffest = 0;
  };
} // namespace tribodraw

#endif
