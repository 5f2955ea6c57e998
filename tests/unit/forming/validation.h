#ifndef tribodraw_tests_unit_forming_validation_h
#define tribodraw_tests_unit_forming_validation_h

#include "claims.h"

#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/increment_solver.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw::test
{
  using Eigen::Vector3d;

  /// A cylinder along y (a drum) or a sphere around the origin of its frame.
  class Round : public ToolGeometry
  {
  public:
    Round(const double r, const bool sphere)
      : radius(r)
      , keep(1, sphere ? 1 : 0, 1)
    {}
    ToolDistance distance(const Vector3d &x) const override
    {
      const Vector3d flat = keep.cwiseProduct(x);
      const double   r    = flat.norm();
      const Vector3d n    = r > 0 ? Vector3d(flat / r) : Vector3d::UnitZ();
      return {r - radius, n, (Eigen::Matrix3d(keep.asDiagonal()) - n * n.transpose()) / std::max(r, 1e-9)};
    }
    double      smallest_radius() const override { return radius; }
    std::string describe() const override { return "round"; }

  private:
    double   radius;
    Vector3d keep;
  };

  inline std::shared_ptr<const SheetMaterial>
  material(const std::string &strength, const std::string &initial_strain, const std::string &exponent, const std::string &poisson = "0.3")
  {
    Parameters p = Parameters::from_text("set Accept unusual values = Poisson's ratio, Swift/Initial strain\nset Young's modulus = 200 GPa\nset Poisson's ratio = " + poisson +
                                         "\nset Yield locus = von Mises\nset Hardening = Swift\nsubsection Swift\nset Strength coefficient = " + strength +
                                         " MPa\nset Initial strain = " + initial_strain + "\nset Hardening exponent = " + exponent + "\nend\n");
    auto m = std::make_shared<SheetMaterial>(SheetMaterial::read(p));
    p.finish();
    return m;
  }

  inline SolverSettings
  tight(const double elastic_slip = 0.01)
  {
    SolverSettings s;
    s.contact.stick_slip     = elastic_slip;
    s.residual_tolerance     = 1e-6;
    s.displacement_tolerance = 1e-4;
    s.max_iterations         = 60;
    return s;
  }

  /// Accepts what has been solved.
  inline void
  advance(Shell &shell, Contact &contact, IncrementSolver &solver, const IncrementSolver::Load &load, const char *what)
  {
    const auto outcome = solver.solve(load);
    ASSERT_TRUE(outcome.converged) << what << ": " << outcome.reason << ", residual " << outcome.residual;
    shell.commit();
    contact.commit();
  }
} // namespace tribodraw::test

#endif
