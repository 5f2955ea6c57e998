#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/asperity_model.h>

#include <cmath>
#include <limits>

namespace tribodraw
{
  namespace
  {
    /// Plastic contact with volume conservation and uniform rise: alpha = P / (P + H), H = B sigma_y.
    class PullenWilliamson : public AsperityModel
    {
    public:
      explicit PullenWilliamson(Parameters &parameters)
          : hardness_over_shear_strength(
              std::sqrt(3.)
              * parameters.quantity("Hardness over flow stress", "", Range::positive().usual(1, 6),
                                    "Indentation hardness divided by the flow stress (Tabor: 2.8)."))
      {
      }

      double
      normal_load(const double alpha, const double k) const override
      {
        return hardness_over_shear_strength * k * alpha / (1. - alpha);
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

  TRIBODRAW_REGISTER(AsperityModel, PullenWilliamson, "Pullen-Williamson",
                     "Contact fraction = P / (P + hardness): raised valleys resist; bulk strain does not flatten.",
                     "J. Pullen, J.B.P. Williamson: On the plastic contact of rough surfaces. "
                     "Proc. R. Soc. Lond. A 327 (1972) 159-173")
} // namespace tribodraw
