#ifndef tribodraw_material_hardening_law_h
#define tribodraw_material_hardening_law_h

namespace tribodraw
{
  class Parameters;

  /// Flow stress as a function of equivalent plastic strain and its rate.
  class HardeningLaw
  {
  public:
    struct FlowStress
    {
      double value;        ///< [MPa]
      double strain_slope; ///< d value / d strain [MPa]
      double rate_slope;   ///< d value / d rate [MPa s]
    };
    virtual ~HardeningLaw() = default;
    static const char *
    kind()
    {
      return "hardening law";
    }
    /// @param strain equivalent plastic strain >= 0; @param rate its rate [1/s] >= 0
    virtual FlowStress flow_stress(double strain, double rate) const = 0;
  };
} // namespace tribodraw

#endif
