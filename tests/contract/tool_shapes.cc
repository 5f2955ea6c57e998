// What every registered tool shape must hold, so that contact can rely on it. The shapes are made in documentation
// mode, in which the reader of a shape stands in its own example for the missing file.
#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/tool_geometry.h>
#include <tribodraw/tools/triangulation.h>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace tribodraw;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
  class ToolShape : public ::testing::TestWithParam<std::string>
  {
  protected:
    void
    SetUp() override
    {
      Parameters parameters = Parameters::for_documentation();
      tool                  = Registry<ToolGeometry>::entries().at(GetParam()).create(parameters);
      ASSERT_TRUE(tool);
    }

    Vector3d
    random_point()
    {
      std::uniform_real_distribution<double> plan(-150, 150), height(-60, 60);
      return { plan(random), plan(random), height(random) };
    }

    /// Distance within which the surface is smooth on both sides; 10 mm for planes.
    double
    smooth_band() const
    {
      return 0.5 * std::min(20., tool->smallest_radius());
    }

    /// A random point moved along its normal into the band. The way may end short of it beyond a medial axis:
    /// such points are left out by the caller.
    Vector3d
    random_point_near_surface()
    {
      std::uniform_real_distribution<double> within(-smooth_band(), smooth_band());
      const Vector3d                         x = random_point();
      const ToolDistance                     d = tool->distance(x);
      return x - (d.distance - within(random)) * d.normal;
    }

    std::unique_ptr<ToolGeometry> tool;
    std::mt19937                  random{ 7 };
  };

  std::vector<std::string>
  names()
  {
    std::vector<std::string> result;
    for (const auto &[name, entry] : Registry<ToolGeometry>::entries())
      result.push_back(name);
    return result;
  }
} // namespace

TEST_P(ToolShape, DistanceHasNoJumps)
{
  std::normal_distribution<double> step(0, 0.5);
  for (int i = 0; i < 200000; ++i)
    {
      const Vector3d x = random_point(), y = x + Vector3d(step(random), step(random), step(random));
      ASSERT_LE(std::abs(tool->distance(x).distance - tool->distance(y).distance), (x - y).norm() + 1e-11)
          << x.transpose() << " and " << y.transpose();
    }
}

TEST_P(ToolShape, CanBeDrawn)
{
  const PlacedTool          placed{ tool.get(), Vector3d::Zero(), false };
  const Eigen::AlignedBox3d box(Vector3d(-150, -150, -60), Vector3d(150, 150, 60));
  const double              cell = std::cbrt(box.volume() / 40000);
  const TriangleMesh        mesh = triangulate(placed, box);
  EXPECT_FALSE(mesh.triangles.empty());
  unsigned away = 0;
  for (const Vector3d &x : mesh.vertices)
    {
      EXPECT_LE(std::abs(tool->distance(x).distance), cell);
      away += std::abs(tool->distance(x).distance) > 1e-3 * cell;
    }
  EXPECT_LE(away, mesh.vertices.size() / 20); // at creases and ends of surfaces
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const unsigned corner : mesh.triangles[t])
      ASSERT_LT(corner, mesh.vertices.size());
}

TEST_P(ToolShape, NormalIsAUnitVectorEverywhere)
{
  for (int i = 0; i < 20000; ++i)
    {
      const ToolDistance d = tool->distance(random_point());
      ASSERT_NEAR(d.normal.norm(), 1, 1e-12);
      ASSERT_TRUE(d.curvature.allFinite());
    }
}

TEST_P(ToolShape, DistanceTimesNormalLeadsToTheSurface)
{
  int checked = 0;
  for (int i = 0; i < 20000; ++i)
    {
      const Vector3d     x = random_point_near_surface();
      const ToolDistance d = tool->distance(x);
      if (std::abs(d.distance) > smooth_band())
        continue;
      ++checked;
      ASSERT_NEAR(tool->distance(x - d.distance * d.normal).distance, 0, 1e-10) << x.transpose();
    }
  EXPECT_GT(checked, 15000);
}

