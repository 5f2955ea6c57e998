#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/johnson_curve.h>

#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    double
    normal_probability(double x)
    {
      return 0.5 * std::erfc(-x / std::sqrt(2.));
    }

    /// Root of an increasing function between two values, to 2^-48 of their distance.
    template <class Function>
    double
    bisect(double low, double high, const Function &f)
    {
      for (int i = 0; i < 48; ++i)
        {
          const double middle           = 0.5 * (low + high);
          (f(middle) < 0. ? low : high) = middle;
        }
      return 0.5 * (low + high);
    }

    constexpr unsigned n_hermite = 60;
    /// Curves of smaller delta are steps (bounded) or have all weight in single points (unbounded).
    constexpr double smallest_bounded = 0.03, smallest_unbounded = 0.4, largest_delta = 200.;
  } // namespace

  double
  normal_quantile(double p)
  {
    return -std::sqrt(2.) * boost::math::erfc_inv(2. * p);
  }

  JohnsonCurve::JohnsonCurve(double skewness, double kurtosis, std::size_t points)
  {
    if (!(kurtosis >= skewness * skewness + 1.))
      throw InputError(describe_error("no height distribution has this skewness and kurtosis.", "",
                                      "Ssk " + units::number(skewness) + ", Sku " + units::number(kurtosis),
                                      "Sku of at least Ssk^2 + 1 = " + units::number(skewness * skewness + 1.)));
    // The outermost values one by one, the others in narrow classes.
    const std::size_t tail = std::min<std::size_t>(500, points / 4);
    const auto        n    = static_cast<double>(points);
    for (std::size_t i = 0; i < tail; ++i)
      {
        const double g = normal_quantile((static_cast<double>(i) + 0.5) / n);
        for (const double s : { 1., -1. })
          {
            nodes.push_back(s * g);
            weights.push_back(1. / n);
          }
      }
    constexpr int classes = 800;
    const double  end     = -normal_quantile(static_cast<double>(tail) / n);
    for (int i = 0; i < classes; ++i)
      {
        const double a = end * (2. * i / classes - 1.), b = end * (2. * (i + 1) / classes - 1.);
        nodes.push_back(0.5 * (a + b));
        weights.push_back(normal_probability(b) - normal_probability(a));
      }

    const double magnitude = std::abs(skewness);
    find_log_normal(magnitude);
    const double on_line = moments().kurtosis;
    if (std::abs(kurtosis - on_line) > 1e-6 * on_line)
      {
        family = kurtosis > on_line ? Family::unbounded : Family::bounded;
        match_kurtosis(magnitude, kurtosis);
      }
    const Moments m = moments();
    if (!(std::abs(m.skewness - magnitude) < 1e-6 && std::abs(m.kurtosis - kurtosis) < 1e-4 * kurtosis))
      throw InputError(describe_error("this skewness and kurtosis cannot be generated with that many pixels.", "",
                                      "Ssk " + units::number(skewness) + ", Sku " + units::number(kurtosis),
                                      "nearer to the values 0 and 3 of Gaussian heights"));
    mean      = m.mean;
    deviation = m.deviation;
    sign      = skewness < 0. ? -1. : 1.;
    expand();
  }

  /// The function up to scale and offset, which are chosen so that it stays within the range of numbers for any shift.
  double
  JohnsonCurve::raw(double g) const
  {
    if (family == Family::bounded) // exp(shift / delta) / (1 + exp(-u))
      return 1. / (std::exp(-g / delta) + std::exp(-shift / delta));
    const double rise = std::exp(g / delta);
    if (family == Family::log_normal)
      return delta >= largest_delta ? g : rise;
    return rise - std::exp(-(g - 2. * shift) / delta); // 2 exp(shift / delta) sinh(u)
  }

  JohnsonCurve::Moments
  JohnsonCurve::moments() const
  {
    std::vector<double> values(nodes.size());
    double              total = 0.;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        values[i] = raw(nodes[i]);
        total += weights[i] * values[i];
      }
    double m2 = 0., m3 = 0., m4 = 0.;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const double d = values[i] - total, w = weights[i] * d * d;
        m2 += w;
        m3 += w * d;
        m4 += w * d * d;
      }
    return { total, std::sqrt(m2), m3 / (m2 * std::sqrt(m2)), m4 / (m2 * m2) };
  }

  void
  JohnsonCurve::find_log_normal(double skewness)
  {
    family = Family::log_normal;
    shift  = 0.;
    // The skewness falls with delta; at largest_delta the curve is the normal distribution itself.
    delta = std::exp(bisect(std::log(0.15), std::log(largest_delta), [&](double x) {
      delta = std::exp(x);
      return skewness - moments().skewness;
    }));
    if (skewness == 0.)
      delta = largest_delta;
  }

  void
  JohnsonCurve::match_skewness(double skewness)
  {
    const double furthest = 6. + 20. * delta; // practically log-normal
    // sinh is skew if its centre lies below the variable, the bounded curve if its step lies above
    const double direction = family == Family::unbounded ? -1. : 1.;
    const double distance  = bisect(0., furthest, [&](double x) {
      shift = direction * x;
      return moments().skewness - skewness;
    });
    shift                  = direction * (skewness == 0. ? 0. : distance);
  }

  void
  JohnsonCurve::match_kurtosis(double skewness, double kurtosis)
  {
    // Away from the log-normal line (the largest delta that still has the skewness) towards smaller delta.
    const bool   unbounded = family == Family::unbounded;
    const double smallest  = unbounded ? smallest_unbounded : smallest_bounded,
                 line      = std::min(delta, 0.999 * largest_delta);
    delta                  = std::exp(bisect(std::log(smallest), std::log(std::max(line, smallest)), [&](double x) {
      delta = std::exp(x);
      match_skewness(skewness);
      const double excess = moments().kurtosis - kurtosis;
      return unbounded ? -excess : excess;
    }));
    match_skewness(skewness);
  }

  void
  JohnsonCurve::expand()
  {
    // c_k = sum of w f(g) He_k(g) / sqrt(k!), by the recurrence of the normalised polynomials
    // sqrt(k + 1) h_{k+1} = g h_k - sqrt(k) h_{k-1}.
    hermite_squares.assign(n_hermite + 2, 0.);
    std::vector<double> c(n_hermite + 1, 0.);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const double g = nodes[i], f = weights[i] * (*this)(g);
        double       before = 0., here = 1.;
        for (unsigned k = 0; k <= n_hermite; ++k)
          {
            c[k] += f * here;
            const double next = (g * here - std::sqrt(static_cast<double>(k)) * before) / std::sqrt(k + 1.);
            before            = here;
            here              = next;
          }
      }
    double sum = 0.;
    for (unsigned k = 1; k <= n_hermite && sum < 1.; ++k)
      {
        hermite_squares[k] = std::min(c[k] * c[k], 1. - sum);
        sum += hermite_squares[k];
      }
    hermite_squares[n_hermite + 1] = 1. - sum; // what higher terms contribute, at the first of them

    constexpr std::size_t n = 4096;
    inverse.resize(n + 1);
    for (std::size_t i = 0; i <= n; ++i)
      inverse[i] = bisect(0., 1., [&](double rho) { return correlation(rho) - static_cast<double>(i) / n; });
    inverse.front() = 0.;
    inverse.back()  = 1.;
  }

  double
  JohnsonCurve::operator()(double g) const
  {
    return sign * (raw(sign * g) - mean) / deviation;
  }

  double
  JohnsonCurve::correlation(double rho) const
  {
    double sum = 0.;
    for (std::size_t k = hermite_squares.size(); k-- > 0;)
      sum = sum * rho + hermite_squares[k];
    return sum;
  }

  double
  JohnsonCurve::normal_correlation(double rho) const
  {
    const double      at = std::clamp(rho, 0., 1.) * static_cast<double>(inverse.size() - 1);
    const std::size_t k  = std::min(static_cast<std::size_t>(at), inverse.size() - 2);
    const double      t  = at - static_cast<double>(k);
    return (1. - t) * inverse[k] + t * inverse[k + 1];
  }
} // namespace tribodraw
