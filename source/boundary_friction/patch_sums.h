#ifndef tribodraw_source_boundary_friction_patch_sums_h
#define tribodraw_source_boundary_friction_patch_sums_h

#include <tribodraw/base/parameters.h>
#include <tribodraw/boundary_friction/ploughing.h>

#include <memory>

namespace tribodraw
{
  /// How the depth of a patch's paraboloid is chosen: entry `Depth of patches`.
  struct PatchDepth
  {
    explicit PatchDepth(Parameters &parameters)
        : from_slopes(
            parameters.choice("Depth of patches", { "slopes", "volume" },
                              "What the paraboloid of a patch has in common with the tool there besides area and "
                              "second moments: the mean square slope, or the volume below the plateau's plane. Both "
                              "agree for a single smooth summit.",
                              Default{ "slopes", "the volume says nothing of the slopes where patches end at the edge "
                                                 "of a plateau or hold several summits" })
            == "slopes")
    {
    }

    double
    of(const ContactPatch &patch) const
    {
      return from_slopes ? patch.depth_of_slope() : patch.depth_of_volume();
    }

    const bool from_slopes;
  };

  /// What an indentation into patches is made of.
  struct PatchIndentation : Indentation
  {
    PatchIndentation(const PlateauContact &c, const PloughingStrength &s, const PatchDepth &d)
        : contact(c), strength(s), depth(d)
    {
    }

    const PlateauContact   &contact;
    const PloughingStrength strength;
    const PatchDepth        depth;
  };

  /// A law whose indentation is the given kind of PatchIndentation.
  template <class Kind>
  class PatchLaw : public PloughingLaw
  {
  public:
    explicit PatchLaw(Parameters &parameters) : depth(parameters) {}

    std::unique_ptr<Indentation>
    indentation(const PlateauContact &contact, const PloughingStrength &strength) const override
    {
      return std::make_unique<Kind>(contact, strength, depth);
    }

  private:
    const PatchDepth depth;
  };

  /// Sum over the patches and sliding directions of what @p add(sums, patch, direction angle minus patch angle, weight)
  /// contributes.
  template <class Add>
  IndentationForces
  sum_over_patches(const PlateauContact &contact, const std::size_t n_pixels, const Add &add)
  {
    const double       pi = 3.14159265358979323846;
    const unsigned int n  = contact.tool().n_directions;
    IndentationForces  sums;
    for (const ContactPatch &patch : contact.patches(n_pixels))
      {
        for (unsigned int d = 0; d < n; ++d)
          add(sums, patch, patch.psi - pi * d / n, 1. / n);
        ++sums.n_patches;
      }
    return sums;
  }
} // namespace tribodraw

#endif
