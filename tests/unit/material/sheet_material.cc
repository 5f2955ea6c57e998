#include "paper_material.h"

#include <tribodraw/base/errors.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  const char *const loci[] = { "von Mises", "Hill 1948", "Vegter" };
  const char *const laws[] = { "Swift", "Bergstroem-van Liempt" };

  /// Rows: (normal along, normal across, engineering shear) strain of axes turned by @p degrees; its transpose brings
  /// stresses back (work conjugate).
  Matrix3
  strain_rotation(const double degrees)
  {
    const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
    Matrix3      Q;
    Q << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
    return Q;
  }

  struct PathPoint
  {
    double       stress; ///< along the specimen
    double       eps_p, rate;
    Vector3      strain;
    PlasticState state;
  };

  /// Tension with stress ratio across/along of @p ratio (no shear) and prescribed strain along, in @p n increments;
  /// Newton on the two other strain components with the tangent of the material.
  std::vector<PathPoint>
  pull(const SheetMaterial &sheet, const double degrees, const double ratio, const double last_strain, const int n,
       const double time_increment)
  {
    const Matrix3          Q = strain_rotation(degrees), Q_inverse = Q.inverse();
    std::vector<PathPoint> path;
    PlasticState           state, next;
    Vector3                local = Vector3::Zero();
    for (int i = 1; i <= n; ++i)
      {
        const double target    = last_strain * i / n;
        bool         converged = false;
        // The start follows the last direction.
        local *= i > 1 ? target / local[0] : 1.;
        local[0] = target;
        for (int k = 0; k < 60 && !converged; ++k)
          {
            const auto    u       = sheet.update(Q_inverse * local, state, time_increment, next);
            const Vector3 stress  = Q_inverse.transpose() * u.stress;
            const Matrix3 tangent = Q_inverse.transpose() * u.tangent * Q_inverse;
            EXPECT_TRUE(u.converged);
            const Eigen::Vector2d residual(stress[1] - ratio * stress[0], stress[2]);
            Eigen::Matrix2d       jacobian;
            jacobian << tangent(1, 1) - ratio * tangent(0, 1), tangent(1, 2) - ratio * tangent(0, 2), tangent(2, 1),
                tangent(2, 2);
            converged = residual.norm() < 1e-10 * stress.norm();
            if (!converged)
              local.tail<2>() -= jacobian.inverse() * residual;
            else
              path.push_back(
                  { stress[0], next.eps_p, (next.eps_p - state.eps_p) / time_increment, Q_inverse * local, next });
          }
        EXPECT_TRUE(converged) << degrees << " " << target;
        state = next;
      }
    return path;
  }
} // namespace

// In rolling direction the equivalent stress is the tensile stress: the curve is the hardening law at the actual rate.
TEST(SheetMaterial, tension_reproduces_the_hardening_law)
{
  for (const char *locus : loci)
    for (const char *law : laws)
      {
        const auto   sheet  = paper::sheet(locus, law);
        const double factor = 1;
        for (const auto &p : pull(sheet, 0, 0, 0.3, 30, 0.1)) // 0.1 1/s
          {
            EXPECT_NEAR(p.stress / (factor * sheet.hardening().flow_stress(p.eps_p, p.rate).value), 1, 1e-9) << locus;
            EXPECT_NEAR(p.stress, 210e3 * (p.strain[0] - p.state.plastic_strain[0]), 1e-6);
          }
      }
}

// At other angles the stress is f_un times that, and the strains have the R-values of Table 2.
TEST(SheetMaterial, vegter_tension_at_the_test_angles)
{
  const auto   sheet = paper::sheet("Vegter", "Bergstroem-van Liempt");
  const double R[] = { 1.92667, 1.49433, 2.21133 }, f_un[] = { 1, 1.0310, .9885 };
  for (int j = 0; j < 3; ++j)
    for (const auto &p : pull(sheet, 45. * j, 0, 0.2, 10, 0.2))
      {
        const Vector3 plastic = strain_rotation(45. * j) * p.state.plastic_strain;
        EXPECT_NEAR(p.stress / (f_un[j] * sheet.hardening().flow_stress(p.eps_p, p.rate).value), 1, 1e-8);
        EXPECT_NEAR(plastic[1] / -(plastic[0] + plastic[1]), R[j], 1e-6);
      }
}

