// Contact of nodes with rigid tools: law, Coulomb friction, exact tangent, energies.
#include <tribodraw/contact/contact.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/material/sheet_material.h>

#include "claims.h"

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
    Bench(std::vector<ContactTool> tools, const double mu, const bool initial_thickness = false)
      : shell(make_quarter_rectangle(4, 4, 2, 2), thickness,
              std::make_shared<SheetMaterial>(2.1e5, 0.3, std::make_shared<Elastic>(), std::make_shared<Strong>()), 3)
      , contact(shell, std::move(tools), {1000., 0.02, 0.01, initial_thickness})
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
    /// Turn all directors at random, the sheet stays flat.
    void bend(const double angle)
    {
      std::mt19937                           random(11);
      std::uniform_real_distribution<double> u(-angle, angle);
      Eigen::VectorXd                        du = Eigen::VectorXd::Zero(shell.n_dofs());
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        for (unsigned c = 3; c < 5; ++c)
          du[shell.dof(i, c)] = u(random);
      shell.move(du);
    }
    /// Onto a cylinder of radius @p R around an axis along y.
    void roll(const double R)
    {
      auto c = shell.trial();
      for (unsigned i = 0; i < shell.n_nodes(); ++i)
        {
          const double angle = c.position[i][0] / R;
          c.director[i]      = {std::sin(angle), 0, std::cos(angle)};
          c.position[i]      = Vector3d(0, c.position[i][1], 0) + R * c.director[i];
        }
      shell.set_trial(c);
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
  EXPECT_TRUE(claims::agrees("force of a plate pressed on a plane, N", "area times stiffness times penetration", -b.contact.tool_forces()[0][2], 16 * 1000. * 0.06, 1e-9));
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
  EXPECT_TRUE(claims::agrees("friction work of a sliding plate, N mm", "Coulomb force times way", b.contact.friction_work(), mu * normal * (0.5 * 1.005 + 1.), 1e-9));
  // sliding back by twice the elastic slip turns the force around
  b.shift({-0.016, -0.012, 0});
  b.residual();
  EXPECT_NEAR(b.contact.tool_forces()[0][0], -0.8 * mu * normal, 1e-9);
}

