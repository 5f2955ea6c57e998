#include <tribodraw/base/errors.h>
#include <tribodraw/shell/blank_mesh.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <fstream>
#include <unistd.h>

using namespace tribodraw;

namespace
{
  /// A rectangle 2 x 1 in metres at z = 0.5: a square as quadrangle, a square as two triangles, one of them clockwise;
  /// a node nobody uses, points and lines.
  const std::string old_format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"sheet\"\n"
                                 "$EndPhysicalNames\n$Nodes\n7\n1 0 0 0.5\n2 1 0 0.5\n3 2 0 0.5\n4 0 1 0.5\n5 1 1 0.5\n"
                                 "6 2 1 0.5\n99 7 7 7\n$EndNodes\n$Elements\n5\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n"
                                 "3 3 2 7 1 1 2 5 4\n4 2 2 7 1 2 3 6\n5 2 2 7 1 2 5 6\n$EndElements\n";
  const std::string new_format
      = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 2 1 0 0 0\n$EndEntities\n$Nodes\n2 6 1 6\n"
        "0 1 0 1\n1\n0 0 0.5\n2 1 0 5\n2\n3\n4\n5\n6\n1 0 0.5\n2 0 0.5\n0 1 0.5\n1 1 0.5\n2 1 0.5\n$EndNodes\n"
        "$Elements\n2 3 1 3\n2 1 3 1\n1 1 2 5 4\n2 1 2 2\n2 2 3 6\n3 2 5 6\n$EndElements\n";

  BlankMesh
  read(const std::string &text, const double unit = 1000)
  {
    const auto file = std::filesystem::temp_directory_path() / ("tribodraw_gmsh_" + std::to_string(getpid()) + ".msh");
    std::ofstream(file) << text;
    try
      {
        BlankMesh mesh = read_blank_mesh(file, unit);
        std::filesystem::remove(file);
        return mesh;
      }
    catch (...)
      {
        std::filesystem::remove(file);
        throw;
      }
  }

  std::string
  with(std::string text, const std::string &old_part, const std::string &new_part)
  {
    const auto at = text.find(old_part);
    EXPECT_NE(at, std::string::npos) << old_part;
    return text.replace(at, old_part.size(), new_part);
  }

  /// The message of the refusal.
  std::string
  message(const std::string &text)
  {
    try
      {
        read(text);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "accepted";
  }
} // namespace

TEST(Gmsh, BothFormatsGiveTheSameMesh)
{
  for (const std::string &text : { old_format, new_format })
    {
      const BlankMesh mesh = read(text);
      ASSERT_EQ(mesh.nodes.size(), 6u); // the unused one is dropped
      ASSERT_EQ(mesh.triangles.size(), 4u);
      double area = 0;
      for (const auto &t : mesh.triangles)
        {
          const double twice = (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]).z();
          EXPECT_GT(twice, 0); // the clockwise triangle is turned
          area += 0.5 * twice;
        }
      EXPECT_NEAR(area, 2e6, 1e-6);       // 2000 x 1000 mm
      EXPECT_EQ(mesh.symmetry_factor, 4); // boundary on x = 0 and y = 0
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        {
          EXPECT_EQ(mesh.nodes[i].z(), 0);
          EXPECT_EQ(mesh.on_x_plane[i], mesh.nodes[i].x() == 0);
          EXPECT_EQ(mesh.on_y_plane[i], mesh.nodes[i].y() == 0);
          EXPECT_EQ(mesh.on_outer_edge[i], mesh.nodes[i].x() == 2000 || mesh.nodes[i].y() == 1000);
        }
    }
}

TEST(Gmsh, SymmetryNeedsAMeshOnOneSide)
{
  // Node 4 beyond the plane x = 0: only y = 0 remains.
  const BlankMesh mesh = read(with(old_format, "4 0 1 0.5", "4 -0.2 1 0.5"));
  EXPECT_EQ(mesh.symmetry_factor, 2);
}

TEST(Gmsh, MistakesAreNamedWithTheirLine)
{
  const std::vector<std::array<std::string, 3>> mistakes{
    // old part, new part, what the message must contain
    { "2 1 0 0.5", "2 1 0", "line 11" },
    { "2 1 0 0.5", "2 1 zero 0.5", "'zero'" },
    { "2 1 0 0.5", "1 1 0 0.5", "same number" },
    { "2 1 0 0.5", "2 nan 0 0.5", "not a number" },
    { "$Nodes\n7", "$Nodes\n8", "not a number" },
    { "$Nodes\n7", "$Nodes\n6", "longer than its head" },
    { "$Nodes\n7", "$Nodes\n700000000000", "size of the file" },
    { "$Nodes\n7", "$Nodes\n-1", "size of the file" },
    { "2.2 0 8", "2.1 0 8", "version" },
    { "2.2 0 8", "2.2 1 8", "Binary" },
    { "1 2 3 6", "1 2 3 60", "does not exist" },
    { "1 2 3 6", "1 2 3", "wrong number of nodes" },
    { "1 2 3 6", "1 2 3 3", "no area" },
    { "4 2 2 7", "4 4 2 7", "Gmsh type 4" },
    { "6 2 1 0.5", "6 2 1 0.9", "plane" },
    { "$EndElements\n", "", "ends where" },
    { "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "", "must come first" },
    { "3 3 2 7 1 1 2 5 4\n4 2 2 7 1 2 3 6\n5 2 2 7 1 2 5 6", "3 1 0 1 2\n4 1 0 1 2\n5 1 0 1 2", "no triangles" },
    { "5 2 2 7 1 2 5 6", "5 2 2 7 1 2 3 6", "more than two" },
  };
  for (const auto &mistake : mistakes)
    {
      const std::string text = message(with(old_format, mistake[0], mistake[1]));
      EXPECT_NE(text.find(mistake[2]), std::string::npos) << mistake[1] << ": " << text;
    }
  // Coincident nodes along the seam between the squares.
  const std::string seam
      = with(with(with(with(old_format, "$Nodes\n7", "$Nodes\n8"), "99 7 7 7", "98 1 0 0.5\n99 1 1 0.5"), "1 2 3 6",
                  "1 98 3 6"),
             "1 2 5 6", "1 98 99 6");
  EXPECT_NE(message(seam).find("same place"), std::string::npos) << message(seam);
  // A node lost in space: the other edges are nothing against the size of the mesh.
  const std::string lost = with(with(with(old_format, "6 2 1 0.5", "6 2 1e30 0.5"), "$Elements\n5", "$Elements\n4"), "5 2 2 7 1 2 5 6\n", "");
  EXPECT_NE(message(lost).find("no length"), std::string::npos) << message(lost);
  EXPECT_NE(message("").find("no triangles"), std::string::npos);
  EXPECT_NE(message("hello\n").find("line 1"), std::string::npos);
  EXPECT_THROW(read_blank_mesh("/nowhere/mesh.msh"), InputError);
}

TEST(Gmsh, EveryShortenedFileIsRefused)
{
  // Whatever is cut off up to the last element: an InputError and nothing else.
  for (const std::string &text : { old_format, new_format })
    for (std::size_t n = 0; n + 14 < text.size(); ++n)
      EXPECT_THROW(read(text.substr(0, n)), InputError) << n;
}