TEST(SheetMaterial, equibiaxial_tension)
{
  const auto sheet = paper::sheet("Vegter", "Bergstroem-van Liempt");
  for (const auto &p : pull(sheet, 0, 1, 0.2, 10, 0.2))
    {
      // Equibiaxial factor and ratio of Table 2.
      EXPECT_NEAR(p.stress / (1.132 * sheet.hardening().flow_stress(p.eps_p, p.rate).value), 1, 1e-8);
      EXPECT_NEAR(p.state.plastic_strain[1] / p.state.plastic_strain[0], .8988, 1e-6);
    }
  const auto mises = paper::sheet("von Mises", "Swift");
  for (const auto &p : pull(mises, 0, 1, 0.2, 10, 0.2))
    {
      EXPECT_NEAR(p.stress / mises.hardening().flow_stress(p.eps_p, 0).value, 1, 1e-9);
      EXPECT_NEAR(p.strain[1], p.strain[0], 1e-12);
      // Plastic incompressibility: eps_p = -E33^p = 2 E11^p; elastic E33 = -2 nu s/E.
      EXPECT_NEAR(p.eps_p, 2 * p.state.plastic_strain[0], 1e-12);
      EXPECT_NEAR(mises.thickness_strain(p.strain, p.state), -p.eps_p - 2 * 0.3 * p.stress / 210e3, 1e-12);
    }
}

TEST(SheetMaterial, elastic_state)
{
  const auto   sheet = paper::sheet("Vegter", "Bergstroem-van Liempt");
  PlasticState state;
  const auto   u = sheet.update({ 5e-4, -1.5e-4, 0 }, {}, 1, state);
  EXPECT_NEAR(u.stress[0], 105., 1e-10); // E eps in uniaxial stress, nu = 0.3
  EXPECT_NEAR(u.stress[1], 0., 1e-10);
  EXPECT_NEAR(u.elastic_energy, 0.5 * 105 * 5e-4, 1e-14);
  EXPECT_FALSE(u.plastic);
  EXPECT_EQ(state.eps_p, 0.);
  const auto shear = sheet.update({ 0, 0, 1e-4 }, {}, 1, state);
  EXPECT_NEAR(shear.stress[2], 210e3 / 2.6 * 1e-4, 1e-10);
  EXPECT_NEAR(sheet.thickness_strain({ 5e-4, -1.5e-4, 0 }, {}), -1.5e-4, 1e-15);
}

