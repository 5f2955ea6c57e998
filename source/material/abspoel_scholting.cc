#include <tribodraw/base/parameters.h>
#include <tribodraw/material/forming_limit.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Forming limit curve of steel sheet predicted from tensile data: four points (uniaxial tension TE, plane strain
    /// PS, intermediate IM at minor/major 0.75, equibiaxial BI) joined by straight lines; A80 in per cent, thickness t
    /// in mm:
    ///   lambda = 0.797 r^0.701, v = 0.0626 A80^0.567 + (t-1)(0.12 - 0.0024 A80)
    ///   TE: e1 = (1+lambda) v / sqrt(1+lambda^2), e2 = -lambda v / sqrt(1+lambda^2)
    ///   PS: e1 = 0.0084 A80 + 0.0017 A80 (t-1)
    ///   IM: e1 = 0.0062 A80 + 0.18 + 0.0027 A80 (t'-1), e2 = 0.75 e1
    ///   BI: e1 = e2 = 0.00215 Amin + 0.25 + 0.00285 Amin t'
    /// with t' = min(t, (1.5 - 0.00215 Amin)/(0.6 + 0.00285 Amin)). Beyond TE the line through TE and PS goes on,
    /// beyond BI the limit is constant.
    class AbspoelScholting : public FormingLimitCurve
    {
    public:
      explicit AbspoelScholting(Parameters &parameters)
      {
        const auto   percent = Range::positive().usual(5., 70.);
        const double r       = parameters.quantity("R value", "", Range::positive().usual(0.2, 5.),
                                                   "R-value of the direction considered (across rolling: safest).");
        const double A80
            = 100
              * parameters.quantity("Elongation A80", "%", percent, "Total elongation of the direction considered.");
        const double A_min = 100
                             * parameters.quantity("Smallest elongation A80", "%", percent,
                                                   "Smallest total elongation of 0, 45 and 90 degrees.");
        const double t       = parameters.quantity("Thickness", "mm", Range::positive().usual(0.2, 3.),
                                                   "Initial thickness of the sheet.");
        const double lambda  = 0.797 * std::pow(r, 0.701);
        const double v       = 0.0626 * std::pow(A80, 0.567) + (t - 1) * (0.12 - 0.0024 * A80);
        const double te      = v / std::sqrt(1 + lambda * lambda);
        const double t_trans = (1.5 - 0.00215 * A_min) / (0.6 + 0.00285 * A_min);
        const double t_bi    = std::min(t, t_trans);
        const double im      = 0.0062 * A80 + 0.18 + 0.0027 * A80 * (t_bi - 1);
        const double bi      = 0.00215 * A_min + 0.25 + 0.00285 * A_min * t_bi;
        minor                = { -lambda * te, 0., 0.75 * im, bi };
        major                = { (1 + lambda) * te, 0.0084 * A80 + 0.0017 * A80 * (t - 1), im, bi };
        if (!parameters.documentation_mode() && !(minor[0] < 0 && 0 < minor[2] && minor[2] < minor[3] && major[1] > 0))
          parameters.problem("", "the points of the forming limit curve are not in order",
                             "elongations and thickness in the range of steel sheet",
                             "The rule holds for steel of about 0.2 to 3 mm.");
      }

      double
      limit(const double minor_strain) const override
      {
        if (minor_strain >= minor[3])
          return major[3];
        const int    i = minor_strain < minor[1] ? 0 : minor_strain < minor[2] ? 1 : 2;
        const double w = (minor_strain - minor[i]) / (minor[i + 1] - minor[i]);
        return (1 - w) * major[i] + w * major[i + 1];
      }

    private:
      std::array<double, 4> minor, major; ///< TE, PS, IM, BI
    };
  } // namespace

  TRIBODRAW_REGISTER(FormingLimitCurve, AbspoelScholting, "Abspoel-Scholting",
                     "Forming limit curve of steel from R-value, elongations and thickness (four points).",
                     "M. Abspoel, M. E. Scholting, J. M. M. Droog, J. Mater. Process. Technol. 213 (2013) 759-769")
} // namespace tribodraw
