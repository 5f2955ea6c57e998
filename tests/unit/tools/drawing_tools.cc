#include <tribodraw/base/errors.h>
#include <tribodraw/tools/drawing_tools.h>
#include <tribodraw/tools/plane.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace tribodraw;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
  // Dimensions of prm/cross_die.prm [mm].
  constexpr double reach = 80, half_width = 35, corner = 20, fillet = 25, clearance = 1.5;
  constexpr double die_edge = 14, punch_edge = 18;

  std::shared_ptr<const Outline>
  cross()
  {
    return std::make_shared<CrossOutline>(reach, half_width, corner, fillet);
  }
  const DrawingPunch cross_punch(cross(), punch_edge);
  const DrawingDie   cross_die(cross()->offset(clearance), die_edge);

  // NUMISHEET'93 square cup: punch 70 x 70, corner 10, edge 8; die 74 x 74, corner 12, edge 5.
  const DrawingPunch square_punch(std::make_shared<RoundedRectangleOutline>(35, 35, 10), 8);
  const DrawingDie   square_die(std::make_shared<RoundedRectangleOutline>(37, 37, 12), 5);

  /// A point of an outline with its outward normal, written down piece by piece and independently of the product.
  struct Sample
  {
    Vector2d point, normal;
  };

  void
  add_line(std::vector<Sample> &s, const Vector2d &a, const Vector2d &b, const Vector2d &normal, const double step)
  {
    const int n = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
    for (int i = 0; i <= n; ++i)
      s.push_back({ a + (b - a) * i / n, normal });
  }

  void
  add_arc(std::vector<Sample> &s, const Vector2d &centre, const double radius, const double from, const double to,
          const double outwards, const double step)
  {
    const int n = static_cast<int>(std::ceil(std::abs(to - from) * radius / step));
    for (int i = 0; i <= n; ++i)
      {
        const double   angle = from + (to - from) * i / n;
        const Vector2d e(std::cos(angle), std::sin(angle));
        s.push_back({ centre + radius * e, outwards * e });
      }
  }

  /// First quadrant of a cross.
  std::vector<Sample>
  sample_cross(const double a, const double b, const double rc, const double ri, const double step)
  {
    std::vector<Sample> s;
    add_line(s, { a, 0 }, { a, b - rc }, { 1, 0 }, step);
    add_arc(s, { a - rc, b - rc }, rc, 0, M_PI / 2, 1, step);
    add_line(s, { a - rc, b }, { b + ri, b }, { 0, 1 }, step);
    add_arc(s, { b + ri, b + ri }, ri, 1.5 * M_PI, M_PI, -1, step);
    add_line(s, { b, b + ri }, { b, a - rc }, { 1, 0 }, step);
    add_arc(s, { b - rc, a - rc }, rc, 0, M_PI / 2, 1, step);
    add_line(s, { b - rc, a }, { 0, a }, { 0, 1 }, step);
    return s;
  }

  std::vector<Sample>
  sample_square(const double a, const double rc, const double step)
  {
    std::vector<Sample> s;
    add_line(s, { a, 0 }, { a, a - rc }, { 1, 0 }, step);
    add_arc(s, { a - rc, a - rc }, rc, 0, M_PI / 2, 1, step);
    add_line(s, { a - rc, a }, { 0, a }, { 0, 1 }, step);
    return s;
  }

  /// Section through wall, edge and flat: (distance inwards or outwards from the wall, height).
  struct Section
  {
    std::vector<Vector2d> points;
    std::vector<bool>     is_end; ///< where the sampled piece stops although the surface goes on
  };

  Section
  sample_section(const double r, const double wall, const double flat, const double step)
  {
    Section    s;
    const auto add = [&s](const double x, const double z, const bool is_end) {
      s.points.push_back({ x, z });
      s.is_end.push_back(is_end);
    };
    for (double z = r + wall; z > r; z -= step)
      add(0, z, z == r + wall);
    const int n = static_cast<int>(std::ceil(M_PI / 2 * r / step));
    for (int i = 0; i <= n; ++i)
      add(r - r * std::cos(M_PI / 2 * i / n), r - r * std::sin(M_PI / 2 * i / n), false);
    for (double x = r + step; x < r + flat; x += step)
      add(x, 0, x + step >= r + flat);
    return s;
  }

  /// Compare with the nearest of the sampled points. @p direction +1: the flat part lies outside of the outline and
  /// the wall goes down (die); -1: inside, and the wall goes up (punch).
  void
  compare_with_closest_sample(const ToolGeometry &tool, const std::vector<Sample> &outline, const Section &section,
                              const double direction, const double spread, const double step)
  {
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> plan(0, 100), height(-25, 25);
    int                                    compared = 0;
    for (int i = 0; i < 700; ++i)
      {
        const Vector3d x(plan(random), plan(random), height(random));
        const double   d      = tool.distance(x).distance;
        double         best   = 1e300;
        bool           at_end = false;
        for (std::size_t k = 0; k < section.points.size(); ++k)
          for (const Sample &s : outline)
            {
              const Vector2d p = s.point + direction * section.points[k][0] * s.normal;
              const double   squared
                  = (x.head<2>() - p).squaredNorm() + std::pow(x[2] + direction * section.points[k][1], 2);
              if (squared < best)
                {
                  best   = squared;
                  at_end = section.is_end[k];
                }
            }
        best = std::sqrt(best);
        if (at_end || std::abs(d) > 12)
          continue;
        ++compared;
        // No sample can be nearer than the surface. The foot point has a sample within e (half the diagonal of a
        // cell of the sampling); a surface of curvature 1/R between the two adds at most e^2 |d| / R.
        const double e = 0.5 * step * std::hypot(1, spread), curvature = 1. / 5;
        EXPECT_LE(std::abs(d), best + 1e-10) << x.transpose();
        EXPECT_GE(std::abs(d), std::sqrt(std::max(0., best * best - e * e * (1 + curvature * std::abs(d)))) - 1e-10)
            << x.transpose();
      }
    EXPECT_GT(compared, 50);
  }
} // namespace

