#include <tribodraw/base/registry.h>
#include <tribodraw/boundary_friction/contact_patches.h>
#include <tribodraw/boundary_friction/ploughing_law.h>

#include <algorithm>
#include <vector>

namespace tribodraw
{
  namespace
  {
    /// Tractions summed over the pixels of the tool map, without patches.
    class Pixels : public PloughingLaw
    {
    public:
      explicit Pixels(Parameters &) {}

      std::unique_ptr<Indentation>
      indentation(const PlateauContact &contact, const PloughingStrength &strength) const override
      {
        return std::make_unique<State>(contact, strength);
      }

    private:
      struct State : Indentation
      {
        State(const PlateauContact &contact, const PloughingStrength &s) : pixel_area(contact.pixel_area()), strength(s)
        {
          const ToolSurface &tool    = contact.tool();
          double             frontal = 0, drag = 0, support = 0;
          up_to.reserve(contact.n_plateau_pixels() + 1);
          up_to.push_back({ 0., 0., 0. });
          for (const std::uint32_t i : contact.pixels())
            up_to.push_back(
                { frontal += tool.frontal[i], drag += tool.shear_drag[i], support += tool.shear_support[i] });
        }

        IndentationForces
        forces(const std::size_t n_pixels) const override
        {
          const Sum        &sum = up_to[std::min(n_pixels, up_to.size() - 1)];
          IndentationForces f;
          f.area             = 0.5 * pixel_area * static_cast<double>(std::min(n_pixels, up_to.size() - 1));
          f.pressure_support = strength.hardness * f.area;
          f.pressure_drag    = strength.hardness * pixel_area * sum.frontal;
          f.shear_support    = strength.tau * pixel_area * sum.shear_support;
          f.shear_drag       = strength.tau * pixel_area * sum.shear_drag;
          return f;
        }

        struct Sum
        {
          double frontal, shear_drag, shear_support;
        };
        std::vector<Sum>        up_to; // over the pixels that touch first
        const double            pixel_area;
        const PloughingStrength strength;
      };
    };
  } // namespace

  TRIBODRAW_REGISTER(PloughingLaw, Pixels, "pixels",
                     "Normal pressure and shear are summed over the pixels of the tool map that touch and lead; no "
                     "patches are fitted.",
                     "Direct integration of the tractions of the paraboloid law; no publication")
} // namespace tribodraw
