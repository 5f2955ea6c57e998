#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class CylindricalPunch : public DrawingPunch
    {
    public:
      explicit CylindricalPunch(Parameters &parameters) : DrawingPunch(read_punch(parameters, circle_format())) {}
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, CylindricalPunch, "cylindrical punch",
                     "Circular punch with a flat face and a rounded edge.", "")
} // namespace tribodraw
