#ifndef tribodraw_tests_tools_triangle_samples_h
#define tribodraw_tests_tools_triangle_samples_h

#include "faceted_tools.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <unistd.h>

/// Files of triangles, written here from the formats' definitions.
namespace triangle_samples
{
  using tribodraw::TriangleMesh;

  /// A circular punch of 60 mm with an edge of 8 mm, coarse, without a top: a skin.
  inline TriangleMesh
  punch()
  {
    std::vector<Eigen::Vector2d> section; // outwards from the wall; the wall ends 20 mm above the face
    for (int i = 0; i <= 3; ++i)
      section.emplace_back(-8 + 8 * std::sin(M_PI / 6 * i), 8 - 8 * std::cos(M_PI / 6 * i));
    section.emplace_back(0, 20);
    section.insert(section.begin(), { { -30, 0 }, { -20, 0 } });
    TriangleMesh mesh = faceted::sweep(faceted::circle(30, 24), section, true);
    tribodraw::turn_over(mesh); // the sweep's normals are those of a die
    return mesh;
  }

  inline std::string
  ascii_stl(const TriangleMesh &mesh)
  {
    std::string text = "solid tool\n";
    char        line[128];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (unsigned k = 0; k < 3; ++k)
          {
            const Eigen::Vector3d x = mesh.corner(t, k);
            std::snprintf(line, sizeof(line), "      vertex %.8e %.8e %.8e\n", x[0], x[1], x[2]);
            text += line;
          }
        text += "    endloop\n  endfacet\n";
      }
    return text + "endsolid tool\n";
  }

  template <class Number>
  void
  append(std::string &bytes, const Number value)
  {
    char raw[sizeof(Number)];
    std::memcpy(raw, &value, sizeof(Number)); // the tests run on little-endian machines
    bytes.append(raw, sizeof(Number));
  }

  inline std::string
  binary_stl(const TriangleMesh &mesh)
  {
    std::string bytes(80, ' ');
    append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      {
        for (int k = 0; k < 3; ++k)
          append(bytes, 0.f);
        for (unsigned k = 0; k < 3; ++k)
          for (int c = 0; c < 3; ++c)
            append(bytes, static_cast<float>(mesh.corner(t, k)[c]));
        append(bytes, static_cast<std::uint16_t>(0));
      }
    return bytes;
  }

  inline std::string
  obj(const TriangleMesh &mesh, const bool with_normals)
  {
    std::string text = "o tool\n";
    char        line[128];
    for (const Eigen::Vector3d &x : mesh.vertices)
      {
        std::snprintf(line, sizeof(line), "v %.8e %.8e %.8e\n", x[0], x[1], x[2]);
        text += line;
      }
    if (with_normals)
      for (const auto &n : mesh.normals)
        for (const Eigen::Vector3d &x : n)
          {
            std::snprintf(line, sizeof(line), "vn %.8e %.8e %.8e\n", x[0], x[1], x[2]);
            text += line;
          }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      {
        text += "f";
        for (unsigned k = 0; k < 3; ++k)
          {
            text += " " + std::to_string(mesh.triangles[t][k] + 1);
            if (with_normals)
              text += "//" + std::to_string(3 * t + k + 1);
          }
        text += "\n";
      }
    return text;
  }

  /// A file while this object lives.
  class File
  {
  public:
    File(const std::string &content, const std::string &extension)
        : path(std::filesystem::temp_directory_path()
               / ("tribodraw_triangles_" + std::to_string(getpid()) + "_" + std::to_string(counter()++) + extension))
    {
      std::ofstream(path, std::ios::binary) << content;
    }
    ~File() { std::filesystem::remove(path); }
    File(const File &)            = delete;
    File &operator=(const File &) = delete;

    const std::filesystem::path path;

  private:
    static int &
    counter()
    {
      static int n = 0;
      return n;
    }
  };
} // namespace triangle_samples

#endif
