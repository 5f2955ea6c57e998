#include <tribodraw/output/tool_surfaces.h>
#include <tribodraw/tools/triangulation.h>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// Around the flat blank and half its length above and below. Not by the punch travel, which a resumed run may
    /// change.
    Eigen::AlignedBox3d
    working_space(const Simulation &simulation)
    {
      Eigen::AlignedBox3d box;
      for (const Vector3d &x : simulation.shell().mesh().nodes)
        box.extend(x);
      const double depth = 0.5 * box.sizes().maxCoeff();
      box.min()[2] -= depth;
      box.max()[2] += depth;
      return box;
    }
  } // namespace

  void
  ToolSurfaces::triangulate_all(const Simulation &simulation)
  {
    // At their places of the start, so that a resumed run gets the same triangles.
    const Eigen::AlignedBox3d box = working_space(simulation);
    for (const ContactTool &tool :
         simulation.tools().place(simulation.blank().thickness, simulation.shell().mesh().nodes))
      {
        shapes.push_back(triangulate({ tool.geometry.get(), tool.place, tool.mirrored }, box));
        for (Vector3d &x : shapes.back().vertices)
          x -= tool.place;
      }
  }

  SurfaceFields
  ToolSurfaces::at_present(const Simulation &simulation)
  {
    SurfaceFields fields;
    auto         &number = fields.cell_scalars["tool"];
    if (simulation.tools_away())
      {
        // A triangle without area: ParaView complains about a file without points.
        fields.points.assign(3, simulation.shell().committed().position.front());
        fields.triangles = { { 0, 1, 2 } };
        number           = { 0. };
        return fields;
      }
    if (shapes.empty())
      triangulate_all(simulation);
    const auto &tools = simulation.contact().tools();
    for (std::size_t t = 0; t < shapes.size(); ++t)
      {
        const auto first = static_cast<unsigned>(fields.points.size());
        for (const Vector3d &x : shapes[t].vertices)
          fields.points.push_back(x + tools[t].place);
        for (const auto &[a, b, c] : shapes[t].triangles)
          fields.triangles.push_back({ first + a, first + b, first + c });
        number.resize(fields.triangles.size(), static_cast<double>(t));
      }
    return fields;
  }
} // namespace tribodraw
