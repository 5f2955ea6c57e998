// The monitor of necking, fed with strains as a part would show them.
#include "unit/forming/steel.h"

#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/necking.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  struct ConstantLimit : FormingLimitCurve
  {
    double limit(double) const override { return 0.4; }
  };

  std::shared_ptr<const SheetMaterial> steel()
  {
    Parameters p     = Parameters::from_text(isotropic_steel);
    const auto scope = p.section("Sheet material");
    return std::make_shared<SheetMaterial>(SheetMaterial::read(p));
  }

  class Necking : public ::testing::Test
  {
  protected:
    Shell          shell{make_quarter_rectangle(40, 40, 4, 4), 1., steel(), 5};
    NeckingMonitor monitor{shell, std::make_shared<ConstantLimit>()};

    /// Plane strain: the sheet has the strain @p around, element 10 has @p here.
    void observe(const double path, const double around, const double here, const double force)
    {
      observe(monitor, path, around, here, force);
    }
    void observe(NeckingMonitor &which, const double path, const double around, const double here, const double force)
    {
      Shell::ElementResults r;
      r.major_strain.assign(shell.n_elements(), around);
      r.minor_strain.assign(shell.n_elements(), 0.);
      r.thickness.assign(shell.n_elements(), std::exp(-around));
      r.major_strain[10] = here;
      r.thickness[10]    = std::exp(-here);
      which.observe(r, path, force);
    }
  };
} // namespace

TEST_F(Necking, LimitForceAndAccelerationTogether)
{
  observe(10, 0.10, 0.20, 100);
  EXPECT_NEAR(monitor.state().ratio, 0.5, 1e-12);
  EXPECT_EQ(monitor.state().element, 10u);
  observe(20, 0.20, 0.42, 110); // the limit is passed, the force still rises
  EXPECT_TRUE(monitor.limit_exceeded());
  EXPECT_FALSE(monitor.necked());
  observe(22, 0.24, 0.46, 111); // 0.02 per mm
  EXPECT_FALSE(monitor.necked());
  observe(24, 0.25, 0.60, 108); // 0.07 per mm, force down by 3 %
  EXPECT_TRUE(monitor.necked());
  EXPECT_EQ(monitor.travel(), 24);
  EXPECT_LT((monitor.place() - monitor.state().place).norm(), 1e-12);
  for (const char *piece : {"24.00 mm", "1.500 times its limit", "97.3 %"})
    EXPECT_NE(monitor.reason().find(piece), std::string::npos) << monitor.reason();
}

// At the end of a drawing the force falls because the flange becomes small; the strain stands still.
TEST_F(Necking, FallingForceAloneIsNone)
{
  observe(10, 0.20, 0.42, 110);
  observe(20, 0.25, 0.44, 100);
  observe(30, 0.27, 0.445, 60);
  observe(40, 0.28, 0.446, 20);
  EXPECT_TRUE(monitor.limit_exceeded());
  EXPECT_FALSE(monitor.necked());
}

TEST_F(Necking, BelowTheLimitIsNone)
{
  observe(10, 0.1, 0.1, 100);
  observe(20, 0.1, 0.15, 90);
  observe(30, 0.1, 0.35, 50);
  EXPECT_FALSE(monitor.necked());
}

TEST_F(Necking, IsKeptInACheckpoint)
{
  observe(20, 0.20, 0.42, 110);
  observe(22, 0.24, 0.46, 111);
  Archive archive;
  monitor.save(archive);
  NeckingMonitor resumed(shell, std::make_shared<ConstantLimit>());
  resumed.load(archive);
  observe(resumed, 24, 0.25, 0.60, 108);
  EXPECT_TRUE(resumed.necked());
}
