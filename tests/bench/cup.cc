// CPU time of a deep drawing: NUMISHEET'93 square cup, quarter, constant friction 0.144, to 40 mm with 2,592 triangles.
#include "bench.h"
#include "unit/forming/square_cup.h"

#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/constant_friction.h>
#include <tribodraw/forming/simulation.h>

#include <mpi.h>

using namespace tribodraw;

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  {
    log::set_level(log::Level::quiet);
    Parameters p  = Parameters::from_text(square_cup);
    const auto in = [&](const char *name, auto read) {
      const auto scope = p.section(name);
      return read(p);
    };
    const auto   blank    = in("Blank", Blank::read);
    const auto   material = std::make_shared<SheetMaterial>(in("Sheet material", SheetMaterial::read));
    const auto   tools    = in("Tools", ToolSet::read);
    const auto   process  = in("Process", Process::read);
    const auto   settings = in("Solver", SolverSettings::read);
    Simulation   simulation(blank, material, tools, process, settings, std::make_unique<ConstantFriction>(0.144));
    bench::Timer timer;
    simulation.run();
    bench::print_row("cup", "square cup 40 mm", timer.stop());
    const auto &r = simulation.record();
    std::fprintf(stderr, "punch force %.1f kN, draw-in %.2f %.2f %.2f mm at %.1f mm\n", 1e-3 * r.punch_force, r.draw_in_x, r.draw_in_y, r.draw_in_diagonal, r.punch_travel);
  }
  MPI_Finalize();
}
