#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class CrossDie : public DrawingDie
    {
    public:
      explicit CrossDie(Parameters &parameters) : DrawingDie(read_die(parameters, cross_format())) {}
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, CrossDie, "cross die", "Die with a cross-shaped opening and a rounded edge.", "")
} // namespace tribodraw
