#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/smooth_surface.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// An octahedron blown up to a ball: stands in where there is no file.
    TriangleMesh
    example()
    {
      TriangleMesh mesh;
      mesh.name          = "an example";
      constexpr int    n = 10;
      constexpr double r = 50;
      for (const double sx : { -1., 1. })
        for (const double sy : { -1., 1. })
          for (const double sz : { -1., 1. })
            {
              const auto node = [&](const int i, const int j) {
                return (r * Eigen::Vector3d(sx * i, sy * j, sz * (n - i - j)).normalized()).eval();
              };
              const auto add = [&](const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &c) {
                const auto first = static_cast<unsigned>(mesh.vertices.size());
                mesh.vertices.insert(mesh.vertices.end(), { a, b, c });
                if ((b - a).cross(c - a).dot(a) > 0)
                  mesh.triangles.push_back({ first, first + 1, first + 2 });
                else
                  mesh.triangles.push_back({ first, first + 2, first + 1 });
              };
              for (int i = 0; i < n; ++i)
                for (int j = 0; i + j < n; ++j)
                  {
                    add(node(i, j), node(i + 1, j), node(i, j + 1));
                    if (i + j < n - 1)
                      add(node(i + 1, j + 1), node(i + 1, j), node(i, j + 1));
                  }
            }
      weld(mesh, 1e-4);
      return mesh;
    }

    class TriangleSurface : public SmoothSurface
    {
    public:
      explicit TriangleSurface(Parameters &p) : TriangleSurface(read(p)) {}

    private:
      struct Input
      {
        TriangleMesh mesh;
        Options      options;
      };
      explicit TriangleSurface(const Input &input) : SmoothSurface(input.mesh, input.options) {}

      static Input
      read(Parameters &p)
      {
        Input      input;
        const auto file = p.input_file(
            "File",
            "STL (ASCII or binary), OBJ, or a mesh of Gmsh (.msh), Abaqus (.inp) or LS-DYNA (.k, .key, .dyn), z upwards. It may be a skin without a back; beyond its border it goes "
            "on along its tangent planes.");
        const double unit
            = p.quantity("Unit", "mm", Range::positive(),
                         "Length of one unit of the file, which the formats do not state: `1 mm`, `1 m`.");
        const auto part = p.text("Part",
                                 "Mesh of a finite-element program: the part that is this tool: name or number of a physical "
                                 "group (Gmsh), name of a part, an instance or an element set (Abaqus), number or title of "
                                 "a part (LS-DYNA).",
                                 Default{ "", "the file holds nothing but this tool" });
        const bool reversed = p.choice("Normals", { "out of the tool", "into the tool" },
                                       "Where the normals of the triangles point (by the order of their corners).",
                                       Default{ "out of the tool", "the rule of the formats" })
                              == "into the tool";
        const std::string symmetry
            = p.choice("Symmetry", { "none", "x = 0", "y = 0", "x = 0 and y = 0" },
                       "Planes at which the file ends, because it holds a half or a quarter of the tool; the rest is "
                       "added by reflection, which also makes the surface smooth across the planes.",
                       Default{ "none", "the file holds the whole tool" });
        input.options.feature_angle
            = p.quantity("Feature angle", "deg", Range::between(1, 80),
                         "Neighbouring triangles at a larger angle form a sharp edge; at a smaller one they are taken "
                         "for pieces of a smooth surface.",
                         Default{ "35 deg", "a quarter circle in three pieces is still smooth" });
        input.options.keep_sharp_edges
            = p.choice("Sharp edges", { "refuse", "keep" },
                       "`refuse`: an error that names their place. `keep`: for edges that the sheet does not touch.",
                       Default{ "refuse", "the sheet would tear at them" })
              == "keep";
        if (p.documentation_mode() || file.empty() || !(unit > 0))
          input.mesh = example();
        else
          {
            input.mesh = read_triangles(file, unit, part);
            if (reversed)
              turn_over(input.mesh);
            if (symmetry.find('x') != std::string::npos)
              reflect(input.mesh, 0);
            if (symmetry.find('y') != std::string::npos)
              reflect(input.mesh, 1);
          }
        return input;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(ToolGeometry, TriangleSurface, "triangle surface",
                     "Any shape from a file of triangles (STL, OBJ, meshes of Gmsh, Abaqus, LS-DYNA), smoothed between their corners.",
                     "D. Walton, D. Meek, Comput. Aided Des. 28 (1996) 113-123")
} // namespace tribodraw
