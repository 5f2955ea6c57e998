#ifndef tribodraw_fluid_viscosity_law_h
#define tribodraw_fluid_viscosity_law_h

namespace tribodraw
{
  class Parameters;

  /// Dynamic viscosity of the lubricant.
  class ViscosityLaw
  {
  public:
    struct Value
    {
      double viscosity;       ///< [MPa s]
      double pressure_slope;  ///< d viscosity / d pressure [s]
    };
    virtual ~ViscosityLaw() = default;
    static const char *kind() { return "viscosity law"; }
    /// @param pressure [MPa] >= 0; @param shear_rate [1/s] >= 0
    virtual Value viscosity(double pressure, double shear_rate) const = 0;
  };
} // namespace tribodraw

#endif
