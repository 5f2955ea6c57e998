#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/pressure_friction.h>

#include <algorithm>

namespace tribodraw
{
  namespace
  {
    /// Measured pairs, linear between them, constant outside.
    class TabulatedFriction : public PressureFrictionLaw
    {
    public:
      explicit TabulatedFriction(Parameters &p)
        : pressures(p.quantity_list("Pressures", "MPa", Range::non_negative(), "Contact pressures of the table, increasing."))
        , coefficients(p.quantity_list("Coefficients", "", Range::non_negative().usual(0, 0.5), "Friction coefficient at each pressure."))
      {
        if (p.documentation_mode())
          return;
        if (pressures.size() != coefficients.size())
          p.problem("Coefficients", "there must be as many coefficients as pressures.", std::to_string(pressures.size()) + " values");
        if (std::adjacent_find(pressures.begin(), pressures.end(), std::greater_equal<double>()) != pressures.end())
          p.problem("Pressures", "the pressures must increase.");
      }
      double coefficient(const double pressure) const override
      {
        if (pressure <= pressures.front())
          return coefficients.front();
        if (pressure >= pressures.back())
          return coefficients.back();
        const auto   after = std::upper_bound(pressures.begin(), pressures.end(), pressure) - pressures.begin();
        const double share = (pressure - pressures[after - 1]) / (pressures[after] - pressures[after - 1]);
        return (1 - share) * coefficients[after - 1] + share * coefficients[after];
      }

    private:
      std::vector<double> pressures, coefficients;
    };
  } // namespace

  TRIBODRAW_REGISTER(PressureFrictionLaw, TabulatedFriction, "table", "Friction coefficient from measured pairs with the contact pressure.", "")
} // namespace tribodraw
