#include <tribodraw/base/parameters.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/surface/texture.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// The value that a standard normal variable exceeds with probability 1 - p: bisection, exact to rounding.
    double
    normal_quantile(double p)
    {
      double low = -9., high = 9.;
      for (int i = 0; i < 100; ++i)
        {
          const double middle                                         = 0.5 * (low + high);
          (0.5 * std::erfc(-middle / std::sqrt(2.)) < p ? low : high) = middle;
        }
      return 0.5 * (low + high);
    }

    /// Plateaus and overlapping craters as left on the sheet by rolls textured by electric discharge:
    /// z = tanh(k (g + b)) + a r with independent Gaussian fields g (craters) and r (fine roughness on both). The
    /// plateau is where g + b > 0; b follows from the area fraction. Up to its scale, levels are +1 and -1.
    class BimodalTexture : public SurfaceTexture
    {
    public:
      explicit BimodalTexture(Parameters &parameters)
          : crater_lengths(read_correlation_lengths(parameters, "Crater correlation length",
                                                    "Correlation length of the crater pattern.")),
            plateau_fraction(
                parameters.quantity("Plateau area fraction", "", Range::between(0.02, 0.98),
                                    "Share of the area that belongs to the plateaus, that is, lies above half "
                                    "the height between plateau and crater floor.")),
            steepness(
                parameters.quantity("Edge steepness", "", Range::positive().usual(0.1, 20.),
                                    "Steepness of the crater walls: height change, in halves of the height between "
                                    "crater floor and plateau, per standard deviation of the crater pattern. Large "
                                    "values give flat plateaus and floors, small ones a Gaussian surface.")),
            fine_ratio(
                parameters.quantity("Fine roughness ratio", "", Range::non_negative().usual(0., 2.),
                                    "Root mean square height of the fine roughness, divided by half the height between "
                                    "crater floor and plateau.")),
            fine_lengths(read_correlation_lengths(parameters, "Fine correlation length",
                                                  "Correlation length of the fine roughness."))
      {
      }

      std::vector<double>
      heights(const Grid &grid, NormalDeviates &deviates) const override
      {
        const double              offset = normal_quantile(plateau_fraction);
        std::vector<double>       z      = gaussian_field(grid, crater_lengths, deviates);
        const std::vector<double> fine   = gaussian_field(grid, fine_lengths, deviates);
        for (std::size_t i = 0; i < z.size(); ++i)
          z[i] = std::tanh(steepness * (z[i] + offset)) + fine_ratio * fine[i];
        return z;
      }

      std::string
      problem(const Grid &grid) const override
      {
        const std::string first = correlation_problem("Bimodal/Crater correlation length", grid, crater_lengths);
        return first.empty() ? correlation_problem("Bimodal/Fine correlation length", grid, fine_lengths) : first;
      }

    private:
      CorrelationLengths crater_lengths;
      double             plateau_fraction, steepness, fine_ratio;
      CorrelationLengths fine_lengths;
    };
  } // namespace

  TRIBODRAW_REGISTER(
      SurfaceTexture, BimodalTexture, "bimodal",
      "Plateaus with overlapping craters and a fine roughness, as on sheet rolled with electro-discharge "
      "textured rolls.",
      "height distribution after Shisode et al. 2021, J. Mater. Process. Technol.")
} // namespace tribodraw
