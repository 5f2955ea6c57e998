#ifndef tribodraw_material_hardening_law_h
#define tribodraw_material_hardening_law_h

#include <tribodraw/material/pack.h>

namespace tribodraw
{
  class Parameters;

  /// Flow stress as a function of equivalent plastic strain and its rate.
  class HardeningLaw
  {
  public:
    template <class Number>
    struct FlowStressOf
    {
      Number value;        ///< [MPa]
      Number strain_slope; ///< d value / d strain [MPa]
      Number rate_slope;   ///< d value / d rate [MPa s]
    };
    using FlowStress = FlowStressOf<double>;

    virtual ~HardeningLaw() = default;
    static const char *
    kind()
    {
      return "hardening law";
    }
    /// @param strain equivalent plastic strain >= 0; @param rate its rate [1/s] >= 0
    virtual FlowStress flow_stress(double strain, double rate) const = 0;
    /// The same for four points at once. A law may implement it in vector arithmetic, for speed; otherwise it calls the
    /// function above for each.
    virtual void flow_stress_pack(const Pack &strain, const Pack &rate, FlowStressOf<Pack> &result) const;
  };
} // namespace tribodraw

#endif
