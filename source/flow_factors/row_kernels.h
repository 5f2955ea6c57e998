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
  /// Add what the neighbours in the row give, w times conductance.
  void add_from_row(int n, float *r, const float *w, const float *kx);
  /// Add what the neighbours in the rows below and above give.
  void add_from_column(int n, float *r, const float *below, const float *above, const float *ky, const float *ky_above);
  /// e += weight * (sum of the neighbours in the row), where the colour is set.
  void interpolate_in_row(int n, float *e, const float *kx, const float *weight, const float *colour, float *spare);
  /// e += weight * (sum of the neighbours in the column).
  void   interpolate_in_column(int n, float *e, const float *below, const float *above, const float *ky,
                               const float *ky_above, const float *weight);
  void   add(int n, float *x, const float *e);
  double dot(int n, const double *r, const float *z);
  /// p = z + beta p
  void direct(int n, double *p, const float *z, double beta);
  /// p times the matrix times p
  double energy(int n, const double *p, const double *below, const double *above, const double *kx, const double *ky,
                const double *ky_above);
  /// x += alpha p, r -= alpha (matrix p), b = r; returns r times r
  double step(int n, double *x, double *r, float *b, const double *p, const double *below, const double *above,
              const double *kx, const double *ky, const double *ky_above, double alpha);
} // namespace tribodraw::row_kernels

#endif
