#ifndef tribodraw_source_lubrication_film_factors_h
#define tribodraw_source_lubrication_film_factors_h

#include <tribodraw/base/sparse_system.h>

#include <klu.h>

namespace tribodraw
{
  /// Sparse direct LU of one pattern after the other set of values (KLU of SuiteSparse): a film on a blank has some
  /// thousand unknowns and is solved several times an increment with slightly different matrices. On one rank.
  class FilmFactors
  {
  public:
    FilmFactors();
    ~FilmFactors();
    FilmFactors(const FilmFactors &)            = delete;
    FilmFactors &operator=(const FilmFactors &) = delete;

    /// Factorise; the pattern must be that of the first call. The pivots of the last factors are tried first. Returns
    /// false if the matrix is singular to working precision.
    bool factor(const SparseMatrix &matrix);
    /// Solve with the last factors; @p b becomes the solution.
    void solve(Eigen::VectorXd &b);

  private:
    klu_common       common;
    klu_symbolic    *symbolic = nullptr;
    klu_numeric     *numeric  = nullptr;
    std::vector<int> start, column; // of the rows: the columns of the transpose, which is what is factorised

    bool find_pivots(double *values);
    bool is_regular(const std::vector<double> &values) const;
    void analyse(const SparseMatrix &matrix);
  };
} // namespace tribodraw

#endif
