#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class CrossPunch : public DrawingPunch
    {
    public:
      explicit CrossPunch(Parameters &parameters) : DrawingPunch(read_punch(parameters, cross_format())) {}
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, CrossPunch, "cross punch", "Cross-shaped punch with a flat face and a rounded edge.",
                     "")
} // namespace tribodraw
