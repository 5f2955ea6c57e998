// CPU time of a whole friction table: the shipped pair (two surfaces of 666 x 666 pixels).
#include "bench.h"

#include <tribodraw/base/parameters.h>
#include <tribodraw/friction_table/builder.h>

#include <mpi.h>

using namespace tribodraw;

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  {
    Parameters   p       = Parameters::from_file(TRIBODRAW_SOURCE_DIR "/prm/friction_table.prm");
    auto         builder = FrictionTableBuilder::read(p);
    bench::Timer timer;
    const auto   table = builder.build();
    bench::print_row("table", "prm/friction_table.prm", timer.stop());
    std::fprintf(stderr, "largest contact fraction %g\n", table.max_contact_fraction());
  }
  MPI_Finalize();
}
