#include <tribodraw/lubrication/bounded_system.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

using tribodraw::BoundedSystem;

namespace
{
  // A fixed sequence of numbers in [-1, 1].
  struct Numbers
  {
    unsigned long state = 12345;
    double
    next()
    {
      state = (1103515245ul * state + 12345ul) % 2147483648ul;
      return 2. * static_cast<double>(state) / 2147483648. - 1.;
    }
  };
} // namespace

TEST(BoundedSystem, ComplementaryForAnyPositiveMatrix)
{
  // Positive definite, but far from an M-matrix and nearly singular (rank 5 plus 1e-4): the plain primal-dual active
  // set cycles on some of these matrices, so that the one-at-a-time steps are needed.
  unsigned largest_number_of_steps = 0;
  Numbers  random;
  for (int trial = 0; trial < 200; ++trial)
    {
      const int       n = 30;
      Eigen::MatrixXd A(5, n);
      for (int i = 0; i < 5 * n; ++i)
        A(i) = random.next();
      const Eigen::MatrixXd       dense = A.transpose() * A + 1e-4 * Eigen::MatrixXd::Identity(n, n);
      const BoundedSystem::Matrix K     = dense.sparseView();
      Eigen::VectorXd             f(n), upper(n), x = Eigen::VectorXd::Zero(n);
      for (int i = 0; i < n; ++i)
        {
          f[i]     = 10 * random.next();
          upper[i] = 0.5 + 0.4 * random.next();
        }
      std::vector<char> set(n, BoundedSystem::free);
      set[3] = BoundedSystem::prescribed;
      x[3]   = 0.7;
      BoundedSystem system;
      system.analyse(K);
      const auto result = system.solve(K, f, upper, set, x);
      ASSERT_TRUE(result.converged) << trial;
      largest_number_of_steps = std::max(largest_number_of_steps, result.iterations);
      EXPECT_EQ(result.x[3], 0.7);
      const Eigen::VectorXd r = f - dense * result.x;
      for (int i = 0; i < n; ++i)
        if (i != 3)
          {
            ASSERT_GE(result.x[i], 0.);
            ASSERT_LE(result.x[i], upper[i]);
            if (result.x[i] > 0)
              {
                ASSERT_GE(r[i], -1e-7) << trial;
              }
            if (result.x[i] < upper[i])
              {
                ASSERT_LE(r[i], 1e-7) << trial;
              }
          }
    }
  EXPECT_GT(largest_number_of_steps, 20u);
}

TEST(BoundedSystem, TwoUnknownsByHand)
{
  // K = [[2,-1],[-1,2]], f = (3, -4), 0 <= x <= 1: x0 = 1 (r0 = 1 > 0), x1 = 0 (r1 = -3 < 0).
  Eigen::MatrixXd K(2, 2);
  K << 2, -1, -1, 2;
  BoundedSystem               system;
  const BoundedSystem::Matrix sparse = K.sparseView();
  system.analyse(sparse);
  const auto result = system.solve(sparse, Eigen::Vector2d(3, -4), Eigen::Vector2d(1, 1),
                                   { BoundedSystem::free, BoundedSystem::free }, Eigen::Vector2d::Zero());
  EXPECT_EQ(result.x[0], 1.);
  EXPECT_EQ(result.x[1], 0.);
  EXPECT_DOUBLE_EQ(result.residual[0], 1.);
  EXPECT_DOUBLE_EQ(result.residual[1], -3.);
  EXPECT_EQ(result.set[0], BoundedSystem::at_upper);
  EXPECT_EQ(result.set[1], BoundedSystem::at_zero);
}
