#include "film_mesh.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/lubrication/film_transport.h>
#include <tribodraw/lubrication/surface_patch.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace tribodraw;
using Kind = FilmTransport::Kind;
using Data = FilmTransport::NodeData;

namespace
{
  /// One row of elements between the stations xs; nodes 2k and 2k+1 stand at station k.
  struct Row
  {
    std::vector<Eigen::Vector3d>         nodes;
    std::vector<std::array<unsigned, 3>> triangles;

    Row(const std::vector<double> &xs, const double width)
    {
      for (const double x : xs)
        {
          nodes.emplace_back(x, 0, 0);
          nodes.emplace_back(x, width, 0);
        }
      for (unsigned k = 0; k + 1 < xs.size(); ++k)
        {
          const unsigned a = 2 * k;
          if (k % 2 == 0)
            triangles.insert(triangles.end(), { { a, a + 2, a + 3 }, { a, a + 3, a + 1 } });
          else
            triangles.insert(triangles.end(), { { a, a + 2, a + 1 }, { a + 2, a + 3, a + 1 } });
        }
    }
  };

  void
  add_stations(std::vector<double> &xs, const double to, const unsigned n)
  {
    const double from = xs.back();
    for (unsigned i = 1; i <= n; ++i)
      xs.push_back(i == n ? to : from + (to - from) * i / n);
  }

  double
  total(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }
} // namespace

