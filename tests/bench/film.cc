// CPU time of the average Reynolds equation: a square slider, assembly and direct solution.
#include "bench.h"

#include <tribodraw/lubrication/average_reynolds.h>
#include <tribodraw/shell/blank_mesh.h>

#include <mpi.h>

using namespace tribodraw;

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  for (const unsigned n : {24u, 100u, 300u})
    {
      const BlankMesh                        mesh = make_quarter_rectangle(10, 10, n, n);
      const AverageReynolds                  reynolds(mesh.nodes, mesh.triangles);
      std::vector<AverageReynolds::NodeData> nodes(mesh.nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        {
          const Eigen::Vector3d &x = mesh.nodes[i];
          nodes[i].fixed           = x[0] <= 1e-9 || x[1] <= 1e-9 || x[0] >= 10 - 1e-9 || x[1] >= 10 - 1e-9;
          nodes[i].film            = 4e-3 - 2e-4 * x[0];
          nodes[i].viscosity       = 3.2e-8;
          nodes[i].sheet_velocity  = {60, 0, 0};
        }
      bench::Timer timer;
      const auto   result = reynolds.solve(mesh.nodes, nodes);
      bench::print_row("film", "square slider, " + std::to_string(nodes.size()) + " nodes", timer.stop());
      std::fprintf(stderr, "load %g N\n", reynolds.load(mesh.nodes, result.pressure));
    }
  MPI_Finalize();
}