TEST(SheetMaterial, tangent_is_the_derivative_of_the_stress)
{
  for (const char *locus : loci)
    for (const char *law : laws)
      {
        const auto   sheet = paper::sheet(locus, law);
        std::mt19937 generator(1);
        int          n_plastic = 0, n_joints = 0;
        const int    n_states = 600;
        for (int i = 0; i < n_states; ++i)
          {
            PlasticState old_state, unused;
            old_state.eps_p          = 0.01 * (i % 7);
            old_state.plastic_strain = 0.01 * paper::random_direction(generator);
            const double  size       = 2e-4 * std::pow(10., 2.5 * (i % 10) / 9.); // 2e-4 to 0.06
            const Vector3 strain     = old_state.plastic_strain + size * paper::random_direction(generator);
            const double  dt         = std::pow(10., i % 4 - 3.);
            const auto    u          = sheet.update(strain, old_state, dt, unused);
            ASSERT_TRUE(u.converged);
            ASSERT_LT((u.tangent - u.tangent.transpose()).norm(), 1e-14 * u.tangent.norm());
            n_plastic += u.plastic;
            const double h = 1e-5 * size;
            for (int j = 0; j < 3; ++j)
              {
                const auto    up      = sheet.update(strain + h * Vector3::Unit(j), old_state, dt, unused);
                const auto    down    = sheet.update(strain - h * Vector3::Unit(j), old_state, dt, unused);
                const Vector3 central = (up.stress - down.stress) / (2 * h);
                // Noise: 1e-11 of the flow stress over 2e-5 of the trial stress.
                if ((central - u.tangent.col(j)).norm() > 1e-6 * u.tangent.norm())
                  {
                    // At joints of the Bezier curves the tangent jumps; one side must fit, to first order in h.
                    ++n_joints;
                    const double right = ((up.stress - u.stress) / h - u.tangent.col(j)).norm();
                    const double left  = ((u.stress - down.stress) / h - u.tangent.col(j)).norm();
                    ASSERT_LT(std::min(left, right), 1e-4 * u.tangent.norm()) << locus << " " << law << " " << i;
                  }
              }
          }
        EXPECT_GT(n_plastic, n_states / 2);
        EXPECT_LT(n_plastic, n_states);
        EXPECT_LE(n_joints, 3) << locus;
      }
}

// The isotropic material does not know the axes.
TEST(SheetMaterial, von_mises_turns_with_the_axes)
{
  const auto    sheet = paper::sheet("von Mises", "Bergstroem-van Liempt");
  const Vector3 strain(0.02, -0.004, 0.011);
  PlasticState  state, turned_state;
  const auto    u = sheet.update(strain, {}, 0.1, state);
  for (double degrees : { 20., 73., 131. })
    {
      const Matrix3 Q = strain_rotation(degrees);
      const auto    v = sheet.update(Q * strain, {}, 0.1, turned_state);
      EXPECT_LT((Q.transpose() * v.stress - u.stress).norm(), 1e-9 * u.stress.norm());
      EXPECT_LT((Q.transpose() * v.tangent * Q - u.tangent).norm(), 1e-9 * u.tangent.norm());
      EXPECT_NEAR(turned_state.eps_p, state.eps_p, 1e-13);
    }
}

TEST(SheetMaterial, work_and_energy)
{
  for (const char *locus : loci)
    {
      const auto   sheet = paper::sheet(locus, "Bergstroem-van Liempt");
      PlasticState old_state, state;
      old_state.eps_p = 0.02;
      old_state.plastic_strain << 0.01, -0.003, 0.002;
      const Vector3 strain(0.03, -0.01, 0.02);
      const auto    u = sheet.update(strain, old_state, 0.1, state);
      // flow stress at the middle of the increment, from value and slope at its end, at the rate of the increment
      const double flow = state.eps_p - old_state.eps_p, rate = flow / 0.1;
      const auto   end  = sheet.hardening().flow_stress(state.eps_p, rate);
      const double mean = end.value - 0.5 * end.strain_slope * flow;
      EXPECT_NEAR(u.plastic_work, mean * flow, 1e-9 * u.plastic_work);
      // and by associated flow, work is equivalent stress times flow at the end of the increment
      EXPECT_NEAR(u.stress.dot(state.plastic_strain - old_state.plastic_strain),
                  sheet.locus().equivalent_stress(u.stress) * flow, 1e-9 * u.plastic_work);
      EXPECT_NEAR(u.elastic_energy, 0.5 * u.stress.dot(strain - state.plastic_strain), 1e-9 * u.elastic_energy);
      EXPECT_LT((sheet.elasticity() * (strain - state.plastic_strain) - u.stress).norm(), 1e-8);
    }
}

