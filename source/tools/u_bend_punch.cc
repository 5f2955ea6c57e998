#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class UBendPunch : public DrawingPunch
    {
    public:
      explicit UBendPunch(Parameters &parameters) : DrawingPunch(read_punch(parameters, strip_format())) {}
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, UBendPunch, "U-bend punch",
                     "Punch of bending a strip into a U: constant width, a flat face and rounded edges, endless in y.",
                     "")
} // namespace tribodraw
