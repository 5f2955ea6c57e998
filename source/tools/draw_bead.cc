#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    class Bead : public DrawBead
    {
    public:
      explicit Bead(Parameters &p) : Bead(read_outline(p), read_radius(p)) {}

    private:
      Bead(std::shared_ptr<const Outline> line, const double radius) : DrawBead(std::move(line), radius) {}

      static double
      read_radius(Parameters &p)
      {
        const double radius = p.quantity("Bead radius", "mm", Range::positive().usual(0.1, 50),
                                         "Radius of the bead's section; its top touches the sheet.");
        return p.documentation_mode() || !(radius > 0) ? 4 : radius;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, Bead, "draw bead",
                     "A ridge of circular section along an outline; faces up, a further tool beside the die.", "")
} // namespace tribodraw
