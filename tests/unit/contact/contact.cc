// Contact of nodes with rigid tools: law, Coulomb friction, exact tangent, energies.
#include <tribodraw/contact/contact.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/material/sheet_material.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace tribodraw;
using Eigen::Vector3d;

namespace
{
  /// A ball: distance, normal and curvature are simple and nothing is aligned with the axes.
  class Ball : public ToolGeometry
  {
  public:
    Ball(const Vector3d &c, const double r)
      : centre(c)
      , radius(r)
    {}
    ToolDistance distance(const Vector3d &x) const override
    {
      const Vector3d n = (x - centre).normalized();
      return {(x - centre).norm() - radius, n, (Eigen::Matrix3d::Identity() - n * n.transpose()) / (x - centre).norm()};
    }
    double      smallest_radius() const override { return radius; }
    std::string describe() const override { return "ball"; }

  private:
    Vector3d centre;
    double   radius;
  };

  class Floor : public ToolGeometry
  {
  public:
    ToolDistance distance(const Vector3d &x) const override { return {x[2], Vector3d::UnitZ(), Eigen::Matrix3d::Zero()}; }
    double       smallest_radius() const override { return 1e300; }
    std::string  describe() const override { return "floor"; }
  };

  struct Elastic : YieldLocus
  {
    double equivalent_stress(const Vector3 &s) const override { return s.norm(); }
    double evaluate(const Vector3 &s, Vector3 &g, Matrix3 &h) const override
    {
      g = s.normalized();
      h = (Matrix3::Identity() - g * g.transpose()) / s.norm();
      return s.norm();
    }
  };
  struct Strong : HardeningLaw
  {
    FlowStress flow_stress(double, double) const override { return {1e9, 0, 0}; }
  };

  constexpr double thickness = 0.8;

  struct Bench
  {
    Shell   shell;
    Contact contact;
    Bench(std::vector<ContactTool> tools, const double mu)
      : shell(make_quarter_rectangle(4, 4, 2, 2), thickness,
              std::make_shared<SheetMaterial>(2.1e5, 0.3, std::make_shared<Elastic>(), std::make_shared<Strong>()), 3)
      , contact(shell, std::move(tools), {1000., 0.02, 0.01})
    {
      for (const Face f : {Face::punch_side, Face::die_side})
        contact.set_friction(f, std::vector<double>(shell.n_nodes(), mu));
    }
    unsigned n_free() const
    {
      unsigned n = 0;
      for (const auto &t : contact.tools())
        n += t.free_index >= 0;
      return n;
    }
    Eigen::VectorXd residual()
    {
      Eigen::VectorXd R = Eigen::VectorXd::Zero(shell.n_dofs() + n_free());
      contact.assemble(R, nullptr, {});
      return R;
    }
    /// Accept the state; the sheet's own forces do not matter here.
    void commit()
    {
      residual();
      Eigen::VectorXd forces;
      ASSERT_TRUE(shell.assemble(1., {}, forces, nullptr));
      shell.commit();
      contact.commit();
    }
    void shift(const Vector3d &u)
    {
      Eigen::VectorXd du = Eigen::VectorXd::Zero(shell.n_dofs());
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        for (unsigned c = 0; c < 3; ++c)
          du[shell.dof(i, c)] = u[c];
      shell.move(du);
    }
  };

  ContactTool floor_below()
  {
    return {"floor", std::make_shared<Floor>(), Vector3d(0, 0, -thickness / 2), Face::die_side};
  }
} // namespace

// The law as documented: e (g+d)^2/(4d) in the transition, e g beyond; area 16 mm^2.
TEST(Contact, PressureLaw)
{
  Bench b({floor_below()}, 0.);
  b.shift({0, 0, -0.01});
  b.residual();
  EXPECT_NEAR(b.contact.tool_forces()[0][2], -16 * 1000. * 0.03 * 0.03 / 0.08, 1e-9);
  b.shift({0, 0, -0.05});
  b.residual();
  EXPECT_NEAR(b.contact.tool_forces()[0][2], -16 * 1000. * 0.06, 1e-9);
  b.shift({0, 0, 0.1});
  b.residual();
  EXPECT_EQ(b.contact.tool_forces()[0][2], 0.);
}

