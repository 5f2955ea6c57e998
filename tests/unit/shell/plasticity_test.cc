#include <gtest/gtest.h>

#include "support.h"

using namespace shell_test;

namespace
{
  constexpr double E = 200000, nu = 0.3, initial = 150, reference = 0.01, exponent = 0.22;
  constexpr double length = 20, width = 6, h = 1;

  /// Stress of a uniaxial test at logarithmic strain: stress = flow stress(strain - stress / E), by bisection.
  double
  uniaxial_stress(const double strain)
  {
    const PowerHardening law(initial, reference, exponent);
    double               low = 0, high = E * strain;
    for (unsigned i = 0; i < 200; ++i)
      {
        const double stress                                                                 = 0.5 * (low + high);
        (stress < law.flow_stress(std::max(0., strain - stress / E), 1).value ? low : high) = stress;
      }
    return 0.5 * (low + high);
  }

  /// A strip held at x = 0 and pulled at x = length, free to contract.
  struct Strip
  {
    BlankMesh     mesh = distorted_rectangle(length, width, 5, 3);
    Shell         shell;
    StaticProblem problem;

    explicit Strip(const Shell::ThicknessPoints kind = Shell::ThicknessPoints::gauss)
        : shell(mesh, h, plastic_material(E, nu, initial, reference, exponent), 5, kind), problem(shell)
    {
      for (unsigned node = 0; node < shell.n_nodes(); ++node)
        {
          problem.fix(node, { 2 });
          if (at(node, 0))
            problem.fix(node, { 0 });
          if (at(node, length))
            problem.fix(node, { 0 });
        }
      problem.fix(0, { 1 });
    }
    bool
    at(const unsigned node, const double x) const
    {
      return mesh.nodes[node].x() == x;
    }

    void
    pull(const double elongation)
    {
      Eigen::VectorXd jump = Eigen::VectorXd::Zero(shell.n_dofs());
      for (unsigned node = 0; node < shell.n_nodes(); ++node)
        if (at(node, length))
          jump[shell.dof(node, 0)] = elongation;
      problem.solve(Eigen::VectorXd::Zero(shell.n_dofs()), 1e-8, &jump);
      shell.commit();
    }
    double
    force() const
    {
      double sum = 0;
      for (unsigned node = 0; node < shell.n_nodes(); ++node)
        if (at(node, length))
          sum += problem.reaction[shell.dof(node, 0)];
      return sum;
    }
  };
} // namespace

TEST(PlasticStrip, TensionReproducesTheHardeningCurve)
{
  for (const auto kind : { Shell::ThicknessPoints::gauss, Shell::ThicknessPoints::lobatto })
    {
      Strip                strip(kind);
      const PowerHardening law(initial, reference, exponent);
      double               plastic_work = 0, last_eps_p = 0;
      for (unsigned step = 1; step <= 8; ++step)
        {
          const double elongation = step <= 4 ? 0.004 : 1.;
          strip.pull(elongation);
          const double stretch = strip.shell.committed().position[5].x() / length; // node 5: end of the first row
          const double strain  = std::log(stretch);
          const double stress  = uniaxial_stress(strain);
          const double eps_p   = strain - stress / E;
          // Stress power per reference volume: force times length = stress volume d strain.
          EXPECT_NEAR(strip.force(), stress * width * h / stretch, 1e-8 * stress * width * h) << "step " << step;
          // Plastic incompressibility (isotropic: half of the strain goes into the thickness) and Hooke.
          const double thickness = h * std::exp(-0.5 * eps_p - nu * stress / E);
          for (unsigned node = 0; node < strip.shell.n_nodes(); ++node)
            {
              EXPECT_NEAR(strip.shell.node_thickness()[node], thickness, 1e-9);
              EXPECT_NEAR(strip.shell.node_eps_p()[node], eps_p, 1e-9);
            }
          // Flow stress in the middle of the increment, from its value and slope at the end, at least the initial one.
          const auto end = law.flow_stress(eps_p, 1);
          plastic_work += std::max(law.flow_stress(last_eps_p, 1).value,
                                   end.value - 0.5 * end.strain_slope * (eps_p - last_eps_p))
                          * (eps_p - last_eps_p) * length * width * h;
          last_eps_p                  = eps_p;
          const double elastic_energy = 0.5 * stress * stress / E * length * width * h;
          const double accuracy       = 1e-7 * (elastic_energy + plastic_work);
          EXPECT_NEAR(strip.shell.plastic_work(), plastic_work, accuracy);
          EXPECT_NEAR(strip.shell.elastic_energy(), elastic_energy, accuracy);
        }
      EXPECT_GT(last_eps_p, 0.15); // the test went far into plasticity
    }
}

TEST(PlasticStrip, NewtonConvergesQuadratically)
{
  // All points flow: the response is smooth. One iteration from half the distance to the solution leaves a quarter of
  // the error.
  Strip strip;
  strip.pull(1.);
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(strip.shell.n_dofs());
  for (unsigned node = 0; node < strip.shell.n_nodes(); ++node)
    if (strip.at(node, length))
      jump[strip.shell.dof(node, 0)] = 0.5;
  const Eigen::VectorXd no_load = Eigen::VectorXd::Zero(strip.shell.n_dofs());
  strip.problem.solve(no_load, 1e-9, &jump);
  const Shell::Configuration solution = strip.shell.trial();
  const auto                 distance = [&](const double size) {
    strip.shell.set_trial(solution);
    Eigen::VectorXd u(strip.shell.n_dofs());
    for (Eigen::Index i = 0; i < u.size(); ++i)
      u[i] = strip.problem.fixed[i] ? 0 : size * std::sin(1.7 * static_cast<double>(i * i));
    strip.shell.move(u);
    strip.shell.move(-strip.problem.solve_linear(strip.problem.residual(no_load)));
    double sum = 0;
    for (unsigned node = 0; node < strip.shell.n_nodes(); ++node)
      sum += (strip.shell.trial().position[node] - solution.position[node]).squaredNorm();
    return std::sqrt(sum);
  };
  const double far = distance(2e-3), near = distance(1e-3);
  EXPECT_GT(far, 1e-8); // above the accuracy of the solution
  EXPECT_GT(std::log2(far / near), 1.9);
  EXPECT_LT(std::log2(far / near), 2.1);
}

