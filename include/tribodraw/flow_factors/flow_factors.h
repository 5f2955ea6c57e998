#ifndef tribodraw_flow_factors_flow_factors_h
#define tribodraw_flow_factors_flow_factors_h

#include <tribodraw/surface/height_map.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// Pressure and shear flow factors of one gap. Tensor components in the order xx, xy, yx, yy.
  struct FlowFactors
  {
    double                cut_height       = 0; ///< s [mm] on the sheet's own height distribution
    double                h_avg            = 0; ///< mean gap [mm]
    double                contact_fraction = 0;
    std::array<double, 4> phi_p{{1, 0, 0, 1}};
    std::array<double, 4> phi_s{{0, 0, 0, 0}};
    double                residual   = 0; ///< relative residual of the worst linear solve
    double                flux_error = 0; ///< relative mismatch of the flux through opposite sides
    unsigned              iterations = 0;
  };

  /// Flow factors as functions of the separation for a pair of surfaces: cell problem, published fits.
  class FlowFactorModel
  {
  public:
    virtual ~FlowFactorModel() = default;
    static const char *kind() { return "flow factor model"; }
    /// @param sheet rough sheet, surface 1; heights towards the tool, zero mean.
    /// @param tool heights towards the sheet, same grid, zero mean; empty z: smooth tool.
    /// @param sq_reference combined Sq [mm] of the undeformed surfaces, to which phi_s refers.
    /// @param cut_heights s [mm]; the gap is max(0, s - z - t).
    /// @param progress called with the fraction done.
    virtual std::vector<FlowFactors> compute(const HeightMap                           &sheet,
                                             const HeightMap                           &tool,
                                             double                                     sq_reference,
                                             const std::vector<double>                 &cut_heights,
                                             const std::function<void(double)>         &progress) const = 0;
    /// Text of everything the result depends on besides the maps, for the cache.
    virtual std::string fingerprint() const = 0;
  };
} // namespace tribodraw

#endif
