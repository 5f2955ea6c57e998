#include <tribodraw/forming/pressure_friction.h>

namespace tribodraw
{
  PressureFriction::PressureFriction(std::shared_ptr<const PressureFrictionLaw> pressure_law)
    : law(std::move(pressure_law))
  {}

  void
  PressureFriction::hand_over(Contact &contact) const
  {
    for (const Face f : {Face::punch_side, Face::die_side})
      {
        std::vector<double> mu;
        for (const double p : contact.face(f).pressure)
          mu.push_back(law->coefficient(p));
        contact.set_friction(f, std::move(mu));
      }
  }

  void
  PressureFriction::start(const Shell &, Contact &contact)
  {
    hand_over(contact);
  }

  void
  PressureFriction::update(const Shell &shell, Contact &contact, const Increment &)
  {
    figures.mean_mu = mean_coefficients(shell, contact); // of the increment that has converged
    hand_over(contact);
  }
} // namespace tribodraw
