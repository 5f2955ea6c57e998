#include <tribodraw/boundary_friction/ploughing.h>

#include <array>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// Gauss-Legendre quadrature over the angles (-pi/2, pi/2).
    template <unsigned int n>
    struct HalfCircleRule
    {
      std::array<double, n> weight, cosine, sine; // of the angle pi/2 * node

      HalfCircleRule()
      {
        for (unsigned int i = 0; i < n; ++i)
          {
            double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
            for (unsigned int iteration = 0; iteration < 20; ++iteration)
              {
                double p0 = 1, p1 = x;
                for (unsigned int k = 2; k <= n; ++k)
                  {
                    const double p2 = ((2. * k - 1.) * x * p1 - (k - 1.) * p0) / k;
                    p0              = p1;
                    p1              = p2;
                  }
                slope = n * (x * p1 - p0) / (x * x - 1.);
                x -= p1 / slope;
              }
            weight[i] = pi / ((1. - x * x) * slope * slope);
            cosine[i] = std::cos(0.5 * pi * x);
            sine[i]   = std::sin(0.5 * pi * x);
          }
      }
    };

    /// Radial integrals over the unit radius, with zy = c r and q = c^2; series where the closed forms cancel.
    double
    integral_of_r_root(const double q) // int r sqrt(1 + q r^2) dr
    {
      if (q < 1e-2)
        return 1. / 2 + q * (1. / 8 + q * (-1. / 48 + q * (1. / 128 + q * (-1. / 256 + q * (7. / 3072)))));
      return (std::pow(1. + q, 1.5) - 1.) / (3. * q);
    }

    double
    integral_of_r2_over_root(const double q) // int r^2 / sqrt(1 + q r^2) dr
    {
      if (q < 1e-2)
        return 1. / 3 + q * (-1. / 10 + q * (3. / 56 + q * (-5. / 144 + q * (35. / 1408 + q * (-63. / 3328)))));
      const double c = std::sqrt(q);
      return (c * std::sqrt(1. + q) - std::asinh(c)) / (2. * q * c);
    }

    double
    integral_of_r3_over_root(const double q) // int r^3 / sqrt(1 + q r^2) dr
    {
      if (q < 1e-2)
        return 1. / 4 + q * (-1. / 12 + q * (3. / 64 + q * (-1. / 32 + q * (35. / 1536 + q * (-9. / 512)))));
      return (std::sqrt(1. + q) * (q - 2.) + 2.) / (3. * q * q);
    }

    template <unsigned int n>
    PloughingForces
    integrate_paraboloid(const HalfCircleRule<n> &rule, const double a, const double b, const double w,
                         const double psi, const double p, const double tau)
    {
      // On the unit disc x' = a r cos(phi), y' = b r sin(phi): d zeta/dx = -2 w G r cos(phi - phi0), d zeta/dy = -r
      // c(phi), so the leading side is the half disc |phi - phi0| < pi/2.
      const double cosine = std::cos(psi), sine = std::sin(psi);
      const double slope = 2. * w * std::hypot(cosine / a, sine / b); // 2 w G
      const double phi0  = std::atan2(-sine / b, cosine / a);

      // c(phi) in terms of the angle theta = phi - phi0 from the sliding direction
      const double c_cosine = 2. * w * (sine * std::cos(phi0) / a + cosine * std::sin(phi0) / b);
      const double c_sine   = 2. * w * (cosine * std::cos(phi0) / b - sine * std::sin(phi0) / a);

      double lateral_pressure = 0, drag_shear = 0, support_shear = 0, lateral_shear = 0;
      for (std::size_t i = 0; i < rule.weight.size(); ++i)
        {
          const double weight = rule.weight[i] * a * b;
          const double c      = c_cosine * rule.cosine[i] + c_sine * rule.sine[i];
          const double zx     = slope * rule.cosine[i]; // |d zeta/dx| at r = 1
          lateral_pressure -= weight * c / 3.;
          drag_shear += weight * integral_of_r_root(c * c);
          support_shear += weight * zx * integral_of_r2_over_root(c * c);
          lateral_shear += weight * zx * c * integral_of_r3_over_root(c * c);
        }
      PloughingForces f;
      f.projected_area = 0.5 * pi * a * b;
      f.frontal_area   = 4. / 3. * w * std::hypot(a * sine, b * cosine);
      f.drag           = p * f.frontal_area + tau * drag_shear;
      f.support        = p * f.projected_area - tau * support_shear;
      f.lateral        = p * lateral_pressure + tau * lateral_shear;
      return f;
    }
  } // namespace

  PloughingForces
  ploughing_traction(const double zx, const double zy, const double p, const double tau)
  {
    const double    root = std::sqrt(1. + zy * zy);
    PloughingForces f;
    f.drag           = p * std::abs(zx) + tau * root;
    f.support        = p - tau * std::abs(zx) / root;
    f.lateral        = p * zy + tau * zx * zy / root;
    f.projected_area = 1.;
    f.frontal_area   = std::abs(zx);
    return f;
  }

  PloughingForces
  plough_paraboloid(const double a, const double b, const double w, const double psi, const double p, const double tau)
  {
    static const HalfCircleRule<24> fine;
    static const HalfCircleRule<12> coarse; // to round-off for the shallow slopes of real tools
    return 2. * w < 0.1 * b && 2. * w < 0.1 * a ? integrate_paraboloid(coarse, a, b, w, psi, p, tau)
                                                : integrate_paraboloid(fine, a, b, w, psi, p, tau);
  }
} // namespace tribodraw
