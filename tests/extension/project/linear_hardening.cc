#include <tribodraw/application/program.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/material/hardening_law.h>

using namespace tribodraw;

/// sigma = s0 + H eps.
struct LinearHardening : HardeningLaw
{
  explicit LinearHardening(Parameters &p)
      : s0(p.quantity("Yield stress", "MPa", Range::positive(), "Stress at zero plastic strain.")),
        H(p.quantity("Hardening modulus", "MPa", Range::non_negative(), "Slope of the flow curve."))
  {
  }
  FlowStress flow_stress(double strain, double) const override { return { s0 + H * strain, H, 0 }; }
  const double s0, H;
};
TRIBODRAW_REGISTER(HardeningLaw, LinearHardening, "linear", "Linear hardening.", "")

int main(int argc, char **argv) { return run_program(argc, argv); }
