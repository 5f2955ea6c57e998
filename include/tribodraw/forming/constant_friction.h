#ifndef tribodraw_forming_constant_friction_h
#define tribodraw_forming_constant_friction_h

#include <tribodraw/forming/friction_coupling.h>

#include <vector>

namespace tribodraw
{
  /// A Coulomb coefficient that does not change: the same everywhere, or one for each tool. A node has the coefficient of the
  /// nearest tool on its face.
  class ConstantFriction : public FrictionCoupling
  {
  public:
    explicit ConstantFriction(double coefficient);
    /// @param coefficients of the tools, in the order of the contact's tools
    explicit ConstantFriction(std::vector<double> coefficients);
    void    start(const Shell &shell, Contact &contact) override;
    void    update(const Shell &shell, Contact &contact, const Increment &increment) override;
    Summary summary() const override { return figures; }

  private:
    void hand_over(const Shell &shell, Contact &contact) const;

    std::vector<double> mu; // one, or one for each tool
    Summary             figures;
  };
} // namespace tribodraw

#endif