TEST(DrawingTools, AgreeWithTheNearestPointOfASampledSurface)
{
  // Spread: by how much the distance of two neighbouring normals grows from the wall to the end of the flat.
  const double step = 0.5;
  compare_with_closest_sample(
      cross_die, sample_cross(reach + clearance, half_width + clearance, corner + clearance, fillet - clearance, step),
      sample_section(die_edge, 40, 10, step), 1, (21.5 + 24) / 21.5, step);
  compare_with_closest_sample(cross_punch, sample_cross(reach, half_width, corner, fillet, step),
                              sample_section(punch_edge, 40, 2, step), -1, (25. + 20) / 25, step);
  compare_with_closest_sample(square_die, sample_square(37, 12, step), sample_section(5, 40, 15, step), 1,
                              (12. + 20) / 12, step);
  compare_with_closest_sample(square_punch, sample_square(35, 10, step), sample_section(8, 40, 2, step), -1, 1, step);
}

TEST(DrawingTools, FlatsWallsAndEdgesLieWhereTheDrawingHasThem)
{
  // Flange and wall of the die: opening at 81.5 on the x axis, edge centre line at x = 95.5, z = -14.
  EXPECT_NEAR(cross_die.distance({ 120, 3, 2 }).distance, 2, 1e-12);
  EXPECT_NEAR(cross_die.distance({ 120, 3, -2 }).distance, -2, 1e-12);
  EXPECT_NEAR(cross_die.distance({ 80, 0, -40 }).distance, 1.5, 1e-12);
  const double       s    = std::sqrt(0.5);
  const ToolDistance edge = cross_die.distance({ 95.5 - 14 * s, 0, -14 + 14 * s });
  EXPECT_NEAR(edge.distance, 0, 1e-12);
  EXPECT_LT((edge.normal - Vector3d(-s, 0, s)).norm(), 1e-12);
  // A cylinder along y there: curvature 1/14 in the section, none along the edge.
  const Vector3d across(s, 0, s);
  EXPECT_LT((edge.curvature - across * across.transpose() / 14).norm(), 1e-12);
  // Face and wall of the punch.
  EXPECT_NEAR(cross_punch.distance({ 10, 5, -3 }).distance, 3, 1e-12);
  EXPECT_NEAR(cross_punch.distance({ 83, 5, 40 }).distance, 3, 1e-12);
  EXPECT_NEAR(cross_punch.distance({ 80 - 18 + 18 * s, 0, 18 - 18 * s }).distance, 0, 1e-12);
}