// Coulomb: the tangential force grows linearly with the slip up to mu p A at the elastic slip dc and stays there.
TEST(Contact, CoulombFriction)
{
  const double mu = 0.15;
  Bench        b({floor_below()}, mu);
  b.shift({0, 0, -0.05});
  b.commit();
  const double normal = 16 * 1000. * 0.05;
  b.shift({0.004, 0.003, 0}); // |slip| = 0.005 = dc/2
  b.residual();
  EXPECT_NEAR(b.contact.tool_forces()[0][0], 0.5 * mu * normal * 0.8, 1e-9);
  EXPECT_NEAR(b.contact.tool_forces()[0][1], 0.5 * mu * normal * 0.6, 1e-9);
  b.shift({0.8, 0.6, 0});
  b.residual();
  EXPECT_NEAR(b.contact.tool_forces()[0].head<2>().norm(), mu * normal, 1e-9);
  b.commit();
  // mean of zero and full traction over the first increment (trapezoidal rule): 1.005 mm
  EXPECT_NEAR(b.contact.friction_work(), 0.5 * mu * normal * 1.005, 1e-9);
  b.shift({0.8, 0.6, 0});
  b.commit();
  EXPECT_NEAR(b.contact.friction_work(), mu * normal * (0.5 * 1.005 + 1.), 1e-9);
  // sliding back by twice the elastic slip turns the force around
  b.shift({-0.016, -0.012, 0});
  b.residual();
  EXPECT_NEAR(b.contact.tool_forces()[0][0], -0.8 * mu * normal, 1e-9);
}

// A tool that moves with the sheet rubs nothing: only relative motion counts.
TEST(Contact, ToolMotionIsSubtracted)
{
  Bench b({floor_below()}, 0.2);
  b.shift({0, 0, -0.05});
  b.commit();
  b.contact.tools()[0].place[2] -= 0.3;
  b.shift({0, 0, -0.3});
  b.residual();
  EXPECT_NEAR(b.contact.tool_forces()[0].head<2>().norm(), 0., 1e-12);
  EXPECT_NEAR(b.contact.tool_forces()[0][2], -16 * 1000. * 0.05, 1e-8);
}

TEST(Contact, MirroredToolFacesDown)
{
  ContactTool t{"lid", std::make_shared<Floor>(), Vector3d::UnitZ(), Face::punch_side, true};
  const auto  d = t.distance({0.3, 0.2, 0.4});
  EXPECT_DOUBLE_EQ(d.distance, 0.6);
  EXPECT_EQ(d.normal, Vector3d(0, 0, -1));
}

// Consistent linearisation: finite differences of the residual, sticking and sliding, with a free tool.
TEST(Contact, TangentIsExact)
{
  ContactTool ball{"ball", std::make_shared<Ball>(Vector3d(1.3, 0.9, -6.), 6. - thickness / 2 + 0.08), Vector3d::Zero(), Face::die_side};
  ContactTool lid{"lid", std::make_shared<Ball>(Vector3d(2.5, 2.2, -7.), 7. - thickness / 2 + 0.05), Vector3d::Zero(), Face::punch_side, true, 0, Vector3d(0.36, 0.48, -0.8)};
  for (const double slide : {0.002, 0.3})
    {
      Bench b({ball, lid}, 0.15);
      b.commit();
      b.shift({slide, -0.6 * slide, -0.003});
      b.contact.tools()[1].place[2] += 0.004;
      const unsigned n = b.shell.n_dofs();
      SparseMatrix   K = b.shell.make_matrix(1);
      K.set_zero();
      Eigen::VectorXd R = Eigen::VectorXd::Zero(n + 1);
      b.contact.assemble(R, &K, {});
      ASSERT_GT(b.contact.force_scale(), 0.);
      std::mt19937                           random(7);
      std::uniform_real_distribution<double> u(-1, 1);
      Eigen::VectorXd                        direction = Eigen::VectorXd::Zero(n + 1);
      for (unsigned i = 0; i < b.shell.n_nodes(); ++i)
        for (unsigned c = 0; c < 3; ++c)
          direction[b.shell.dof(i, c)] = u(random);
      direction[n]         = u(random);
      const double    h    = 1e-6;
      const auto      move = [&](const double s) {
        b.shell.move(s * direction);
        b.contact.tools()[1].place += s * direction[n] * b.contact.tools()[1].axis;
      };
      move(h);
      const Eigen::VectorXd plus = b.residual();
      move(-2 * h);
      const Eigen::VectorXd minus    = b.residual();
      const Eigen::VectorXd numeric  = (plus - minus) / (2 * h);
      const Eigen::VectorXd analytic = K.multiply(direction);
      // the curvature of the friction direction with the normal is left out of the tangent (order mu p dc / radius)
      EXPECT_LT((numeric - analytic).norm(), 2e-3 * numeric.norm()) << "slide " << slide;
      EXPECT_GT(numeric.norm(), 100.);
    }
}

TEST(Contact, CheckpointRestoresEverything)
{
  Bench a({floor_below()}, 0.2), b({floor_below()}, 0.1);
  a.shift({0, 0, -0.05});
  a.commit();
  a.shift({0.02, 0, 0});
  a.commit();
  Archive archive;
  a.contact.save(archive);
  a.shell.save(archive);
  b.shell.load(archive);
  b.contact.load(archive);
  a.shift({-0.004, 0.01, -0.01});
  b.shift({-0.004, 0.01, -0.01});
  EXPECT_EQ(a.residual(), b.residual());
  EXPECT_EQ(a.contact.friction_work(), b.contact.friction_work());
}
