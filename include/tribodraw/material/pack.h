#ifndef tribodraw_material_pack_h
#define tribodraw_material_pack_h

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

/// Everything that a vectorised function calls must be inlined into it, or it would be compiled for another processor.
#define TRIBODRAW_INLINE __attribute__((always_inline))

namespace tribodraw
{
  /// Four numbers that are computed together: one register of AVX2, two of SSE2. Arithmetic and comparison work
  /// component by component. Laws are written once as templates over the type of number, double or Pack.
  struct alignas(32) PackMask
  {
    using Vector = std::int64_t __attribute__((vector_size(32)));
    Vector v;

    TRIBODRAW_INLINE PackMask
    operator!() const
    {
      return { ~v };
    }
    TRIBODRAW_INLINE friend PackMask
    operator&&(const PackMask &a, const PackMask &b)
    {
      return { a.v & b.v };
    }
    TRIBODRAW_INLINE friend PackMask
    operator||(const PackMask &a, const PackMask &b)
    {
      return { a.v | b.v };
    }
    TRIBODRAW_INLINE bool
    operator[](const unsigned i) const
    {
      return v[i] != 0;
    }
  };

  struct alignas(32) Pack
  {
    using Vector = double __attribute__((vector_size(32)));
    Vector v;

    Pack() = default;
    TRIBODRAW_INLINE
    Pack(const double x) : v{ x, x, x, x } {}
    TRIBODRAW_INLINE explicit Pack(const Vector &x) : v(x) {}

    TRIBODRAW_INLINE double &
    operator[](const unsigned i)
    {
      return reinterpret_cast<double *>(&v)[i];
    }
    TRIBODRAW_INLINE double
    operator[](const unsigned i) const
    {
      return v[i];
    }
    TRIBODRAW_INLINE Pack
    operator-() const
    {
      return Pack(-v);
    }
    TRIBODRAW_INLINE friend Pack
    operator+(const Pack &a, const Pack &b)
    {
      return Pack(a.v + b.v);
    }
    TRIBODRAW_INLINE friend Pack
    operator-(const Pack &a, const Pack &b)
    {
      return Pack(a.v - b.v);
    }
    TRIBODRAW_INLINE friend Pack
    operator*(const Pack &a, const Pack &b)
    {
      return Pack(a.v * b.v);
    }
    TRIBODRAW_INLINE friend Pack
    operator/(const Pack &a, const Pack &b)
    {
      return Pack(a.v / b.v);
    }
    TRIBODRAW_INLINE friend PackMask
    operator<(const Pack &a, const Pack &b)
    {
      return { a.v < b.v };
    }
    TRIBODRAW_INLINE friend PackMask
    operator>(const Pack &a, const Pack &b)
    {
      return { a.v > b.v };
    }
    TRIBODRAW_INLINE friend PackMask
    operator<=(const Pack &a, const Pack &b)
    {
      return { a.v <= b.v };
    }
    TRIBODRAW_INLINE friend PackMask
    operator>=(const Pack &a, const Pack &b)
    {
      return { a.v >= b.v };
    }
  };

  namespace pack
  {
    constexpr unsigned lanes = 4;

    /// The result of a comparison.
    template <class Number>
    struct MaskOf
    {
      using type = bool;
    };
    template <>
    struct MaskOf<Pack>
    {
      using type = PackMask;
    };
    template <class Number>
    using Mask = typename MaskOf<Number>::type;

    TRIBODRAW_INLINE inline double
    select(const bool mask, const double a, const double b)
    {
      return mask ? a : b;
    }
    TRIBODRAW_INLINE inline Pack
    select(const PackMask &mask, const Pack &a, const Pack &b)
    {
      return Pack(mask.v ? a.v : b.v);
    }
    TRIBODRAW_INLINE inline bool
    any(const bool mask)
    {
      return mask;
    }
    TRIBODRAW_INLINE inline bool
    any(const PackMask &mask)
    {
#if defined(__x86_64__)
      __m128d half[2];
      std::memcpy(half, &mask, sizeof mask);
      return _mm_movemask_pd(_mm_or_pd(half[0], half[1])) != 0;
#else
      return (mask.v[0] | mask.v[1] | mask.v[2] | mask.v[3]) != 0;
#endif
    }

    template <class Number>
    TRIBODRAW_INLINE inline Number
    max(const Number &a, const Number &b)
    {
      return select(a > b, a, b);
    }
    template <class Number>
    TRIBODRAW_INLINE inline Number
    min(const Number &a, const Number &b)
    {
      return select(a < b, a, b);
    }
    template <class Number>
    TRIBODRAW_INLINE inline Number
    abs(const Number &a)
    {
      return select(a < 0., -a, a);
    }

