#ifndef tribodraw_flow_factors_row_kernels_h
#define tribodraw_flow_factors_row_kernels_h

namespace tribodraw::row_kernels
{
  // Loops over one row of n pixels. Rows have one more value before and after; kx[i] and ky[i] are the conductances of
  // the faces below pixel i, kx[i + 1] and ky_above[i] of those above. Sums run in eight partial sums in a fixed order.

  /// x = b * inverse where the colour is set, else 0.
  void relax_from_zero(int n, float *x, const float *b, const float *inverse, const float *colour);
  /// Solve the equations of the pixels of one colour.
  void relax(int n, float *x, const float *below, const float *above, const float *b, const float *kx, const float *ky,
             const float *ky_above, const float *inverse, const float *colour, float *spare);
  /// What the neighbours contribute to the pixels of one colour; 0 elsewhere.
  void from_neighbours(int n, float *r, const float *x, const float *below, const float *above, const float *kx,
                       const float *ky, const float *ky_above, const float *colour);
  /// w = r * weight where the colour is set, else 0.
  void scale(int n, float *w, const float *r, const float *weight, const float *colour);
  /// r = r * weight + w where the colour is set, else w.
  void scale_and_add(int n, float *r, const float *weight, const float *colour, const float *w);
  /// Add what the neighbours in the row give, w times conductance.
  void add_from_row(int n, float *r, const float *w, const float *kx);
  /// Add what the neighbours in the rows below and above give.
  void add_from_column(int n, float *r, const float *below, const float *above, const float *ky, const float *ky_above);
  /// e += weight * (sum of the neighbours in the row), where the colour is set; then x += e.
  void interpolate_in_row(int n, float *e, float *x, const float *kx, const float *weight, const float *colour,
                          float *spare);
  /// e += weight * (sum of the neighbours in the column).
  void   interpolate_in_column(int n, float *e, const float *below, const float *above, const float *ky,
                               const float *ky_above, const float *weight);
  double dot(int n, const float *b, const float *z);
  /// Sum of k (z - other)^2
  double energy(int n, const float *z, const float *other, const float *k);
  /// p = z + beta p
  void direct(int n, float *p, const float *z, float beta);
  /// x += alpha p, r -= alpha (matrix p), b = r; returns r times r
  double step(int n, double *x, double *r, float *b, const float *p, const float *below, const float *above,
              const double *kx, const double *ky, const double *ky_above, double alpha);
  /// Add k (p0 - p1 + c0 - c1); returns the squares of what was there before.
  double add_flux(int n, double *flux, const double *k, const double *p0, const double *p1, const double *c0,
                  const double *c1);
  /// What flows into each pixel more than out of it; returns the sum of squares.
  double excess(int n, double *e, const double *x_flux, const double *below, const double *above);
} // namespace tribodraw::row_kernels

#endif
