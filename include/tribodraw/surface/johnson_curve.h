#ifndef tribodraw_surface_johnson_curve_h
#define tribodraw_surface_johnson_curve_h

#include <cstddef>
#include <functional>
#include <vector>

namespace tribodraw
{
  /// Value that a standard normal variable stays below with probability @p p.
  double normal_quantile(double p);

  /// Increasing function of a standard normal variable that has a prescribed skewness and kurtosis: Johnson's system
  /// (N. L. Johnson, Biometrika 36 (1949) 149-176). With u = (g - shift) / delta it is exp(u) on the log-normal line,
  /// sinh(u) for kurtosis above it and 1 / (1 + exp(-u)) below it, mirrored for negative skewness, and shifted and
  /// scaled to zero mean and unit variance.
  ///
  /// The moments are those of a sample of @p points equally probable values, as the heights of a map are, whose extreme
  /// values are limited.
  class JohnsonCurve
  {
  public:
    /// Throws InputError if kurtosis < skewness^2 + 1, which no distribution has, or if no curve of the system reaches
    /// both values with that number of points.
    JohnsonCurve(double skewness, double kurtosis, std::size_t points);

    double operator()(double g) const;

    /// Correlation of the values of this function at two normal variables of correlation @p rho in [0, 1] (Mehler's
    /// series: sum of c_k^2 rho^k over the Hermite coefficients c_k).
    double correlation(double rho) const;
    /// Its inverse.
    double normal_correlation(double rho) const;

  private:
    enum class Family
    {
      log_normal,
      unbounded,
      bounded
    };
    struct Moments
    {
      double mean, deviation, skewness, kurtosis;
    };

    double  raw(double g) const;
    Moments moments() const;
    void    match_skewness(double skewness);
    void    match_kurtosis(double skewness, double kurtosis);
    void    find_log_normal(double skewness);
    void    expand();

    Family              family = Family::log_normal;
    double              delta = 1., shift = 0., sign = 1., mean = 0., deviation = 1.;
    std::vector<double> nodes, weights;  ///< of the sample, for sums
    std::vector<double> hermite_squares; ///< c_k^2
    std::vector<double> inverse;         ///< normal correlation at equidistant correlations
  };
} // namespace tribodraw

#endif
