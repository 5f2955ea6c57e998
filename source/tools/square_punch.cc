#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class SquarePunch : public DrawingPunch
    {
    public:
      explicit SquarePunch(Parameters &parameters) : DrawingPunch(read_punch(parameters, rounded_rectangle_format())) {}
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, SquarePunch, "square punch",
                     "Rectangular punch with rounded corners, a flat face and a rounded edge.", "")
} // namespace tribodraw
