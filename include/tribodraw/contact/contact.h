#ifndef tribodraw_contact_contact_h
#define tribodraw_contact_contact_h

#include <tribodraw/base/archive.h>
#include <tribodraw/base/sparse_system.h>
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

  /// Contact of the blank's nodes with rigid tools: penalty with a quadratic transition, Coulomb friction with an elastic
  /// slip that scales with pressure. The friction coefficient is a nodal field of each face that comes from outside.
  /// All ranks evaluate all nodes; the tangent is added on rank 0.
  ///
  /// Pressure over penetration g with stiffness e and transition d:
  ///   0 for g < -d, e (g+d)^2/(4d) for |g| < d, e g beyond.
  /// Friction: elastic slip s (tangential); traction mu p s/dc while |s| < dc, else mu p s/|s|.
  class Contact
  {
  public:
    struct Settings
    {
      double stiffness  = 0; ///< e [MPa/mm]
      double transition = 0; ///< d [mm]
      double stick_slip = 0; ///< dc [mm]
    };

    Contact(const Shell &shell, std::vector<ContactTool> tools, const Settings &settings);

    std::vector<ContactTool>       &tools() { return tool; }
    const std::vector<ContactTool> &tools() const { return tool; }

    /// Friction coefficient of each node on a face.
    void                       set_friction(Face face, std::vector<double> coefficient);
    const std::vector<double> &friction(Face face) const { return mu[static_cast<int>(face)]; }

    struct Options
    {
      bool frozen = false; ///< predictor: contact status, pressure and sliding as committed
    };
    /// Subtracts contact forces from @p residual (internal minus external forces; entries n_dofs.. are the free tools:
    /// force of the tool on the sheet along its axis) and adds the tangent. @p tool_sensitivity, if given, gets the
    /// derivative of the residual along the motion @p motion of the prescribed tools (one vector per tool, mm).
    void assemble(Eigen::VectorXd                    &residual,
                  SparseMatrix                       *tangent,
                  const Options                      &options,
                  const std::vector<Eigen::Vector3d> *motion           = nullptr,
                  Eigen::VectorXd                    *tool_sensitivity = nullptr);

    /// Force on each tool from the modelled part of the sheet, of the last assemble() [N].
    const std::vector<Eigen::Vector3d> &tool_forces() const { return tool_force; }
    /// Sum of the magnitudes of all nodal contact forces of the last assemble() [N]: the scale of the residual.
    double force_scale() const { return scale; }

    /// Contact forces of the last assemble() as dead forces on the nodes: to take the tools away by fading them out.
    Loads frozen_forces() const;

    /// Accept the trial state: elastic slips, tool positions, dissipation; lag areas and thickness.
    void commit();

    /// Committed state of a face, per node.
    struct FaceState
    {
      std::vector<double>          pressure;   ///< nominal, per current area [MPa]
      std::vector<int>             tool;       ///< index of the touching tool, -1: none
      std::vector<double>          gap;        ///< smallest distance of the face from the tools [mm], negative: penetration
      std::vector<Eigen::Vector3d> slip;       ///< relative sliding of the last increment [mm]
    };
    const FaceState &face(Face f) const { return faces[static_cast<int>(f)]; }
    /// Count energies from the committed state on: tools that touch before the holder closes already lean on the transition
    /// range, and nobody worked for that.
    void start_energy_balance();
    /// Energy dissipated by friction and stored in the penalty springs so far, modelled part [N mm].
    double friction_work() const { return dissipated; }
    double penalty_energy() const { return stored; }
    /// Largest penetration of the committed state [mm].
    double max_penetration() const;

    void save(Archive &archive) const;
    void load(const Archive &archive);

  private:
    struct NodeTool
    {
      Eigen::Vector3d slip       = Eigen::Vector3d::Zero(); ///< committed elastic slip
      Eigen::Vector3d traction   = Eigen::Vector3d::Zero(); ///< committed friction force [N]
      double          pressure   = 0;                       ///< committed [MPa]
      double          last_slide = 0;                       ///< |sliding| of the last committed increment [mm]
      bool            slid       = false;
      // trial values of the last assemble()
      Eigen::Vector3d trial_slip = Eigen::Vector3d::Zero(), trial_traction = Eigen::Vector3d::Zero(), trial_sliding = Eigen::Vector3d::Zero();
      double          trial_pressure = 0, trial_penetration = -1e300;
      bool            trial_slides   = false;
    };
    struct Law
    {
      double pressure, stiffness;
    };
    Law    law(double penetration) const;
    double energy(double penetration) const;
    void   evaluate(unsigned node, unsigned t, const Options &options, Eigen::Vector3d &force, Eigen::Matrix3d &stiffness, double &weight);
    void   add_tangent(SparseMatrix &tangent, unsigned node, const ContactTool &t, const Eigen::Matrix3d &K) const;

    const Shell                                        &sheet;
    std::vector<ContactTool>                            tool;
    Settings                                            settings;
    std::array<std::vector<double>, n_faces>            mu;
    std::vector<double>                                 area, half_thickness; // lagged
    std::vector<std::vector<NodeTool>>                  pair;                 // [tool][node]
    std::array<FaceState, n_faces>                      faces;
    std::vector<Eigen::Vector3d>                        tool_force, node_force; // of the last assemble()
    double                                              scale = 0, dissipated = 0, stored = 0, energy_at_start = 0;
  };
} // namespace tribodraw

#endif
