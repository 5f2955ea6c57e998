#ifndef tribodraw_forming_pressure_friction_h
#define tribodraw_forming_pressure_friction_h

#include <tribodraw/forming/friction_coupling.h>

#include <memory>

namespace tribodraw
{
  class Parameters;

  /// Friction coefficient as a function of the contact pressure.
  class PressureFrictionLaw
  {
  public:
    virtual ~PressureFrictionLaw() = default;
    static const char *
    kind()
    {
      return "pressure friction law";
    }
    /// @param pressure nominal contact pressure [MPa], not negative
    virtual double coefficient(double pressure) const = 0;
  };

  /// The coefficients of a law at the pressures of the committed state: they act in the next increment.
  class PressureFriction : public FrictionCoupling
  {
  public:
    explicit PressureFriction(std::shared_ptr<const PressureFrictionLaw> law);
    void    start(const Shell &shell, Contact &contact) override;
    void    update(const Shell &shell, Contact &contact, const Increment &increment) override;
    Summary summary() const override { return figures; }

  private:
    void hand_over(Contact &contact) const;

    std::shared_ptr<const PressureFrictionLaw> law;
    Summary                                    figures;
  };
} // namespace tribodraw

#endif
