#include "film_factors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tribodraw
{
  namespace
  {
    /// The diagonal is taken as pivot unless it is smaller than this part of the greatest entry of its column: films
    /// are nearly dominated by their diagonals, and the ordering then keeps its few entries.
    constexpr double diagonal_preference = 1e-3;
    /// Pivots that were good for other values may be bad for these: the residual, in parts of the terms of its row,
    /// tells.
    constexpr double largest_residual = 1e-13;
  } // namespace

  FilmFactors::FilmFactors()
  {
    klu_defaults(&common);
    common.btf   = 0;  // one block in general, and the ordering must serve all values
    common.scale = -1; // none
    common.tol   = diagonal_preference;
  }

  FilmFactors::~FilmFactors()
  {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }

  void
  FilmFactors::analyse(const SparseMatrix &matrix)
  {
    start.assign(matrix.row_start().begin(), matrix.row_start().end());
    column   = matrix.columns();
    symbolic = klu_analyze(matrix.size(), start.data(), column.data(), &common);
    if (symbolic == nullptr)
      throw std::runtime_error("KLU failed to order a film matrix, status " + std::to_string(common.status) + ".");
  }

  /// A pivot below this share of its column is round-off of a vanishing one: n eliminations leave some sqrt(n) times
  /// the machine precision.
  bool
  FilmFactors::is_regular(const double *values) const
  {
    const int     n     = symbolic->n;
    const double  limit = 20 * std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(n));
    const double *pivot = static_cast<const double *>(numeric->Udiag);
    for (int k = 0; k < n; ++k)
      {
        const int j        = symbolic->Q[k];
        double    greatest = 0;
        for (int i = start[j]; i < start[j + 1]; ++i)
          greatest = std::max(greatest, std::abs(values[i]));
        if (!(std::abs(pivot[k]) > limit * greatest))
          return false;
      }
    return true;
  }

  bool
  FilmFactors::factor_again(double *values)
  {
    return numeric != nullptr && klu_refactor(start.data(), column.data(), values, symbolic, numeric, &common) != 0
           && common.status == KLU_OK && is_regular(values);
  }

  bool
  FilmFactors::factor_anew(double *values)
  {
    klu_free_numeric(&numeric, &common);
    numeric = klu_factor(start.data(), column.data(), values, symbolic, &common);
    if (numeric == nullptr && common.status != KLU_SINGULAR)
      throw std::runtime_error("KLU failed to factorise a film matrix, status " + std::to_string(common.status) + ".");
    return numeric != nullptr && common.status == KLU_OK && is_regular(values);
  }

  bool
  FilmFactors::solve(const SparseMatrix &matrix, Eigen::VectorXd &b)
  {
    if (symbolic == nullptr)
      analyse(matrix);
    auto *const values = const_cast<double *>(matrix.values().data()); // KLU only reads them
    if (factor_again(values))
      {
        Eigen::VectorXd x = b;
        klu_tsolve(symbolic, numeric, symbolic->n, 1, x.data(), &common);
        double worst = 0;
        for (int i = 0; i < symbolic->n; ++i)
          {
            double residual = b[i], terms = std::abs(b[i]);
            for (int k = start[i]; k < start[i + 1]; ++k)
              {
                const double term = values[k] * x[column[k]];
                residual -= term;
                terms += std::abs(term);
              }
            worst = std::max(worst, std::isfinite(residual) ? std::abs(residual) / std::max(terms, 1e-300) : 1.);
          }
        if (worst < largest_residual)
          {
            b = x;
            return true;
          }
      }
    if (!factor_anew(values))
      return false;
    klu_tsolve(symbolic, numeric, symbolic->n, 1, b.data(), &common);
    return true;
  }
} // namespace tribodraw