TEST_P(ToolShape, NormalAndCurvatureAreTheDerivatives)
{
  const double h       = 1e-5;
  int          checked = 0, smooth = 0;
  for (int i = 0; i < 20000; ++i)
    {
      const Vector3d     x = random_point_near_surface();
      const ToolDistance d = tool->distance(x);
      if (std::abs(d.distance) > smooth_band())
        continue;
      Vector3d gradient;
      Matrix3d curvature;
      double   change = 0;
      for (int k = 0; k < 3; ++k)
        {
          const Vector3d     e = h * Vector3d::Unit(k);
          const ToolDistance a = tool->distance(x - e), b = tool->distance(x + e);
          gradient[k]      = (b.distance - a.distance) / (2 * h);
          curvature.col(k) = (b.normal - a.normal) / (2 * h);
          change += (b.curvature - d.curvature).norm() + (a.curvature - d.curvature).norm();
        }
      // Central differences: error h^2/6 times the third derivative (a few 1/mm^2) plus rounding 1e-13/h.
      ASSERT_LT((gradient - d.normal).norm(), 1e-7) << x.transpose();
      ++checked;
      // The curvature jumps where an arc joins a straight piece, and a little between the patches of a surface from
      // triangles. The difference of the normals is a mean of the curvature between the two points.
      if (change < 1e-4)
        {
          ASSERT_LT((curvature - d.curvature).norm(), 1e-6 + change) << x.transpose();
          ++smooth;
        }
      ASSERT_LT((d.curvature - d.curvature.transpose()).norm(), 1e-13);
      ASSERT_LT((d.curvature * d.normal).norm(), 1e-12); // |normal| = 1 along every path
    }
  EXPECT_GT(checked, 15000);
  EXPECT_GT(smooth, 0.95 * checked);
}

TEST_P(ToolShape, SmallestRadiusIsThatOfItsSharpestConvexPlace)
{
  double largest = 0; // convex curvature on the surface
  for (int i = 0; i < 20000; ++i)
    {
      const Vector3d     x = random_point_near_surface();
      const ToolDistance d = tool->distance(x);
      if (std::abs(d.distance) > smooth_band())
        continue;
      const Matrix3d on_surface = tool->distance(x - d.distance * d.normal).curvature;
      largest = std::max(largest, Eigen::SelfAdjointEigenSolver<Matrix3d>(on_surface).eigenvalues()[2]);
    }
  // The samples may miss the sharpest place of a surface that is not made of arcs by a little.
  const double expected = 1 / tool->smallest_radius();
  EXPECT_LE(largest, expected * 1.05 + 1e-12);
  EXPECT_GE(largest, expected * 0.95);
}

TEST_P(ToolShape, TellsWhatItIs)
{
  EXPECT_FALSE(tool->describe().empty());
  EXPECT_GT(tool->smallest_radius(), 0);
  const ModelInfo &info = Registry<ToolGeometry>::entries().at(GetParam()).info;
  EXPECT_FALSE(info.description.empty());
}

INSTANTIATE_TEST_SUITE_P(AllRegistered, ToolShape, ::testing::ValuesIn(names()), [](const auto &test) {
  std::string name = test.param;
  for (char &c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)))
      c = '_';
  return name;
});

TEST(ToolShapes, TheShippedOnesAndThatOfTheTutorialAreRegistered)
{
  for (const char *name :
       { "triangle surface", "ring", "draw bead", "bead groove", "plane", "plate", "cylinder", "sphere", "cross die", "cross punch", "square die", "square punch",
         "cylindrical die", "cylindrical punch", "hemispherical punch", "U-bend die", "U-bend punch" })
    EXPECT_TRUE(Registry<ToolGeometry>::entries().count(name)) << name;
}