TEST(PlasticStrip, EquibiaxialTensionReproducesTheHardeningCurve)
{
  // von Mises: the equivalent stress is the stress along both axes, the equivalent plastic strain twice the strain
  // along one of them; Hooke: elastic strain (1 - nu) stress / E.
  const BlankMesh      mesh = distorted_rectangle(10, 10, 4, 4);
  Shell                shell(mesh, h, plastic_material(E, nu, initial, reference, exponent), 5);
  StaticProblem        problem(shell);
  const PowerHardening law(initial, reference, exponent);
  for (unsigned node = 0; node < shell.n_nodes(); ++node)
    {
      problem.fix(node, { 2 });
      for (unsigned c = 0; c < 2; ++c)
        if (mesh.nodes[node][c] == 0 || mesh.nodes[node][c] == 10)
          problem.fix(node, { c });
    }
  for (unsigned step = 1; step <= 15; ++step)
    {
      Eigen::VectorXd jump = Eigen::VectorXd::Zero(shell.n_dofs());
      for (unsigned node = 0; node < shell.n_nodes(); ++node)
        for (unsigned c = 0; c < 2; ++c)
          if (mesh.nodes[node][c] == 10)
            jump[shell.dof(node, c)] = 0.1;
      problem.solve(Eigen::VectorXd::Zero(shell.n_dofs()), 1e-8, &jump);
      shell.commit();
      const double strain = std::log(1 + 0.01 * step);
      double       low = 0, high = E; // stress = flow stress(2 (strain - (1 - nu) stress / E)), by bisection
      for (unsigned i = 0; i < 200; ++i)
        {
          const double s = 0.5 * (low + high);
          (s < law.flow_stress(std::max(0., 2 * (strain - (1 - nu) * s / E)), 1).value ? low : high) = s;
        }
      const auto results = shell.element_results();
      for (unsigned e = 0; e < shell.n_elements(); ++e)
        {
          EXPECT_NEAR(results.membrane_stress_xx[e], low, 1e-6 * low);
          EXPECT_NEAR(results.membrane_stress_yy[e], low, 1e-6 * low);
          EXPECT_NEAR(results.eps_p[e], 2 * (strain - (1 - nu) * low / E), 1e-8);
        }
    }
}

TEST(PlasticStrip, HistoryChangesAtCommitOnly)
{
  Strip strip;
  strip.pull(0.5);
  const double    force     = strip.force();
  const double    thickness = strip.shell.node_thickness()[7];
  Eigen::VectorXd result, again;
  ASSERT_TRUE(strip.shell.assemble(1, {}, result, nullptr));
  Eigen::VectorXd excursion = Eigen::VectorXd::Zero(strip.shell.n_dofs());
  for (unsigned node = 0; node < strip.shell.n_nodes(); ++node)
    excursion[strip.shell.dof(node, 0)] = 0.05 * strip.mesh.nodes[node].x();
  strip.shell.move(excursion);
  ASSERT_TRUE(strip.shell.assemble(1, {}, again, nullptr));
  EXPECT_GT((again - result).norm(), 0.001 * force); // the excursion was felt
  strip.shell.revert();
  EXPECT_THROW(strip.shell.commit(), std::logic_error); // nothing was assembled for this configuration
  ASSERT_TRUE(strip.shell.assemble(1, {}, again, nullptr));
  EXPECT_EQ((again - result).norm(), 0); // and left no trace
  EXPECT_EQ(strip.shell.node_thickness()[7], thickness);
}

TEST(PlasticStrip, ContinuesFromACheckpoint)
{
  Strip whole, first, second;
  for (Strip *strip : { &whole, &first })
    {
      strip->pull(0.5);
      strip->pull(0.7);
    }
  Archive archive;
  first.shell.save(archive);
  second.shell.load(archive);
  EXPECT_EQ(second.shell.plastic_work(), first.shell.plastic_work());
  EXPECT_EQ(second.shell.elastic_energy(), first.shell.elastic_energy());
  EXPECT_EQ(second.shell.node_thickness(), first.shell.node_thickness());
  whole.pull(0.6);
  second.pull(0.6);
  // The same run, with or without interruption. The parallel solver does not repeat its round-off, and the iteration
  // stops at 1e-8 N, which at a hardening slope of some 1000 MPa x 6 mm^2 is 2e-12 of strain.
  EXPECT_NEAR(second.force(), whole.force(), 1e-10 * whole.force());
  EXPECT_NEAR(second.shell.plastic_work(), whole.shell.plastic_work(), 1e-10 * whole.shell.plastic_work());
  for (unsigned e = 0; e < whole.shell.n_elements(); ++e)
    EXPECT_NEAR(second.shell.element_results().eps_p[e], whole.shell.element_results().eps_p[e], 2e-11);
}
