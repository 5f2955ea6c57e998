#include <tribodraw/base/errors.h>
#include <tribodraw/shell/blank_mesh.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>

using namespace tribodraw;

TEST(BlankMesh, QuarterRectangleCoversTheQuarter)
{
  const BlankMesh mesh = make_quarter_rectangle(3, 2, 6, 4);
  EXPECT_EQ(mesh.nodes.size(), 7u * 5u);        // (6 + 1)(4 + 1) grid points
  EXPECT_EQ(mesh.triangles.size(), 2u * 6 * 4); // two a square
  double area = 0;
  for (const auto &t : mesh.triangles)
    {
      const double twice = (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]).z();
      EXPECT_GT(twice, 0) << "clockwise";
      area += 0.5 * twice;
    }
  EXPECT_NEAR(area, 6, 1e-12);                                  // 3 x 2
  EXPECT_DOUBLE_EQ(mesh.smallest_edge(), 0.5);                  // the squares are 0.5 x 0.5
  EXPECT_NEAR(mesh.largest_edge(), 0.5 * std::sqrt(2.), 1e-15); // and their diagonals
  EXPECT_EQ(mesh.symmetry_factor, 4);
}

TEST(BlankMesh, QuarterRectangleMarksItsSides)
{
  const BlankMesh mesh = make_quarter_rectangle(3, 2, 6, 4);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    {
      EXPECT_EQ(mesh.on_x_plane[i], mesh.nodes[i].x() == 0);
      EXPECT_EQ(mesh.on_y_plane[i], mesh.nodes[i].y() == 0);
      EXPECT_EQ(mesh.on_outer_edge[i], mesh.nodes[i].x() == 3 || mesh.nodes[i].y() == 2);
    }
}

TEST(BlankMesh, DiagonalsAlternate)
{
  // Nodes in the interior of a mesh with alternating diagonals belong to 4 or 8 triangles in turn, with equal
  // diagonals all to 6.
  for (const bool alternating : { true, false })
    {
      std::vector<Eigen::Vector3d> points;
      for (int j = 0; j <= 4; ++j)
        for (int i = 0; i <= 4; ++i)
          points.emplace_back(i, j, 0);
      const BlankMesh       mesh = make_mapped_grid(4, 4, points, alternating);
      std::vector<unsigned> valence(mesh.nodes.size(), 0);
      for (const auto &t : mesh.triangles)
        for (const unsigned node : t)
          ++valence[node];
      for (unsigned j = 1; j < 4; ++j)
        for (unsigned i = 1; i < 4; ++i)
          EXPECT_EQ(valence[5 * j + i], alternating ? ((i + j) % 2 == 0 ? 8u : 4u) : 6u);
    }
}

TEST(BlankMesh, RejectsWhatIsNoMesh)
{
  EXPECT_THROW(make_quarter_rectangle(1, 1, 0, 3), InputError);
  EXPECT_THROW(make_quarter_rectangle(1, -1, 2, 3), InputError);
  EXPECT_THROW(make_mapped_grid(2, 2, {}), InputError);
}