// For the predictor: a point that has flowed and lies on the surface gets the plastic tangent, one inside does not.
TEST(SheetMaterial, loading_tangent)
{
  const auto    sheet = paper::sheet("Vegter", "Swift");
  const Vector3 strain(0.01, 0.002, 0.004);
  PlasticState  state, next;
  const auto    u       = sheet.update(strain, {}, 1, state);
  const auto    plain   = sheet.update(strain * (1 - 1e-12) + 1e-12 * state.plastic_strain, state, 1, next);
  const auto    loading = sheet.update(strain * (1 - 1e-12) + 1e-12 * state.plastic_strain, state, 1, next, true);
  EXPECT_FALSE(plain.plastic);
  EXPECT_EQ((plain.tangent - sheet.elasticity()).norm(), 0.);
  EXPECT_LT((loading.stress - u.stress).norm(), 1e-6);
  // It is the derivative of the stress for a small further increment in the direction of flow.
  const Vector3 further = 1e-8 * state.plastic_strain / state.plastic_strain.norm();
  const auto    v       = sheet.update(strain + further, state, 1, next);
  EXPECT_TRUE(v.plastic);
  EXPECT_LT((v.stress - u.stress - loading.tangent * further).norm(), 1e-4 * (sheet.elasticity() * further).norm());
  // Inside, or never flowed: elastic.
  const Vector3 inside = state.plastic_strain + 0.999 * (strain - state.plastic_strain);
  EXPECT_EQ((sheet.update(inside, state, 1, next, true).tangent - sheet.elasticity()).norm(), 0.);
}

TEST(SheetMaterial, refuses_what_is_not_finite)
{
  const auto   sheet = paper::sheet("Vegter", "Bergstroem-van Liempt");
  PlasticState state;
  EXPECT_FALSE(sheet.update({ std::nan(""), 0, 0 }, {}, 1, state).converged);
  EXPECT_FALSE(sheet.update({ 0.1, 0, 0 }, {}, 0, state).converged);
  EXPECT_FALSE(sheet.update({ std::numeric_limits<double>::infinity(), 0, 0 }, {}, 1, state).converged);
  EXPECT_TRUE(sheet.update({ 0, 0, 0 }, {}, 1, state).converged);
  EXPECT_FALSE(evaluate_in_cauchy_green(sheet, { 1, 1, 1.1 }, {}, 1, state).update.converged);
}

// s = dW/dC, by differences of the stored energy.
TEST(CauchyGreen, elastic_stress_is_the_derivative_of_the_energy)
{
  const auto    sheet = paper::sheet("Vegter", "Bergstroem-van Liempt");
  PlasticState  state;
  const Vector3 C(1.0004, 0.9999, 0.0003);
  const auto    r = evaluate_in_cauchy_green(sheet, C, {}, 1, state);
  ASSERT_FALSE(r.update.plastic);
  for (int j = 0; j < 3; ++j)
    {
      const double h    = 1e-6;
      const double up   = evaluate_in_cauchy_green(sheet, C + h * Vector3::Unit(j), {}, 1, state).update.elastic_energy;
      const double down = evaluate_in_cauchy_green(sheet, C - h * Vector3::Unit(j), {}, 1, state).update.elastic_energy;
      EXPECT_NEAR((up - down) / (2 * h), r.stress[j], 1e-6 * r.stress.norm());
    }
}

// Uniaxial stress with stretch l: second Piola-Kirchhoff stress S11 = T11/l^2, s1 = S11/2.
TEST(CauchyGreen, stress_of_pure_stretch)
{
  const auto   sheet = paper::sheet("von Mises", "Swift");
  PlasticState state;
  const auto   r = evaluate_in_cauchy_green(sheet, { 1.44, 0.85, 0 }, {}, 1, state);
  EXPECT_NEAR(r.strain[0], std::log(1.2), 1e-15);
  EXPECT_NEAR(r.stress[0], 0.5 * r.update.stress[0] / 1.44, 1e-10);
  EXPECT_NEAR(r.stress[1], 0.5 * r.update.stress[1] / 0.85, 1e-10);
  EXPECT_NEAR(r.stress[2], 0, 1e-10);
}

