#include <tribodraw/base/errors.h>
#include <tribodraw/shell/element.h>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <random>

#include "support.h"

using namespace tribodraw;
using namespace tribodraw::shell_element;

namespace
{
  class RandomElement
  {
  public:
    explicit RandomElement(const unsigned seed) : generator(seed)
    {
      NodeState nodes;
      nodes.position = { Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 0.2, 0.1), Eigen::Vector3d(0.4, 1.7, -0.1) };
      nodes.opposite
          = { Eigen::Vector3d(1.1, -1.6, 0.2), Eigen::Vector3d(2.6, 1.9, 0), Eigen::Vector3d(-1.4, 0.8, 0.1) };
      for (unsigned i = 0; i < 3; ++i)
        {
          nodes.position[i] += 0.2 * vector();
          nodes.opposite[i] += 0.2 * vector();
          nodes.director[i] = (Eigen::Vector3d::UnitZ() + 0.1 * vector()).normalized();
          nodes.frame[i]    = frame_along(vector(), nodes.director[i]);
        }
      undeformed = nodes;
      // Elements in the interior, at an edge, at a corner with a plane of symmetry.
      Neighbours neighbours;
      neighbours.present  = { true, seed % 3 != 1, seed % 3 == 0 };
      neighbours.mirrored = { false, false, seed % 3 == 2 };
      reference           = make_reference(nodes, neighbours);
    }

    NodeState undeformed;
    Reference reference;

    Eigen::Vector3d
    vector()
    {
      return { uniform(generator), uniform(generator), uniform(generator) };
    }
    ForceVector
    increment(const double size)
    {
      ForceVector w;
      for (double &entry : w)
        entry = size * uniform(generator);
      return w;
    }

  private:
    std::mt19937                     generator;
    std::uniform_real_distribution<> uniform{ -1, 1 };
  };

  NodeState
  moved(NodeState nodes, const ForceVector &increment)
  {
    for (unsigned i = 0; i < 3; ++i)
      {
        nodes.position[i] += increment.segment<3>(displacement_dof(i, 0));
        nodes.opposite[i] += increment.segment<3>(opposite_dof(i, 0));
        turn(nodes.director[i], nodes.frame[i], increment[director_dof(i, 0)], increment[director_dof(i, 1)]);
      }
    return nodes;
  }

  const ThicknessRule &
  five_points()
  {
    static const ThicknessRule rule = make_thickness_rule(5);
    return rule;
  }

  struct Evaluation
  {
    Summary                   summary;
    ForceVector               force;
    TangentMatrix             tangent;
    std::vector<PlasticState> states;
  };

  Evaluation
  evaluate(const Reference &reference, const NodeState &nodes, const SheetMaterial &material,
           const std::vector<PlasticState> &old_states, const Options &options = {},
           const ThicknessRule &rule = five_points())
  {
    Evaluation result;
    result.states  = old_states;
    result.summary = integrate(reference, nodes, { 0.3, 0.95, &rule, &material }, options, old_states.data(),
                               result.states.data(), result.force, result.tangent);
    return result;
  }

  /// Largest difference between the tangent and central differences of the forces, relative to the largest entry.
  double
  tangent_error(RandomElement &element, const SheetMaterial &material, const double deformation, bool &plastic)
  {
    const std::vector<PlasticState> old_states(15);
    const NodeState                 nodes = moved(element.undeformed, element.increment(deformation));
    const Evaluation                at    = evaluate(element.reference, nodes, material, old_states);
    plastic                               = at.summary.plastic_work > 0;
    double       error                    = 0;
    const double step                     = 1e-6;
    for (unsigned j = 0; j < n_dofs; ++j)
      {
        const ForceVector difference
            = (evaluate(element.reference, moved(nodes, step * ForceVector::Unit(j)), material, old_states).force
               - evaluate(element.reference, moved(nodes, -step * ForceVector::Unit(j)), material, old_states).force)
              / (2 * step);
        error = std::max(error, (difference - at.tangent.col(j)).cwiseAbs().maxCoeff());
      }
    return error / at.tangent.cwiseAbs().maxCoeff();
  }
} // namespace

TEST(ShellElement, ForcesAreTheGradientOfTheElasticEnergy)
{
  // Origin: the definition; central differences with a step of 1e-5 are exact to some 1e-9.
  RandomElement                   element(1);
  const auto                      material = shell_test::elastic_material(1000, 0.3);
  const std::vector<PlasticState> states(15);
  const NodeState                 nodes = moved(element.undeformed, element.increment(0.4));
  const Evaluation                at    = evaluate(element.reference, nodes, *material, states);
  ASSERT_TRUE(at.summary.valid);
  const double step = 1e-5;
  for (unsigned j = 0; j < n_dofs; ++j)
    {
      const auto energy = [&](const double s) {
        return evaluate(element.reference, moved(nodes, s * ForceVector::Unit(j)), *material, states)
            .summary.elastic_energy;
      };
      EXPECT_NEAR((energy(step) - energy(-step)) / (2 * step), at.force[j], 1e-7 * at.force.norm()) << "unknown " << j;
    }
}

