#include <tribodraw/forming/constant_friction.h>

#include <algorithm>

namespace tribodraw
{
  ConstantFriction::ConstantFriction(const double coefficient)
    : mu{coefficient}
  {}

  ConstantFriction::ConstantFriction(std::vector<double> coefficients)
    : mu(std::move(coefficients))
  {}

  void
  ConstantFriction::hand_over(const Shell &shell, Contact &contact) const
  {
    for (const Face f : {Face::punch_side, Face::die_side})
      {
        std::vector<double> values(shell.n_nodes(), mu.front());
        for (unsigned i = 0; i < values.size() && mu.size() > 1; ++i)
          {
            double nearest = 1e300;
            for (std::size_t t = 0; t < contact.tools().size(); ++t)
              if (contact.tools()[t].face == f)
                {
                  const double distance = contact.tools()[t].distance(shell.committed().position[i]).distance;
                  if (distance < nearest)
                    {
                      nearest   = distance;
                      values[i] = mu[t];
                    }
                }
          }
        contact.set_friction(f, std::move(values));
      }
  }

  void
  ConstantFriction::start(const Shell &shell, Contact &contact)
  {
    hand_over(shell, contact);
  }

  void
  ConstantFriction::update(const Shell &shell, Contact &contact, const Increment &)
  {
    figures.mean_mu = mean_coefficients(shell, contact);
    if (mu.size() > 1)
      hand_over(shell, contact);
  }
} // namespace tribodraw
