#include "paper_material.h"

#include <tribodraw/base/errors.h>

#include "claims.h"
#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  Vector3
  uniaxial(const double degrees)
  {
    const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
    return { c * c, s * s, c * s };
  }

  /// Width over thickness strain rate in tension along @p degrees.
  double
  r_value(const Vector3 &n, const double degrees)
  {
    const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
    const double width = n[0] * s * s + n[1] * c * c - n[2] * s * c;
    return width / -(n[0] + n[1]);
  }

  struct Reference
  {
    Vector3 stress;
    double  value;
  };

  void
  expect_derivatives(const YieldLocus &locus, const int n_states, const double tolerance)
  {
    std::mt19937 generator(1);
    for (int i = 0; i < n_states; ++i)
      {
        const Vector3 s = 300. * paper::random_direction(generator);
        Vector3       n, n_up, n_down;
        Matrix3       H, unused;
        const double  e = locus.evaluate(s, n, H);
        ASSERT_NEAR(locus.equivalent_stress(s), e, 1e-12 * e);
        ASSERT_NEAR(n.dot(s), e, 1e-11 * e) << s.transpose();    // Euler, degree 1
        ASSERT_LT((H * s).norm(), 1e-10) << s.transpose();       // Euler, degree 0 of the gradient
        ASSERT_LT((H - H.transpose()).norm(), 1e-15 * H.norm()); // symmetric
        ASSERT_EQ(locus.evaluate(-s, n_up, unused), e);          // tension and compression alike
        ASSERT_EQ((n_up + n).norm(), 0.);
        // Central differences: truncation h^2 f'''/6 ~ 1e-10 f''' and round-off 1e-16/1e-5.
        const double h = 1e-5 * 300;
        for (int j = 0; j < 3; ++j)
          {
            const Vector3 d    = h * Vector3::Unit(j);
            const double  up   = locus.evaluate(s + d, n_up, unused);
            const double  down = locus.evaluate(s - d, n_down, unused);
            ASSERT_NEAR((up - down) / (2 * h), n[j], tolerance) << s.transpose();
            // At the joints of the Bezier curves the second derivative jumps: there one side must fit.
            Vector3       one_sided;
            const Vector3 central = (n_up - n_down) / (2 * h) * 300;
            double        error   = (central - H.col(j) * 300).norm();
            if (error > tolerance)
              error = std::min(((n_up - n) / h * 300 - H.col(j) * 300).norm(),
                               ((n - n_down) / h * 300 - H.col(j) * 300).norm())
                      / 100;
            ASSERT_LT(error, tolerance) << s.transpose() << " component " << j;
          }
      }
  }
} // namespace

// The regression values of the reference below have 8 digits; hinge points interpolated in coordinates.
// Origin: independent script for the construction of Vegter and van den Boogaard (2006) with Table 2 of Shisode et al.
TEST(Vegter, equivalent_stress_of_the_interpolated_construction)
{
  const auto      locus       = paper::locus("Vegter interpolated");
  const Reference reference[] = { { { 1, 0, 0 }, 1. },
                                  { { 0, 1, 0 }, 1.01163379 },
                                  { { 0, 0, 1 }, 1.78141979 },
                                  { { 1, -1, 0 }, 1.84626246 },
                                  { { 1, 1, 0 }, 0.88339223 },
                                  { { 1, .5, 0 }, 0.80622320 },
                                  { { .5, 1, 0 }, 0.79712384 },
                                  { { 1, .3, .2 }, 0.91646191 },
                                  { { -.4, .7, -.25 }, 1.11558721 },
                                  { { .8, .75, .05 }, 0.69593237 } };
  for (const auto &r : reference)
    EXPECT_TRUE(claims::agrees(
        claims::with(claims::with("Vegter, equivalent stress at", r.stress[0]) + ",", r.stress[1]),
        "independent script with Table 2 of Shisode et al. 2021", locus->equivalent_stress(r.stress), r.value, 1e-8))
        << r.stress.transpose();
  Vector3 n;
  Matrix3 H;
  locus->evaluate({ 1, 0, 0 }, n, H);
  EXPECT_LT((n - Vector3(1, -.65831474, 0)).norm(), 1e-8); // -R0/(1+R0)
  locus->evaluate({ 1, .3, .2 }, n, H);
  EXPECT_LT((n - Vector3(.878713, -.305998, .647744)).norm(), 1e-6);
}

