#ifndef tribodraw_source_lubrication_film_factors_h
#define tribodraw_source_lubrication_film_factors_h

#include <tribodraw/base/sparse_system.h>

#include <klu.h>

#include <vector>

namespace tribodraw
{
  /// Sparse direct solution of systems of one pattern (KLU of SuiteSparse): a film on a blank has some thousand
  /// unknowns and is solved several times an increment with slightly different matrices. On one rank.
  class FilmFactors
  {
  public:
    FilmFactors();
    ~FilmFactors();
    FilmFactors(const FilmFactors &)            = delete;
    FilmFactors &operator=(const FilmFactors &) = delete;

    /// @p b becomes the solution. The pattern must be that of the first call. Returns false if the matrix is singular
    /// to working precision; then @p b is as it was.
    bool solve(const SparseMatrix &matrix, Eigen::VectorXd &b);

  private:
    klu_common       common;
    klu_symbolic    *symbolic = nullptr;
    klu_numeric     *numeric  = nullptr;
    std::vector<int> start, column; // of the rows: the columns of the transpose, which is what is factorised

    void analyse(const SparseMatrix &matrix);
    /// With the pivots of the last factors.
    bool factor_again(double *values);
    bool factor_anew(double *values);
    bool is_regular(const double *values) const;
  };
} // namespace tribodraw

#endif
