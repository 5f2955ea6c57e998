#ifndef tribodraw_flow_factors_fitted_factors_h
#define tribodraw_flow_factors_fitted_factors_h

#include <tribodraw/flow_factors/flow_factors.h>

#include <functional>

namespace tribodraw
{
  /// One separation as published laws see it. Heights over the combined Sq of the undeformed surfaces.
  struct FittedSeparation
  {
    double h_t;   ///< distance of the mean planes of the undeformed surfaces, may be negative
    double h_avg; ///< mean gap of the actual surfaces, contact as zero
    /// Mean gap at another distance of the mean planes.
    std::function<double(double)> mean_gap;
  };

  /// Base of the published laws: factors as functions of the separation and of the ratio gamma of the correlation
  /// lengths along and across the flow (Peklenik number), Sq_1 and Sq_2.
  ///
  /// A law gives both factors for flow and sliding along x; along y it is asked with 1/gamma. Off-diagonal components
  /// are zero: lays are along x or y. Of two rough surfaces Sq^2 PhiS = Sq_1^2 Ps(gamma_1) - Sq_2^2 Ps(gamma_2).
  /// Pressure factors belong to h_avg^3 (not to the cube of the distance of the mean planes), for which h_avg is taken
  /// from the maps. gamma is measured on the maps (lags of the autocorrelation 0.5 along x and y) or given.
  class FittedFactors : public FlowFactorModel
  {
  public:
    std::vector<FlowFactors> compute(const HeightMap &sheet, const HeightMap &tool, double sq_reference,
                                     const std::vector<double>         &cut_heights,
                                     const std::function<void(double)> &progress) const override;
    std::string              fingerprint() const override;

    /// PhiP in the form with h_avg^3.
    virtual double pressure_factor(const FittedSeparation &at, double gamma) const = 0;
    /// Ps of one rough surface against a smooth one, Sq counting that surface only.
    virtual double shear_factor(const FittedSeparation &at, double gamma) const = 0;

  protected:
    explicit FittedFactors(Parameters &parameters);
    /// Name and version of the law, for the fingerprint.
    virtual std::string law() const = 0;
    /// What is to be said of separations outside the published range, or nothing.
    virtual std::string remark(const FittedSeparation &at, double gamma) const = 0;

  private:
    struct Ratios
    {
      double gap, sheet, tool;
    };
    bool   measured = true;
    Ratios given{ 1, 1, 1 };

    Ratios ratios(const HeightMap &sheet, const HeightMap &tool, const HeightMap &sum) const;
  };

  /// Largest and smallest gamma for which coefficients are published; others are replaced by the nearer end.
  constexpr double largest_gamma = 9;
  double           limited_gamma(double gamma);
} // namespace tribodraw

#endif
