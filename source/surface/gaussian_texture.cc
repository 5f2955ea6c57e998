#include <tribodraw/base/registry.h>
#include <tribodraw/surface/texture.h>

namespace tribodraw
{
  namespace
  {
    /// Gaussian heights. Different correlation lengths in x and y give a lay, as of a ground tool.
    class GaussianTexture : public SurfaceTexture
    {
    public:
      explicit GaussianTexture(Parameters &parameters)
          : lengths(read_correlation_lengths(parameters, "Correlation length", "Correlation length of the heights."))
      {
      }

      std::vector<double>
      heights(const Grid &grid, NormalDeviates &deviates) const override
      {
        return gaussian_field(grid, lengths, deviates);
      }

      std::string
      problem(const Grid &grid) const override
      {
        return correlation_problem("Gaussian/Correlation length", grid, lengths);
      }

    private:
      CorrelationLengths lengths;
    };
  } // namespace

  TRIBODRAW_REGISTER(
      SurfaceTexture, GaussianTexture, "gaussian",
      "Gaussian heights with a Gaussian autocorrelation function; two correlation lengths give a lay, as of "
      "a ground tool.",
      "Patir 1978, Wear 47, 263-277")
} // namespace tribodraw
