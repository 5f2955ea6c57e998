#ifndef tribodraw_fluid_viscosity_law_h
#define tribodraw_fluid_viscosity_law_h

#include <limits>

namespace tribodraw
{
  class Parameters;

  /// Dynamic viscosity of the lubricant. A law reads its own constants; the viscosity at ambient pressure and low
  /// shear rate, which all laws share, is given afterwards by the reader of the lubricant.
  class ViscosityLaw
  {
  public:
    struct Value
    {
      double viscosity;      ///< [MPa s]
      double pressure_slope; ///< d viscosity / d pressure [s]
    };
    virtual ~ViscosityLaw() = default;
    static const char *
    kind()
    {
      return "viscosity law";
    }
    /// @param pressure [MPa] >= 0; @param shear_rate [1/s] >= 0
    virtual Value viscosity(double pressure, double shear_rate) const = 0;

    /// @param value [MPa s] at ambient pressure. To be called before the first viscosity().
    void
    set_reference_viscosity(double value)
    {
      reference = value;
    }
    double
    reference_viscosity() const
    {
      return reference;
    }

  protected:
    double reference = std::numeric_limits<double>::signaling_NaN();
  };
} // namespace tribodraw

#endif