// Exact piecewise solution of the parallel pocket pad: viscosity 0.01 Pa s, U = 1 m/s, gap 1 um, pocket 1.4 um between
// 4 and 10 mm of a length of 20 mm, 0.1 MPa at both ends, cavitation pressure 0. With the cavitated flow q = theta 1.4
// um U/2 the pressure falls linearly to zero on the inlet land: q = U h/2 + h^3 p_a/(12 eta l) = 5.00208333e-7 m^2/s;
// theta = 0.714583; exit land: p_b = 0.35 MPa; load 2457.01 N/m.
TEST(FilmTransport, parallel_pocket_with_jump_of_the_gap)
{
  const double        tiny = 1e-7, u = 1000;
  std::vector<double> errors, exit_errors;
  for (const unsigned n : { 1u, 2u, 4u })
    {
      std::vector<double> xs{ 0. };
      add_stations(xs, 4. - tiny, 20);
      add_stations(xs, 4. + tiny, 1);
      add_stations(xs, 9.9, 60);
      add_stations(xs, 10. - tiny, 50 * n);
      add_stations(xs, 10. + tiny, 1);
      add_stations(xs, 20., 40);
      const Row         row(xs, 1.);
      std::vector<Data> nodes(row.nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        {
          const double x          = row.nodes[i][0];
          nodes[i].film           = x > 4. && x < 10. ? 1.4e-3 : 1e-3;
          nodes[i].viscosity      = 1e-8; // 0.01 Pa s
          nodes[i].sheet_velocity = { u, 0, 0 };
          nodes[i].kind           = x == 0. || x == 20. ? Kind::reservoir : Kind::film;
          nodes[i].fixed_pressure = 0.1;
        }
      const FilmTransport film(row.nodes, row.triangles);
      const auto          result = film.solve(row.nodes, nodes, FilmTransport::steady);
      ASSERT_TRUE(result.converged);
      EXPECT_LT(result.volume_error, 1e-12);
      EXPECT_NEAR(-(result.outflow[0] + result.outflow[1]), 5.00208333e-7 * 1e6, 1e-8); // mm^3/s for 1 mm of width
      double load = 0;
      for (std::size_t k = 0; k + 1 < xs.size(); ++k)
        load += (xs[k + 1] - xs[k]) * 0.5 * (result.pressure[2 * k] + result.pressure[2 * k + 2]);
      const auto exit = static_cast<std::size_t>(std::find(xs.begin(), xs.end(), 10. + tiny) - xs.begin());
      errors.push_back(std::abs(load - 2.45701));
      exit_errors.push_back(std::abs(result.pressure[2 * exit] - 0.35));
      const std::size_t middle = 2 * 40; // about x = 6 mm
      EXPECT_NEAR(result.fill[middle], 0.714583, 1e-6);
      EXPECT_EQ(result.pressure[middle], 0.);
    }
  // The film reforms inside an element: first order. The elements there have 2, 1 and 0.5 um, the full zone 40 um.
  EXPECT_LT(errors[2], 2e-4 * 2.45701);
  EXPECT_LT(exit_errors[2], 3e-3 * 0.35);
  EXPECT_LT(exit_errors[2], 0.65 * exit_errors[1]);
  EXPECT_LT(exit_errors[1], 0.65 * exit_errors[0]);
}

// With a flooded film nothing differs from the average Reynolds equation.
TEST(FilmTransport, flooded_film_is_the_average_reynolds_equation)
{
  const FilmMesh                         mesh(14, 9, 2., 1., 0.15);
  std::vector<AverageReynolds::NodeData> plain(mesh.nodes.size());
  std::vector<Data>                      nodes(mesh.nodes.size());
  for (unsigned i = 0; i < nodes.size(); ++i)
    {
      auto        &d = nodes[i];
      const double x = mesh.nodes[i][0], y = mesh.nodes[i][1];
      d.fixed     = mesh.at_end(i) || mesh.at_side(i);
      d.kind      = d.fixed ? Kind::reservoir : Kind::film;
      d.film      = 2e-3 - 0.5e-3 * x + 1e-4 * y;
      d.viscosity = 3e-8;
      d.phi_p << 0.8, 0.05, 0.05, 0.5;
      d.sq_phi_s << 1e-4 * x, 0, 0, 2e-4;
      d.sheet_velocity = { 60, 5, 0 };
      plain[i]         = d;
    }
  const auto reference = AverageReynolds(mesh.nodes, mesh.triangles).solve(mesh.nodes, plain);
  const auto result    = FilmTransport(mesh.nodes, mesh.triangles).solve(mesh.nodes, nodes, FilmTransport::steady);
  ASSERT_TRUE(result.converged);
  const double p_max = *std::max_element(reference.pressure.begin(), reference.pressure.end());
  ASSERT_GT(p_max, 0);
  for (unsigned i = 0; i < nodes.size(); ++i)
    {
      EXPECT_NEAR(result.pressure[i], reference.pressure[i], 1e-11 * p_max);
      EXPECT_EQ(result.fill[i], 1.);
    }
  EXPECT_NEAR(total(result.outflow), 0., 1e-12 * 60 * 2e-3);
}

// A starved inlet: a wedge that closes from 2 to 1 um over 10 mm receives the flow q = 0.6 um U. Up to x_f it is partly
// filled, theta = 2 q/(U h); from there on h^3 p'/(12 eta) = U h/2 - q, and p = 0 at both ends of the full part gives
// h_f = q/(U - q/h_e) = 1.5 um, x_f = 5 mm.
TEST(FilmTransport, starved_inlet)
{
  const double u = 100, q = 0.6e-3 * u;         // mm^2/s
  for (const unsigned n : { 101u, 201u, 401u }) // odd: x_f lies inside an element
    {
      std::vector<double> xs{ 0. };
      add_stations(xs, 10., n);
      const Row         row(xs, 1.);
      std::vector<Data> nodes(row.nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        {
          const double x          = row.nodes[i][0];
          nodes[i].film           = (2. - x / 10.) * 1e-3;
          nodes[i].viscosity      = 3e-8;
          nodes[i].sheet_velocity = { u, 0, 0 };
          nodes[i].kind           = x == 0. || x == 10. ? Kind::border : Kind::film;
          nodes[i].inflow         = x == 0. ? 0.5 * q : 0.;
        }
      const FilmTransport film(row.nodes, row.triangles);
      const auto          result = film.solve(row.nodes, nodes, FilmTransport::steady);
      ASSERT_TRUE(result.converged);
      EXPECT_LT(result.volume_error, 1e-13);
      EXPECT_NEAR(result.outflow[0] + result.outflow[1], 0., 1e-15); // the inlet takes all
      EXPECT_NEAR(total(result.outflow), q, 1e-12 * q);
      std::size_t k = 2; // the dual cell of the first nodes is cut in half
      for (; result.fill[2 * k] < 1.; ++k)
        {
          EXPECT_EQ(result.pressure[2 * k], 0.);
          // The transport across a face takes the gap at the face, half an element on. The last node fills partly.
          const double at_face = 0.5 * (nodes[2 * k].film + nodes[2 * k + 2].film);
          const double allowed = result.fill[2 * k + 2] < 1. ? 1. / n / n : 1.;
          EXPECT_NEAR(result.fill[2 * k], 2. * q / (u * at_face), allowed);
        }
      EXPECT_NEAR(xs[k], 5., 10. / n);
      // Greatest pressure where U h/2 = q, h = 1.2 um: the integral of p' from 1.5 to 1.2 um.
      const auto antiderivative
          = [&](const double h) { return 12. * 3e-8 * (10. / 1e-3) * (0.5 * u / h - 0.5 * q / (h * h)); };
      const double exact = antiderivative(1.2e-3) - antiderivative(1.5e-3);
      EXPECT_NEAR(*std::max_element(result.pressure.begin(), result.pressure.end()), exact, 0.5 / n * exact);
    }
}

// Lubricant that is carried along: with PhiS = h/Sq (below percolation) it moves with the sheet, so nothing crosses a
// mesh that moves with the sheet, whatever the tool does.
TEST(FilmTransport, trapped_lubricant_moves_with_the_sheet)
{
  const FilmMesh    mesh(8, 8, 1., 1., 0.1);
  std::vector<Data> nodes(mesh.nodes.size());
  for (unsigned i = 0; i < nodes.size(); ++i)
    {
      auto &d          = nodes[i];
      d.film           = 1e-3;
      d.viscosity      = 3e-8;
      d.phi_p          = Eigen::Matrix2d::Identity();
      d.sq_phi_s       = 1e-3 * Eigen::Matrix2d::Identity();
      d.sheet_velocity = d.mesh_velocity = { 40, 10, 0 };
      d.old_volume                       = 1e-6 * (1. + 0.5 * std::sin(i)); // far below the volume of the gap
    }
  const auto result = FilmTransport(mesh.nodes, mesh.triangles).solve(mesh.nodes, nodes, 0.1);
  ASSERT_TRUE(result.converged);
  for (unsigned i = 0; i < nodes.size(); ++i)
    EXPECT_NEAR(result.volume[i], nodes[i].old_volume, 1e-18);
}

// The balance holds in every step of a film that fills, empties, lifts off and leaves the contact. Random, but the same
// for every library: the Mersenne twister and integer arithmetic only.
TEST(FilmTransport, volume_is_conserved_in_all_states)
{
  std::mt19937      random(7);
  const auto        number = [&] { return (random() >> 8) / double(1 << 24); };
  const FilmMesh    mesh(20, 20, 10., 10., 0.15);
  std::vector<Data> nodes(mesh.nodes.size());
  for (unsigned i = 0; i < nodes.size(); ++i)
    {
      auto        &d = nodes[i];
      const double x = mesh.nodes[i][0], y = mesh.nodes[i][1];
      d.kind           = mesh.at_end(i) || mesh.at_side(i) ? Kind::border : x > 7. ? Kind::carried : Kind::film;
      d.viscosity      = 3e-8;
      d.phi_p          = 0.3 * Eigen::Matrix2d::Identity();
      d.sq_phi_s       = 3e-4 * Eigen::Matrix2d::Identity();
      d.sheet_velocity = d.mesh_velocity = { -40. + 10. * y, 30., 0 };
      d.p_limit                          = x < 5. ? 0.5 : 5.;
      d.film                             = 1e-3 * (1. + 0.5 * number());
    }
  const FilmTransport   film(mesh.nodes, mesh.triangles);
  FilmTransport::Result last;
  double                start = 0, left = 0;
  unsigned              n_starved = 0, n_lifted = 0, n_full = 0;
  for (unsigned step = 0; step < 12; ++step)
    {
      for (unsigned i = 0; i < nodes.size(); ++i)
        {
          nodes[i].old_volume = step == 0 ? 0.25e-3 * (0.7 + 0.6 * number()) : last.volume[i];
          start += step == 0 ? nodes[i].old_volume : 0.;
          nodes[i].film *= 0.95 + 0.05 * number(); // asperities flatten
        }
      last = film.solve(mesh.nodes, nodes, 0.01, step == 0 ? nullptr : &last);
      ASSERT_TRUE(last.converged);
      EXPECT_LT(last.volume_error, 1e-13);
      left += 0.01 * total(last.outflow);
      for (unsigned i = 0; i < nodes.size(); ++i)
        {
          EXPECT_GE(last.outflow[i], -1e-12);
          if (nodes[i].kind == Kind::film)
            {
              EXPECT_GE(last.fill[i], -1e-12);
              EXPECT_GE(last.pressure[i], -1e-10);
              EXPECT_LE(last.pressure[i], nodes[i].p_limit * (1 + 1e-9));
              n_starved += last.fill[i] < 1.;
              n_full += last.fill[i] == 1.;
              n_lifted += last.fill[i] > 1.;
              const double expected = last.fill[i] < 1. - 1e-12   ? 0.
                                      : last.fill[i] > 1. + 1e-12 ? nodes[i].p_limit
                                                                  : last.pressure[i];
              EXPECT_EQ(last.pressure[i], expected);
            }
        }
    }
  EXPECT_NEAR(total(last.volume) + left, start, 1e-12 * start);
  // All three states must have been met, else the test shows little.
  EXPECT_GT(n_starved, 100u);
  EXPECT_GT(n_full, 100u);
  EXPECT_GT(n_lifted, 100u);
}

// A sealed film at rest: the volume decides. On the curve the pressure is where g(p) is the film; below g(0) there is
// none; beyond g(p_limit) the gap opens. The curve is steep, flat and steep again (hardened asperities and a strain).
TEST(FilmTransport, sealed_film_takes_the_pressure_of_its_gap)
{
  const FilmMesh    mesh(6, 5, 3., 2., 0.15);
  std::vector<Data> nodes(mesh.nodes.size());
  SurfacePatch      patch(nodes.size(), mesh.triangles);
  patch.move_to(mesh.nodes);
  FilmTransport::GapCurve curve;
  curve.n        = 5;
  curve.pressure = { 0, 2, 5, 9, 10 };
  curve.gap      = { 1e-3, 1.4e-3, 1.401e-3, 1.402e-3, 1.7e-3 };
  EXPECT_DOUBLE_EQ(curve.at(1), 1.2e-3);
  EXPECT_DOUBLE_EQ(curve.at(10), 1.7e-3);
  for (auto &d : nodes)
    {
      d.film      = 1.3e-3;
      d.viscosity = 3e-8;
      d.p_limit   = 10;
      d.closed    = curve;
    }
  const FilmTransport film(mesh.nodes, mesh.triangles);
  const auto          solve = [&](const auto &wanted_film) {
    for (unsigned i = 0; i < nodes.size(); ++i)
      nodes[i].old_volume = wanted_film(i) * patch.nodal_area()[i];
    const auto result = film.solve(mesh.nodes, nodes, 0.01);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(result.volume_error, 1e-13);
    return result;
  };
  for (const double p : { 0.5, 1.9, 3., 6.6, 9.7 })
    for (const double found : solve([&](unsigned) { return curve.at(p); }).pressure)
      EXPECT_NEAR(found, p, 1e-6);
  const auto lifted = solve([](unsigned) { return 1.9e-3; });
  const auto empty  = solve([](unsigned) { return 0.7e-3; });
  for (unsigned i = 0; i < nodes.size(); ++i)
    {
      EXPECT_DOUBLE_EQ(lifted.pressure[i], 10.);
      EXPECT_NEAR(lifted.fill[i], 1.9, 1e-12);
      EXPECT_EQ(empty.pressure[i], 0.);
      EXPECT_NEAR(empty.fill[i], 0.7, 1e-12);
    }
  // Uneven amounts: pressure flow evens them out, and everywhere film and pressure lie on the curve.
  const auto uneven = solve([](const unsigned i) { return 1e-3 * (1.2 + 0.5 * std::sin(3. * i)); });
  for (unsigned i = 0; i < nodes.size(); ++i)
    {
      const double w = uneven.fill[i] * curve.gap[0], p = uneven.pressure[i];
      if (p > 0 && p < 10)
        EXPECT_NEAR(w, curve.at(p), 1e-12);
      else
        EXPECT_TRUE(p == 0 ? w <= 1e-3 * (1 + 1e-12) : w >= 1.7e-3 * (1 - 1e-12)) << w;
    }
}

TEST(FilmTransport, wrong_input_is_named)
{
  const FilmMesh    mesh(2, 2, 1., 1.);
  std::vector<Data> nodes(mesh.nodes.size());
  for (auto &d : nodes)
    {
      d.film      = 1e-3;
      d.viscosity = 3e-8;
    }
  const FilmTransport film(mesh.nodes, mesh.triangles);
  nodes[4].kind = Kind::carried;
  EXPECT_THROW(film.solve(mesh.nodes, nodes, FilmTransport::steady), InputError);
  nodes[4].kind = Kind::film;
  nodes[4].film = 0;
  EXPECT_THROW(film.solve(mesh.nodes, nodes, 1.), InputError);
  nodes[4].film       = 1e-3;
  nodes[4].old_volume = -1;
  EXPECT_THROW(film.solve(mesh.nodes, nodes, 1.), InputError);
}
