// CPU time of flow factors: the shipped bimodal surface (666 x 666 pixels), full tensors of one separation at a time.
#include "bench.h"

#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/height_distribution.h>
#include <tribodraw/flow_factors/flow_factors.h>
#include <tribodraw/surface/surface.h>

#include <mpi.h>

using namespace tribodraw;

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  {
    Parameters p     = Parameters::from_file(TRIBODRAW_SOURCE_DIR "/prm/flow_factors_bimodal.prm");
    const auto sheet = [&] {
      const auto scope = p.section("Sheet surface");
      return read_surface(p)();
    }();
    const auto model = [&] {
      const auto scope = p.section("Flow factors");
      return read_flow_factors(p);
    }();
    const HeightDistribution heights(sheet);
    for (const double separation : {6., 2., 1., 0.8})
      {
        const double s = heights.cut_height_for_mean_gap(separation * heights.sq());
        bench::Timer timer;
        const auto   factors = model->compute(sheet, {}, heights.sq(), {s}, {});
        const auto   m       = timer.stop();
        std::fprintf(stderr, "h_avg/Sq %g: phi_p_xx %g\n", separation, factors[0].phi_p[0]);
        bench::print_row("micro", "666x666 h_avg/Sq " + std::to_string(separation).substr(0, 3), m);
      }
  }
  MPI_Finalize();
}
