#include "paper_material.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  /// 1/2 ln C by the spectral decomposition, as definition.
  Vector3
  spectral(const Vector3 &C)
  {
    Eigen::Matrix2d matrix;
    matrix << C[0], C[2], C[2], C[1];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(matrix);
    const Eigen::Matrix2d E = solver.eigenvectors() * (0.5 * solver.eigenvalues().array().log()).matrix().asDiagonal()
                              * solver.eigenvectors().transpose();
    return { E(0, 0), E(1, 1), 2 * E(0, 1) };
  }

  Vector3
  random_metric(std::mt19937 &generator, const double spread)
  {
    std::uniform_real_distribution<double> u(-1, 1);
    const double                           l1 = std::exp(spread * u(generator)), l2 = std::exp(spread * u(generator));
    const double                           a = 3 * u(generator), c = std::cos(a), s = std::sin(a);
    return { c * c * l1 + s * s * l2, s * s * l1 + c * c * l2, c * s * (l1 - l2) };
  }
} // namespace

TEST(LogarithmicStrain, equals_the_spectral_form)
{
  std::mt19937 generator(1);
  for (double spread : { 1e-9, 1e-4, 1e-2, 0.3, 1., 3. })
    for (int i = 0; i < 200; ++i)
      {
        const Vector3 C = random_metric(generator, spread);
        // Round-off of the logarithm near one is 1e-16; of the eigenvalues 1e-16 times their ratio.
        EXPECT_LT((LogarithmicStrain(C).strain() - spectral(C)).norm(), 1e-13) << C.transpose();
      }
}

TEST(LogarithmicStrain, derivatives)
{
  std::mt19937 generator(2);
  for (double spread : { 1e-9, 1e-3, 0.13, 0.15, 0.3, 1. })
    for (int i = 0; i < 200; ++i)
      {
        const Vector3           C = random_metric(generator, spread);
        const Vector3           T = 300 * paper::random_direction(generator);
        const LogarithmicStrain strain(C);
        const Matrix3           second = strain.second_derivative(T);
        for (int j = 0; j < 3; ++j)
          {
            const double            h = 1e-5 * std::min(C[0], C[1]);
            const LogarithmicStrain up(C + h * Vector3::Unit(j)), down(C - h * Vector3::Unit(j));
            const Vector3           first = (up.strain() - down.strain()) / (2 * h);
            EXPECT_LT((first - strain.derivative().col(j)).norm(), 2e-8 * strain.derivative().norm());
            const Vector3 change = (up.derivative() - down.derivative()).transpose() * T / (2 * h);
            EXPECT_LT((change - second.col(j)).norm(), 1e-7 * second.norm()) << C.transpose();
          }
        EXPECT_EQ((second - second.transpose()).norm(), 0.);
      }
}

// Series and closed form meet at (d^2+y^2)/p^2 = 0.02: no jump.
TEST(LogarithmicStrain, series_meets_closed_form)
{
  const double r = std::sqrt(0.02);
  for (double angle : { 0., 0.4, 1.9 })
    {
      const Vector3 direction(std::cos(angle), -std::cos(angle), std::sin(angle)), one(1, 1, 0), T(100, -30, 70);
      const LogarithmicStrain below(one + r * (1 - 1e-13) * direction), above(one + r * (1 + 1e-13) * direction);
      EXPECT_LT((below.strain() - above.strain()).norm(), 1e-12);
      EXPECT_LT((below.derivative() - above.derivative()).norm(), 2e-12);
      EXPECT_LT((below.second_derivative(T) - above.second_derivative(T)).norm(), 2e-9);
    }
}

TEST(LogarithmicStrain, pure_stretch_and_rejection)
{
  const LogarithmicStrain strain({ std::exp(0.4), std::exp(-0.2), 0 });
  EXPECT_NEAR(strain.strain()[0], 0.2, 1e-15);
  EXPECT_NEAR(strain.strain()[1], -0.1, 1e-15);
  EXPECT_NEAR(strain.derivative()(0, 0), 0.5 * std::exp(-0.4), 1e-15); // d(1/2 ln C11)/dC11
  EXPECT_FALSE(LogarithmicStrain({ 1, 1, 1 }).valid());
  EXPECT_FALSE(LogarithmicStrain({ -1, -1, 0 }).valid());
  EXPECT_FALSE(LogarithmicStrain({ std::nan(""), 1, 0 }).valid());
}
