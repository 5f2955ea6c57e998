#include <tribodraw/tools/drawing_tools.h>
#include <tribodraw/tools/plane.h>
#include <tribodraw/tools/triangulation.h>

#include "claims.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace tribodraw;
using Eigen::Vector3d;

namespace
{
  /// A ball around the origin of its frame.
  class Ball : public ToolGeometry
  {
  public:
    ToolDistance
    distance(const Vector3d &x) const override
    {
      const double r = std::max(1e-12, x.norm());
      return { r - 20, x / r, (Eigen::Matrix3d::Identity() - x * x.transpose() / (r * r)) / r };
    }
    double
    smallest_radius() const override
    {
      return 20;
    }
    std::string
    describe() const override
    {
      return "ball";
    }
  };

  double
  area(const TriangleMesh &mesh)
  {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      sum += 0.5 * (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).norm();
    return sum;
  }
} // namespace

TEST(Triangulation, ABallIsClosedAndItsNormalsPointOut)
{
  const Ball         ball;
  const Vector3d     place(7, -3, 12);
  const TriangleMesh mesh
      = triangulate({ &ball, place, false }, { place - Vector3d::Constant(25), place + Vector3d::Constant(25) });
  ASSERT_GT(mesh.triangles.size(), 1000u);
  const MeshTopology topology(mesh); // throws if neighbours have opposite orientations
  EXPECT_EQ(topology.n_border_edges(), 0u);
  for (const Vector3d &x : mesh.vertices)
    EXPECT_NEAR((x - place).norm(), 20, 1e-9); // the distance is exact everywhere
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_GT(topology.facet_normals()[t].dot(mesh.corner(t, 0) - place), 0);
  // Chords lie below the sphere: 4 pi r^2 less a part of the order (spacing/r)^2, here (1.46/20)^2 = 0.5 %.
  const double sphere = 4 * M_PI * 400;
  EXPECT_LT(area(mesh), sphere);
  EXPECT_TRUE(claims::at_least("area of a triangulated ball over 4 pi r^2", "closed form", area(mesh) / sphere, 0.995));
}

TEST(Triangulation, AMirroredPunchIsThereUpsideDown)
{
  const DrawingPunch        punch(std::make_shared<CircleOutline>(30), 8);
  const Eigen::AlignedBox3d box(Vector3d(0, 0, -40), Vector3d(50, 50, 40));
  for (const bool mirrored : { false, true })
    {
      const PlacedTool   tool{ &punch, { 0, 0, 5 }, mirrored };
      const TriangleMesh mesh = triangulate(tool, box);
      ASSERT_GT(mesh.triangles.size(), 500u);
      for (const Vector3d &x : mesh.vertices)
        {
          EXPECT_NEAR(tool.distance(x).distance, 0, 1e-6) << x.transpose();
          // The face at z = 5, and the wall from there to the end of the box and half a cell of 1.7 mm.
          EXPECT_GE(mirrored ? 5 - x[2] : x[2] - 5, -1e-6);
          EXPECT_LE(std::abs(x[2]), 40 + 1.8);
        }
    }
}

TEST(Triangulation, NothingWhereTheSurfaceIsElsewhere)
{
  const Plane plane(Facing::up);
  EXPECT_TRUE(
      triangulate({ &plane, { 0, 0, 100 }, false }, { Vector3d(0, 0, -40), Vector3d(50, 50, 40) }).triangles.empty());
}