TEST(DrawingTools, EdgesAroundCornersAreTori)
{
  // On a torus the curvature around its axis is n_r / R: radial component of the normal by the distance to the axis.
  // The normal stands at 45 degrees to the wall; plan direction 45 degrees.
  const double   s = std::sqrt(0.5);
  const Vector3d radial(s, s, 0), around(-s, s, 0), up(0, 0, 1);
  struct Case
  {
    const char         *what;
    const ToolGeometry &tool;
    Vector3d            axis;          ///< centre of the plan arc
    double              sign;          ///< of the direction from the axis to the edge, along (1,1)
    double              circle_radius; ///< of the edge's centre line about the axis
    double              edge;
    double              n_r, n_z; ///< signs of the normal's components
  };
  // die, convex corner of the opening: wall at 21.5 from (60,15), centre line at 35.5, the normal points to the axis.
  // die, fillet: wall at 23.5 from (60,60) (towards the centre), centre line at 9.5, normal away from the axis.
  // punch, convex corner: wall at 20 from (60,15), centre line at 2, normal away.
  // punch, fillet: wall at 25, centre line at 43, normal to the axis.
  const Case cases[] = { { "die corner", cross_die, { 60, 15, -14 }, 1, 35.5, 14, -1, 1 },
                         { "die fillet", cross_die, { 60, 60, -14 }, -1, 9.5, 14, 1, 1 },
                         { "punch corner", cross_punch, { 60, 15, 18 }, 1, 2, 18, 1, -1 },
                         { "punch fillet", cross_punch, { 60, 60, 18 }, -1, 43, 18, -1, -1 } };
  for (const Case &c : cases)
    {
      SCOPED_TRACE(c.what);
      const Vector3d     n = s * (c.n_r * c.sign * radial + c.n_z * up);
      const double       R = c.circle_radius + c.n_r * c.edge * s;
      const ToolDistance d = c.tool.distance(c.axis + c.sign * c.circle_radius * radial + c.edge * n);
      EXPECT_NEAR(d.distance, 0, 1e-12);
      EXPECT_LT((d.normal - n).norm(), 1e-12);
      EXPECT_NEAR(around.dot(d.curvature * around), c.n_r * s / R, 1e-12);
      const Vector3d section = n.cross(around);
      EXPECT_NEAR(section.dot(d.curvature * section), 1 / c.edge, 1e-12);
      EXPECT_NEAR(around.dot(d.curvature * section), 0, 1e-12);
    }
}

TEST(DrawingTools, DistanceNeverJumpsAndTheNormalTurnsSteadily)
{
  // |d(x) - d(y)| <= |x - y| for neighbours of a fine grid through the whole press. Within 2 mm of the surface the
  // normal turns by at most h / (smallest radius - 2 mm).
  const double                            h = 0.5, extent = 120;
  const int                               n = static_cast<int>(extent / h);
  const std::vector<const ToolGeometry *> tools{ &cross_die, &cross_punch, &square_die, &square_punch };
  for (const ToolGeometry *tool : tools)
    for (const double z : { -30., -13., -4., -0.5, 0.5, 4., 13., 30. })
      {
        std::vector<ToolDistance> row(n + 1); // behind j: of this i, ahead: of the one before
        for (int i = 0; i <= n; ++i)
          for (int j = 0; j <= n; ++j)
            {
              const Vector3d     x(i * h - 20, j * h - 20, z);
              const ToolDistance d       = tool->distance(x);
              const double       bound   = h / (tool->smallest_radius() - 2);
              const auto         compare = [&](const ToolDistance &other) {
                ASSERT_LE(std::abs(d.distance - other.distance), h * (1 + 1e-12)) << x.transpose();
                if (std::abs(d.distance) < 2 && std::abs(other.distance) < 2)
                  {
                    ASSERT_LE((d.normal - other.normal).norm(), bound * (1 + 1e-12)) << x.transpose();
                  }
              };
              if (i > 0)
                compare(row[j]);
              if (j > 0)
                compare(row[j - 1]);
              row[j] = d;
            }
      }
}

TEST(DrawingTools, SharpEdgesAreRefusedWithTheNumbers)
{
  const auto message = [](const auto &make) -> std::string {
    try
      {
        make();
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "no error";
  };
  // Fillet of the opening 25 - 1.5 = 23.5 mm.
  const std::string die = message([] { DrawingDie(cross()->offset(clearance), 24); });
  EXPECT_NE(die.find("24 mm"), std::string::npos) << die;
  EXPECT_NE(die.find("at most 23.5 mm"), std::string::npos) << die;
  const std::string punch = message([] { DrawingPunch(cross(), 21); });
  EXPECT_NE(punch.find("21 mm"), std::string::npos) << punch;
  EXPECT_NE(punch.find("at most 20 mm"), std::string::npos) << punch;
  EXPECT_NE(message([] { DrawingPunch(cross(), 0); }).find("must be positive"), std::string::npos);
}

TEST(DrawingTools, SmallestRadiusIsTheOneTheMeshMustResolve)
{
  EXPECT_EQ(cross_die.smallest_radius(), 14);
  EXPECT_EQ(cross_punch.smallest_radius(), 18);
  EXPECT_EQ(square_die.smallest_radius(), 5);
  EXPECT_EQ(square_punch.smallest_radius(), 8);
  EXPECT_TRUE(std::isinf(Plane(Facing::up).smallest_radius()));
}

TEST(DrawingTools, BlankHolderFacesDown)
{
  const ToolDistance d = Plane(Facing::down).distance({ 5, 6, 2 });
  EXPECT_EQ(d.distance, -2); // 2 mm inside the holder, the body of which is above z = 0
  EXPECT_EQ(d.normal, Vector3d(0, 0, -1));
  EXPECT_EQ(d.curvature, Matrix3d::Zero());
}