// Along the test angles both constructions are the same, so the same reference values hold.
TEST(Vegter, equivalent_stress_along_the_test_angles)
{
  const auto      locus = paper::locus("Vegter");
  const Reference reference[]
      = { { { 1, 0, 0 }, 1. },          { { 0, 1, 0 }, 1.01163379 }, { { 0, 0, 1 }, 1.78141979 },
          { { 1, -1, 0 }, 1.84626246 }, { { 1, 1, 0 }, 0.88339223 }, { { 1, .5, 0 }, 0.80622320 },
          { { .5, 1, 0 }, 0.79712384 } };
  for (const auto &r : reference)
    EXPECT_NEAR(locus->equivalent_stress(r.stress), r.value, 1e-8) << r.stress.transpose();
  // Yield multipliers (stress on the locus), six digits; the same independent construction.
  const Reference multiplier[] = { { { 1, 1, 0 }, 1.132 },      { { 1, .5, 0 }, 1.240351 },  { { .5, 1, 0 }, 1.254510 },
                                   { { 1, .75, 0 }, 1.231562 }, { { 1, .25, 0 }, 1.153605 }, { { 1, -1, 0 }, .541635 },
                                   { { 0, 0, 1 }, .561350 },    { { 1, -.5, 0 }, .716664 } };
  for (const auto &r : multiplier)
    EXPECT_NEAR(1 / locus->equivalent_stress(r.stress), r.value, 1e-6) << r.stress.transpose();
  EXPECT_NEAR(1 / paper::locus("Vegter interpolated")->equivalent_stress({ 1, .5, .3 }), 1.042285, 1e-6);
}

// Hinge points are not visible outside, but the locus must pass through the reference points with their normals:
// the measured factors and R-values of Table 2 themselves.
TEST(Vegter, passes_through_the_measured_points_with_their_normals)
{
  const double R[] = { 1.92667, 1.49433, 2.21133 }, f_un[] = { 1, 1.0310, .9885 }, f_ps[] = { 1.248, 1.2401, 1.265 };
  for (const char *name : { "Vegter", "Vegter interpolated" })
    {
      const auto locus = paper::locus(name);
      Vector3    n;
      Matrix3    H;
      for (int j = 0; j < 3; ++j)
        {
          EXPECT_NEAR(locus->evaluate(f_un[j] * uniaxial(45. * j), n, H), 1, 1e-14);
          EXPECT_NEAR(r_value(n, 45. * j), R[j], 1e-12);
        }
      // Plane strain points, second coordinate from the independent construction (8 digits).
      EXPECT_NEAR(locus->evaluate({ f_ps[0], .75204668, 0 }, n, H), 1, 1e-8);
      EXPECT_NEAR(n[1], 0, 1e-7);
      EXPECT_NEAR(locus->evaluate({ .77315423, f_ps[2], 0 }, n, H), 1, 1e-8);
      EXPECT_NEAR(n[0], 0, 1e-7);
      // Equibiaxial: strain ratio 0.8988.
      EXPECT_NEAR(locus->evaluate({ 1.132, 1.132, 0 }, n, H), 1, 1e-14);
      EXPECT_NEAR(n[1] / n[0], .8988, 1e-7);
      EXPECT_NEAR(n[2], 0, 1e-7);
    }
}

TEST(Vegter, uniaxial_factors_and_r_values_between_the_test_angles)
{
  // Uniaxial factor: cosine interpolation, the same in both constructions; reference with six digits. R-value: the
  // reference is the mean of the two sides of the kink that interpolated hinge points have.
  const double angle[]  = { 15, 22.5, 30, 60, 67.5, 75 },
               factor[] = { 1.008417, 1.016691, 1.024688, 1.018938, 1.008559, .998458 },
               R[]      = { 1.79369, 1.66966, 1.55782, 1.70419, 1.87467, 2.04246 };
  const auto tangent = paper::locus("Vegter"), interpolated = paper::locus("Vegter interpolated");
  for (int i = 0; i < 6; ++i)
    {
      Vector3 n, n1, n2;
      Matrix3 H;
      EXPECT_NEAR(1 / tangent->evaluate(uniaxial(angle[i]), n, H), factor[i], 1e-6);
      EXPECT_NEAR(1 / interpolated->equivalent_stress(uniaxial(angle[i])), factor[i], 1e-6);
      const double  c = std::cos(angle[i] * pi / 180), s = std::sin(angle[i] * pi / 180);
      const Vector3 across = 1e-9 * Vector3(s * s, c * c, -s * c);
      interpolated->evaluate(uniaxial(angle[i]) + across, n1, H);
      interpolated->evaluate(uniaxial(angle[i]) - across, n2, H);
      EXPECT_NEAR(r_value(0.5 * (n1 + n2), angle[i]), R[i], 2e-5);
      // The tangent construction has one normal, between those of the two sides.
      const double side1 = r_value(n1, angle[i]), side2 = r_value(n2, angle[i]), one = r_value(n, angle[i]);
      EXPECT_GT(one, std::min(side1, side2));
      EXPECT_LT(one, std::max(side1, side2));
    }
}

