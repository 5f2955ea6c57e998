#include <tribodraw/base/parallel.h>
#include <tribodraw/base/sparse_system.h>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <random>

using namespace tribodraw;

namespace
{
  std::vector<std::vector<int>>
  banded_pattern(const int n, const int width)
  {
    std::vector<std::vector<int>> columns(n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (std::abs(i - j) <= width || i == n - 1 || j == n - 1) // the last unknown couples with all
          columns[i].push_back(j);
    return columns;
  }

  /// Random entries, the same on each rank; symmetric on request. Diagonal entries of either sign.
  Eigen::MatrixXd
  random_matrix(const std::vector<std::vector<int>> &columns, const bool symmetric, const unsigned seed)
  {
    std::mt19937                     generator(seed);
    std::uniform_real_distribution<> uniform(-1, 1);
    const auto                       n = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd                  A = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (const int j : columns[i])
        A(i, j) = uniform(generator) + (i == j ? (i % 3 == 0 ? -6 : 6) : 0);
    if (symmetric)
      A = (0.5 * (A + A.transpose())).eval();
    return A;
  }

  /// The part of this rank: entry (i, j) belongs to rank (i + j) mod size; the last row is shared among all.
  SparseMatrix
  part_of(const Eigen::MatrixXd &A, const std::vector<std::vector<int>> &columns)
  {
    SparseMatrix part(columns);
    for (int i = 0; i < part.size(); ++i)
      for (const int j : columns[i])
        if (i + 1 == part.size())
          part.add(i, j, A(i, j) / parallel::size());
        else if ((i + j) % parallel::size() == parallel::rank())
          part.add(i, j, A(i, j));
    return part;
  }

  SparseMatrix
  whole(const Eigen::MatrixXd &A, const std::vector<std::vector<int>> &columns)
  {
    SparseMatrix matrix(columns);
    for (int i = 0; i < matrix.size(); ++i)
      for (const int j : columns[i])
        matrix.add(i, j, A(i, j));
    return matrix;
  }

  double
  error_against_dense(DirectSolver &solver, const Eigen::MatrixXd &A)
  {
    Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1, 2);
    // Origin of the expected values: dense LU of Eigen.
    const Eigen::VectorXd expected = A.fullPivLu().solve(b);
    solver.solve(b);
    return (b - expected).norm() / expected.norm();
  }
} // namespace

TEST(SparseMatrix, ProductAndEliminationAgreeWithDense)
{
  const auto            columns = banded_pattern(12, 2);
  const Eigen::MatrixXd A       = random_matrix(columns, false, 1);
  SparseMatrix          matrix  = whole(A, columns);
  const Eigen::VectorXd x       = Eigen::VectorXd::LinSpaced(12, 1, 3);
  EXPECT_LT((matrix.multiply(x) - A * x).norm(), 1e-13);

  std::vector<bool> fixed(12, false);
  fixed[3] = fixed[11]       = true;
  Eigen::MatrixXd eliminated = A; // rows and columns 3 and 11 become those of 5 I
  for (const int k : { 3, 11 })
    {
      eliminated.row(k).setZero();
      eliminated.col(k).setZero();
      eliminated(k, k) = 5;
    }
  matrix.eliminate(fixed, 5);
  EXPECT_LT((matrix.multiply(x) - eliminated * x).norm(), 1e-13);
  EXPECT_THROW(matrix.position(0, 8), std::logic_error);
}

TEST(DirectSolver, UnsymmetricAgreesWithDense)
{
  const auto   columns = banded_pattern(60, 3);
  DirectSolver solver(DirectSolver::Symmetry::unsymmetric);
  for (const unsigned seed : { 1, 2, 3 }) // the analysis of the first serves the others
    {
      const Eigen::MatrixXd A = random_matrix(columns, false, seed);
      ASSERT_TRUE(solver.factor(part_of(A, columns)));
      EXPECT_LT(error_against_dense(solver, A), 1e-12);
    }
}

TEST(DirectSolver, SymmetricAgreesWithDenseAndCountsNegativePivots)
{
  const auto   columns = banded_pattern(60, 3);
  DirectSolver solver(DirectSolver::Symmetry::symmetric);
  for (const unsigned seed : { 4, 5, 6 })
    {
      const Eigen::MatrixXd A = random_matrix(columns, true, seed);
      ASSERT_TRUE(solver.factor(part_of(A, columns)));
      EXPECT_LT(error_against_dense(solver, A), 1e-12);
      // Sylvester's law of inertia: as many as negative eigenvalues, which Eigen computes.
      const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues();
      const auto            negative    = (eigenvalues.array() < 0).count();
      ASSERT_GT(negative, 10);
      if (parallel::rank() == 0)
        {
          EXPECT_EQ(solver.n_negative_pivots(), negative);
        }
    }
}

TEST(DirectSolver, TakesAnotherPattern)
{
  DirectSolver solver;
  for (const int n : { 20, 31 })
    {
      const auto            columns = banded_pattern(n, 2);
      const Eigen::MatrixXd A       = random_matrix(columns, false, 7);
      ASSERT_TRUE(solver.factor(part_of(A, columns)));
      EXPECT_LT(error_against_dense(solver, A), 1e-12);
    }
}

TEST(DirectSolver, WorksOnOneRankAlone)
{
  const auto            columns = banded_pattern(25, 2);
  const Eigen::MatrixXd A       = random_matrix(columns, false, 8 + parallel::rank()); // another on each rank
  DirectSolver          solver(DirectSolver::Symmetry::unsymmetric, false);
  ASSERT_TRUE(solver.factor(whole(A, columns)));
  EXPECT_LT(error_against_dense(solver, A), 1e-12);
}

TEST(DirectSolver, ReportsSingularMatrices)
{
  // Stiffness of a chain of equal springs without support: a rigid motion costs nothing. Units far from one.
  const auto columns = banded_pattern(40, 1);
  for (const auto symmetry : { DirectSolver::Symmetry::symmetric, DirectSolver::Symmetry::unsymmetric })
    {
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(40, 40);
      for (int i = 0; i + 1 < 40; ++i)
        {
          const double k = 1.3e5 * (1 + 0.01 * i);
          A(i, i) += k;
          A(i + 1, i + 1) += k;
          A(i, i + 1) -= k;
          A(i + 1, i) -= k;
        }
      DirectSolver solver(symmetry);
      EXPECT_FALSE(solver.factor(part_of(A, columns)));
      Eigen::VectorXd b = Eigen::VectorXd::Ones(40);
      EXPECT_THROW(solver.solve(b), std::logic_error);
      A(0, 0) += 1.; // a weak support, 1e-5 of the springs
      EXPECT_TRUE(solver.factor(part_of(A, columns)));
    }
}
