#ifndef tribodraw_boundary_friction_shear_law_h
#define tribodraw_boundary_friction_shear_law_h

namespace tribodraw
{
  class Parameters;

  /// Shear strength of the boundary layer between tool and sheet plateaus.
  class ShearLaw
  {
  public:
    virtual ~ShearLaw() = default;
    static const char *
    kind()
    {
      return "boundary shear law";
    }
    /// Shear stress per real area [MPa] at the pressure @p p0 [MPa] in the layer (per real area); >= 0, not decreasing,
    /// 0 at 0. The cap by the shear strength of the sheet is the caller's.
    virtual double shear_stress(double p0) const = 0;
  };
} // namespace tribodraw

#endif
