#include <tribodraw/boundary_friction/ploughing.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    IndentationForces
    mix(const IndentationForces &a, const IndentationForces &b, const double share)
    {
      const auto between = [&](const double x, const double y) { return (1. - share) * x + share * y; };
      return { between(a.area, b.area),
               between(a.pressure_support, b.pressure_support),
               between(a.pressure_drag, b.pressure_drag),
               between(a.shear_support, b.shear_support),
               between(a.shear_drag, b.shear_drag),
               b.n_patches };
    }

    /// The state at which the leading sides carry the load, between 0 and n pixels; support at n is at least the load.
    class Search
    {
    public:
      Search(const Indentation &tool, const double wanted_load, const std::size_t n, const IndentationForces &at_n)
          : indentation(tool), load(wanted_load), above(n), high(at_n)
      {
      }

      /// @return pixels that touch
      double
      run(IndentationForces &result)
      {
        // The load-bearing area, and nearly the support, are proportional to the number of pixels: the chord aims well.
        // It is led astray by less than the step beside it, which closes the bracket from the other side. Halving
        // takes over should this fail.
        bool last_was_below = true;
        for (unsigned int i = 0; i < 64 && above - below > 1 + above / 500; ++i)
          {
            const double width = static_cast<double>(above - below);
            double       aim   = width * (load - low.support()) / (high.support() - low.support());
            aim += (last_was_below ? 1. : -1.) * (1. + 5e-4 * static_cast<double>(above));
            const double trial = i < 12 ? std::clamp(std::floor(aim), 1., width - 1.) : std::floor(0.5 * width);
            last_was_below     = evaluate(below + static_cast<std::size_t>(trial));
          }
        const double share = (load - low.support()) / (high.support() - low.support());
        result             = mix(low, high, share);
        return (1. - share) * static_cast<double>(below) + share * static_cast<double>(above);
      }

    private:
      const Indentation &indentation;
      const double       load;
      std::size_t        below = 0, above;
      IndentationForces  low, high;

      /// True if @p m pixels carry less than the load.
      bool
      evaluate(const std::size_t m)
      {
        const IndentationForces forces = indentation.forces(m);
        const bool              less   = forces.support() < load;
        (less ? below : above)         = m;
        (less ? low : high)            = forces;
        return less;
      }
    };
  } // namespace

  PloughingBalance
  balance_ploughing(const PlateauContact &contact, const PloughingLaw &law, const double p_solid,
                    const PloughingStrength &strength)
  {
    const double      load = p_solid * contact.nominal_area();
    const std::size_t n    = contact.n_plateau_pixels();
    PloughingBalance  result;
    result.patch_pressure  = strength.hardness;
    const auto indentation = load > 0 && n > 0 ? law.indentation(contact, strength) : nullptr;
    if (!indentation)
      return result;

    // Leading sides are half of the patches: with 20 % more pixels than that takes, most states carry the load, and
    // the whole plateau needs not be looked at.
    const double      guess   = 1.2 * load / (0.5 * strength.hardness * contact.pixel_area()) + 8.;
    std::size_t       highest = guess < static_cast<double>(n) ? static_cast<std::size_t>(guess) : n;
    IndentationForces forces  = indentation->forces(highest);
    if (forces.support() < load && highest < n)
      forces = indentation->forces(highest = n);
    const IndentationForces all = forces;
    result.n_patches            = all.n_patches;
    double pixels               = static_cast<double>(highest);
    if (all.support() >= load)
      {
        pixels                = Search(*indentation, load, highest, all).run(forces);
        result.n_patches      = forces.n_patches;
        result.support        = forces.support() / contact.nominal_area();
        result.coefficient    = (forces.pressure_drag + forces.shear_drag - strength.tau * forces.area) / load;
        result.patch_pressure = forces.pressure_support / forces.area;
      }
    else
      {
        // The trailing sides begin to touch: the shear on them supports what the shear on the leading sides takes off.
        const double touching = all.shear_support > 0 ? std::min(1., (load - all.support()) / all.shear_support) : 1.;
        const double shear_support = (1. - touching) * all.shear_support;
        const double rest          = load - (all.pressure_support - shear_support);
        result.full_contact        = true;
        result.back_pressure       = std::max(0., rest) / (2. * all.area);
        result.patch_pressure      = all.pressure_support / all.area + result.back_pressure;
        result.support
            = (all.pressure_support - shear_support + result.back_pressure * 2. * all.area) / contact.nominal_area();
        result.coefficient = (all.pressure_drag + (1. + touching) * (all.shear_drag - strength.tau * all.area)) / load;
      }
    result.patch_fraction = pixels * contact.pixel_area() / contact.nominal_area();
    return result;
  }
} // namespace tribodraw
