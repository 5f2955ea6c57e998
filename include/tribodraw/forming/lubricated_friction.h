#ifndef tribodraw_forming_lubricated_friction_h
#define tribodraw_forming_lubricated_friction_h

#include <tribodraw/fluid/lubricant.h>
#include <tribodraw/forming/friction_coupling.h>
#include <tribodraw/lubrication/lubricated_face.h>

#include <memory>
#include <vector>

namespace tribodraw
{
  /// Friction coefficients from asperities and lubricant film on both faces of the blank: one LubricatedFace each, fed with
  /// the contact pressures and sliding of the increment (paper, Fig. 8). Staggered, its coefficients act in the next one;
  /// iterated, film and friction are found from the state before the increment and the pressures and sliding at its end
  /// until the coefficients are those with which the equilibrium was found.
  class LubricatedFriction : public FrictionCoupling
  {
  public:
    /// @param tables friction table of each tool, in the order of the contact's tools.
    LubricatedFriction(std::vector<std::shared_ptr<const FrictionTable>> tables, const Lubricant &lubricant, const LubricationSettings &settings);

    void        start(const Shell &shell, Contact &contact) override;
    bool        iterate(const Shell &shell, Contact &contact, const Increment &increment, bool in_equilibrium) override;
    void        revert(Contact &contact) override;
    void        update(const Shell &shell, Contact &contact, const Increment &increment) override;
    Summary     summary() const override;
    std::map<std::string, std::vector<double>> fields() const override;
    std::string report() const override;
    void        report_end() const override;
    void        save(Archive &archive) const override;
    void        load(const Archive &archive) override;

  private:
    using Nodes = std::vector<LubricatedFace::Node>;
    void   attempt(const std::array<Contact::FaceState, n_faces> &states, const std::vector<Eigen::Vector3d> &positions,
                   const std::vector<double> &eps_p, const Increment &increment, bool preliminary);
    /// Of the attempted coefficients against those of the contact, in parts of the friction force.
    double change(const Shell &shell, const Contact &contact) const;
    void   hand_over(Contact &contact, const Nodes &(LubricatedFace::*nodes)() const) const;

    std::vector<std::shared_ptr<const FrictionTable>> tables;
    Lubricant                                         lubricant;
    LubricationSettings                               settings;
    std::array<std::unique_ptr<LubricatedFace>, n_faces> faces;
    std::vector<int>                                  table_of_tool; // within the list of its face
    std::vector<Eigen::Vector3d>                      reference;     // nodes of the undeformed blank

    // the loop of the present increment
    bool     settled = false; // the attempt of the faces belongs to the equilibrium
    unsigned n_loops = 0;
    double   last_change = 0, expected_change = 0;
    // of the last accepted increment, and so far
    unsigned accepted_loops = 0, n_unsettled = 0;
    double   accepted_change = 0, worst_change = 0;
  };
} // namespace tribodraw

#endif
