#ifndef tribodraw_base_sparse_system_h
#define tribodraw_base_sparse_system_h

#include <Eigen/Core>

#include <memory>
#include <utility>
#include <vector>

namespace tribodraw
{
  /// Square sparse matrix with a fixed pattern in compressed rows. In parallel each rank holds a part; the matrix is
  /// the sum of the parts.
  class SparseMatrix
  {
  public:
    SparseMatrix() = default;
    /// @param columns for each row the sorted column indices.
    explicit SparseMatrix(const std::vector<std::vector<int>> &columns);

    int    size() const { return static_cast<int>(start.size()) - 1; }
    void   set_zero();
    /// Position of entry (row, col) in values(); the entry must be in the pattern.
    std::size_t position(int row, int col) const;
    void        add(int row, int col, double v) { value[position(row, col)] += v; }
    /// Make the unknowns marked in @p fixed trivial: their rows and columns become zero, the diagonal @p diagonal
    /// (on the rank that should contribute it; pass 0 elsewhere).
    void eliminate(const std::vector<bool> &fixed, double diagonal);

    Eigen::VectorXd multiply(const Eigen::VectorXd &x) const; ///< with this rank's part only

    const std::vector<std::size_t> &row_start() const { return start; }
    const std::vector<int>         &columns() const { return column; }
    const std::vector<double>      &values() const { return value; }
    std::vector<double>            &values() { return value; }

  private:
    std::vector<std::size_t> start{0};
    std::vector<int>         column;
    std::vector<double>      value;
  };

  /// Sparse direct LU (unsymmetric) or LDL^T (symmetric) by MUMPS. The analysis is made once per pattern.
  class DirectSolver
  {
  public:
    enum class Symmetry { unsymmetric, symmetric };
    /// @param collective true: the matrix is the sum of all ranks' parts and every rank must call; false: this rank alone.
    explicit DirectSolver(Symmetry symmetry = Symmetry::unsymmetric, bool collective = true);
    ~DirectSolver();
    DirectSolver(const DirectSolver &)            = delete;
    DirectSolver &operator=(const DirectSolver &) = delete;

    /// Factorise. Returns false if the matrix is singular to working precision. Unknowns marked in @p trivial have been
    /// eliminated (SparseMatrix::eliminate): their cleared entries are left out of the pattern.
    bool factor(const SparseMatrix &matrix, const std::vector<bool> &trivial = {});
    /// Solve with the last factors; the right-hand side (whole, same on each rank) is replaced by the solution (on each rank).
    void solve(Eigen::VectorXd &b);
    /// Number of negative pivots of the last factorisation (symmetric only).
    int  n_negative_pivots() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };
} // namespace tribodraw

#endif
