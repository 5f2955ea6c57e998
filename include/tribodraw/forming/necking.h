#ifndef tribodraw_forming_necking_h
#define tribodraw_forming_necking_h

#include <tribodraw/base/archive.h>
#include <tribodraw/material/forming_limit.h>
#include <tribodraw/shell/shell.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Where the sheet is nearest to its forming limit.
  struct FormingLimitState
  {
    double          ratio   = 0; ///< largest major strain over its limit; above one: exceeded
    unsigned        element = 0;
    Eigen::Vector3d place = Eigen::Vector3d::Zero(), place_undeformed = Eigen::Vector3d::Zero(); ///< centre of the element [mm]
  };

  /// Recognises a neck: the forming limit is exceeded, the force of the press falls, and the critical element thins faster
  /// and faster. (The force also falls when the flange becomes small; then the thinning slows down.)
  class NeckingMonitor
  {
  public:
    NeckingMonitor(const Shell &shell, std::shared_ptr<const FormingLimitCurve> limit);

    /// Look at the committed state. @param path travel so far [mm], @param force of the press.
    void observe(const Shell::ElementResults &elements, double path, double force);
    /// There is no equilibrium any more although the limit is exceeded: the neck gathers all deformation.
    void without_equilibrium(const std::string &solver_says);

    const FormingLimitState &state() const { return critical; }
    bool                     limit_exceeded() const { return critical.ratio > 1; }
    bool                     necked() const { return !why.empty(); }
    /// What was seen, in words with numbers; empty: no neck.
    const std::string &reason() const { return why; }
    /// Where and when the neck was recognised.
    double                 travel() const { return neck_travel; }
    const Eigen::Vector3d &place() const { return neck_place; }

    void save(Archive &archive) const;
    void load(const Archive &archive);

  private:
    void recognise(const std::string &reason);

    const Shell                                  &sheet;
    std::shared_ptr<const FormingLimitCurve>      limit;
    std::vector<std::vector<unsigned>>            neighbours;
    std::vector<double>                           last_thinning; // -ln(t/t0) of each element
    double                                        initial_thickness = 0, last_path = 0, seen_path = 0, largest_force = 0;
    FormingLimitState                             critical;
    double                                        slowest = 1e300; // thinning per travel of the critical element since the limit was exceeded [1/mm]
    std::string                                   why;
    double                                        neck_travel = 0;
    Eigen::Vector3d                               neck_place = Eigen::Vector3d::Zero();
  };
} // namespace tribodraw

#endif
