#include <tribodraw/forming/constant_friction.h>

#include <algorithm>

namespace tribodraw
{
  ConstantFriction::ConstantFriction(const double coefficient)
    : mu(coefficient)
  {}

  void
  ConstantFriction::start(const Shell &shell, Contact &contact)
  {
    for (const Face f : {Face::punch_side, Face::die_side})
      contact.set_friction(f, std::vector<double>(shell.n_nodes(), mu));
  }

  void
  ConstantFriction::update(const Shell &, Contact &contact, const Increment &)
  {
    for (const Face f : {Face::punch_side, Face::die_side})
      {
        const auto &tool                = contact.face(f).tool;
        touching[static_cast<int>(f)] = std::any_of(tool.begin(), tool.end(), [](const int t) { return t >= 0; });
      }
  }

  FrictionCoupling::Summary
  ConstantFriction::summary() const
  {
    Summary s;
    for (unsigned f = 0; f < n_faces; ++f)
      s.mean_mu[f] = touching[f] ? mu : 0.;
    return s;
  }
} // namespace tribodraw
