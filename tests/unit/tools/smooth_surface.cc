// Surfaces from triangles against the shapes they were made from.
#include "faceted_tools.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/tools/drawing_tools.h>
#include <tribodraw/tools/placement.h>
#include <tribodraw/tools/smooth_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>

using namespace tribodraw;
using namespace faceted;
using Eigen::Matrix3d;

namespace
{
  using Exact = std::function<ToolDistance(const Vector3d &)>;

  // Opening of 80 mm, edge 6 mm; and the NUMISHEET'93 square die.
  const DrawingDie round_die(std::make_shared<CircleOutline>(40), 6);
  const DrawingDie square_die(std::make_shared<RoundedRectangleOutline>(37, 37, 12), 5);

  ToolDistance
  ball(const Vector3d &x)
  {
    const double   length = x.norm();
    const Vector3d n      = x / length;
    return { length - 50, n, (Matrix3d::Identity() - n * n.transpose()) / length };
  }

  /// @p n pieces along a quarter circle, walls and flange in one piece or in four.
  TriangleMesh
  faceted_round_die(const int n, const int n_flat = 4)
  {
    return sweep(circle(40, 8 * n), die_section(6, 30, 40, n, n_flat), true);
  }
  TriangleMesh
  faceted_square_die(const int n, const int n_flat = 4)
  {
    return sweep(rounded_rectangle(37, 37, 12, n, n_flat), die_section(5, 30, 40, n, n_flat), true);
  }

  /// Normals as a file can give them.
  TriangleMesh
  with_normals(TriangleMesh mesh, const Exact &exact)
  {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      mesh.normals.push_back(
          { exact(mesh.corner(t, 0)).normal, exact(mesh.corner(t, 1)).normal, exact(mesh.corner(t, 2)).normal });
    return mesh;
  }

  struct Errors
  {
    double distance = 0, normal = 0; ///< largest
    double curvature = 0;            ///< exceeded by a tenth of the points, times the smallest radius
  };

  Vector3d
  point_of_press(std::mt19937 &random)
  {
    std::uniform_real_distribution<double> plan(-65, 65), height(-25, 20);
    for (;;)
      {
        const double   z = height(random), y = plan(random); // one after the other: the same points with every compiler
        const Vector3d x(plan(random), y, z);
        if (x.head<2>().cwiseAbs().maxCoeff() > 25) // the middle of the opening is far from everything
          return x;
      }
  }

  Vector3d
  point_of_ball(std::mt19937 &random)
  {
    std::normal_distribution<double> any;
    const double z = any(random), y = any(random);
    return 50 * Vector3d(any(random), y, z).normalized();
  }

  /// Within 0.5 mm of the surface, where contact happens.
  Errors
  compare(const TriangleMesh &mesh, const Exact &exact, Vector3d (*point)(std::mt19937 &), const double radius)
  {
    const SmoothSurface                    surface(mesh, {});
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> within(-0.5, 0.5);
    Errors                                 errors;
    std::vector<double>                    curvatures;
    for (int i = 0; i < 5000; ++i)
      {
        const Vector3d     start = point(random);
        const ToolDistance far   = exact(start);
        const Vector3d     x     = start - (far.distance - within(random)) * far.normal;
        const ToolDistance e = exact(x), d = surface.distance(x);
        if (std::abs(e.distance) > 0.6)
          continue;
        errors.distance = std::max(errors.distance, std::abs(d.distance - e.distance));
        errors.normal   = std::max(errors.normal, (d.normal - e.normal).norm());
        curvatures.push_back(radius * (d.curvature - e.curvature).norm());
      }
    std::sort(curvatures.begin(), curvatures.end());
    errors.curvature = curvatures[curvatures.size() * 9 / 10];
    std::printf("%6zu triangles: distance %.2e mm, normal %.2e, curvature %.3f, radius %.3f mm\n",
                mesh.triangles.size(), errors.distance, errors.normal, errors.curvature, surface.smallest_radius());
    return errors;
  }

  double
  order(const double coarse, const double fine)
  {
    return std::log2(coarse / fine);
  }