// What the two constructions differ by: the size of the kinks, and 2e-4 in the stress.
TEST(Vegter, constructions_differ_little)
{
  const auto   tangent = paper::locus("Vegter"), interpolated = paper::locus("Vegter interpolated");
  std::mt19937 generator(2);
  double       largest = 0;
  for (int i = 0; i < 10000; ++i)
    {
      const Vector3 s = paper::random_direction(generator);
      largest = std::max(largest, std::abs(tangent->equivalent_stress(s) / interpolated->equivalent_stress(s) - 1));
    }
  EXPECT_LT(largest, 3e-4);
  EXPECT_GT(largest, 1e-6);
}

TEST(Vegter, derivatives)
{
  expect_derivatives(*paper::locus("Vegter"), 10000, 1e-6);
}
TEST(Hill1948, derivatives)
{
  expect_derivatives(*paper::locus("Hill 1948"), 10000, 1e-6);
}
TEST(VonMises, derivatives)
{
  expect_derivatives(*paper::locus("von Mises"), 10000, 1e-6);
}

// The gradient is continuous across the joints of the curves at every angle, also off the test angles.
TEST(Vegter, gradient_is_continuous_at_the_joints)
{
  const auto locus = paper::locus("Vegter");
  Vector3    n1, n2;
  Matrix3    H;
  for (double theta = 0; theta <= 90; theta += 2.5)
    {
      const double c = std::cos(2 * theta * pi / 180), q = std::sin(2 * theta * pi / 180);
      // Once around in the plane of principal stresses: the largest change of the gradient per step halves with the
      // step. A jump would stay.
      double largest[2] = { 0, 0 };
      for (int k = 0; k < 2; ++k)
        {
          const int n_steps = 5000 * (k + 1);
          for (int i = 0; i <= n_steps; ++i)
            {
              const double phi = pi * i / n_steps, m = std::cos(phi), R = std::sin(phi);
              locus->evaluate({ m + R * c, m - R * c, R * q }, n2, H);
              if (i > 0)
                largest[k] = std::max(largest[k], (n2 - n1).norm());
              n1 = n2;
            }
        }
      EXPECT_NEAR(largest[1] / largest[0], 0.5, 0.01) << theta;
    }
}

TEST(Vegter, equibiaxial_state_from_all_sides)
{
  const auto locus = paper::locus("Vegter");
  Vector3    n0, n;
  Matrix3    H;
  EXPECT_NEAR(locus->evaluate({ 200, 200, 0 }, n0, H), 200 / 1.132, 1e-12);
  EXPECT_TRUE(H.allFinite());
  for (double radius : { 1e-12, 1e-8, 1.9e-5, 2.1e-5, 1e-3 })
    for (double phi = 0.1; phi < 2 * pi; phi += 0.2)
      {
        const Vector3 d = radius * Vector3(std::cos(phi), -std::cos(phi), std::sin(phi));
        const double  e = locus->evaluate(Vector3(200, 200, 0) + d, n, H);
        // First-order change of value and gradient: the curvature times stress is about 6.
        EXPECT_NEAR(e, 200 / 1.132 + n0.dot(d), 1e-12 * e + 10 * d.squaredNorm() / 200);
        EXPECT_LT((n - n0).norm(), 10 * (d.norm() + 2e-5) / 200);
        EXPECT_LT(H.norm() * 200, 10.);
        EXPECT_NEAR(n.dot(Vector3(200, 200, 0) + d), e, 1e-12 * e);
        const Vector3 eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix3>(H).eigenvalues();
        EXPECT_GT(eigenvalues[0] * 200, -1e-6);
      }
}

// Convexity: e((s+t)/2) <= (e(s)+e(t))/2 for random and for close pairs, and no negative curvature.
TEST(Vegter, is_convex)
{
  const auto   locus = paper::locus("Vegter");
  std::mt19937 generator(3);
  Vector3      n;
  Matrix3      H;
  double       lowest = 0;
  for (int i = 0; i < 100000; ++i)
    {
      const Vector3 s = paper::random_direction(generator);
      const Vector3 t
          = i % 2 ? paper::random_direction(generator) : Vector3(s + 0.05 * paper::random_direction(generator));
      ASSERT_LE(locus->equivalent_stress(0.5 * (s + t)),
                0.5 * (locus->equivalent_stress(s) + locus->equivalent_stress(t)) + 1e-15)
          << s.transpose() << " and " << t.transpose();
      locus->evaluate(s, n, H);
      lowest = std::min(
          lowest, Eigen::SelfAdjointEigenSolver<Matrix3>().computeDirect(H, Eigen::EigenvaluesOnly).eigenvalues()[0]);
    }
  EXPECT_GT(lowest, -1e-6);
}

