#include <tribodraw/base/parameters.h>
#include <tribodraw/material/yield_locus.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace tribodraw
{
  namespace
  {
    using Alphas = std::array<double, 8>;

    /// Barlat's plane-stress locus with two linear transformations X' = L' s and X'' = L'' s:
    ///   |X'_1 - X'_2|^M + |2 X''_2 + X''_1|^M + |2 X''_1 + X''_2|^M = 2 sigma^M
    /// (indices: principal values). Convex for every choice of the coefficients.
    class Yld2000 : public YieldLocus
    {
    public:
      explicit Yld2000(Parameters &parameters);
      /// @param alphas are scaled so that the equivalent stress in rolling direction is the stress.
      Yld2000(const Alphas &alphas, double exponent);

      double
      equivalent_stress(const Vector3 &s) const override
      {
        if (s[0] == 0 && s[1] == 0 && s[2] == 0)
          return 0;
        return compute<double>({ 0.5 * (s[0] + s[1]), 0.5 * (s[0] - s[1]), s[2] }).e;
      }
      double
      evaluate(const Vector3 &s, Vector3 &gradient, Matrix3 &hessian) const override
      {
        const auto r = compute<double>({ 0.5 * (s[0] + s[1]), 0.5 * (s[0] - s[1]), s[2] });
        to_cartesian(r, gradient, hessian);
        return r.e;
      }
      void
      evaluate_pack(const MohrStress<Pack> &stress, LocusDerivatives<Pack> &result) const override
      {
        pack::vectorised([&]() TRIBODRAW_INLINE { result = compute<Pack>(stress); });
      }

    private:
      void set(const Alphas &alphas, double exponent);
      template <class Number>
      LocusDerivatives<Number> compute(const MohrStress<Number> &stress) const;
      /// |x|^(M-2)
      template <class Number>
      Number power(const Number &x) const;

      double M         = 8;
      int    half_of_M = 4;          ///< M/2 if M is an even integer, else 0
      double dm = 0, da = 1, db = 1; ///< X'_xx - X'_yy = dm m + da a, 2 X'_xy = db b
      double pm = 0, pa = 0;         ///< 3/2 (X''_xx + X''_yy)
      double xm = 0, xa = 0, yb = 0; ///< (X''_xx - X''_yy)/2 and X''_xy
    };

    // The transformations as in Barlat et al. (2003), written for sxx = m + a, syy = m - a.
    void
    Yld2000::set(const Alphas &a, const double exponent)
    {
      M         = exponent;
      half_of_M = M <= 40 && M == 2 * std::floor(M / 2) ? static_cast<int>(M / 2) : 0;
      // X'_xx - X'_yy = ((2 a1 + a2) sxx - (a1 + 2 a2) syy)/3
      dm               = (a[0] - a[1]) / 3;
      da               = a[0] + a[1];
      db               = 2 * a[6];
      const double L11 = (-2 * a[2] + 2 * a[3] + 8 * a[4] - 2 * a[5]) / 9;
      const double L12 = (a[2] - 4 * a[3] - 4 * a[4] + 4 * a[5]) / 9;
      const double L21 = (4 * a[2] - 4 * a[3] - 4 * a[4] + a[5]) / 9;
      const double L22 = (-2 * a[2] + 8 * a[3] + 2 * a[4] - 2 * a[5]) / 9;
      pm               = 1.5 * (L11 + L21 + L12 + L22);
      pa               = 1.5 * (L11 + L21 - L12 - L22);
      xm               = 0.5 * (L11 - L21 + L12 - L22);
      xa               = 0.5 * (L11 - L21 - L12 + L22);
      yb               = a[7];
    }

    Yld2000::Yld2000(const Alphas &alphas, const double exponent)
    {
      set(alphas, exponent);
      const double along = equivalent_stress({ 1, 0, 0 });
      Alphas       scaled;
      for (unsigned i = 0; i < 8; ++i)
        scaled[i] = alphas[i] / along;
      set(scaled, exponent);
    }

    template <class Number>
    TRIBODRAW_INLINE inline Number
    Yld2000::power(const Number &x) const
    {
      if (half_of_M == 0)
        return pack::pow(pack::max(pack::abs(x), Number(1e-60)), M - 2);
      const Number square = x * x;
      Number       result = 1.;
      for (int i = 1; i < half_of_M; ++i)
        result = result * square;
      return result;
    }

    template <class Number>
    TRIBODRAW_INLINE inline LocusDerivatives<Number>
    Yld2000::compute(const MohrStress<Number> &stress) const
    {
      // Of size one, so that the powers neither overflow nor vanish.
      const Number size = pack::abs(stress.m) + pack::abs(stress.a) + pack::abs(stress.b), inverse_size = 1. / size;
      const Number m = stress.m * inverse_size, a = stress.a * inverse_size, b = stress.b * inverse_size;

      // First term D^M with D^2 = x^2 + y^2: D^(M-2) is its gradient over M (x dx + y dy).
      const Number x = dm * m + da * a, y = db * b, D2 = x * x + y * y;
      const Number D_power = power(pack::sqrt(D2)), curvature = (M - 2) * D_power / pack::max(D2, Number(1e-30));
      // Half gradients of D^2 and the outer product that the second derivative needs.
      const Number wm = dm * x, wa = da * x, wb = db * y;

      // The others |p + r|^M + |p - r|^M, r^2 = X^2 + Y^2.
      const Number p = pm * m + pa * a, X = xm * m + xa * a, Y = yb * b, r = pack::sqrt(Number(X * X + Y * Y));
      const Number plus = p + r, minus = p - r, P = power(plus), Q = power(minus);
      const Number f_p = P * plus + Q * minus, f_r = P * plus - Q * minus; // over M
      const Number f_pp = (M - 1) * (P + Q), f_pr = (M - 1) * (P - Q);     // over M; f_rr = f_pp
      // f_r/r and (f_rr - f_r/r)/r^2, f_pr/r; near r = 0 their limits.
      const auto   tiny = r < 1e-5 * pack::abs(p) || r < 1e-30;
      const Number ir   = 1. / pack::select(tiny, Number(1.), r);
      const Number g    = pack::select(tiny, f_pp, Number(f_r * ir));
      const Number h    = pack::select(tiny, Number(0.), Number((f_pp - g) * ir * ir));
      const Number k
          = pack::select(tiny, Number(2. * (M - 1) * (M - 2) * power(p) * p / pack::max(Number(p * p), Number(1e-30))),
                         Number(f_pr * ir));
      const Number vm = xm * X, va = xa * X, vb = yb * Y; // half gradient of r^2

      const Number             phi = D_power * D2 + P * plus * plus + Q * minus * minus;
      LocusDerivatives<Number> d;
      d.e            = pack::pow(Number(0.5 * phi), 1 / M);
      const Number s = d.e / phi; // gradient = s (gradient of phi)/M
      d.m            = s * (D_power * wm + f_p * pm + g * vm);
      d.a            = s * (D_power * wa + f_p * pa + g * va);
      d.b            = s * (D_power * wb + g * vb);
      const Number q = (M - 1) / d.e;
      d.mm           = s
                 * (D_power * (dm * dm) + curvature * wm * wm + f_pp * (pm * pm) + g * (xm * xm) + h * vm * vm
                    + 2. * k * pm * vm)
             - q * d.m * d.m;
      d.aa = s
                 * (D_power * (da * da) + curvature * wa * wa + f_pp * (pa * pa) + g * (xa * xa) + h * va * va
                    + 2. * k * pa * va)
             - q * d.a * d.a;
      d.bb = s * (D_power * (db * db) + curvature * wb * wb + g * (yb * yb) + h * vb * vb) - q * d.b * d.b;
      d.ma = s
                 * (D_power * (dm * da) + curvature * wm * wa + f_pp * (pm * pa) + g * (xm * xa) + h * vm * va
                    + k * (pm * va + pa * vm))
             - q * d.m * d.a;
      d.mb = s * (curvature * wm * wb + h * vm * vb + k * pm * vb) - q * d.m * d.b;
      d.ab = s * (curvature * wa * wb + h * va * vb + k * pa * vb) - q * d.a * d.b;

      d.e  = d.e * size;
      d.mm = d.mm * inverse_size;
      d.aa = d.aa * inverse_size;
      d.bb = d.bb * inverse_size;
      d.ma = d.ma * inverse_size;
      d.mb = d.mb * inverse_size;
      d.ab = d.ab * inverse_size;
      return d;
    }

    /// What tensile and equibiaxial tests measure: at 0, 45, 90 degrees and equibiaxial.
    struct Measured
    {
      std::vector<double> stress; ///< over that at 0 degrees
      std::vector<double> R;      ///< the last is strain across over strain along the rolling direction
    };

    using Vector8 = Eigen::Matrix<double, 8, 1>;

    /// Zero if the locus with these coefficients has the measured values.
    Vector8
    misfit(const Vector8 &alpha, const double exponent, const Measured &measured)
    {
      Alphas a;
      for (unsigned i = 0; i < 8; ++i)
        a[i] = alpha[i];
      const Yld2000 locus(a, exponent);
      Vector8       result;
      // The locus scales itself, so the first equation fixes the common factor of the coefficients.
      result[0] = alpha.sum() / 8 - 1;
      for (unsigned i = 0; i < 3; ++i)
        {
          const double c2 = 1 - 0.5 * i, s2 = 0.5 * i, cs = i == 1 ? 0.5 : 0.;
          Vector3      n;
          Matrix3      H;
          const double e     = locus.evaluate({ c2, s2, cs }, n, H);
          const double width = s2 * n[0] + c2 * n[1] - cs * n[2];
          if (i > 0)
            result[i] = measured.stress[i] * e - 1;
          result[4 + i] = width + measured.R[i] * (n[0] + n[1]);
        }
      Vector3      n;
      Matrix3      H;
      const double e = locus.evaluate({ 1, 1, 0 }, n, H);
      result[3]      = measured.stress[3] * e - 1;
      result[7]      = n[1] - measured.R[3] * n[0];
      return result;
    }

    /// Damped Newton from the isotropic locus. Returns the remaining misfit.
    double
    fit(const double exponent, const Measured &measured, Alphas &alphas)
    {
      const unsigned max_iterations = 100, max_halvings = 12;
      Vector8        alpha = Vector8::Ones(), r = misfit(alpha, exponent, measured);
      for (unsigned iteration = 0; iteration < max_iterations && r.norm() > 1e-13; ++iteration)
        {
          Eigen::Matrix<double, 8, 8> J;
          const double                h = 1e-6;
          for (unsigned j = 0; j < 8; ++j)
            {
              const Vector8 up = alpha + h * Vector8::Unit(j), down = alpha - h * Vector8::Unit(j);
              J.col(j) = (misfit(up, exponent, measured) - misfit(down, exponent, measured)) / (2 * h);
            }
          // Coefficients that the isotropic start does not feel (the equations are singular there): least change.
          const Vector8 step
              = J.fullPivLu().isInvertible()
                    ? Vector8(J.fullPivLu().solve(-r))
                    : Vector8(
                        (J.transpose() * J + 1e-6 * decltype(J)::Identity()).partialPivLu().solve(-J.transpose() * r));
          double size  = std::min(1., 0.5 / step.lpNorm<Eigen::Infinity>());
          bool   lower = false;
          for (unsigned i = 0; i < max_halvings && !lower; ++i, size *= 0.5)
            {
              const Vector8 next = misfit(alpha + size * step, exponent, measured);
              if ((lower = next.allFinite() && next.norm() < r.norm()))
                {
                  alpha += size * step;
                  r = next;
                }
            }
          if (!lower)
            break;
        }
      for (unsigned i = 0; i < 8; ++i)
        alphas[i] = alpha[i];
      return r.norm();
    }

    Measured
    read_measured(Parameters &parameters)
    {
      Measured data;
      data.stress = parameters.quantity_list(
          "Yield stresses", "", Range::positive().usual(0.5, 1.6),
          "Yield stress in tension at 0, 45, 90 degrees to the rolling direction and in equibiaxial tension, over that "
          "at 0 degrees (the first is 1).");
      data.R = parameters.quantity_list(
          "R values", "", Range::positive().usual(0.1, 5.),
          "R-values at 0, 45, 90 degrees and, last, strain across over strain along the rolling direction in "
          "equibiaxial tension.");
      const auto four = [&](const char *entry, const std::vector<double> &list) {
        if (!list.empty() && list.size() != 4 && !parameters.documentation_mode())
          parameters.problem(entry, std::to_string(list.size()) + " numbers were given",
                             "4 numbers, for 0, 45 and 90 degrees and equibiaxial tension");
        return list.size() == 4;
      };
      const bool good = four("Yield stresses", data.stress) && four("R values", data.R);
      if (good && !parameters.documentation_mode() && std::abs(data.stress[0] - 1) > 1e-12)
        parameters.problem("Yield stresses", "the first is " + std::to_string(data.stress[0]),
                           "1, because the flow stress is that of the rolling direction", "Divide all by the first.");
      if (!good)
        data.R.clear();
      return data;
    }

    Yld2000::Yld2000(Parameters &parameters)
    {
      const double exponent
          = parameters.quantity("Exponent", "", Range{ 2., 40. }.usual(4., 12.),
                                "Exponent M: 6 for body-centred (steel), 8 for face-centred cubic metals (aluminium).");
      const bool fitted
          = parameters.choice("Coefficients", { "given", "fitted" },
                              "The coefficients alpha are given, or fitted to measured yield stresses and R-values.")
            == "fitted";
      const bool documentation = parameters.documentation_mode();
      Alphas     alphas{ 1, 1, 1, 1, 1, 1, 1, 1 };
      if (!fitted || documentation)
        {
          const auto list = parameters.quantity_list(
              "Alpha", "", Range::positive().usual(0.1, 3.),
              "The eight coefficients alpha_1 to alpha_8. A common factor is changed so that "
              "the equivalent stress in rolling direction is the stress.");
          if (list.size() == 8)
            std::copy(list.begin(), list.end(), alphas.begin());
          else if (!list.empty() && !documentation)
            parameters.problem("Alpha", std::to_string(list.size()) + " numbers were given", "8 numbers");
        }
      else
        parameters.mark_unselected("Alpha");
      if (fitted || documentation)
        {
          const Measured measured = read_measured(parameters);
          if (!documentation && !measured.R.empty() && exponent > 0 && !parameters.has_problems())
            {
              const double rest = fit(exponent, measured, alphas);
              if (!(rest < 1e-9))
                parameters.problem(
                    "",
                    "no coefficients were found that give these yield stresses and R-values (misfit "
                        + std::to_string(rest) + ")",
                    "values that a sheet can have, as measured",
                    "Compare the entries with the data sheet; extreme R-values may need another exponent.");
            }
        }
      else
        for (const char *entry : { "Yield stresses", "R values" })
          parameters.mark_unselected(entry);
      if (exponent > 0)
        *this = Yld2000(alphas, exponent);
    }
  } // namespace

  TRIBODRAW_REGISTER(YieldLocus, Yld2000, "Yld2000-2d",
                     "Two linear transformations of the stress, eight coefficients given or fitted; for aluminium and "
                     "steel.",
                     "F. Barlat et al., Int. J. Plasticity 19 (2003) 1297-1319")
} // namespace tribodraw