  std::string
  refusal(const TriangleMesh &mesh, const SmoothSurface::Options &options = {})
  {
    try
      {
        SmoothSurface(mesh, options);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "no error";
  }

  /// The twelve triangles of a box.
  TriangleMesh
  box(const Vector3d &half)
  {
    TriangleMesh mesh;
    mesh.name = "box";
    for (unsigned i = 0; i < 8; ++i)
      mesh.vertices.emplace_back((i & 1 ? 1 : -1) * half[0], (i & 2 ? 1 : -1) * half[1], (i & 4 ? 1 : -1) * half[2]);
    const unsigned faces[6][4]
        = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
    for (const auto &f : faces)
      {
        mesh.triangles.push_back({ f[0], f[1], f[2] });
        mesh.triangles.push_back({ f[0], f[2], f[3] });
      }
    return mesh;
  }
} // namespace

// With the normals of the shape the patches alone are measured.
TEST(SmoothSurface, PatchesConvergeWithGivenNormals)
{
  Errors last;
  for (const int n : { 4, 8, 16 })
    {
      const Errors e = compare(with_normals(sphere(50, n), ball), ball, point_of_ball, 50);
      if (n > 4)
        {
          // Quartics: fourth order, and one less for each derivative.
          EXPECT_GT(order(last.distance, e.distance), 3.7);
          EXPECT_GT(order(last.normal, e.normal), 2.7);
          EXPECT_GT(order(last.curvature, e.curvature), 1.7);
        }
      last = e;
    }
  // The curvature of a die jumps where its edge begins: third order for the distance, second for the normal.
  const Exact exact = [](const Vector3d &x) { return square_die.distance(x); };
  for (const int n : { 4, 8, 16 })
    {
      const Errors e = compare(with_normals(faceted_square_die(n), exact), exact, point_of_press, 5);
      if (n > 4)
        {
          EXPECT_GT(order(last.distance, e.distance), 2.7);
          EXPECT_GT(order(last.normal, e.normal), 1.7);
        }
      last = e;
    }
  EXPECT_LT(last.curvature, 0.01);
}

// As from STL. The flat facets are off by the sag of the chords: r (1 - cos(pi/4n)) with n pieces to a quarter circle
// of the opening's corner (r = 12 mm) or, around the round die, pi/8n and r = 80 mm at the end of the flange.
TEST(SmoothSurface, EstimatedNormalsAreFarBetterThanFacets)
{
  struct Case
  {
    const char *what;
    Exact       exact;
    TriangleMesh (*make)(int, int);
    int    n_flat;
    double edge, sag_radius, pieces;
  };
  const Exact round  = [](const Vector3d &x) { return round_die.distance(x); };
  const Exact square = [](const Vector3d &x) { return square_die.distance(x); };
  for (const Case &c : { Case{ "round, walls in one piece", round, faceted_round_die, 1, 6, 40, 8 },
                         Case{ "round, walls in four", round, faceted_round_die, 4, 6, 40, 8 },
                         Case{ "square, sides in one piece", square, faceted_square_die, 1, 5, 12, 4 },
                         Case{ "square, sides in four", square, faceted_square_die, 4, 5, 12, 4 } })
    {
      SCOPED_TRACE(c.what);
      Errors last;
      for (const int n : { 6, 12, 24 })
        {
          const Errors e     = compare(c.make(n, c.n_flat), c.exact, point_of_press, c.edge);
          const double facet = c.sag_radius * (1 - std::cos(M_PI / (c.pieces * n)));
          EXPECT_LT(e.distance, facet / 4) << n;
          // Facets turn by half the angle between them.
          EXPECT_LT(e.normal, 0.5 * M_PI / (4 * n)) << n;
          if (n > 6)
            {
              EXPECT_GT(order(last.distance, e.distance), 1.9);
              EXPECT_GT(order(last.normal, e.normal), 1.6);
            }
          last = e;
        }
      EXPECT_LT(last.curvature, 0.06);
      EXPECT_LT(last.normal, 0.006);
    }
}

// Rows of corners that do not follow the lines at which the edge begins, diagonals at random.
TEST(SmoothSurface, IrregularMeshesAreSmoothedToo)
{
  const Exact exact = [](const Vector3d &x) { return round_die.distance(x); };
  const auto  point = [](std::mt19937 &random) {
    for (;;)
      {
        const Vector3d x = point_of_press(random);
        if (x.head<2>().norm() < 54 && x[2] > -14) // the mesh ends at 56 and -16
          return x;
      }
  };
  const Errors coarse = compare(irregular_die(40, 6, 1.5), exact, point, 6),
               fine   = compare(irregular_die(40, 6, 0.75), exact, point, 6);
  // Chords of up to 2.1 mm over the edge of 6 mm: sag 0.09 mm.
  EXPECT_LT(coarse.distance, 0.02);
  EXPECT_GT(order(coarse.distance, fine.distance), 1.4);
  EXPECT_LT(fine.normal, 0.04);
}

TEST(SmoothSurface, DistanceAndNormalDoNotJump)
{
  const SmoothSurface              surface(faceted_square_die(6), {});
  std::mt19937                     random(1);
  std::normal_distribution<double> step(0, 0.05);
  double                           largest = 0;
  for (int i = 0; i < 50000; ++i)
    {
      const Vector3d     x = point_of_press(random), y = x + Vector3d(step(random), step(random), step(random));
      const ToolDistance a = surface.distance(x), b = surface.distance(y);
      // Exact distances do not grow faster than the way; beyond the border, where the surface goes on along its tangent
      // planes, they nearly do so.
      ASSERT_LE(std::abs(a.distance - b.distance), (x - y).norm() * (1 + 1e-9) + 1e-9) << x.transpose();
      if (std::abs(a.distance) < 1 && std::abs(b.distance) < 1)
        largest = std::max(largest, (a.normal - b.normal).norm() / (x - y).norm());
    }
  // The normal turns by the curvature: 1/(5 - 1) mm on the inner side of the edge, with some overshoot of the
  // smoothing.
  EXPECT_LT(largest, 2. / 4);
}

TEST(SmoothSurface, BeyondItsBorderItGoesOnAlongItsTangentPlanes)
{
  // The flange of the mesh ends 40 mm outside of the opening, the wall 30 mm below.
  const SmoothSurface surface(faceted_square_die(8), {});
  for (const double outside : { 76., 78., 90., 200. })
    {
      const ToolDistance d = surface.distance({ outside, 3, 1.5 });
      EXPECT_NEAR(d.distance, 1.5, 1e-3 * (outside - 70)) << outside;
      EXPECT_NEAR(d.normal[2], 1, 1e-5);
    }
  EXPECT_NEAR(surface.distance({ 36, 2, -45 }).distance, 1, 2e-3);
  EXPECT_NEAR(surface.distance({ 38, 2, -45 }).distance, -1, 2e-3);
}

TEST(SmoothSurface, SharpEdgesAreRefusedWithTheirPlace)
{
  const std::string text = refusal(box({ 30, 20, 10 }));
  EXPECT_NE(text.find("12 sharp edges"), std::string::npos) << text;
  EXPECT_NE(text.find("90 degrees"), std::string::npos) << text;
  EXPECT_NE(text.find("30, "), std::string::npos) << text;
}

TEST(SmoothSurface, KeptSharpEdgesAreExact)
{
  const Vector3d         half(30, 20, 10);
  SmoothSurface::Options options;
  options.keep_sharp_edges = true;
  const SmoothSurface                    surface(box(half), options);
  std::mt19937                           random(2);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (int i = 0; i < 5000; ++i)
    {
      const Vector3d x = half.cwiseProduct(Vector3d(place(random), place(random), place(random)));
      const Vector3d q = x.cwiseAbs() - half;
      // The distance to a box, inside and outside.
      const double expected = q.maxCoeff() <= 0 ? q.maxCoeff() : q.cwiseMax(0).norm();
      const auto   d        = surface.distance(x);
      ASSERT_NEAR(d.distance, expected, 1e-9) << x.transpose();
      ASSERT_NEAR(d.normal.norm(), 1, 1e-12);
      if (expected > 0.01)
        {
          const Vector3d n = q.cwiseMax(0).cwiseProduct(x.cwiseSign()).normalized();
          ASSERT_LT((d.normal - n).norm(), 1e-6) << x.transpose();
        }
    }
}

TEST(SmoothSurface, ReflectionCompletesAQuarter)
{
  TriangleMesh whole = faceted_square_die(6), quarter = whole;
  quarter.triangles.clear();
  for (const auto &t : whole.triangles)
    if (std::all_of(t.begin(), t.end(),
                    [&](const unsigned v) { return whole.vertices[v][0] > -1e-9 && whole.vertices[v][1] > -1e-9; }))
      quarter.triangles.push_back(t);
  weld(quarter, 1e-9);
  EXPECT_EQ(4 * quarter.triangles.size(), whole.triangles.size());
  reflect(quarter, 0);
  reflect(quarter, 1);
  EXPECT_EQ(quarter.triangles.size(), whole.triangles.size());
  EXPECT_EQ(quarter.vertices.size(), whole.vertices.size());
  const SmoothSurface surface(quarter, {});
  EXPECT_LT(std::abs(surface.distance({ 0, 38, -0.5 }).normal[0]), 1e-9);
  EXPECT_THROW(reflect(whole, 0), InputError);
}

TEST(SmoothSurface, SmallestRadiusIsThatOfTheEdge)
{
  // By a tenth smaller or larger: the curvature of the smoothed surface swings about that of the shape.
  EXPECT_NEAR(SmoothSurface(sphere(50, 8), {}).smallest_radius(), 50, 2);
  EXPECT_NEAR(SmoothSurface(faceted_round_die(12), {}).smallest_radius(), 6, 0.6);
  EXPECT_NEAR(SmoothSurface(faceted_square_die(12), {}).smallest_radius(), 5, 0.5);
  // Seen from the other side the edge is hollow, and the opening (40 mm) is the sharpest convex place.
  TriangleMesh turned = faceted_round_die(12);
  turn_over(turned);
  EXPECT_NEAR(SmoothSurface(turned, {}).smallest_radius(), 40, 4);
}

TEST(SmoothSurface, IsPlacedOnTheBlank)
{
  // A ball of 50 mm comes down on nodes 5 mm apart: touched at half the thickness 0.4 mm by the node in the middle.
  const SmoothSurface   surface(sphere(50, 12), {});
  std::vector<Vector3d> nodes;
  for (double x = 0; x <= 50; x += 5)
    for (double y = 0; y <= 50; y += 5)
      nodes.emplace_back(x, y, 0);
  const auto place = touching_place({ &surface, { 0, 0, 0 }, false }, { 0, 0, -1 }, nodes, 0.4);
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place)[2], 50.4, 1e-6);
  EXPECT_NEAR(surface.extent().sizes()[0], 100, 0.2);
  // A ball of 100 mm for a blank of 260 mm, and the same in a file that was taken for metres or micrometres.
  EXPECT_EQ(implausible_size(surface, 260), "");
  EXPECT_NE(implausible_size(surface, 260e3).find("for a blank of 2.6e+05 mm"), std::string::npos);
  EXPECT_NE(implausible_size(surface, 2.6), "");
  EXPECT_EQ(implausible_size(round_die, 260e3), ""); // without bounds
}

