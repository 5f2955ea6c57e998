#include "row_kernels.h"

// One version of each loop for every common width of vector registers; the program chooses at its start. The
// resolvers run before a sanitizer is ready.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define TRIBODRAW_VECTORISED __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define TRIBODRAW_VECTORISED
#endif

namespace tribodraw::row_kernels
{
  namespace
  {
    constexpr int n_sums = 8;

    inline double
    total(const double *s)
    {
      return ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]));
    }

    // Matrix times p in pixel i, formed from differences.
    inline __attribute__((always_inline)) double
    image(const int i, const float *p, const float *below, const float *above, const double *kx, const double *ky,
          const double *ky_above)
    {
      const double here = p[i];
      return (kx[i] * (here - p[i - 1]) + kx[i + 1] * (here - p[i + 1]))
             + (ky[i] * (here - below[i]) + ky_above[i] * (here - above[i]));
    }
  } // namespace

  TRIBODRAW_VECTORISED void
  relax_from_zero(const int n, float *x, const float *b, const float *inverse, const float *colour)
  {
    for (int i = 0; i < n; ++i)
      x[i] = colour[i] * (b[i] * inverse[i]);
  }

  TRIBODRAW_VECTORISED void
  relax(const int n, float *__restrict x, const float *below, const float *above, const float *b, const float *kx,
        const float *ky, const float *ky_above, const float *inverse, const float *colour, float *__restrict spare)
  {
    // Two loops: a vector just written cannot be read back shifted by one pixel without delay.
    for (int i = 0; i < n; ++i)
      spare[i] = ((b[i] + kx[i] * x[i - 1]) + kx[i + 1] * x[i + 1] + (ky[i] * below[i] + ky_above[i] * above[i]))
                 * inverse[i];
    for (int i = 0; i < n; ++i)
      x[i] += colour[i] * (spare[i] - x[i]);
  }

  TRIBODRAW_VECTORISED void
  from_neighbours(const int n, float *r, const float *x, const float *below, const float *above, const float *kx,
                  const float *ky, const float *ky_above, const float *colour)
  {
    for (int i = 0; i < n; ++i)
      {
        const float s = (kx[i] * x[i - 1] + kx[i + 1] * x[i + 1]) + (ky[i] * below[i] + ky_above[i] * above[i]);
        r[i]          = colour[i] * s;
      }
  }

  TRIBODRAW_VECTORISED void
  scale(const int n, float *__restrict w, const float *r, const float *weight, const float *colour)
  {
    for (int i = 0; i < n; ++i)
      w[i] = colour[i] * (r[i] * weight[i]);
  }

  TRIBODRAW_VECTORISED void
  scale_and_add(const int n, float *__restrict r, const float *weight, const float *colour, const float *w)
  {
    for (int i = 0; i < n; ++i)
      r[i] = colour[i] * (r[i] * weight[i]) + w[i];
  }

  TRIBODRAW_VECTORISED void
  add_from_row(const int n, float *r, const float *w, const float *kx)
  {
    for (int i = 0; i < n; ++i)
      r[i] += kx[i] * w[i - 1] + kx[i + 1] * w[i + 1];
  }

  TRIBODRAW_VECTORISED void
  add_from_column(const int n, float *r, const float *below, const float *above, const float *ky, const float *ky_above)
  {
    for (int i = 0; i < n; ++i)
      r[i] += ky[i] * below[i] + ky_above[i] * above[i];
  }

  TRIBODRAW_VECTORISED void
  interpolate_in_row(const int n, float *__restrict e, float *__restrict x, const float *kx, const float *weight,
                     const float *colour, float *__restrict spare)
  {
    for (int i = 0; i < n; ++i)
      spare[i] = colour[i] * weight[i] * (kx[i] * e[i - 1] + kx[i + 1] * e[i + 1]);
    for (int i = 0; i < n; ++i)
      {
        e[i] += spare[i];
        x[i] += e[i];
      }
  }

  TRIBODRAW_VECTORISED void
  interpolate_in_column(const int n, float *e, const float *below, const float *above, const float *ky,
                        const float *ky_above, const float *weight)
  {
    for (int i = 0; i < n; ++i)
      e[i] += weight[i] * (ky[i] * below[i] + ky_above[i] * above[i]);
  }

  TRIBODRAW_VECTORISED double
  dot(const int n, const float *b, const float *z)
  {
    double sum[n_sums] = {};
    int    i           = 0;
    for (; i + n_sums <= n; i += n_sums)
      for (int l = 0; l < n_sums; ++l)
        sum[l] += static_cast<double>(b[i + l]) * z[i + l];
    for (; i < n; ++i)
      sum[0] += static_cast<double>(b[i]) * z[i];
    return total(sum);
  }

  TRIBODRAW_VECTORISED double
  energy(const int n, const float *z, const float *other, const float *k)
  {
    double sum[n_sums] = {};
    int    i           = 0;
    for (; i + n_sums <= n; i += n_sums)
      for (int l = 0; l < n_sums; ++l)
        {
          const double difference = static_cast<double>(z[i + l]) - other[i + l];
          sum[l] += k[i + l] * difference * difference;
        }
    for (; i < n; ++i)
      {
        const double difference = static_cast<double>(z[i]) - other[i];
        sum[0] += k[i] * difference * difference;
      }
    return total(sum);
  }

  TRIBODRAW_VECTORISED void
  direct(const int n, float *p, const float *z, const float beta)
  {
    for (int i = 0; i < n; ++i)
      p[i] = z[i] + beta * p[i];
  }

  TRIBODRAW_VECTORISED double
  step(const int n, double *__restrict x, double *__restrict r, float *__restrict b, const float *p, const float *below,
       const float *above, const double *kx, const double *ky, const double *ky_above, const double alpha)
  {
    double sum[n_sums] = {};
    int    i           = 0;
    for (; i + n_sums <= n; i += n_sums)
      for (int l = 0; l < n_sums; ++l)
        {
          x[i + l] += alpha * p[i + l];
          const double v = r[i + l] - alpha * image(i + l, p, below, above, kx, ky, ky_above);
          r[i + l]       = v;
          b[i + l]       = static_cast<float>(v);
          sum[l] += v * v;
        }
    for (; i < n; ++i)
      {
        x[i] += alpha * p[i];
        r[i] -= alpha * image(i, p, below, above, kx, ky, ky_above);
        b[i] = static_cast<float>(r[i]);
        sum[0] += r[i] * r[i];
      }
    return total(sum);
  }

  TRIBODRAW_VECTORISED double
  add_flux(const int n, double *__restrict flux, const double *k, const double *p0, const double *p1, const double *c0,
           const double *c1)
  {
    double sum[n_sums] = {};
    int    i           = 0;
    for (; i + n_sums <= n; i += n_sums)
      for (int l = 0; l < n_sums; ++l)
        {
          const int    j = i + l;
          const double f = flux[j];
          flux[j]        = f + k[j] * ((p0[j] - p1[j]) + (c0[j] - c1[j]));
          sum[l] += f * f;
        }
    for (; i < n; ++i)
      {
        sum[0] += flux[i] * flux[i];
        flux[i] += k[i] * ((p0[i] - p1[i]) + (c0[i] - c1[i]));
      }
    return total(sum);
  }

  TRIBODRAW_VECTORISED double
  excess(const int n, double *__restrict e, const double *x_flux, const double *below, const double *above)
  {
    double sum[n_sums] = {};
    int    i           = 0;
    for (; i + n_sums <= n; i += n_sums)
      for (int l = 0; l < n_sums; ++l)
        {
          const int j = i + l;
          e[j]        = (x_flux[j] - x_flux[j + 1]) + (below[j] - above[j]);
          sum[l] += e[j] * e[j];
        }
    for (; i < n; ++i)
      {
        e[i] = (x_flux[i] - x_flux[i + 1]) + (below[i] - above[i]);
        sum[0] += e[i] * e[i];
      }
    return total(sum);
  }
} // namespace tribodraw::row_kernels
