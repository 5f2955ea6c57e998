#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class CylindricalDie : public DrawingDie
    {
    public:
      explicit CylindricalDie(Parameters &parameters) : DrawingDie(read_die(parameters, circle_format())) {}
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, CylindricalDie, "cylindrical die", "Die with a circular opening and a rounded edge.",
                     "")
} // namespace tribodraw
