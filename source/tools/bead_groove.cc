#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class GroovedPlate : public BeadGroove
    {
    public:
      explicit GroovedPlate(Parameters &p) : GroovedPlate(read_outline(p), read_size(p)) {}

    private:
      struct Size
      {
        double width, edge;
      };
      GroovedPlate(std::shared_ptr<const Outline> line, const Size &size)
          : BeadGroove(std::move(line), size.width, size.edge)
      {
      }

      static Size
      read_size(Parameters &p)
      {
        const Range  usual = Range::positive().usual(0.1, 100);
        const double width = p.quantity("Groove width", "mm", usual, "Distance of the groove's walls.");
        const double edge
            = p.quantity("Edge radius", "mm", usual, "Radius of the groove's edges, over which the sheet is drawn.");
        return p.documentation_mode() || !(width > 0 && edge > 0) ? Size{ 10, 3 } : Size{ width, edge };
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, GroovedPlate, "bead groove",
                     "A plate with a groove for a bead along an outline; faces up: upside down it is a blank holder.",
                     "")
} // namespace tribodraw
