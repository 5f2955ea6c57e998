#ifndef tests_film_mesh_h
#define tests_film_mesh_h

#include <tribodraw/lubrication/average_reynolds.h>

#include <cmath>

/// A rectangle [0,a] x [0,b] of nx x ny squares cut into triangles; distortion in parts of the element size.
struct FilmMesh
{
  std::vector<Eigen::Vector3d>         nodes;
  std::vector<std::array<unsigned, 3>> triangles;
  unsigned                             nx, ny;
  double                               a, b;

  FilmMesh(const unsigned nx_, const unsigned ny_, const double a_, const double b_, const double distortion = 0)
      : nx(nx_), ny(ny_), a(a_), b(b_)
  {
    for (unsigned j = 0; j <= ny; ++j)
      for (unsigned i = 0; i <= nx; ++i)
        {
          double x = i, y = j;
          // A fixed irregular pattern: no random numbers, the border keeps its shape.
          if (i > 0 && i < nx)
            x += distortion * std::sin(12.9898 * i + 78.233 * j);
          if (j > 0 && j < ny)
            y += distortion * std::sin(39.425 * i + 7.513 * j + 1.);
          nodes.emplace_back(a * x / nx, b * y / ny, 0.);
        }
    for (unsigned j = 0; j < ny; ++j)
      for (unsigned i = 0; i < nx; ++i)
        {
          const unsigned p = j * (nx + 1) + i, q = p + 1, r = p + nx + 1, s = r + 1;
          if ((i + j) % 2 == 0)
            {
              triangles.push_back({ p, q, s });
              triangles.push_back({ p, s, r });
            }
          else
            {
              triangles.push_back({ p, q, r });
              triangles.push_back({ q, s, r });
            }
        }
  }
  bool
  at_end(const unsigned n) const
  {
    return n % (nx + 1) == 0 || n % (nx + 1) == nx;
  }
  bool
  at_side(const unsigned n) const
  {
    return n / (nx + 1) == 0 || n / (nx + 1) == ny;
  }
};

#endif
