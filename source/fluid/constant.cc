#include <tribodraw/base/parameters.h>
#include <tribodraw/fluid/viscosity_law.h>

namespace tribodraw
{
  namespace
  {
    class ConstantViscosity : public ViscosityLaw
    {
    public:
      explicit ConstantViscosity(Parameters &) {}

      Value
      viscosity(double, double) const override
      {
        return { reference, 0 };
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(ViscosityLaw, ConstantViscosity, "constant",
                     "The same viscosity at every pressure and shear rate.", "")
} // namespace tribodraw