TEST(ShellElement, ElasticTangentIsExact)
{
  const auto material = shell_test::elastic_material(1000, 0.3);
  for (unsigned seed = 1; seed <= 10; ++seed)
    {
      RandomElement element(seed);
      bool          plastic;
      EXPECT_LT(tangent_error(element, *material, 0.4, plastic), 1e-6) << "seed " << seed; // required accuracy
      EXPECT_FALSE(plastic);
    }
}

TEST(ShellElement, PlasticTangentIsExact)
{
  const auto material = shell_test::plastic_material(1000, 0.3, 5, 0.02, 0.2);
  for (unsigned seed = 1; seed <= 10; ++seed)
    {
      RandomElement element(seed);
      bool          plastic;
      EXPECT_LT(tangent_error(element, *material, 0.3, plastic), 1e-6) << "seed " << seed; // required accuracy
      EXPECT_TRUE(plastic);
    }
}

TEST(ShellElement, TangentIsExactForEveryThicknessRule)
{
  // Gauss and Lobatto, 5 to 11 points, from a history of earlier flow.
  const auto material = shell_test::plastic_material(1000, 0.3, 5, 0.02, 0.2);
  for (unsigned n = 5; n <= 11; ++n)
    for (const bool lobatto : { false, true })
      {
        RandomElement             element(n);
        const ThicknessRule       rule = make_thickness_rule(n, lobatto);
        std::vector<PlasticState> history(3 * n);
        const NodeState           before = moved(element.undeformed, element.increment(0.2));
        history                          = evaluate(element.reference, before, *material, history, {}, rule).states;
        const NodeState  nodes           = moved(before, element.increment(0.1));
        const Evaluation at              = evaluate(element.reference, nodes, *material, history, {}, rule);
        ASSERT_TRUE(at.summary.valid);
        EXPECT_GT(at.summary.plastic_work, 0);
        const double step = 1e-6;
        for (unsigned j = 0; j < n_dofs; ++j)
          {
            const auto force = [&](const double s) {
              return evaluate(element.reference, moved(nodes, s * ForceVector::Unit(j)), *material, history, {}, rule)
                  .force;
            };
            const ForceVector difference = (force(step) - force(-step)) / (2 * step);
            EXPECT_LT((difference - at.tangent.col(j)).cwiseAbs().maxCoeff(), 1e-6 * at.tangent.cwiseAbs().maxCoeff())
                << n << " points, unknown " << j;
          }
      }
}

TEST(ShellElement, TangentIsSymmetric)
{
  // Associated plasticity and conservative kinematics.
  RandomElement    element(3);
  const auto       material = shell_test::plastic_material(1000, 0.3, 5, 0.02, 0.2);
  const Evaluation at       = evaluate(element.reference, moved(element.undeformed, element.increment(0.3)), *material,
                                       std::vector<PlasticState>(15));
  EXPECT_LT((at.tangent - at.tangent.transpose()).norm(), 1e-10 * at.tangent.norm());
}

TEST(ShellElement, RigidMotionNeitherStrainsNorLoads)
{
  const auto material = shell_test::elastic_material(1000, 0.3);
  for (unsigned seed = 1; seed <= 5; ++seed)
    {
      RandomElement            element(seed);
      const Eigen::Quaterniond turn_all = Eigen::Quaterniond(Eigen::AngleAxisd(2.5, element.vector().normalized()));
      const Eigen::Vector3d    shift    = 10 * element.vector();
      NodeState                nodes    = element.undeformed;
      for (unsigned i = 0; i < 3; ++i)
        {
          nodes.position[i] = turn_all * nodes.position[i] + shift;
          nodes.opposite[i] = turn_all * nodes.opposite[i] + shift;
          nodes.director[i] = turn_all * nodes.director[i];
          for (auto &e : nodes.frame[i])
            e = turn_all * e;
        }
      const Evaluation at = evaluate(element.reference, nodes, *material, std::vector<PlasticState>(15));
      ASSERT_TRUE(at.summary.valid);
      // Zero but for round-off: E h = 300 N/mm, strains of 1e-15.
      EXPECT_LT(at.force.norm(), 1e-11);
      EXPECT_LT(at.summary.elastic_energy, 1e-24);
    }
}

