#include <tribodraw/base/registry.h>
#include <tribodraw/flattening/bulk_strain_law.h>

#include <limits>

namespace tribodraw
{
  namespace
  {
    /// Wilson and Sheu's softening by strain, H/k = 2 / (f1(A) E + f2), used in Westeneng's form ds/d eps = -l/E. Here
    /// f2 = 2k/H of the sheet at rest, whichever asperity model gave that: straining then starts at E = 0, without a
    /// jump. With the Wilson-Sheu asperity model this is their law unchanged.
    class WestenengStrain : public BulkStrainLaw
    {
    public:
      explicit WestenengStrain(Parameters &) {}

      double
      strain_rate_number(const double alpha, const double hardness, const double hardness_at_rest) const override
      {
        const double f1 = 0.515 + 0.345 * alpha - 0.860 * alpha * alpha; // 0 at alpha = 1
        if (!(f1 > 1e-14) || alpha >= 1.)
          return std::numeric_limits<double>::infinity();
        return (2. / hardness - 2. / hardness_at_rest) / f1;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(BulkStrainLaw, WestenengStrain, "Westeneng",
                     "Plateaus on a straining sheet carry less (Wilson and Sheu's fit); the cut height falls with the "
                     "equivalent plastic strain.",
                     "J.D. Westeneng: Modelling of contact and friction in deep drawing processes. PhD thesis, "
                     "University of Twente 2001; W.R.D. Wilson, S. Sheu: Int. J. Mech. Sci. 30 (1988) 475-489")
} // namespace tribodraw
