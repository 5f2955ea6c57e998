#include <tribodraw/base/registry.h>
#include <tribodraw/flattening/asperity_model.h>

#include <cmath>
#include <limits>

namespace tribodraw
{
  namespace
  {
    /// Upper-bound fits of Wilson and Sheu (1988) for the effective hardness of asperities on a straining sheet,
    ///   H/k = 2 / ( f1(A) E + f2(A) ),   P = A H.
    /// Load alone is the branch E = 0, so that straining starts without a jump.
    class WilsonSheu : public AsperityModel
    {
    public:
      explicit WilsonSheu(Parameters &) {}

      double
      normal_load(const double alpha, const double k) const override
      {
        return alpha > 0 ? 2. * k * alpha * inverse_f2(alpha) : 0.;
      }

      double
      strain_rate_number(const double alpha, const double p_solid, const double k) const override
      {
        const double f1 = 0.515 + 0.345 * alpha - 0.860 * alpha * alpha; // 0 at alpha = 1
        if (!(f1 > 1e-14) || alpha >= 1.)
          return std::numeric_limits<double>::infinity();
        return (2. * alpha * k / p_solid - 1. / inverse_f2(alpha)) / f1;
      }

    private:
      static double
      inverse_f2(const double alpha)
      {
        return 2.571 - alpha - alpha * std::log1p(-alpha);
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(AsperityModel, WilsonSheu, "Wilson-Sheu",
                     "Upper-bound fit for plateaus on a sheet that strains; load alone is its branch without strain.",
                     "W.R.D. Wilson, S. Sheu: Real area of contact and boundary friction in metal forming. "
                     "Int. J. Mech. Sci. 30 (1988) 475-489")
} // namespace tribodraw
