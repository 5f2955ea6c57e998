#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/triangle_mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <unordered_map>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector3d;

    std::string
    place(const Vector3d &x)
    {
      char text[96];
      std::snprintf(text, sizeof(text), "(%.6g, %.6g, %.6g) mm", x[0], x[1], x[2]);
      return text;
    }

    /// Vertices by cells of space.
    class Cells
    {
    public:
      Cells(const double cell_size, const double same_place) : size(cell_size), tolerance(same_place) {}

      /// The vertex at this place, or nothing.
      int
      find(const std::vector<Vector3d> &vertices, const Vector3d &x) const
      {
        std::int64_t low[3], high[3];
        for (int k = 0; k < 3; ++k)
          {
            low[k]  = index(x[k] - tolerance);
            high[k] = index(x[k] + tolerance);
          }
        for (auto i = low[0]; i <= high[0]; ++i)
          for (auto j = low[1]; j <= high[1]; ++j)
            for (auto k = low[2]; k <= high[2]; ++k)
              {
                const auto [begin, end] = cells.equal_range(key(i, j, k));
                for (auto it = begin; it != end; ++it)
                  if ((vertices[it->second] - x).norm() <= tolerance)
                    return static_cast<int>(it->second);
              }
        return -1;
      }
      void
      add(const Vector3d &x, const unsigned vertex)
      {
        cells.emplace(key(index(x[0]), index(x[1]), index(x[2])), vertex);
      }

    private:
      const double                                     size, tolerance;
      std::unordered_multimap<std::uint64_t, unsigned> cells;

      std::int64_t
      index(const double x) const
      {
        return static_cast<std::int64_t>(std::floor(x / size));
      }
      /// Cells that share a key only cost time.
      static std::uint64_t
      key(const std::int64_t i, const std::int64_t j, const std::int64_t k)
      {
        return static_cast<std::uint64_t>(i) * 73856093u ^ static_cast<std::uint64_t>(j) * 19349669u
               ^ static_cast<std::uint64_t>(k) * 83492791u;
      }
    };
  } // namespace

  void
  weld(TriangleMesh &mesh, const double tolerance)
  {
    Cells                 cells(std::max(8 * tolerance, 1e-12), tolerance);
    std::vector<Vector3d> vertices;
    std::vector<int>      image(mesh.vertices.size(), -1);
    std::size_t           kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      {
        std::array<unsigned, 3> corners = mesh.triangles[t];
        for (unsigned &corner : corners)
          {
            int &vertex = image[corner];
            if (vertex < 0)
              vertex = cells.find(vertices, mesh.vertices[corner]);
            if (vertex < 0)
              {
                vertex = static_cast<int>(vertices.size());
                vertices.push_back(mesh.vertices[corner]);
                cells.add(vertices.back(), static_cast<unsigned>(vertex));
              }
            corner = static_cast<unsigned>(vertex);
          }
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
          continue;
        mesh.triangles[kept] = corners;
        if (!mesh.normals.empty())
          mesh.normals[kept] = mesh.normals[t];
        ++kept;
      }
    mesh.triangles.resize(kept);
    if (!mesh.normals.empty())
      mesh.normals.resize(kept);
    mesh.vertices = std::move(vertices);
  }

  void
  turn_over(TriangleMesh &mesh)
  {
    for (auto &t : mesh.triangles)
      std::swap(t[1], t[2]);
    for (auto &n : mesh.normals)
      {
        std::swap(n[1], n[2]);
        for (Vector3d &normal : n)
          normal *= -1;
      }
  }

  void
  reflect(TriangleMesh &mesh, const int axis)
  {
    double low = 1e300, high = -1e300, size = 0;
    for (const Vector3d &x : mesh.vertices)
      {
        low  = std::min(low, x[axis]);
        high = std::max(high, x[axis]);
        size = std::max(size, (x - mesh.vertices[0]).norm());
      }
    const double same_place = 1e-5 * size;
    if ((low < -same_place && high > same_place) || low > same_place || high < -same_place)
      throw InputError(describe_error("The tool's surface does not end at a plane of symmetry.", mesh.name,
                                      std::string(1, "xy"[axis]) + " from " + units::number(low) + " to "
                                          + units::number(high) + " mm",
                                      "from or up to 0 mm", "`Symmetry` is for files with a half or a quarter only."));
    const auto n_vertices = static_cast<unsigned>(mesh.vertices.size());
    const auto n          = mesh.triangles.size();
    for (unsigned i = 0; i < n_vertices; ++i)
      {
        Vector3d &x = mesh.vertices[i];
        if (std::abs(x[axis]) <= same_place)
          x[axis] = 0;
        Vector3d image = x;
        image[axis] *= -1;
        mesh.vertices.push_back(image);
      }
    for (std::size_t t = 0; t < n; ++t)
      {
        const auto &v = mesh.triangles[t];
        mesh.triangles.push_back({ v[0] + n_vertices, v[2] + n_vertices, v[1] + n_vertices });
        if (!mesh.normals.empty())
          {
            std::array<Vector3d, 3> images{ mesh.normals[t][0], mesh.normals[t][2], mesh.normals[t][1] };
            for (Vector3d &image : images)
              image[axis] *= -1;
            mesh.normals.push_back(images);
          }
      }
    weld(mesh, 1e-7 * size);
  }

  MeshTopology::MeshTopology(const TriangleMesh &mesh) : sides(mesh.triangles.size()), normals(mesh.triangles.size())
  {
    struct Edge
    {
      unsigned      low, high;
      bool          forward;
      std::uint32_t triangle;
      unsigned      k;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      {
        double longest = 0;
        for (unsigned k = 0; k < 3; ++k)
          {
            const unsigned a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            edges.push_back({ std::min(a, b), std::max(a, b), a < b, static_cast<std::uint32_t>(t), k });
            longest = std::max(longest, (mesh.vertices[a] - mesh.vertices[b]).norm());
          }
        const Vector3d area = (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
        // A height of 1e-6 of the length leaves no direction to the normal: the corners are numbers of single
        // precision in most files.
        if (!(area.norm() > 1e-6 * longest * longest))
          throw InputError(describe_error(
              "A triangle of the tool's surface has no area.",
              mesh.name + ", triangle " + std::to_string(t + 1) + " near " + place(mesh.corner(t, 0)),
              "height " + units::number(area.norm() / longest) + " mm on a length of " + units::number(longest) + " mm",
              "", "Repair the surface, or export it with another tolerance."));
        normals[t] = area.normalized();
      }
    std::sort(edges.begin(), edges.end(), [](const Edge &a, const Edge &b) {
      return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    for (std::size_t i = 0; i < edges.size();)
      {
        std::size_t n = 1;
        while (i + n < edges.size() && edges[i + n].low == edges[i].low && edges[i + n].high == edges[i].high)
          ++n;
        const Vector3d middle = 0.5 * (mesh.vertices[edges[i].low] + mesh.vertices[edges[i].high]);
        if (n > 2)
          throw InputError(describe_error("An edge of the tool's surface belongs to more than two triangles.",
                                          mesh.name + ", edge at " + place(middle), std::to_string(n) + " triangles",
                                          "one or two",
                                          "Export a single skin: without inner walls, doubled faces and "
                                          "without the sheet."));
        if (n == 2)
          {
            const Edge &a = edges[i], &b = edges[i + 1];
            if (a.forward == b.forward)
              throw InputError(describe_error(
                  "Two neighbouring triangles of the tool's surface have opposite orientations.",
                  mesh.name + ", edge at " + place(middle),
                  "triangles " + std::to_string(a.triangle + 1) + " and " + std::to_string(b.triangle + 1), "",
                  "Unify the normals before the export: all must point out of the tool (or all into it)."));
            sides[a.triangle][a.k] = { static_cast<int>(b.triangle), b.k };
            sides[b.triangle][b.k] = { static_cast<int>(a.triangle), a.k };
          }
        i += n;
      }
  }

  std::size_t
  MeshTopology::n_border_edges() const
  {
    std::size_t n = 0;
    for (const auto &side : sides)
      n += static_cast<std::size_t>(
          std::count_if(side.begin(), side.end(), [](const Side &s) { return s.triangle < 0; }));
    return n;
  }
} // namespace tribodraw
