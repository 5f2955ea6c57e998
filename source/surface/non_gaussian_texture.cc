#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/surface/johnson_curve.h>
#include <tribodraw/surface/spectral_field.h>
#include <tribodraw/surface/texture.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    /// Heights with prescribed skewness and kurtosis. A Gaussian field is made with the autocorrelation function that
    /// the transformation turns into the wanted one; then its values are replaced, in the order of their size, by the
    /// quantiles of the wanted distribution.
    class NonGaussianTexture : public SurfaceTexture
    {
    public:
      explicit NonGaussianTexture(Parameters &parameters)
          : correlation(read_lay_correlation(parameters)),
            skewness(parameters.quantity("Skewness", "", Range::between(-5., 5.),
                                         "Ssk of the heights; negative for plateaus with valleys.")),
            kurtosis(parameters.quantity("Kurtosis", "", Range::between(1., 50.),
                                         "Sku of the heights; 3 for Gaussian ones, at least Ssk^2 + 1 for any."))
      {
      }

      std::vector<double>
      heights(const Grid &grid, NormalDeviates &deviates) const override
      {
        const std::size_t   n = grid.nx * grid.ny;
        const JohnsonCurve  curve(skewness, kurtosis, n);
        std::vector<double> field
            = spectral_field(grid, correlation, deviates, [&](double rho) { return curve.normal_correlation(rho); });
        std::vector<std::uint32_t> order(n);
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return field[a] != field[b] ? field[a] < field[b] : a < b; });
        parallel::for_range(n, 4096, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            field[order[i]] = curve(normal_quantile((static_cast<double>(i) + 0.5) / static_cast<double>(n)));
        });
        return field;
      }

      std::string
      problem(const Grid &grid) const override
      {
        const std::string first = correlation_problem("Non-gaussian/Correlation length", grid, correlation);
        if (!first.empty())
          return first;
        try
          {
            JohnsonCurve(skewness, kurtosis, grid.nx * grid.ny);
          }
        catch (const InputError &e)
          {
            return e.what();
          }
        return {};
      }

    private:
      LayCorrelation correlation;
      double         skewness, kurtosis;
    };
  } // namespace

  TRIBODRAW_REGISTER(
      SurfaceTexture, NonGaussianTexture, "non-gaussian",
      "Heights with prescribed skewness and kurtosis and a Gaussian autocorrelation function, with a lay.",
      "Johnson 1949, Biometrika 36, 149-176; translation process as in Grigoriu 1984, J. Eng. Mech. 110, 610-620")
} // namespace tribodraw
