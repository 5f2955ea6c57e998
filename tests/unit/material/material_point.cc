#include "paper_material.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/material/material_point.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace tribodraw;

namespace
{
  constexpr double degree = 3.14159265358979323846 / 180;

  /// A file that is gone with the object.
  struct TemporaryFile
  {
    std::filesystem::path path;
    explicit TemporaryFile(const std::string &text)
        : path(std::filesystem::temp_directory_path()
               / ("tribodraw_path_" + std::to_string(std::hash<std::string>()(text)) + ".csv"))
    {
      std::ofstream(path) << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path); }
  };

  std::string
  message(const std::string &text)
  {
    const TemporaryFile file(text);
    try
      {
        read_strain_path(file.path);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
} // namespace

// Tension gives back the flow curve at its own rate, at each test angle times the factor of Table 2, with its R-value;
// equibiaxial tension 1.132 times the curve with the strain ratio 0.8988 (Shisode et al. 2021, Table 2).
TEST(MaterialPoint, reproduces_the_input)
{
  const auto   sheet    = paper::sheet("Vegter", "Bergstroem-van Liempt");
  const double factor[] = { 1, 1.0310, .9885, 1.132 }, R[] = { 1.92667, 1.49433, 2.21133 };
  for (int j = 0; j < 4; ++j)
    {
      const double angle = j < 3 ? 45. * j * degree : 0.;
      const auto   path
          = run_point_test(sheet, j < 3 ? PointTest::uniaxial : PointTest::equibiaxial, angle, 0.3, 0.1, 60);
      ASSERT_EQ(path.size(), 61u);
      const Matrix3 Q = strain_rotation(angle), to_local = Matrix3(strain_rotation(-angle)).transpose();
      for (std::size_t i = 5; i < path.size(); ++i)
        {
          const PointState &s     = path[i];
          const double      rate  = (s.plastic.eps_p - path[i - 1].plastic.eps_p) / (s.time - path[i - 1].time);
          const double      curve = sheet.hardening().flow_stress(s.plastic.eps_p, rate).value;
          EXPECT_NEAR((to_local * s.stress)[0] / (factor[j] * curve), 1, 1e-6);
          const Vector3 plastic = Q * s.plastic.plastic_strain;
          if (j < 3)
            {
              EXPECT_NEAR(-plastic[1] / (plastic[0] + plastic[1]), R[j], 1e-6);
            }
          else
            {
              EXPECT_NEAR(plastic[1] / plastic[0], .8988, 1e-6);
            }
        }
    }
}

TEST(MaterialPoint, boundary_conditions_hold)
{
  for (const char *locus : { "Vegter", "Yld2000-2d" })
    {
      const auto sheet = paper::sheet(locus, "Swift");
      for (const double angle : { 0., 30 * degree, 90 * degree })
        {
          const Matrix3 Q = strain_rotation(angle), to_local = Matrix3(strain_rotation(-angle)).transpose();
          for (const auto &s : run_point_test(sheet, PointTest::plane_strain, angle, 0.2, 1, 20))
            {
              EXPECT_NEAR((Q * s.strain)[1], 0, 1e-14);
              EXPECT_NEAR((to_local * s.stress)[2], 0, 1e-7);
            }
          for (const auto &s : run_point_test(sheet, PointTest::shear, angle, 0.2, 1, 20))
            {
              EXPECT_NEAR((to_local * s.stress)[0], 0, 1e-7);
              EXPECT_NEAR((to_local * s.stress)[1], 0, 1e-7);
            }
        }
    }
}

// Stress power = stored + dissipated energy. The plastic work of an increment and the trapezoidal rule are of second
// order on a smooth path, so the error falls by four when the increments are halved. The path starts in the plastic
// range: at the onset of flow the stress has a corner.
TEST(MaterialPoint, energy_balance_is_of_second_order)
{
  for (const char *locus : { "von Mises", "Vegter", "Yld2000-2d" })
    {
      const auto sheet = paper::sheet(locus, "Swift");
      double     error[3];
      for (int k = 0; k < 3; ++k)
        {
          const int                     n = 50 << k;
          std::vector<PrescribedStrain> path{ { 1, Vector3(0.02, 0, 0), "" } };
          for (int i = 1; i <= n; ++i)
            path.push_back({ 1. + i, Vector3(0.02 + 0.1 * i / n, 0.05 * i / n, 0.04 * std::sin(1. * i / n)), "" });
          const auto  states = follow_strain_path(sheet, path);
          const auto &a = states[1], &b = states.back();
          error[k] = b.elastic_energy - a.elastic_energy + b.plastic_work - a.plastic_work
                     - (b.stress_power - a.stress_power);
          EXPECT_LT(std::abs(error[k]), 2e-3 * (b.stress_power - a.stress_power)) << locus;
        }
      EXPECT_LT(std::abs(error[1]), 0.4 * std::abs(error[0])) << locus;
      EXPECT_LT(std::abs(error[2]), 0.4 * std::abs(error[1])) << locus;
    }
}

TEST(MaterialPoint, strain_path_from_a_file)
{
  const TemporaryFile file("time_s,eps_xx,eps_yy,eps_xy\n0,0,0,0\n0.5,0.01,0.005,0.001\n1,0.02,0.01,0\n");
  const auto          path = read_strain_path(file.path);
  ASSERT_EQ(path.size(), 2u);
  EXPECT_EQ(path[0].strain, Vector3(0.01, 0.005, 0.002)); // engineering shear
  const auto states = follow_strain_path(paper::sheet("Hill 1948", "Swift"), path);
  ASSERT_EQ(states.size(), 3u);
  EXPECT_EQ(states[2].strain, path[1].strain);
  EXPECT_GT(states[2].plastic.eps_p, 0.02);
}

TEST(MaterialPoint, wrong_strain_paths_are_refused_with_the_line)
{
  const std::string head = "time_s,eps_xx,eps_yy,eps_xy\n";
  EXPECT_NE(message(head + "0,0,0,0\n\n1,0,0,0\n0.5,0,0,0\n").find(".csv:5"), std::string::npos); // after an empty line
  EXPECT_NE(message(head + "0,0.1,0,0\n").find("strain at time 0"), std::string::npos);
  EXPECT_NE(message(head + "1,nan,0,0\n").find(".csv:2"), std::string::npos);
  EXPECT_NE(message(head + "1,30,0,0\n").find("larger than 3"), std::string::npos);
  EXPECT_NE(message(head + "1,x,0,0\n").find("not a number"), std::string::npos);
  EXPECT_NE(message(head).find("no rows"), std::string::npos);
  EXPECT_NE(message("time_s,eps_xx\n1,0\n").find("eps_yy"), std::string::npos);
  EXPECT_NE(message("").find("empty"), std::string::npos);
}