TEST(SmoothSurface, BrokenSurfacesAreExplained)
{
  const auto expect = [](const TriangleMesh &mesh, const std::string &part) {
    const std::string text = refusal(mesh);
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  TriangleMesh turned = sphere(50, 4);
  std::swap(turned.triangles[7][0], turned.triangles[7][1]);
  expect(turned, "opposite orientations");
  TriangleMesh doubled = sphere(50, 4);
  doubled.triangles.push_back(doubled.triangles[3]);
  expect(doubled, "more than two triangles");
  TriangleMesh flat = sphere(50, 4);
  flat.vertices.push_back(0.5 * (flat.corner(0, 0) + flat.corner(0, 1)));
  flat.triangles.push_back(
      { flat.triangles[0][0], flat.triangles[0][1], static_cast<unsigned>(flat.vertices.size() - 1) });
  expect(flat, "no area");
  TriangleMesh normals = with_normals(sphere(50, 4), ball);
  normals.normals[5][1] *= -1;
  expect(normals, "triangle 6");
}

// A figure for the documentation, and a wide limit for a slow machine.
TEST(SmoothSurface, AQueryTakesMicroseconds)
{
  const SmoothSurface                    surface(faceted_square_die(8, 10), {});
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> within(-1, 1);
  std::vector<Vector3d>                  points;
  for (int i = 0; i < 20000; ++i)
    {
      const Vector3d     x = point_of_press(random);
      const ToolDistance e = square_die.distance(x);
      points.push_back(x - (e.distance - within(random)) * e.normal);
    }
  double     sum   = 0;
  const auto start = std::clock();
  for (const Vector3d &x : points)
    sum += surface.distance(x).distance;
  const double each = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / static_cast<double>(points.size());
  std::printf("%.2f us CPU for a distance within 1 mm of the surface (mean %.3g mm)\n", 1e6 * each,
              sum / static_cast<double>(points.size()));
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(each, 2e-5);
#endif
}
