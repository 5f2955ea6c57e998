#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/asperity_model.h>

#include <cmath>
#include <limits>

namespace tribodraw
{
  namespace
  {
    /// Every plateau carries the same hardness, P = H alpha with H = B sigma_y; bulk strain does not flatten.
    class IdealPlastic : public AsperityModel
    {
    public:
      explicit IdealPlastic(Parameters &parameters)
          : hardness_over_shear_strength(
              std::sqrt(3.)
              * parameters.quantity("Hardness over flow stress", "", Range::positive().usual(1, 6),
                                    "Indentation hardness divided by the flow stress (Tabor: 2.8)."))
      {
      }

      double
      normal_load(const double alpha, const double k) const override
      {
        return hardness_over_shear_strength * k * alpha;
      }

      double
      strain_rate_number(double, double, double) const override
      {
        return std::numeric_limits<double>::infinity();
      }

    private:
      const double hardness_over_shear_strength;
    };
  } // namespace

  TRIBODRAW_REGISTER(AsperityModel, IdealPlastic, "ideal plastic",
                     "Constant hardness: contact fraction = solid pressure / hardness; bulk strain does not flatten.",
                     "F.P. Bowden, D. Tabor: The Friction and Lubrication of Solids. Oxford 1950")
} // namespace tribodraw
