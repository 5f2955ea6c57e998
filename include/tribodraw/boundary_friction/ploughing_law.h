#ifndef tribodraw_boundary_friction_ploughing_law_h
#define tribodraw_boundary_friction_ploughing_law_h

#include <cstddef>
#include <memory>

namespace tribodraw
{
  class Parameters;
  class PlateauContact;

  /// Strength of a plateau against an indenting tool summit.
  struct PloughingStrength
  {
    double hardness;       ///< normal pressure at which the plateau yields under a summit [MPa]
    double shear_strength; ///< k of the sheet [MPa]
    double tau;            ///< shear stress of the boundary layer, at most k [MPa]
  };

  /// Forces on the leading sides of all touching tool summits, averaged over the sliding directions, split by their
  /// cause [N]:  support = pressure_support - shear_support,  drag = pressure_drag + shear_drag.
  struct IndentationForces
  {
    double      area             = 0; ///< of the leading sides, projected [mm^2]
    double      pressure_support = 0, pressure_drag = 0;
    double      shear_support = 0, shear_drag = 0;
    std::size_t n_patches = 0;

    double
    support() const
    {
      return pressure_support - shear_support;
    }
  };

  /// The forces as the tool sinks into the plateaus.
  class Indentation
  {
  public:
    virtual ~Indentation() = default;
    /// When the @p n_pixels highest tool pixels above plateaus touch.
    virtual IndentationForces forces(std::size_t n_pixels) const = 0;
  };

  /// How summits of a hard tool plough the plateaus of the sheet.
  class PloughingLaw
  {
  public:
    virtual ~PloughingLaw() = default;
    static const char *
    kind()
    {
      return "ploughing law";
    }
    /// @param contact must outlive the result. Returns nullptr if summits do not plough in this law.
    virtual std::unique_ptr<Indentation> indentation(const PlateauContact    &contact,
                                                     const PloughingStrength &strength) const = 0;
  };
} // namespace tribodraw

#endif
