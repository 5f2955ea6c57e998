#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class SquareDie : public DrawingDie
    {
    public:
      explicit SquareDie(Parameters &parameters) : DrawingDie(read_die(parameters, rounded_rectangle_format())) {}
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, SquareDie, "square die",
                     "Die with a rectangular opening, rounded corners and a rounded edge.", "")
} // namespace tribodraw
