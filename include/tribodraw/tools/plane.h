#ifndef tribodraw_tools_plane_h
#define tribodraw_tools_plane_h

#include <tribodraw/tools/shape_entries.h>
#include <tribodraw/tools/tool_geometry.h>

namespace tribodraw
{
  class Parameters;

  /// The plane z = 0 as a flat tool: a blank holder (faces down, its body is above) or a plate (faces up).
  class Plane : public ToolGeometry
  {
  public:
    explicit Plane(Facing facing);
    /// Entry `Facing`.
    explicit Plane(Parameters &parameters);
    ToolDistance distance(const Eigen::Vector3d &x) const override;
    double       smallest_radius() const override;
    std::string  describe() const override;

  private:
    double normal; ///< its z component
  };
} // namespace tribodraw

#endif