TEST(CauchyGreen, tangent_is_the_derivative_of_the_stress)
{
  for (const char *locus : loci)
    {
      const auto                             sheet = paper::sheet(locus, "Bergstroem-van Liempt");
      std::mt19937                           generator(3);
      std::uniform_real_distribution<double> u(-1, 1);
      int                                    n_joints = 0;
      for (int i = 0; i < 400; ++i)
        {
          PlasticState old_state, unused;
          old_state.eps_p          = 0.05 * (i % 5);
          old_state.plastic_strain = 0.05 * (i % 5) * paper::random_direction(generator);
          const double  spread     = std::pow(10., -4. + i % 5);
          const Vector3 strain     = spread * Vector3(u(generator), u(generator), u(generator));
          // C = exp(2 E) of this strain.
          const double  mean = 0.5 * (strain[0] + strain[1]), d = 0.5 * (strain[0] - strain[1]), y = 0.5 * strain[2];
          const double  r = std::sqrt(d * d + y * y), sinh = std::sinh(2 * r) / r;
          const Vector3 C
              = std::exp(2 * mean) * Vector3(std::cosh(2 * r) + sinh * d, std::cosh(2 * r) - sinh * d, sinh * y);
          const auto response = evaluate_in_cauchy_green(sheet, C, old_state, 0.05, unused);
          ASSERT_TRUE(response.update.converged) << locus << " " << i;
          ASSERT_LT((response.strain - strain).norm(), 1e-13);
          const double h = 1e-5 * std::min({ 0.01, spread, C[0], C[1] });
          for (int j = 0; j < 3; ++j)
            {
              const auto up   = evaluate_in_cauchy_green(sheet, C + h * Vector3::Unit(j), old_state, 0.05, unused);
              const auto down = evaluate_in_cauchy_green(sheet, C - h * Vector3::Unit(j), old_state, 0.05, unused);
              if (((up.stress - down.stress) / (2 * h) - response.tangent.col(j)).norm()
                  > 1e-5 * response.tangent.norm())
                ++n_joints;
            }
          ASSERT_LT((response.tangent - response.tangent.transpose()).norm(), 1e-12 * response.tangent.norm());
        }
      EXPECT_LE(n_joints, 3) << locus; // onset of flow or a joint within the difference step
    }
}

TEST(SheetMaterial, is_read_from_parameters)
{
  const std::string indented_vegter = paper::vegter, indented_law = paper::bergstroem_van_liempt;
  const std::string text = "subsection Sheet material\nset Young's modulus = 210 GPa\nset Poisson's ratio = 0.3\n"
                           "set Yield locus = Vegter\nset Hardening = Bergstroem-van Liempt\n"
                           "subsection Vegter\n"
                           + indented_vegter + "end\nsubsection Bergstroem-van Liempt\n" + indented_law + "end\nend\n";
  auto                parameters = Parameters::from_text(text);
  const SheetMaterial sheet      = [&] {
    const auto scope = parameters.section("Sheet material");
    return SheetMaterial::read(parameters);
  }();
  parameters.finish();
  EXPECT_EQ(sheet.youngs_modulus(), 210e3);
  EXPECT_EQ(sheet.poissons_ratio(), 0.3);
  EXPECT_NEAR(sheet.locus().equivalent_stress({ 0, 0, 1 }), 1.78141979, 1e-8);
  EXPECT_NEAR(sheet.hardening().flow_stress(.1, 1).value, 368.25, 0.005);
}

TEST(SheetMaterial, documentation_visits_every_law)
{
  auto parameters = Parameters::for_documentation();
  SheetMaterial::read(parameters);
  std::string all;
  for (const auto &e : parameters.entries())
    all += e.path + "\n";
  for (const char *entry :
       { "Vegter/Shear factors", "Hill 1948/R45", "Swift/Initial strain", "Bergstroem-van Liempt/Temperature" })
    EXPECT_NE(all.find(entry), std::string::npos) << entry;
}
