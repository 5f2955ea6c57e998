// CPU time of the average Reynolds equation on a square slider, smooth and rough: assembly and solution. The reference is
// the time that a code with linear triangles and a sparse direct solver takes for a million unknowns, 13 s on one core of
// this class. Arguments: divisions of a side instead of 25 316 999 1999.
#include "bench.h"

#include <tribodraw/base/parallel.h>
#include <tribodraw/lubrication/average_reynolds.h>
#include <tribodraw/shell/blank_mesh.h>

#include <mpi.h>

#include <cmath>
#include <string>
#include <vector>

using namespace tribodraw;

namespace
{
  constexpr double side = 10; // mm

  /// Gap 4 to 2 um, 32 mPa s, 60 mm/s. Rough: full tensors that vary over the surface, as with an oblique lay.
  std::vector<AverageReynolds::NodeData>
  slider(const BlankMesh &mesh, const bool rough)
  {
    std::vector<AverageReynolds::NodeData> nodes(mesh.nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const double x = mesh.nodes[i][0], y = mesh.nodes[i][1];
        auto        &d   = nodes[i];
        d.fixed          = x <= 1e-9 || y <= 1e-9 || x >= side - 1e-9 || y >= side - 1e-9;
        d.film           = 4e-3 - 2e-4 * x;
        d.viscosity      = 3.2e-8;
        d.sheet_velocity = { 60, 0, 0 };
        if (rough)
          {
            const double a = 0.5 + 0.3 * std::sin(2.1 * x) * std::cos(1.7 * y), b = 0.2 * a * std::cos(x + y);
            d.phi_p << a, b, b, 0.7 * a;
            d.sq_phi_s << 6e-4 * a, 5e-5, 5e-5, 4e-4;
          }
      }
    return nodes;
  }
} // namespace

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  std::vector<unsigned> divisions{ 25, 316, 999, 1999 };
  if (argc > 1)
    {
      divisions.clear();
      for (int i = 1; i < argc; ++i)
        divisions.push_back(static_cast<unsigned>(std::stoul(argv[i])));
    }
  for (const unsigned n : divisions)
    {
      const BlankMesh       mesh = make_quarter_rectangle(side, side, n, n);
      const AverageReynolds reynolds(mesh.nodes, mesh.triangles);
      for (const bool rough : { false, true })
        {
          const auto   nodes = slider(mesh, rough);
          bench::Timer timer;
          const auto   result = reynolds.solve(mesh.nodes, nodes);
          if (parallel::rank() == 0)
            bench::print_row("film",
                             std::string(rough ? "rough" : "smooth") + " square slider; " + std::to_string(nodes.size())
                                 + " unknowns",
                             timer.stop(),
                             n == 999 ? std::optional(bench::Reference{ "P1 with a sparse direct solver", 13. })
                                      : std::nullopt);
          const double load = reynolds.load(mesh.nodes, result.pressure);
          if (parallel::rank() == 0)
            std::fprintf(stderr, "load %.12g N, converged %d, steps %u, flux %.1e\n", load, result.converged,
                         result.iterations, result.flux_imbalance);
        }
    }
  MPI_Finalize();
}
