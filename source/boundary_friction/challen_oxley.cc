#include <tribodraw/boundary_friction/challen_oxley.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    double
    arc_sine_of_ratio(const double theta, const double f)
    {
      const double root = std::sqrt(1. - f), sine = std::sin(theta);
      return sine > 0 && sine >= root ? pi / 2 : sine > 0 ? std::asin(sine / root) : 0.;
    }
  } // namespace

  double
  ChallenOxley::friction(const double theta) const
  {
    return (pressure * std::sin(theta) + shear * std::cos(theta))
           / (pressure * std::cos(theta) - shear * std::sin(theta));
  }

  ChallenOxley
  challen_oxley(const double theta, const double f_given)
  {
    const double f = std::clamp(f_given, 0., 1.), arc = std::acos(f), root = std::sqrt(1. - f * f);
    if (theta <= 0.5 * arc)
      return { ChallenOxley::Regime::wave, 1. + pi / 2 + arc - 2. * theta - 2. * arc_sine_of_ratio(theta, f) + root,
               f };
    if (theta < 0.5 * (pi - arc))
      {
        const double beta = theta - pi / 4 - 0.5 * arc + arc_sine_of_ratio(theta, f);
        return { ChallenOxley::Regime::wedge, 1. - std::sin(2. * beta) + root, f };
      }
    return { ChallenOxley::Regime::cutting, 1. + root, -f };
  }
} // namespace tribodraw