TEST(Vegter, becomes_von_mises_with_its_points)
{
  // On the von Mises locus: pure shear 1/sqrt(3), plane strain (2,1)/sqrt(3), R = 1; the Bezier curves are no ellipse
  // arcs, so agreement is approximate between the points (0.3 %), exact in them.
  const std::string text   = "set R values = 1, 1, 1\n"
                             "set Uniaxial factors = 1, 1, 1\n"
                             "set Plane strain factors = 1.1547005383792515, 1.1547005383792515, 1.1547005383792515\n"
                             "set Plane strain ratios = 0.5, 0.5, 0.5\n"
                             "set Shear factors = 0.5773502691896258, 0.5773502691896258, 0.5773502691896258\n"
                             "set Equibiaxial factor = 1\nset Equibiaxial ratio = 1\n";
  const auto        vegter = paper::make<YieldLocus>("Vegter", text);
  const auto        mises  = paper::locus("von Mises");
  std::mt19937      generator(4);
  for (int i = 0; i < 1000; ++i)
    {
      const Vector3 s = paper::random_direction(generator);
      EXPECT_NEAR(vegter->equivalent_stress(s) / mises->equivalent_stress(s), 1, 3e-3);
    }
  for (const Vector3 &s : { Vector3(1, 0, 0), Vector3(0, 0, 1), Vector3(2, 1, 0), Vector3(1, 1, 0), Vector3(1, -1, 0) })
    EXPECT_NEAR(vegter->equivalent_stress(s), mises->equivalent_stress(s), 1e-14);
}

TEST(Vegter, refuses_wrong_data)
{
  const auto replaced = [](const std::string &from, const std::string &to) {
    std::string text = paper::vegter;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  const auto message = [](const std::string &text) -> std::string {
    try
      {
        paper::make<YieldLocus>("Vegter", text);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  };
  EXPECT_NE(message(replaced("1, 1.0310", "1.1, 1.0310")).find("rolling direction"), std::string::npos);
  EXPECT_NE(message(replaced("1.248, ", "")).find("3 numbers"), std::string::npos);
  EXPECT_NE(message(replaced("1.132", "1.4")).find("not convex"), std::string::npos);
  EXPECT_EQ(message(paper::vegter), "");
}

TEST(Hill1948, r_values_and_yield_stresses)
{
  const auto   locus = paper::locus("Hill 1948");
  Vector3      n;
  Matrix3      H;
  const double R[] = { 1.79, 1.51, 2.27 };
  for (int j = 0; j < 3; ++j)
    {
      locus->evaluate(uniaxial(45. * j), n, H);
      EXPECT_NEAR(r_value(n, 45. * j), R[j], 1e-12);
    }
  EXPECT_NEAR(locus->equivalent_stress({ 1, 0, 0 }), 1, 1e-15);
  // Hill (1948): sigma_90/sigma_0 = sqrt(R90 (1+R0)/(R0 (1+R90))).
  EXPECT_NEAR(1 / locus->equivalent_stress({ 0, 1, 0 }), std::sqrt(2.27 * 2.79 / (1.79 * 3.27)), 1e-14);
}

TEST(VonMises, closed_form_and_frame_rotation)
{
  const auto locus = paper::locus("von Mises");
  EXPECT_NEAR(locus->equivalent_stress({ 1, 0, 0 }), 1, 1e-15);
  EXPECT_NEAR(locus->equivalent_stress({ 0, 0, 1 }), std::sqrt(3.), 1e-15); // pure shear
  EXPECT_NEAR(locus->equivalent_stress({ 1, 1, 0 }), 1, 1e-15);
  std::mt19937 generator(5);
  for (int i = 0; i < 100; ++i)
    {
      const Vector3 s = paper::random_direction(generator);
      const double  c = std::cos(0.1 * i), d = std::sin(0.1 * i);
      const Vector3 turned(c * c * s[0] + d * d * s[1] - 2 * c * d * s[2],
                           d * d * s[0] + c * c * s[1] + 2 * c * d * s[2],
                           c * d * (s[0] - s[1]) + (c * c - d * d) * s[2]);
      EXPECT_NEAR(locus->equivalent_stress(turned), locus->equivalent_stress(s), 1e-14);
    }
}