TEST(ShellElement, TensionOnlyLeavesTensionAndDropsPressure)
{
  RandomElement                   element(4);
  const auto                      material = shell_test::elastic_material(1000, 0.3);
  const std::vector<PlasticState> states(15);
  Options                         tension_only;
  tension_only.tension_only = true;
  for (const double stretch : { 1.02, 0.98 })
    {
      NodeState nodes = element.undeformed;
      for (unsigned i = 0; i < 3; ++i)
        {
          nodes.position[i] *= stretch;
          nodes.opposite[i] *= stretch;
        }
      const Evaluation exact   = evaluate(element.reference, nodes, *material, states);
      const Evaluation clipped = evaluate(element.reference, nodes, *material, states, tension_only);
      const double     change  = (clipped.tangent - exact.tangent).norm() / exact.tangent.norm();
      if (stretch > 1)
        EXPECT_LT(change, 1e-14); // both principal forces are tensile: nothing to drop
      else
        {
          // Dropping pressure adds a positive semi-definite matrix.
          const Eigen::MatrixXd added = clipped.tangent - exact.tangent;
          EXPECT_GT(change, 1e-3);
          EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(added).eigenvalues().minCoeff(),
                    -1e-10 * added.norm());
        }
    }
}

TEST(ShellElement, FullElasticBlendGivesTheElasticModuli)
{
  // With a blend of one the moduli are the elastic ones, at plastic stresses. Where the stresses vanish at the same
  // time (yield stress tending to zero) the whole tangent is that of the elastic element without stress-dependent
  // terms; so the difference to blend 0 must be 1 / 0.25 times the difference at blend 0.25 (linearity), and positive
  // semi-definite.
  RandomElement                   element(5);
  const auto                      material = shell_test::plastic_material(1000, 0.3, 5, 0.02, 0.2);
  const std::vector<PlasticState> states(15);
  const NodeState                 nodes = moved(element.undeformed, element.increment(0.3));
  Options                         quarter, full;
  quarter.elastic_blend       = 0.25;
  full.elastic_blend          = 1;
  const Eigen::MatrixXd plain = evaluate(element.reference, nodes, *material, states).tangent;
  const Eigen::MatrixXd a     = evaluate(element.reference, nodes, *material, states, quarter).tangent - plain;
  const Eigen::MatrixXd b     = evaluate(element.reference, nodes, *material, states, full).tangent - plain;
  EXPECT_GT(b.norm(), 0.5 * plain.norm());
  EXPECT_LT((b - 4 * a).norm(), 1e-10 * b.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(b).eigenvalues().minCoeff(), -1e-10 * b.norm());

  // The same element of a material that does not yield, with plastic strains such that the stress is the same:
  // its exact tangent is what the full blend must give.
  const Evaluation plastic  = evaluate(element.reference, nodes, *material, states, full);
  const auto       elastic  = shell_test::elastic_material(1000, 0.3);
  const Evaluation expected = evaluate(element.reference, nodes, *elastic, plastic.states);
  EXPECT_LT((plastic.tangent - expected.tangent).norm(), 1e-9 * expected.tangent.norm());
}

TEST(ShellElement, InversionIsReported)
{
  RandomElement element(6);
  const auto    material = shell_test::elastic_material(1000, 0.3);
  NodeState     nodes    = element.undeformed;
  std::swap(nodes.position[0], nodes.position[1]);
  EXPECT_FALSE(evaluate(element.reference, nodes, *material, std::vector<PlasticState>(15)).summary.valid);
}

TEST(ThicknessRule, IntegratesPolynomialsExactly)
{
  // Mean of x^k over [-1, 1] is 1/(k+1) for even k. Gauss with n points is exact to degree 2n-1, Lobatto to 2n-3.
  for (unsigned n = 3; n <= 11; ++n)
    for (const bool lobatto : { false, true })
      {
        const ThicknessRule rule = make_thickness_rule(n, lobatto);
        for (unsigned k = 0; k <= 2 * n - (lobatto ? 3 : 1); ++k)
          {
            double mean = 0;
            for (unsigned l = 0; l < n; ++l)
              mean += rule.weight[l] * std::pow(rule.point[l], k);
            EXPECT_NEAR(mean, k % 2 == 0 ? 1. / (k + 1) : 0., 1e-13) << n << " points, degree " << k;
          }
        EXPECT_EQ(std::abs(rule.point.front()) > 1 - 1e-14, lobatto);
      }
  EXPECT_THROW(make_thickness_rule(2), InputError);
  EXPECT_THROW(make_thickness_rule(12), InputError);
}