    TRIBODRAW_INLINE inline double
    sqrt(const double x)
    {
      return std::sqrt(x);
    }
    TRIBODRAW_INLINE inline Pack
    sqrt(const Pack &x)
    {
#if defined(__x86_64__)
      // By halves: these instructions are there on every processor.
      __m128d half[2];
      std::memcpy(half, &x, sizeof x);
      half[0] = _mm_sqrt_pd(half[0]);
      half[1] = _mm_sqrt_pd(half[1]);
      Pack root;
      std::memcpy(&root, half, sizeof x);
      return root;
#else
      return Pack{ std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3]) };
#endif
    }

    TRIBODRAW_INLINE inline double
    log(const double x)
    {
      return std::log(x);
    }
    TRIBODRAW_INLINE inline double
    exp(const double x)
    {
      return std::exp(x);
    }

    namespace detail
    {
      using Bits = std::uint64_t __attribute__((vector_size(32)));

      TRIBODRAW_INLINE inline Bits
      bits(const Pack &x)
      {
        Bits b;
        std::memcpy(&b, &x.v, sizeof b);
        return b;
      }
      TRIBODRAW_INLINE inline Pack
      from_bits(const Bits &b)
      {
        Pack x;
        std::memcpy(&x.v, &b, sizeof b);
        return x;
      }
      constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    } // namespace detail

    /// Natural logarithm of normal positive numbers, to 2 units in the last place: x = 2^k f with f in [1/sqrt 2, sqrt
    /// 2), ln f = 2 atanh(z), z = (f-1)/(f+1).
    TRIBODRAW_INLINE inline Pack
    log(const Pack &x)
    {
      // Offset such that the exponent steps at 1/sqrt(2).
      const std::uint64_t root_half = 0x3FE6A09E667F3BCD, one = std::uint64_t(1023) << 52;
      const detail::Bits  exponent = (detail::bits(x) - root_half + one) >> 52;
      // The biased exponent in the low bits of 2^52 reads as 2^52 + exponent.
      const Pack k = detail::from_bits(exponent | std::uint64_t(0x4330000000000000)) - (4503599627370496. + 1023.);
      const Pack f = detail::from_bits(detail::bits(x) - (exponent << 52) + one);
      const Pack z = (f - 1.) / (f + 1.);
      const Pack w = z * z, w2 = w * w, w4 = w2 * w2;
      const Pack p0 = 1. / 3 + w * (1. / 5), p1 = 1. / 7 + w * (1. / 9), p2 = 1. / 11 + w * (1. / 13);
      const Pack p3 = 1. / 15 + w * (1. / 17), p4 = 1. / 19 + w * (1. / 21) + w2 * (1. / 23);
      const Pack series = (p0 + w2 * p1) + w4 * ((p2 + w2 * p3) + w4 * p4);
      return k * detail::ln2_high + (k * detail::ln2_low + 2. * z * w * series + 2. * z);
    }

    /// Exponential function to 2 units in the last place; the argument is limited to [-700, 700].
    TRIBODRAW_INLINE inline Pack
    exp(const Pack &argument)
    {
      const Pack   x       = max(Pack(-700.), min(Pack(700.), argument));
      const double big     = 6755399441055744.; // 1.5 2^52: adding it rounds to an integer
      const Pack   shifted = x * 1.44269504088896340736 + big;
      const Pack   k       = shifted - big;
      const Pack   r       = (x - k * detail::ln2_high) - k * detail::ln2_low;
      const Pack   r2 = r * r, r4 = r2 * r2;
      const Pack   p0 = 1. / 2 + r * (1. / 6), p1 = 1. / 24 + r * (1. / 120);
      const Pack   p2 = 1. / 720 + r * (1. / 5040), p3 = 1. / 40320 + r * (1. / 362880);
      const Pack   p4 = 1. / 3628800 + r * (1. / 39916800), p5 = 1. / 479001600 + r * (1. / 6227020800.);
      const Pack   series = (p0 + r2 * p1) + r4 * ((p2 + r2 * p3) + r4 * (p4 + r2 * p5));
      return (1. + (r + r2 * series)) * detail::from_bits((detail::bits(shifted) + 1023) << 52);
    }

    /// x^y for positive x.
    template <class Number>
    TRIBODRAW_INLINE inline Number
    pow(const Number &x, const double y)
    {
      return pack::exp(Number(y * pack::log(x)));
    }

#if defined(__x86_64__)
    /// Whether vectorised() uses AVX2 and FMA. Tests clear it to run the SSE2 code on any processor; never to be
    /// changed while another thread computes.
    inline bool use_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");

    template <class Body>
    __attribute__((target("avx2,fma"))) inline void
    run_avx2(const Body &body)
    {
      body();
    }
#endif

    /// Run @p body (a lambda `[&]() TRIBODRAW_INLINE {...}`) compiled for the best instructions of this processor.
    template <class Body>
    inline void
    vectorised(const Body &body)
    {
#if defined(__x86_64__)
      if (use_avx2)
        {
          run_avx2(body);
          return;
        }
#endif
      body();
    }
  } // namespace pack
} // namespace tribodraw

#endif
