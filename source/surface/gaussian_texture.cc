#include <tribodraw/base/parameters.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/surface/spectral_field.h>
#include <tribodraw/surface/texture.h>

namespace tribodraw
{
  namespace
  {
    /// Gaussian heights. Different correlation lengths along and across the lay make a ground tool of it.
    class GaussianTexture : public SurfaceTexture
    {
    public:
      explicit GaussianTexture(Parameters &parameters) : correlation(read_lay_correlation(parameters)) {}

      std::vector<double>
      heights(const Grid &grid, NormalDeviates &deviates) const override
      {
        // Along the axes the field needs no transform.
        return correlation.angle == 0. ? gaussian_field(grid, correlation.lengths, deviates)
                                       : spectral_field(grid, correlation, deviates);
      }

      std::string
      problem(const Grid &grid) const override
      {
        const std::string entry = "Gaussian/Correlation length";
        return correlation.angle == 0. ? correlation_problem(entry, grid, correlation.lengths)
                                       : correlation_problem(entry, grid, correlation);
      }

    private:
      LayCorrelation correlation;
    };
  } // namespace

  TRIBODRAW_REGISTER(
      SurfaceTexture, GaussianTexture, "gaussian",
      "Gaussian heights with a Gaussian autocorrelation function; two correlation lengths give a lay, as of "
      "a ground tool.",
      "Patir 1978, Wear 47, 263-277")
} // namespace tribodraw
