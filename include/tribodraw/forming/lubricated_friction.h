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
  /// the contact pressures and sliding of the last increment (paper, Fig. 8).
  class LubricatedFriction : public FrictionCoupling
  {
  public:
    /// @param tables friction table of each tool, in the order of the contact's tools.
    LubricatedFriction(std::vector<std::shared_ptr<const FrictionTable>> tables, const Lubricant &lubricant, const LubricationSettings &settings);

    void        start(const Shell &shell, Contact &contact) override;
    void        update(const Shell &shell, Contact &contact, const Increment &increment) override;
    Summary     summary() const override;
    std::map<std::string, std::vector<double>> fields() const override;
    std::string report() const override;
    void        report_end() const override;
    void        save(Archive &archive) const override;
    void        load(const Archive &archive) override;

  private:
    void hand_over(Contact &contact) const;

    std::vector<std::shared_ptr<const FrictionTable>> tables;
    Lubricant                                         lubricant;
    LubricationSettings                               settings;
    std::array<std::unique_ptr<LubricatedFace>, n_faces> faces;
    std::vector<int>                                  table_of_tool; // within the list of its face
    std::vector<Eigen::Vector3d>                      reference;     // nodes of the undeformed blank
  };
} // namespace tribodraw

#endif
