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

namespace
{
  double
  area(const BlankMesh &mesh)
  {
    double sum = 0;
    for (const auto &t : mesh.triangles)
      {
        const double twice = (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]).z();
        EXPECT_GT(twice, 0) << "clockwise";
        sum += 0.5 * twice;
      }
    return sum;
  }

  /// Smallest angle of all triangles [degrees].
  double
  smallest_angle(const BlankMesh &mesh)
  {
    double largest_cosine = -1;
    for (const auto &t : mesh.triangles)
      for (unsigned k = 0; k < 3; ++k)
        {
          const Eigen::Vector3d u = (mesh.nodes[t[(k + 1) % 3]] - mesh.nodes[t[k]]).normalized();
          const Eigen::Vector3d v = (mesh.nodes[t[(k + 2) % 3]] - mesh.nodes[t[k]]).normalized();
          largest_cosine          = std::max(largest_cosine, u.dot(v));
        }
    return std::acos(largest_cosine) * 180 / M_PI;
  }
} // namespace

TEST(OutlineMesh, QuarterDisc)
{
  SizeField size;
  size.size            = 2;
  const BlankMesh mesh = make_disc(50, size, true);
  // A polygon in the arc: chords of 2 mm on radius 50 cut off a share of (2/50)^2 / 6.
  EXPECT_NEAR(area(mesh) / (0.25 * M_PI * 2500), 1, 1.2 * 0.0016 / 6);
  EXPECT_GT(smallest_angle(mesh), 30);
  EXPECT_LT(mesh.largest_edge(), 1.8 * 2);
  EXPECT_GT(mesh.smallest_edge(), 0.6 * 2);
  // Equilateral triangles of 2 mm would be 1134.
  EXPECT_GT(mesh.triangles.size(), 900u);
  EXPECT_LT(mesh.triangles.size(), 1400u);
  unsigned on_x = 0, on_y = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    {
      on_x += mesh.on_x_plane[i];
      on_y += mesh.on_y_plane[i];
      EXPECT_EQ(mesh.on_outer_edge[i], std::abs(mesh.nodes[i].norm() - 50) < 1e-9);
    }
  EXPECT_EQ(on_x, 26u); // 50 / 2 + 1
  EXPECT_EQ(on_y, 26u);
  EXPECT_EQ(mesh.symmetry_factor, 4);
}

TEST(OutlineMesh, ZonesAreFineAndTheRestIsCoarse)
{
  SizeField size;
  size.size            = 4;
  size.zones           = { { { 20, 10 }, { 30, 30 }, 0.8 } };
  const BlankMesh mesh = make_outline_mesh({ { 0, 0 }, { 60, 0 }, { 60, 40 }, { 0, 40 } }, size, true);
  EXPECT_NEAR(area(mesh), 2400, 1e-9); // 60 x 40
  EXPECT_GT(smallest_angle(mesh), 22);
  double inside = 0, outside = 0;
  for (const auto &t : mesh.triangles)
    for (unsigned k = 0; k < 3; ++k)
      {
        const Eigen::Vector3d &a = mesh.nodes[t[k]], &b = mesh.nodes[t[(k + 1) % 3]];
        const Eigen::Vector2d  m      = 0.5 * (a + b).head<2>();
        const double           length = (a - b).norm();
        if (m[0] > 20 && m[0] < 30 && m[1] > 10 && m[1] < 30)
          inside = std::max(inside, length);
        if (m[0] > 50)
          outside = std::max(outside, length);
        EXPECT_LT(length, 2 * size.at(m));
      }
  EXPECT_LT(inside, 1.5 * 0.8);
  EXPECT_GT(outside, 3);
}

TEST(OutlineMesh, ManyOutlines)
{
  SizeField size;
  size.size                                         = 3;
  const double                                    f = std::sqrt(0.5);
  const std::vector<std::vector<Eigen::Vector2d>> outlines{
    { { 0, 0 }, { 40, 0 }, { 40, 20 }, { 20, 40 }, { 0, 40 } },             // cut corner
    { { 0, 0 }, { 40, 0 }, { 40, 15 }, { 15, 15 }, { 15, 40 }, { 0, 40 } }, // L, re-entrant
    { { 10, 0 }, { 40, 0 }, { 0, 40 }, { 0, 10 }, { 10 * f, 10 * f } },     // with a hole at the origin
    { { 0, 0 }, { 33.3, 0 }, { 47.1, 21.7 }, { 12.9, 39.9 }, { 0, 31.4 } }, // irregular
  };
  for (const auto &outline : outlines)
    {
      double exact = 0;
      for (std::size_t i = 0; i < outline.size(); ++i)
        {
          const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
          exact += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        }
      const BlankMesh mesh = make_outline_mesh(outline, size, true);
      EXPECT_NEAR(area(mesh), exact, 1e-9 * exact);
      EXPECT_GT(smallest_angle(mesh), 22);
    }
  EXPECT_NEAR(area(make_disc(20, size, false)), M_PI * 400, 0.01 * M_PI * 400);
}

TEST(OutlineMesh, RefusesWhatIsNoOutline)
{
  SizeField size;
  size.size = 1;
  EXPECT_THROW(make_outline_mesh({ { 0, 0 }, { 1, 0 } }, size, false), InputError);
  EXPECT_THROW(make_outline_mesh({ { 0, 0 }, { 0, 9 }, { 9, 9 }, { 9, 0 } }, size, false), InputError); // clockwise
  EXPECT_THROW(make_outline_mesh({ { 0, 0 }, { 9, 9 }, { 9, 0 }, { 0, 8 } }, size, false), InputError); // crossing
  EXPECT_THROW(make_outline_mesh({ { 0, 0 }, { 9, 0 }, { 9, 0 }, { 0, 8 } }, size, false), InputError); // double corner
  EXPECT_THROW(make_outline_mesh({ { 0, 0 }, { 50, 0 }, { 50, 0.2 } }, size, false), InputError);       // needle
  size.size = 1e-5;
  EXPECT_THROW(make_outline_mesh({ { 0, 0 }, { 9, 0 }, { 9, 9 } }, size, false), InputError); // 1e12 elements
  EXPECT_THROW(make_disc(-1, size, true), InputError);
}