// The sheet is stretched by 1 % both ways, so that it thins by 2 nu / (1 - nu) %: its face leaves the floor by half of that, unless
// the initial thickness is asked for.
TEST(Contact, FacesFollowTheCurrentThicknessOrNot)
{
  for (const bool initial : {false, true})
    {
      Bench b({floor_below()}, 0., initial);
      auto  c = b.shell.trial();
      for (auto &x : c.position)
        x = Vector3d(1.01 * x[0], 1.01 * x[1], -0.05);
      b.shell.set_trial(c);
      b.commit();
      b.residual();
      // logarithmic strains; area 16 mm^2 stretched
      const double thinner = thickness * (1 - std::exp(-2 * 0.3 / 0.7 * std::log(1.01)));
      const double gap     = initial ? 0.05 : 0.05 - 0.5 * thinner;
      EXPECT_NEAR(b.contact.tool_forces()[0][2], -16 * 1.01 * 1.01 * 1000. * gap, 1e-3) << initial;
    }
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

namespace
{
  /// Derivative of the residual along a random direction of all unknowns, by central differences and by the tangent.
  double
  tangent_error(Bench &b, const double h)
  {
    const unsigned   n = b.shell.n_dofs(), n_free = b.n_free();
    Contact::Tangent K(b.shell, n_free);
    Eigen::VectorXd  R = Eigen::VectorXd::Zero(n + n_free);
    b.contact.assemble(R, &K, {});
    EXPECT_GT(b.contact.force_scale(), 0.);
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    Eigen::VectorXd                        direction = Eigen::VectorXd::NullaryExpr(n + n_free, [&] { return u(random); });
    const auto                             start     = b.shell.trial();
    const auto                             tools     = b.contact.tools();
    const auto                             residual  = [&](const double s) {
      b.shell.set_trial(start);
      b.shell.move(s * direction);
      b.contact.tools() = tools;
      for (auto &t : b.contact.tools())
        if (t.free_index >= 0)
          t.place += s * direction[n + t.free_index] * t.axis;
      return b.residual();
    };
    const Eigen::VectorXd numeric = (residual(h) - residual(-h)) / (2 * h);
    Eigen::VectorXd       analytic(n + n_free);
    analytic.head(n)      = K.sheet.multiply(direction.head(n)) + K.column * direction.tail(n_free);
    analytic.tail(n_free) = K.row.transpose() * direction.head(n) + K.corner * direction.tail(n_free);
    EXPECT_GT(numeric.norm(), 100.);
    b.shell.set_trial(start);
    b.contact.tools() = tools;
    return (numeric - analytic).norm() / numeric.norm();
  }
} // namespace

// Consistent linearisation of every term: both faces, several tools, bent sheet, sticking and sliding, a coefficient that
// depends on pressure, a free tool that moves obliquely. Central differences leave h^2 and round-off / h.
TEST(Contact, TangentIsExact)
{
  ContactTool ball{"ball", std::make_shared<Ball>(Vector3d(1.3, 0.9, -6.), 6. - thickness / 2 + 0.08), Vector3d::Zero(), Face::die_side};
  ContactTool small{"small ball", std::make_shared<Ball>(Vector3d(3.1, 3.2, -1.), 1. - thickness / 2 + 0.06), Vector3d::Zero(), Face::die_side};
  ContactTool lid{"lid", std::make_shared<Ball>(Vector3d(2.5, 2.2, -7.), 7. - thickness / 2 + 0.05), Vector3d::Zero(), Face::punch_side, true, 0, Vector3d(0.36, 0.48, -0.8)};
  for (const double slide : {0.002, 0.3})
    for (const double slope : {0., -2e-4})
      {
        Bench b({ball, small, lid}, 0.15);
        for (const Face f : {Face::punch_side, Face::die_side})
          b.contact.set_friction(f, std::vector<double>(b.shell.n_nodes(), 0.15), std::vector<double>(b.shell.n_nodes(), slope),
                                 std::vector<double>(b.shell.n_nodes(), 20.));
        b.bend(0.05);
        b.commit();
        b.shift({slide, -0.6 * slide, -0.003});
        b.contact.tools()[2].place[2] += 0.004;
        EXPECT_LT(tangent_error(b, 1e-6), 1e-6) << "slide " << slide << ", slope " << slope;
      }
}

// The same against every shape of tool that the program knows, at places where the sheet leans on a random part of it.
TEST(Contact, TangentIsExactForEveryToolShape)
{
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> anywhere(-60, 60);
  for (const auto &[name, entry] : Registry<ToolGeometry>::entries())
    {
      Parameters                                parameters = Parameters::for_documentation();
      const std::shared_ptr<const ToolGeometry> shape      = entry.create(parameters);
      for (unsigned trial = 0; trial < 6; ++trial)
        {
          // a point of the surface, which a node of the sheet penetrates by 0.05 mm
          Vector3d x(anywhere(random), anywhere(random), anywhere(random));
          for (unsigned k = 0; k < 20; ++k)
            {
              const ToolDistance d = shape->distance(x);
              x -= d.distance * d.normal;
            }
          const ToolDistance at = shape->distance(x);
          if (std::abs(at.distance) > 1e-9)
            continue; // beyond a medial axis
          ContactTool tool{"tool", shape, Vector3d::Zero(), Face::die_side, trial % 2 == 1};
          Vector3d    touching = x + (thickness / 2 - 0.05) * at.normal;
          if (tool.mirrored)
            touching[2] = -touching[2];
          Bench b({tool}, 0.15);
          b.bend(0.02);
          b.contact.tools()[0].place = b.shell.trial().position[4] - touching;
          b.commit();
          b.shift({0.05, -0.03, 0.004});
          EXPECT_LT(tangent_error(b, 1e-6), 1e-6) << name << " at " << x.transpose();
        }
    }
}

// The middle of a side lies on the circle through the nodes whose normals are the directors. With the half angle a = L/(2R)
// the formula gives R/2 sin(a)^2 cos(a) for the sagitta R (1 - cos a): less by the part 3/4 a^2 = 3/16 (L/R)^2 of it in
// leading order. Here L = 2 in the direction of the circle and R = 20.
TEST(Contact, MidSidesLieOnTheCurvedSheet)
{
  Bench        b({floor_below()}, 0.);
  const double R = 20;
  b.roll(R);
  const ContactPoints points(b.shell);
  double              largest = 0;
  for (unsigned k = 0; k < points.size(); ++k)
    {
      const Vector3d x = points.position(b.shell.trial(), k);
      largest          = std::max(largest, std::abs(std::hypot(x[0], x[2]) - R));
    }
  EXPECT_LT(largest, 3.01 / 16 * 4 / (R * R) * 4 / (8 * R));
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
