#ifndef tribodraw_forming_constant_friction_h
#define tribodraw_forming_constant_friction_h

#include <tribodraw/forming/friction_coupling.h>

namespace tribodraw
{
  /// The same Coulomb coefficient everywhere.
  class ConstantFriction : public FrictionCoupling
  {
  public:
    explicit ConstantFriction(double coefficient);
    void    start(const Shell &shell, Contact &contact) override;
    void    update(const Shell &shell, Contact &contact, const Increment &increment) override;
    Summary summary() const override;

  private:
    double                      mu;
    std::array<bool, n_faces>   touching{{false, false}};
  };
} // namespace tribodraw

#endif
