// CPU time of a deep drawing: NUMISHEET'93 square cup, quarter, constant friction 0.144, to 40 mm with 2,592 triangles.
#include "bench.h"

#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/constant_friction.h>
#include <tribodraw/forming/simulation.h>

#include <mpi.h>

using namespace tribodraw;

namespace
{
  const char *const cup = R"(
subsection Blank
  set Length = 150 mm
  set Width = 150 mm
  set Thickness = 0.78 mm
  set Element size = 2.0833333 mm
end
subsection Sheet material
  set Young's modulus = 206 GPa
  set Poisson's ratio = 0.3
  set Yield locus = Hill 1948
  subsection Hill 1948
    set R0 = 1.79
    set R45 = 1.51
    set R90 = 2.27
  end
  set Hardening = Swift
  subsection Swift
    set Strength coefficient = 565.32 MPa
    set Initial strain = 0.007117
    set Hardening exponent = 0.2589
  end
end
subsection Tools
  subsection Die
    set Model = square die
    subsection Square die
      set Width in x = 74 mm
      set Width in y = 74 mm
      set Corner radius = 12 mm
      set Clearance = 0 mm
      set Edge radius = 5 mm
    end
  end
  subsection Punch
    set Model = square punch
    subsection Square punch
      set Width in x = 70 mm
      set Width in y = 70 mm
      set Corner radius = 10 mm
      set Edge radius = 8 mm
    end
  end
end
subsection Process
  set Punch travel = 40 mm
  set Punch speed = 10 mm/s
  set Blank holder force = 19.6 kN
end
)";
} // namespace

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  {
    log::set_level(log::Level::quiet);
    Parameters p  = Parameters::from_text(cup);
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
