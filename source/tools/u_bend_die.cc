#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class UBendDie : public DrawingDie
    {
    public:
      explicit UBendDie(Parameters &parameters) : DrawingDie(read_die(parameters, strip_format())) {}
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, UBendDie, "U-bend die",
                     "Die of bending a strip into a U: an opening of constant width with rounded edges, endless in y.",
                     "")
} // namespace tribodraw
